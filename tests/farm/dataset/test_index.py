"""The index: the same bytes however it is made, and few reads."""

import json
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest

from farm.dataset.completion import Completion
from farm.dataset.dataset import Dataset
from farm.dataset.index import done_manifests, index_entry, index_line, read_line, write_index, write_index_of
from farm.dataset.manifest import Receipt, parse_receipt
from farm.dataset.paths import CACHE_FILE, INDEX_FILE, manifest_path
from farm.dataset.report import write_overview, write_report
from farm.spec.job import Job
from farm.spec.job_set import JobSet
from farm.storage import LocalStorage
from tests.load.synthetic import COMMANDS, synthetic_dataset
from tests.stand_in import StandInRenderer, stand_in_header
from worker.service.upload import upload

JOB = Job.from_id("far-000000")


@pytest.fixture
def made(dataset: Dataset) -> Dataset:
    """A finished dataset."""
    for job in dataset.header.spec.jobs():
        upload(StandInRenderer().make(job, dataset.header), job, dataset)
    return dataset


def written(dataset: Dataset) -> tuple[list[str], JobSet]:
    """Write the index as a command of its own; return the ids of the manifests that were read, and the listed jobs."""
    read: list[str] = []

    class Recording(LocalStorage):
        def read(self, path: str) -> bytes:
            if "/manifests/" in path:
                read.append(path.rpartition("/")[2].removesuffix(".json"))
            return super().read(path)

    recording = replace(dataset, storage=Recording(Path(dataset.storage.location)))
    completion = Completion(recording, save_after=1)
    completion.audit()
    read.clear()
    return read, write_index_of(recording, completion)


def receipts(dataset: Dataset) -> Iterator[tuple[Job, Receipt]]:
    """The receipts of all done images, in the index's order."""
    for job, _ in done_manifests(dataset):
        receipt = parse_receipt(dataset.storage.read(manifest_path(job)), dataset, job)
        assert receipt is not None
        yield job, receipt


def by_hand(dataset: Dataset) -> bytes:
    """The index as it must be, from all manifests."""
    return b"".join(index_line(index_entry(dataset, job, receipt)) for job, receipt in receipts(dataset))


def test_lines_are_kept(made: Dataset) -> None:
    """A second index takes the lines of unchanged manifests from the first, and has the same bytes."""
    assert len(written(made)[0]) == 4
    first = made.storage.read(INDEX_FILE)
    assert first == by_hand(made)
    read, listed = written(made)
    assert (read, len(listed)) == ([], 4)
    assert made.storage.read(INDEX_FILE) == first


def test_manifests_that_came_and_went(made: Dataset) -> None:
    """New and replaced manifests are read, lost ones leave the index, and the others' lines stay."""
    upload_again = StandInRenderer().make(JOB, stand_in_header(seed=9))
    content = made.storage.read(manifest_path(Job.from_id("far-000001")))
    made.storage.remove(manifest_path(Job.from_id("far-000001")))
    written(made)
    made.storage.write(manifest_path(Job.from_id("far-000001")), content)
    made.storage.remove(manifest_path(Job.from_id("close_concentrated_light-000000")))
    upload(upload_again, JOB, made)
    read, listed = written(made)
    assert sorted(read) == ["far-000000", "far-000001"]
    assert len(listed) == 3
    assert made.storage.read(INDEX_FILE) == by_hand(made)


@pytest.mark.parametrize("spoil", ["edited", "removed", "cut", "no cache"])
def test_index_that_is_not_as_written(made: Dataset, spoil: str) -> None:
    """Lines of an index that somebody changed are not taken over: all manifests are read again."""
    written(made)
    whole = made.storage.read(INDEX_FILE)
    if spoil in {"removed", "no cache"}:
        made.storage.remove(INDEX_FILE if spoil == "removed" else CACHE_FILE)
    else:
        made.storage.write(INDEX_FILE, whole.replace(b'"cables":1', b'"cables":7') if spoil == "edited" else whole[:-9])
    assert len(written(made)[0]) == 4
    assert made.storage.read(INDEX_FILE) == whole


def test_line_reads_back(made: Dataset) -> None:
    """An entry is the same after it was a line."""
    for job, receipt in receipts(made):
        entry = index_entry(made, job, receipt)
        assert read_line(index_line(entry)) == entry
        assert next(iter(json.loads(index_line(entry)))) == "job_id"


def test_order(made: Dataset) -> None:
    """Lines come by category and index, also of the jobs that were made last."""
    ids = [json.loads(line)["job_id"] for line in by_hand(made).splitlines()]
    assert ids == ["close_concentrated_light-000000", "close_concentrated_light-000001", "far-000000", "far-000001"]


def test_overview_is_index_and_page(made: Dataset) -> None:
    """One pass writes the same index and page as each alone."""
    assert (write_index(made), write_report(made)) == (4, 4)
    alone = {path: made.storage.read(path) for path in ("index.jsonl", "report.html")}
    assert write_overview(made) == 4
    assert {path: made.storage.read(path) for path in alone} == alone


def test_reads_of_each_command(tmp_path: Path) -> None:
    """Of 1,200 pictures, status and overview read each manifest once, and none the next time; verify each file once."""
    dataset, storage = synthetic_dataset(1200, 0.0, tmp_path)

    def manifests_read(command: str) -> int:
        storage.traffic.manifests = 0
        assert COMMANDS[command](dataset) == 1200
        return storage.traffic.manifests

    assert manifests_read("status") == 1200
    assert manifests_read("status") == 0
    assert manifests_read("overview") == 1200
    assert manifests_read("overview") == 0
    assert manifests_read("status") == 0
    storage.traffic.reads = 0
    assert manifests_read("verify") == 1200
    assert storage.traffic.reads == 4 * 1200
