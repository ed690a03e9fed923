"""The id that tells a dataset's folder from every other."""

import shutil
import threading
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from farm.dataset import place
from farm.dataset.dataset import Dataset, create_dataset
from farm.dataset.destination import Destination
from farm.dataset.paths import PLACE_FILE
from farm.dataset.place import claim_place, is_elsewhere, locate, read_place, renew_place
from farm.dataset.verify import Fault, verify
from farm.spec.header import DatasetHeader
from farm.storage import LocalStorage, open_storage


def test_id_is_drawn_once(any_store: Callable[[str], str], header: DatasetHeader) -> None:
    """In a folder and in a bucket, a place has no id until one is claimed, and then the same for all."""
    dataset = create_dataset(Destination(any_store("store"), "cables"), header)
    assert read_place(dataset.storage) == ""
    first = claim_place(dataset.storage)
    assert first == claim_place(dataset.storage) == read_place(dataset.storage) != ""
    assert renew_place(dataset.storage) == claim_place(dataset.storage) != first


def test_claims_at_once_agree(dataset: Dataset) -> None:
    """Coordinators that claim a place at the same moment get the same id."""
    start, found = threading.Barrier(8), set()

    def claim() -> None:
        start.wait()
        found.add(claim_place(dataset.storage))

    threads = [threading.Thread(target=claim) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == {read_place(dataset.storage)}


@pytest.mark.parametrize("content", [b"", b"no id\n", b"\xff" * 17])
def test_id_of_a_killed_writer(dataset: Dataset, content: bytes, monkeypatch: pytest.MonkeyPatch) -> None:
    """An id that nobody ends to write counts for none, and is replaced."""
    monkeypatch.setattr(place, "_PATIENCE_S", 0.0)
    dataset.storage.write(PLACE_FILE, content)
    assert read_place(dataset.storage) == ""
    assert claim_place(dataset.storage) == read_place(dataset.storage) != ""


def test_id_is_a_part_of_the_dataset(dataset: Dataset) -> None:
    """`farm verify` finds nothing extra in a folder with an id."""
    claim_place(dataset.storage)
    assert {finding.fault for finding in verify(dataset).findings} == {Fault.MISSING}


def at(path: Path, dataset: Dataset) -> Dataset:
    """The dataset in another folder."""
    return replace(dataset, storage=LocalStorage(path))


def test_copy_is_elsewhere(dataset: Dataset, tmp_path: Path) -> None:
    """A copied folder is known by its original, and the original by its copy, as long as they have one id."""
    claim_place(dataset.storage)
    shutil.copytree(dataset.storage.location, tmp_path / "b/cables")
    copy = at(tmp_path / "b/cables", dataset)
    assert is_elsewhere(locate(dataset), copy)
    assert is_elsewhere(locate(copy), dataset)
    renew_place(copy.storage)
    assert not is_elsewhere(locate(dataset), copy)


def test_same_place_by_other_ways(dataset: Dataset, tmp_path: Path) -> None:
    """A folder that was moved, is reached by a link, or lies on another machine is no copy."""
    claim_place(dataset.storage)
    was = locate(dataset)
    (tmp_path / "link").symlink_to(dataset.storage.location)
    assert not is_elsewhere(was, dataset)
    assert not is_elsewhere("", dataset)
    assert not is_elsewhere(was, at(tmp_path / "link", dataset))
    assert not is_elsewhere(f"elsewhere:{tmp_path}", dataset)
    shutil.move(dataset.storage.location, tmp_path / "moved")
    assert not is_elsewhere(was, at(tmp_path / "moved", dataset))


@pytest.mark.parametrize(
    ("located", "elsewhere"),
    [("s3://one/cables", False), ("s3://other/cables", True), ("sftp://one/cables", False), ("m:/mnt/cables", False)],
)
def test_buckets_are_compared_by_name(
    dataset: Dataset, monkeypatch: pytest.MonkeyPatch, located: str, elsewhere: bool
) -> None:
    """Two folders of buckets with one id are a copy of each other; a mount and other servers may be the same place."""
    storage = open_storage("memory://one/cables")
    monkeypatch.setattr(type(storage), "location", "s3://one/cables")
    assert is_elsewhere(located, replace(dataset, storage=storage)) is elsewhere
