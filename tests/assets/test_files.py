import os
from pathlib import Path

import pytest

from assets.files import LARGEST_FILE, read_bounded, sha256, write_atomically
from farm.errors import AssetError


def test_a_file_is_read_whole(tmp_path: Path) -> None:
    """All bytes of a file are read."""
    path = tmp_path / "file"
    path.write_bytes(b"abc")
    assert read_bounded(path) == b"abc"


def test_an_oversized_file_is_not_read(tmp_path: Path) -> None:
    """A sparse file over the limit is refused by its size alone."""
    path = tmp_path / "huge.png"
    with path.open("wb") as file:
        file.truncate(LARGEST_FILE + 1)
    with pytest.raises(AssetError, match=r"huge\.png: 512 MiB is more than"):
        read_bounded(path)


def test_an_empty_file_is_refused(tmp_path: Path) -> None:
    """An empty file is refused, as nothing can be decoded from it."""
    (tmp_path / "file").touch()
    with pytest.raises(AssetError, match="the file is empty"):
        read_bounded(tmp_path / "file")


def test_a_missing_file_is_an_asset_error(tmp_path: Path) -> None:
    """The error holds the system's reason."""
    with pytest.raises(AssetError, match="No such file"):
        read_bounded(tmp_path / "file")


def test_the_checksum_is_sha256() -> None:
    """The checksum of 'abc' is the published one."""
    assert sha256(b"abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"


def test_a_write_replaces_the_file_and_leaves_nothing_else(tmp_path: Path) -> None:
    """After a write there is only the file with the new content."""
    path = tmp_path / "file"
    write_atomically(path, b"old")
    write_atomically(path, b"new")
    assert path.read_bytes() == b"new"
    assert os.listdir(tmp_path) == ["file"]  # noqa: PTH208  # names alone are wanted


def test_a_failed_write_keeps_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """If the last step fails, the old content stays and the temporary file goes."""
    path = tmp_path / "file"
    write_atomically(path, b"old")

    def refuse(*_: Path) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Path, "replace", refuse)
    with pytest.raises(OSError, match="No space left"):
        write_atomically(path, b"new")
    assert [entry.name for entry in tmp_path.iterdir()] == ["file"]
    assert path.read_bytes() == b"old"
