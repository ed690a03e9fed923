"""What the farm starts as a process of its own: `python -m worker serve` and `python -m worker preview`."""

import sys

from worker.command import main

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
