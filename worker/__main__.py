"""The worker's program, `python -m worker COMMAND`; the farm starts it as a process of its own."""

import sys
import traceback
from typing import NoReturn

from farm.start import become


def main(arguments: list[str]) -> NoReturn:
    """Run one of the program's commands, and end this process; `farm.start` calls it."""
    from worker.cli import main as run_command  # noqa: PLC0415 - `python -m worker` starts another process first
    from worker.service.exit import end_process  # noqa: PLC0415 - as above

    try:
        exit_code = run_command(arguments)
    except Exception:
        traceback.print_exc()
        exit_code = 1
    end_process(exit_code)


if __name__ == "__main__":
    # This process was started in an environment, and with a path, that may be another program's.
    become("worker.__main__", sys.argv[1:])
