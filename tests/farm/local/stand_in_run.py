"""A run with stand-in workers as a program of its own, for tests that stop it: DATASET LOGS WORKER."""

import sys
from pathlib import Path

from farm.cli import end_on_signals
from farm.dataset.destination import parse_destination
from farm.local.run import LocalRun, run_locally
from farm.run.worker_settings import RendererSettings
from tests.stand_in import stand_in_header

if __name__ == "__main__":
    end_on_signals()
    run_locally(
        parse_destination(sys.argv[1]),
        stand_in_header(),
        LocalRun(
            workers=2,
            renderer=RendererSettings(),
            logs=Path(sys.argv[2]),
            worker_command=[sys.executable, "-P", sys.argv[3]],
        ),
    )
