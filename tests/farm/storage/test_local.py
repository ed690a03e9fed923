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


def test_linked_file_is_replaced_by_the_file(tmp_path: Path) -> None:
    """A write replaces a link; what it linked to may be others' and stays as it is."""
    place = tmp_path / "place"
    place.mkdir()
    (tmp_path / "shared").write_bytes(b"theirs")
    (place / "a").symlink_to(tmp_path / "shared")
    LocalStorage(place).write("a", b"mine")
    assert LocalStorage(place).read("a") == b"mine"
    assert not (place / "a").is_symlink()
    assert (tmp_path / "shared").read_bytes() == b"theirs"


def test_removing_a_linked_file(tmp_path: Path) -> None:
    """Removing takes the link away, and leaves what it linked to."""
    place = tmp_path / "place"
    place.mkdir()
    (tmp_path / "shared").write_bytes(b"theirs")
    (place / "a").symlink_to(tmp_path / "shared")
    LocalStorage(place).remove("a")
    assert LocalStorage(place).files() == {}
    assert (tmp_path / "shared").exists()


def test_links_that_lead_back(tmp_path: Path) -> None:
    """A listing ends where links lead to a folder above them."""
    storage = LocalStorage(tmp_path / "place")
    storage.write("far/images/1", b"")
    (tmp_path / "place/far/ring").symlink_to("..")
    (tmp_path / "place/far/self").symlink_to(".")
    (tmp_path / "other").mkdir()
    (tmp_path / "other/back").symlink_to(tmp_path / "place")
    (tmp_path / "place/other").symlink_to(tmp_path / "other")
    assert storage.files().keys() == storage.files("far").keys() == {"far/images/1"}


def test_link_to_itself(tmp_path: Path) -> None:
    """A link that leads nowhere but to itself is told."""
    (tmp_path / "far").symlink_to("far")
    for under in ("", "far"):
        with pytest.raises(DestinationError, match=r"far: can't list: Too many levels of symbolic links"):
            LocalStorage(tmp_path).files(under)


@pytest.mark.parametrize("name", [".#notes.txt", ".lock"])
def test_lock_of_an_editor(tmp_path: Path, name: str) -> None:
    """A hidden link to nothing, by which an editor marks a file, is no data."""
    storage = LocalStorage(tmp_path)
    storage.write("a", b"")
    (tmp_path / name).symlink_to("me@host.1:2")
    assert storage.files().keys() == {"a"}


@pytest.mark.parametrize("name", ["lost+found", ".DS_Store", ".nfs0001", "._a", ".fuse_hidden01", "Thumbs.db"])
def test_what_systems_put_into_folders(tmp_path: Path, name: str) -> None:
    """What file systems and desktops put into a folder is no file of anybody's, so a new disk is empty."""
    (tmp_path / name).mkdir()
    (tmp_path / name / "inside").write_text("")
    assert LocalStorage(tmp_path).is_empty()
    assert LocalStorage(tmp_path).files() == {}


@pytest.fixture
def anchored(tmp_path: Path) -> LocalStorage:
    """A folder that is used only while its file `anchor` is there."""
    LocalStorage(tmp_path / "place").write("anchor", b"")
    storage = LocalStorage(tmp_path / "place", "anchor")
    storage.write("far/1", b"old")
    return storage


@pytest.mark.parametrize("mount_point", [True, False])
def test_mount_that_vanishes(anchored: LocalStorage, tmp_path: Path, mount_point: bool) -> None:
    """Nothing is written, missed or removed beneath a mount that is gone, and no folder is made there."""
    (tmp_path / "place").rename(tmp_path / "away")
    if mount_point:
        (tmp_path / "place").mkdir()
    for act in (
        lambda: anchored.write("far/1", b"new"),
        lambda: anchored.read("far/1"),
        lambda: anchored.files("far"),
        lambda: anchored.remove("far/1"),
    ):
        with pytest.raises(DestinationError, match="its anchor is gone; is its disk mounted"):
            act()
    assert (tmp_path / "place").exists() == mount_point
    assert not mount_point or list((tmp_path / "place").iterdir()) == []
    if mount_point:
        (tmp_path / "place").rmdir()
    (tmp_path / "away").rename(tmp_path / "place")
    assert anchored.read("far/1") == b"old"
    assert anchored.files("near") == {}


def test_anchor_itself_may_be_missing(tmp_path: Path) -> None:
    """Whether the anchor is there can be asked, and it may be put there."""
    storage = LocalStorage(tmp_path / "place", "anchor")
    with pytest.raises(FileNotFoundError):
        storage.read("anchor")
    storage.write("anchor", b"")
    storage.write("a", b"")


def test_file_where_a_dataset_has_a_folder(anchored: LocalStorage, tmp_path: Path) -> None:
    """A file in a folder's place is told, and does not count as a folder without files."""
    (tmp_path / "place/near").write_text("")
    with pytest.raises(DestinationError, match="near is a file, not a folder"):
        anchored.files("near/images")
