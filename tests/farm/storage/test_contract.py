"""One suite over every kind of storage: a folder, memory, and a bucket of a real object store."""

from collections.abc import Callable

import pytest

from farm.storage import Storage, is_temporary, open_storage


@pytest.fixture
def storage(any_store: Callable[[str], str]) -> Storage:
    """An empty place."""
    return open_storage(any_store("place"))


def test_reads_back(storage: Storage) -> None:
    """A written file is read back, and its folders are made."""
    storage.write("a/b/c.bin", b"\x00\x01")
    assert storage.read("a/b/c.bin") == b"\x00\x01"


def test_replaces(storage: Storage) -> None:
    """A second write replaces the first."""
    storage.write("a", b"first and longer")
    storage.write("a", b"second")
    assert storage.read("a") == b"second"


def test_creates_once(storage: Storage) -> None:
    """Of several that create a file, the first succeeds, and the file stays as it made it."""
    storage.write("header", b"there")
    assert storage.create("mark", b"first")
    assert not storage.create("mark", b"second")
    assert storage.read("mark") == b"first"


def test_missing_file(storage: Storage) -> None:
    """A file that isn't there is distinguished from one that can't be read."""
    storage.write("here", b"")
    with pytest.raises(FileNotFoundError):
        storage.read("not/here")


def test_lists_sizes(storage: Storage) -> None:
    """A listing has every file of every folder with its size, and nothing else."""
    storage.write("a/one", b"1")
    storage.write("two", b"22")
    assert {path: stored.bytes for path, stored in storage.files().items()} == {"a/one": 1, "two": 2}


def test_lists_age(storage: Storage) -> None:
    """A listing has the time at which a file was written."""
    storage.write("a", b"1")
    assert storage.files()["a"].modified_s > 1.6e9


def test_place_that_is_not_there(storage: Storage) -> None:
    """A folder that does not exist has no files and is empty."""
    assert storage.files() == {}
    assert storage.is_empty()


def test_is_empty_until_written(storage: Storage) -> None:
    """A place with a file is not empty, even if the file is below a folder."""
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


def test_lists_one_folder(storage: Storage) -> None:
    """A listing of one folder has the files below it, subfolders included, by the same paths as the whole listing."""
    for path in ("far/images/1", "far/images/more/2", "far/images2/3", "far/image", "images/4"):
        storage.write(path, b"")
    assert storage.files("far/images").keys() == {"far/images/1", "far/images/more/2"}
    assert storage.files("far/images").items() <= storage.files().items()


def test_lists_folder_that_is_not_there(storage: Storage) -> None:
    """A folder that doesn't exist has no files, even if others begin with its name, or a file has it."""
    storage.write("far2/1", b"")
    storage.write("near", b"")
    assert storage.files("far") == {}
    assert storage.files("near") == {}
    assert storage.files("far/deeper") == {}


def test_lists_its_own_folder_alone(any_store: Callable[[str], str]) -> None:
    """A listing omits the files of a place whose name begins with this one's."""
    open_storage(any_store("place2")).write("a", b"")
    storage = open_storage(any_store("place"))
    assert storage.files() == {}
    assert storage.is_empty()


def test_lists_many(storage: Storage) -> None:
    """A listing that a store gives in several pages is complete."""
    paths = {f"a/{number:02d}" for number in range(45)}
    for path in paths:
        storage.write(path, b"")
    assert storage.files().keys() == storage.files("a").keys() == paths


def test_odd_names(storage: Storage) -> None:
    """A path with characters that mean something in URLs is a path like others."""
    path = "a b/c+d%20?e=1&f#g/ä.bin"
    storage.write(path, b"1")
    assert storage.files().keys() == {path}
    assert storage.read(path) == b"1"
    storage.remove(path)
    assert storage.files() == {}
