"""A file in memory that has a path, for libraries that read or write only what has one: no disk takes part."""

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from farm.errors import DestinationError

_DESCRIPTORS = Path("/proc/self/fd")
"""Folder in which Linux shows the open files of a process."""


class MemoryFile:
    """An empty file that another library in this process may write.

    Attributes:
        path: path of the file, in this process alone; it has no suffix.
    """

    def __init__(self, descriptor: int) -> None:
        self._descriptor = descriptor
        folder = _DESCRIPTORS if _DESCRIPTORS.is_dir() else Path("/dev/fd")
        self.path = folder / str(descriptor)

    def content(self) -> bytes:
        """Read all that was written."""
        with open(os.dup(self._descriptor), "rb") as file:  # noqa: PTH123 - a descriptor, no path
            file.seek(0)
            return file.read()


@contextmanager
def memory_file() -> Iterator[MemoryFile]:
    """Make a file that is gone after `with`; where the system has none in memory, it is one without a name on disk.

    Raises:
        DestinationError: if it can't be made.
    """
    try:
        descriptor = os.memfd_create("cable-farm") if hasattr(os, "memfd_create") else _nameless()
    except OSError as error:
        raise DestinationError(f"can't make a file for a picture: {error.strerror}; name a folder by TMPDIR") from error
    try:
        yield MemoryFile(descriptor)
    finally:
        os.close(descriptor)


def _nameless() -> int:
    with tempfile.TemporaryFile() as file:
        return os.dup(file.fileno())
