"""A stand-in worker, as a program, that receives through the gate."""

import sys
from typing import Any

from celery import signals

from farm.queue import wire
from tests.stand_in import open_stand_in
from worker.command import main


def _keep_only_task(instance: Any, **_: Any) -> None:
    wire.keep_only_task(instance.app)


if __name__ == "__main__":
    wire.install()
    signals.celeryd_init.connect(_keep_only_task, weak=False)
    sys.exit(main(sys.argv[1:], open_stand_in))
