"""Creating and opening datasets."""

from collections.abc import Callable

import pytest

from farm.dataset.dataset import create_dataset, open_dataset, open_for_message
from farm.dataset.destination import Destination, parse_destination
from farm.dataset.header_comparison import first_difference
from farm.dataset.header_file import header_content, parse_header
from farm.dataset.paths import HEADER_FILE
from farm.errors import ConflictError, DestinationError, MessageError
from farm.spec.header import DatasetHeader
from farm.spec.job import Job, JobMessage
from farm.storage import open_storage
from tests.stand_in import stand_in_header


@pytest.fixture
def destination(any_store: Callable[[str], str]) -> Destination:
    """A free place in a store."""
    return Destination(any_store("store"), "cables")


def test_opens_what_was_created(destination: Destination, header: DatasetHeader) -> None:
    """A header is the same after it was written and read, and so is its fingerprint."""
    create_dataset(destination, header)
    assert open_dataset(destination).header == header
    assert open_dataset(destination).identity == parse_header(header_content(header)).identity


def test_same_again(destination: Destination, header: DatasetHeader) -> None:
    """The same description is accepted a second time, even from another version of the farm."""
    create_dataset(destination, header)
    create_dataset(destination, header.model_copy(update={"farm_version": "9.9"}))
    assert open_dataset(destination).header.farm_version == header.farm_version


def test_another_description(destination: Destination, header: DatasetHeader) -> None:
    """Another description is refused with the first key that differs, and changes nothing."""
    create_dataset(destination, header)
    with pytest.raises(ConflictError, match=r"spec\.seed is 0, asked 7"):
        create_dataset(destination, stand_in_header(seed=7))
    assert open_dataset(destination).header == header


def test_foreign_files(destination: Destination, header: DatasetHeader) -> None:
    """A folder with other files in it is left alone."""
    storage = open_storage(destination.location)
    storage.write("letter.txt", b"dear reader")
    with pytest.raises(ConflictError, match=HEADER_FILE):
        create_dataset(destination, header)
    assert list(storage.files()) == ["letter.txt"]


@pytest.mark.parametrize("content", [b"", b"{", b"[]", b'{"format": 2}', b"\xff\xfe"])
def test_damaged_header(destination: Destination, header: DatasetHeader, content: bytes) -> None:
    """A header that can't be read is refused and not replaced."""
    open_storage(destination.location).write(HEADER_FILE, content)
    with pytest.raises(ConflictError):
        create_dataset(destination, header)
    assert open_storage(destination.location).read(HEADER_FILE) == content


def test_no_dataset(destination: Destination) -> None:
    """Opening an empty place names what is missing."""
    with pytest.raises(DestinationError, match="no dataset here"):
        open_dataset(destination)


def test_message_of_another_description(destination: Destination, header: DatasetHeader) -> None:
    """A worker refuses a job that was submitted for another description."""
    create_dataset(destination, header)
    message = JobMessage(dataset="cables", spec_sha256="1" * 64, job_id="far-000000")
    with pytest.raises(MessageError, match="submit again"):
        open_for_message(destination.store, message)


def test_message_beyond_the_quota(destination: Destination, header: DatasetHeader) -> None:
    """A worker refuses a job that the dataset doesn't ask for."""
    dataset = create_dataset(destination, header)
    with pytest.raises(MessageError, match="quotas"):
        open_for_message(destination.store, dataset.message(Job.from_id("far-000002")))


@pytest.mark.parametrize("out", ["/", "..", ".hidden", "a b", "s3://bucket/.x", "ä", "x" * 101])
def test_bad_names(out: str, tmp_path: object, monkeypatch: pytest.MonkeyPatch) -> None:
    """A place whose last part can't be a dataset's name is refused."""
    del tmp_path
    monkeypatch.chdir("/")
    with pytest.raises(DestinationError, match="name"):
        parse_destination(out)


@pytest.mark.parametrize("out", ["s3://bucket", "s3://bucket/", "s3://", "s3:///cables", "memory://cables"])
def test_url_without_a_folder(out: str) -> None:
    """A URL that ends with its bucket has no place for a dataset, and never becomes a local folder."""
    with pytest.raises(DestinationError, match="names no folder"):
        parse_destination(out)


def test_destination_of_a_url() -> None:
    """A URL is split at its last part."""
    assert parse_destination("s3://bucket/data/cables/") == Destination("s3://bucket/data", "cables")


def test_first_difference() -> None:
    """The difference is named by its path; equal values have none."""
    assert first_difference({"a": [1, {"b": 2}]}, {"a": [1, {"b": 3}]}) == "a[1].b is 2, asked 3"
    assert first_difference({"a": [1]}, {"a": [1, 2]}) == "a has 1 entries, asked 2"
    assert first_difference({"a": 1}, {"a": 1}) == ""
