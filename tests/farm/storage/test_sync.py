"""File systems that can't sync, and disks that fail."""

import errno
import os
from collections.abc import Callable
from pathlib import Path

import pytest

from farm.errors import DestinationError
from farm.storage import LocalStorage

UNSUPPORTED = [errno.EINVAL, errno.ENOTSUP, errno.EOPNOTSUPP, errno.ENOSYS]
LOST = [errno.EIO, errno.ENOSPC, errno.EDQUOT, errno.ESTALE]


def refuse(monkeypatch: pytest.MonkeyPatch, number: int, *, folders: bool) -> None:
    """Have every sync fail, of folders or of files."""
    real: Callable[[int], None] = os.fsync

    def fail(descriptor: int) -> None:
        if Path(f"/proc/self/fd/{descriptor}").resolve().is_dir() == folders:
            raise OSError(number, os.strerror(number))
        real(descriptor)

    monkeypatch.setattr(os, "fsync", fail)


@pytest.mark.parametrize("number", [*UNSUPPORTED, errno.EBADF, errno.EPERM, errno.EACCES, errno.ENOTTY])
def test_folders_that_can_not_be_synced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, number: int) -> None:
    """A share that syncs no folders takes files."""
    refuse(monkeypatch, number, folders=True)
    LocalStorage(tmp_path).write("a/b", b"1")
    assert LocalStorage(tmp_path).read("a/b") == b"1"


@pytest.mark.parametrize("number", UNSUPPORTED)
def test_files_that_can_not_be_synced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, number: int) -> None:
    """A file system without any sync takes files."""
    refuse(monkeypatch, number, folders=False)
    LocalStorage(tmp_path).write("a/b", b"1")
    assert LocalStorage(tmp_path).read("a/b") == b"1"


@pytest.mark.parametrize("number", [errno.EACCES, errno.EPERM, errno.EISDIR, errno.EINVAL])
def test_folders_that_can_not_be_opened(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, number: int) -> None:
    """A folder in which one may write but not look is taken, too."""
    real = os.open

    def fail(path: str, flags: int, mode: int = 0o777) -> int:
        if Path(path) == tmp_path:
            raise OSError(number, os.strerror(number))
        return real(path, flags, mode)

    monkeypatch.setattr(os, "open", fail)
    LocalStorage(tmp_path).write("a", b"1")
    assert (tmp_path / "a").read_bytes() == b"1"


@pytest.mark.parametrize("folders", [True, False])
@pytest.mark.parametrize("number", LOST)
def test_disk_that_fails(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, number: int, folders: bool) -> None:
    """A sync that fails because data may be lost is never passed over."""
    refuse(monkeypatch, number, folders=folders)
    with pytest.raises(DestinationError, match=f"can't write: {os.strerror(number)}"):
        LocalStorage(tmp_path).write("a", b"1")
