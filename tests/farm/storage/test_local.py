"""Behaviour of a folder alone."""

import hashlib
import os
import stat
from pathlib import Path

import pytest

from farm.errors import DestinationError
from farm.storage import LocalStorage


def test_failed_write_keeps_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """If the disk fails in the middle, the earlier content stays and nothing lies beside it."""
    storage = LocalStorage(tmp_path)
    storage.write("a", b"old")

    def full(_descriptor: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(DestinationError, match="No space left"):
        storage.write("a", b"new")
    assert [path.name for path in tmp_path.iterdir()] == ["a"]
    assert storage.read("a") == b"old"


def test_write_that_reads_back_wrong(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """If a disk returns other bytes than were written, the file isn't put in place."""
    storage = LocalStorage(tmp_path)
    monkeypatch.setattr(hashlib, "file_digest", lambda _file, _kind: hashlib.sha256(b"rotten"))
    with pytest.raises(DestinationError, match="reads back other than written"):
        storage.write("a", b"fresh")
    assert list(tmp_path.iterdir()) == []


def test_place_that_is_a_file(tmp_path: Path) -> None:
    """Writing below a file is refused in one line that names the place."""
    (tmp_path / "file").write_text("")
    with pytest.raises(DestinationError, match=r"file/a/b: can't write"):
        LocalStorage(tmp_path / "file").write("a/b", b"")


def test_files_can_be_read_by_others(tmp_path: Path) -> None:
    """Permissions follow the umask, as other programs' do."""
    LocalStorage(tmp_path).write("a", b"")
    plain = tmp_path / "plain"
    plain.write_bytes(b"")
    assert stat.S_IMODE((tmp_path / "a").stat().st_mode) == stat.S_IMODE(plain.stat().st_mode)
