"""Reading and writing asset files: bounded reads, checksums, atomic writes."""

import hashlib
import os
import secrets
from pathlib import Path

from farm.errors import AssetError

LARGEST_FILE = 512 * 2**20
"""Bytes above which a file isn't read at all."""


def read_bounded(path: Path) -> bytes:
    """Read a whole file.

    Args:
        path: The file.

    Returns:
        Its bytes.

    Raises:
        AssetError: It can't be read, is empty or is larger than `LARGEST_FILE`.
    """
    try:
        size = path.stat().st_size
        if size > LARGEST_FILE:
            raise AssetError(
                f"{path}: {size / 2**20:.0f} MiB is more than the {LARGEST_FILE // 2**20} MiB allowed; "
                "use a smaller resolution"
            )
        data = path.read_bytes()
    except OSError as error:
        raise AssetError(f"{path}: can't be read ({error.strerror}); check the file and its permissions") from error
    if not data:
        raise AssetError(f"{path}: the file is empty; copy or download it again")
    return data


def sha256(data: bytes) -> str:
    """SHA-256 of some bytes, 64 hexadecimal digits."""
    return hashlib.sha256(data).hexdigest()


def write_atomically(path: Path, data: bytes) -> None:
    """Write a file so that readers see the old content or the new, never a part.

    Args:
        path: The file; its folder exists.
        data: What it is to hold.

    Raises:
        OSError: It can't be written; nothing is left behind.
    """
    temporary = path.with_name(f".{path.name}.{os.getpid()}.{secrets.token_hex(4)}.part")
    try:
        temporary.write_bytes(data)
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)
