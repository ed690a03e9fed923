"""A coordinator as a program: queues what is missing, then becomes `farm watch`. Argument: the dataset's folder."""

import os
import sys
from typing import NoReturn

from farm.cli.connection import coordinator_of
from farm.dataset import open_dataset, parse_destination
from farm.errors import FarmError
from farm.queue.broker import broker_url, connect


def main(place: str) -> NoReturn:
    """Queue what is missing, as often as a supervisor starts this."""
    try:
        url = broker_url(None)
        client = connect(url)
        coordinator_of(open_dataset(parse_destination(place)), url, client).submit_missing()
    except FarmError as error:
        sys.stderr.write(f"{error}\n")
        sys.exit(error.exit_code)
    os.execv(sys.executable, [sys.executable, "-P", "-m", "farm", "watch", place])  # noqa: S606 - no shell is wanted


if __name__ == "__main__":
    main(sys.argv[1])
