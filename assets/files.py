"""Reading and writing asset files: bounded reads, checksums, atomic writes."""

import hashlib
import os
import secrets
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from io import BufferedReader
from pathlib import Path
from typing import Annotated

from pydantic import Field

from farm.errors import AssetError

Checksum = Annotated[str, Field(pattern=r"^[0-9a-f]{64}$")]
"""SHA-256 of a file's content, as hexadecimal digits."""

LARGEST_FILE = 512 * 2**20
"""Bytes above which a file isn't read at all."""


def read_bounded(path: Path) -> bytes:
    """Read a whole file.

    Args:
        path: The file.

    Returns:
        Its bytes.

    Raises:
        AssetError: It can't be read, is no regular file, is empty or is larger than `LARGEST_FILE`.
    """
    with _opened(path) as file:
        size = os.fstat(file.fileno()).st_size
        if size > LARGEST_FILE:
            raise AssetError(
                f"{path}: {size / 2**20:.0f} MiB is more than the {LARGEST_FILE // 2**20} MiB allowed; "
                "use a smaller resolution"
            )
        # A file that grows meanwhile is read no further than the limit.
        data = file.read(LARGEST_FILE)
    return _filled(path, data)


def read_start(path: Path, length: int) -> bytes:
    """Read the first bytes of a file.

    Args:
        path: The file.
        length: Bytes to read at most.

    Returns:
        As many as asked for, or all that there are.

    Raises:
        AssetError: It can't be read, is no regular file, or is empty.
    """
    with _opened(path) as file:
        data = file.read(length)
    return _filled(path, data)


@contextmanager
def _opened(path: Path) -> Iterator[BufferedReader]:
    try:
        with open_regular(path) as file:
            yield file
    except OSError as error:
        raise AssetError(f"{path}: can't be read ({error.strerror}); check the file and its permissions") from error


def _filled(path: Path, data: bytes) -> bytes:
    if not data:
        raise AssetError(f"{path}: the file is empty; copy or download it again")
    return data


def open_regular(path: Path) -> BufferedReader:
    """Open a file for reading; a link is followed.

    Raises:
        AssetError: It is a device, pipe or the like, which may have no end or never begin.
        OSError: It can't be opened.
    """
    # Without this flag opening a pipe waits for somebody to write to it.
    descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
    if not stat.S_ISREG(os.fstat(descriptor).st_mode):
        os.close(descriptor)
        raise AssetError(f"{path}: isn't a regular file; name one")
    return os.fdopen(descriptor, "rb")


def sha256(data: bytes) -> str:
    """Compute the SHA-256 of some bytes, 64 hexadecimal digits."""
    return hashlib.sha256(data).hexdigest()


def write_atomically(path: Path, data: bytes) -> None:
    """Write a file so that readers see the old content or the new, never a part.

    Args:
        path: The file; its folder exists.
        data: Content to write.

    Raises:
        OSError: It can't be written; nothing is left behind.
    """
    temporary = path.with_name(f".{path.name}.{os.getpid()}.{secrets.token_hex(4)}.part")
    try:
        temporary.write_bytes(data)
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)
