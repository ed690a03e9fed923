"""Listings and files in parts, in every kind of storage, and in one that knows no parts."""

from collections.abc import Callable, Iterator

import pytest

from farm.errors import DestinationError
from farm.storage import Storage, StoredFile, open_storage, read_parts, scan, write_parts

MB = 1_000_000


class Plain:
    """A storage with nothing but `Storage`'s own methods."""

    def __init__(self, storage: Storage) -> None:
        self._storage = storage
        self.location = storage.location
        self.read = storage.read
        self.write = storage.write
        self.create = storage.create
        self.files = storage.files
        self.is_empty = storage.is_empty
        self.remove = storage.remove


@pytest.fixture(params=["as it is", "plain"])
def storage(request: pytest.FixtureRequest, any_store: Callable[[str], str]) -> Storage:
    """An empty place, of each kind, also without methods for parts."""
    opened = open_storage(any_store("place"))
    return opened if request.param == "as it is" else Plain(opened)


def test_scan_is_the_listing(storage: Storage) -> None:
    """A scan yields what a listing holds, of all folders or one, deep or not; of more files than a page has."""
    for number in range(25):
        storage.write(f"far/images/{number}", b"1")
    storage.write("far/more", b"22")
    for under, deep in (("", True), ("", False), ("far", True), ("far", False), ("far/images", True), ("gone", True)):
        assert dict(scan(storage, under, deep=deep)) == storage.files(under, deep=deep)
    assert len(dict(scan(storage, "far"))) == 26


@pytest.mark.parametrize(
    "sizes", [(), (0,), (3, 0, 5), (1, 9 * MB, 9 * MB, 2)], ids=["none", "empty", "small", "large"]
)
def test_parts(storage: Storage, sizes: tuple[int, ...]) -> None:
    """A file that is written in parts is read back as a whole and in parts, in place of an earlier one."""
    parts = [bytes([65 + number]) * size for number, size in enumerate(sizes)]
    storage.write("a/file", b"former")
    assert write_parts(storage, "a/file", iter(parts)) == sum(sizes)
    assert storage.read("a/file") == b"".join(parts)
    assert b"".join(read_parts(storage, "a/file")) == b"".join(parts)
    assert storage.files().keys() == {"a/file"}


def test_missing_file(storage: Storage) -> None:
    """A file that isn't there is told as by a plain read."""
    storage.write("here", b"")
    with pytest.raises(FileNotFoundError):
        list(read_parts(storage, "not/here"))


@pytest.mark.parametrize("before", [0, 20 * MB], ids=["at once", "late"])
def test_parts_that_end_early(any_store: Callable[[str], str], before: int) -> None:
    """If the parts fail, so does the write, and nothing else is there: no half file, and in a folder the former one."""
    location = any_store("place")
    storage = open_storage(location)
    if "memory" in location:
        pytest.skip("a store of a test's own process, which puts a file in place as it is opened")
    storage.write("file", b"former")

    def parts() -> Iterator[bytes]:
        yield bytes(before)
        raise DestinationError("the source is gone")

    with pytest.raises(DestinationError, match="the source is gone"):
        write_parts(storage, "file", parts())
    assert storage.read("file") == b"former"
    assert storage.files().keys() == {"file"}


def test_tags(any_store: Callable[[str], str]) -> None:
    """A bucket's listing has a tag for each content; a folder's has none, as its times are fine enough."""
    storage = open_storage(any_store("place"))
    for name, content in (("a", b"1"), ("b", b"1"), ("c", b"2")):
        storage.write(name, content)
    tags = {path: stored.tag for path, stored in storage.files().items()}
    assert tags["a"] == tags["b"]
    assert (tags["a"] != tags["c"]) == storage.location.startswith("s3")
    assert StoredFile(1, 2.0).tag == ""
