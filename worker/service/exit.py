"""Ending a process that has had Blender in it."""

import os
import sys
from typing import NoReturn


def end_process(exit_code: int) -> NoReturn:
    """Write out what was printed, and end this process at once.

    Blender 4.5 may hang in an ordinary exit: the destructor of its file cache waits for a thread that waits for it.
    """
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(exit_code)
