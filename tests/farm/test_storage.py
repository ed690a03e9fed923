"""One suite over both kinds of storage."""

import os
import stat
from collections.abc import Callable
from pathlib import Path

import pytest

from farm.errors import DestinationError, FarmError
from farm.storage import LocalStorage, Storage, is_temporary, open_storage


@pytest.fixture
def storage(any_store: Callable[[str], str]) -> Storage:
    """An empty place."""
    return open_storage(any_store("place"))


def test_reads_back(storage: Storage) -> None:
    """What was written is read, folders being made on the way."""
    storage.write("a/b/c.bin", b"\x00\x01")
    assert storage.read("a/b/c.bin") == b"\x00\x01"


def test_replaces(storage: Storage) -> None:
    """A second write takes the first one's place."""
    storage.write("a", b"first and longer")
    storage.write("a", b"second")
    assert storage.read("a") == b"second"


def test_missing_file(storage: Storage) -> None:
    """A file that is not there is told apart from one that can't be read."""
    storage.write("here", b"")
    with pytest.raises(FileNotFoundError):
        storage.read("not/here")


def test_lists_sizes(storage: Storage) -> None:
    """A listing has every file of every folder with its size, and nothing else."""
    storage.write("a/one", b"1")
    storage.write("two", b"22")
    assert {path: stored.bytes for path, stored in storage.files().items()} == {"a/one": 1, "two": 2}


def test_lists_age(storage: Storage) -> None:
    """A listing tells when a file was written."""
    storage.write("a", b"1")
    assert storage.files()["a"].modified_s > 1.6e9


def test_place_that_is_not_there(storage: Storage) -> None:
    """A folder that does not exist has no files and is empty."""
    assert storage.files() == {}
    assert storage.is_empty()


def test_is_empty_until_written(storage: Storage) -> None:
    """A file makes a place not empty, even below a folder."""
    storage.write("a/b", b"")
    assert not storage.is_empty()


def test_removes(storage: Storage) -> None:
    """A removed file is gone, and removing it again is no error."""
    storage.write("a", b"1")
    storage.remove("a")
    storage.remove("a")
    assert storage.files() == {}


def test_write_leaves_no_temporary_file(storage: Storage) -> None:
    """After a write the folder holds the file alone."""
    storage.write("a", b"1")
    assert not [path for path in storage.files() if is_temporary(path)]


def test_failed_write_keeps_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """When the disk gives out in the middle, the former content stays and nothing lies beside it."""
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
    """A disk that returns other bytes than were written never gets its file into place."""
    storage = LocalStorage(tmp_path)
    monkeypatch.setattr(Path, "read_bytes", lambda _path: b"rotten")
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


@pytest.mark.parametrize("location", ["nosuch://bucket/a", "hdfs:///a"])
def test_unknown_kind(location: str) -> None:
    """A URL whose kind is unknown, or whose package is not installed, is refused by a foreseen error."""
    with pytest.raises(FarmError):
        open_storage(location).files()
