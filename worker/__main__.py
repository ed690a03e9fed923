"""The worker's program, `python -m worker COMMAND`; the farm starts it as a process of its own."""

import sys
import traceback

from worker.cli import main
from worker.service.exit import end_process

if __name__ == "__main__":
    try:
        exit_code = main(sys.argv[1:])
    except Exception:
        traceback.print_exc()
        exit_code = 1
    end_process(exit_code)
