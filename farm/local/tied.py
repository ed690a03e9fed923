"""Ties a process to its parent's life. As a program: `python -I .../tied.py PARENT PROGRAM ARGUMENTS...`.

A coordinator that is killed by SIGKILL can't end its children. On Linux the kernel ends them; elsewhere they go on.
"""

import ctypes
import os
import signal
import sys
from pathlib import Path

_PR_SET_PDEATHSIG = 1  # from linux/prctl.h


def die_with_parent(parent: int) -> None:
    """Ask the kernel to kill this process when its parent ends.

    Args:
        parent: process id of the parent; if it has ended already, this process ends at once.

    Raises:
        OSError: if the kernel refuses.
    """
    if not sys.platform.startswith("linux"):
        return
    libc = ctypes.CDLL(None, use_errno=True)
    if libc.prctl(_PR_SET_PDEATHSIG, int(signal.SIGKILL), 0, 0, 0) != 0:
        raise OSError(ctypes.get_errno(), "prctl(PR_SET_PDEATHSIG) failed")
    if os.getppid() != parent:
        os.kill(os.getpid(), signal.SIGKILL)


def tied(command: list[str]) -> list[str]:
    """Build the command that runs `command` as a child tied to the calling process."""
    # Named by its path, it needs no package; isolated, it is the same whatever the environment that it hands on.
    return [sys.executable, "-I", str(Path(__file__).resolve()), str(os.getpid()), *command]


def main(arguments: list[str]) -> None:
    """Tie this process, then become the program."""
    die_with_parent(int(arguments[0]))
    os.execvp(arguments[1], arguments[1:])  # noqa: S606 - no shell is wanted


if __name__ == "__main__":
    main(sys.argv[1:])
