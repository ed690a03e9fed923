"""Asks the system to bring a file or folder to the disk; where a file system has no such thing, nothing is lost."""

import errno
import os
from collections.abc import Collection
from pathlib import Path

_NO_SYNC = frozenset({errno.EINVAL, errno.ENOTSUP, errno.EOPNOTSUPP, errno.ENOSYS})
"""Errors by which a file system says that it can't sync: Linux gives EINVAL for one without that operation."""

_NO_SYNC_OF_FOLDERS = _NO_SYNC | {errno.EBADF, errno.EPERM, errno.EACCES, errno.ENOTTY}
"""Errors by which a file system says that it syncs no folders; shares of virtual machines and some in user space do.
EIO, ENOSPC and EDQUOT are none: they tell of lost data."""

_NO_OPENING = frozenset({errno.EACCES, errno.EPERM, errno.EISDIR, *_NO_SYNC})
"""Errors of opening a folder to sync it, where it may be written but not read, or can't be opened at all."""


def sync_file(descriptor: int) -> None:
    """Bring an open file's content to the disk.

    Raises:
        OSError: if the content may be lost.
    """
    _sync(descriptor, _NO_SYNC)


def sync_folder(folder: Path) -> None:
    """Bring a folder's entries to the disk.

    Raises:
        OSError: if they may be lost.
    """
    try:
        descriptor = os.open(folder, os.O_RDONLY)
    except OSError as error:
        if error.errno in _NO_OPENING:
            return
        raise
    try:
        _sync(descriptor, _NO_SYNC_OF_FOLDERS)
    finally:
        os.close(descriptor)


def _sync(descriptor: int, passed_over: Collection[int]) -> None:
    try:
        os.fsync(descriptor)
    except OSError as error:
        if error.errno not in passed_over:
            raise
