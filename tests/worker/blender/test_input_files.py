"""Finding a dataset's input files by their content."""

import os
from pathlib import Path

import pytest

from assets.files import sha256
from farm.errors import AssetError
from farm.spec.header import FileRef
from worker.blender.input_files import InputFiles

CONTENT = b"a photograph"


@pytest.fixture
def gone(tmp_path: Path) -> FileRef:
    """A file that is not where the header says."""
    return FileRef(path=str(tmp_path / "elsewhere" / "lab.jpg"), sha256=sha256(CONTENT))


def write(path: Path, content: bytes = CONTENT) -> Path:
    """Write a file and the folders above it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)
    return path


def test_the_headers_path_comes_first(tmp_path: Path) -> None:
    """A file that is where the header says is taken from there."""
    path = write(tmp_path / "lab.jpg")
    write(tmp_path / "other" / "lab.jpg")
    assert InputFiles([tmp_path / "other"]).find(FileRef(path=str(path), sha256=sha256(CONTENT))) == path


@pytest.mark.parametrize("there", ["b/lab.jpg", "b/deep/down/lab.jpg", "b/renamed.JPG", "b/deep/another name.jpg"])
def test_a_moved_or_renamed_file_is_found(tmp_path: Path, gone: FileRef, there: str) -> None:
    """A file is found below each of the folders, also under another name."""
    for number in range(3):
        write(tmp_path / "a" / f"{number}.jpg", b"another")
    path = write(tmp_path / there)
    assert InputFiles([tmp_path / "a", tmp_path / "b"]).find(gone) == path


def test_a_changed_file_is_found_elsewhere(tmp_path: Path) -> None:
    """What stands at the header's path with another content counts for nothing."""
    changed = write(tmp_path / "lab.jpg", b"changed")
    path = write(tmp_path / "other" / "lab.jpg")
    assert InputFiles([tmp_path / "other"]).find(FileRef(path=str(changed), sha256=sha256(CONTENT))) == path


def test_a_place_may_be_a_file(tmp_path: Path, gone: FileRef) -> None:
    """A template is named itself, not its folder."""
    path = write(tmp_path / "mine.jpg")
    assert InputFiles([path]).find(gone) == path


def test_links_are_followed_once(tmp_path: Path, gone: FileRef) -> None:
    """A folder may be a link, and links may lead in a circle."""
    write(tmp_path / "real" / "lab.jpg")
    (tmp_path / "a").mkdir()
    (tmp_path / "a" / "link").symlink_to(tmp_path / "real")
    (tmp_path / "real" / "back").symlink_to(tmp_path / "a")
    (tmp_path / "a" / "loop.jpg").symlink_to(tmp_path / "a" / "loop.jpg")
    found = InputFiles([tmp_path / "a"]).find(gone)
    assert found == tmp_path / "a" / "link" / "lab.jpg"


def test_devices_and_pipes_are_passed_over(tmp_path: Path, gone: FileRef) -> None:
    """Nothing but regular files is opened, and another content is never taken."""
    (tmp_path / "a").mkdir()
    (tmp_path / "a" / "lab.jpg").symlink_to("/dev/zero")
    os.mkfifo(tmp_path / "a" / "pipe.jpg")
    write(tmp_path / "a" / "other.jpg", b"another")
    with pytest.raises(AssetError):
        InputFiles([tmp_path / "a"]).find(gone)


def test_the_error_tells_what_to_do(tmp_path: Path, gone: FileRef) -> None:
    """It names the file, the start of its checksum, where it was looked for, and the option."""
    with pytest.raises(AssetError) as refused:
        InputFiles([tmp_path / "a", tmp_path / "b"]).find(gone)
    for part in (gone.path, gone.sha256[:12], f"{tmp_path / 'a'}, {tmp_path / 'b'}", "--inputs", "FARM_INPUTS"):
        assert part in str(refused.value)


def test_a_file_is_read_once_unless_it_changes(tmp_path: Path, gone: FileRef) -> None:
    """Folders hold other files, and are looked through for each file that is missing."""
    files, other = InputFiles([tmp_path / "a"]), write(tmp_path / "a" / "other.jpg", b"1 photograph")
    stamp = other.stat()
    with pytest.raises(AssetError):
        files.find(gone)
    # The same length and time: only a second reading would see the change.
    other.write_bytes(CONTENT)
    os.utime(other, ns=(stamp.st_atime_ns, stamp.st_mtime_ns))
    with pytest.raises(AssetError):
        files.find(gone)
    os.utime(other, ns=(0, 0))
    assert files.find(gone) == other


def test_a_file_that_was_found_stays_found(tmp_path: Path, gone: FileRef) -> None:
    """Thousands of pictures use a file, which is looked for once."""
    path = write(tmp_path / "a" / "lab.jpg")
    files = InputFiles([tmp_path / "a"])
    assert files.once_checked(gone) == path
    path.unlink()
    assert files.once_checked(gone) == path
