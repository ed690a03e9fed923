"""The log of a process: all its output, that of Blender's C code included, at the end of one file."""

import os
import sys
from pathlib import Path

from farm.errors import DestinationError

_MAX_BYTES = 16 * 1024 * 1024
"""Size above which a log is emptied before more is written to it."""


def prepare_log(folder: Path, name: str) -> Path:
    """Make a folder for logs, and a log file in it.

    Returns:
        The log file, which can be written.

    Raises:
        DestinationError: if the file can't be written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / name).open("ab").close()
    except OSError as error:
        raise DestinationError(
            f"{folder}: can't write logs: {error.strerror}; name another folder by --logs"
        ) from error
    return folder / name


def send_output_to(log_file: Path) -> None:
    """Send all that this process prints from now on to the end of a file, which is emptied first if it is large."""
    sys.stdout.flush()
    sys.stderr.flush()
    too_large = log_file.exists() and log_file.stat().st_size > _MAX_BYTES
    flags = os.O_WRONLY | os.O_CREAT | os.O_APPEND | (os.O_TRUNC if too_large else 0)
    descriptor = os.open(log_file, flags, 0o644)
    os.dup2(descriptor, 1)
    os.dup2(descriptor, 2)
    os.close(descriptor)
