"""Done jobs: what a look finds, and what only an audit finds."""

import os
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from operator import attrgetter
from pathlib import Path

import pytest

from farm.dataset.completion import STALE_TEMPORARY_S, Completion, is_done, job_of_manifest
from farm.dataset.dataset import Dataset, create_dataset
from farm.dataset.destination import Destination
from farm.dataset.outputs import IMAGE, MASK, OUTPUTS, Output
from farm.dataset.paths import CACHE_FILE, file_path, manifest_path
from farm.spec.header import DatasetHeader
from farm.spec.job import Job
from farm.spec.job_set import JobSet
from farm.storage import LocalStorage, StoredFile
from tests.stand_in import StandInRenderer, stand_in_header
from worker.service.upload import upload

JOB = Job.from_id("far-000001")
ALL = ["close_concentrated_light-000000", "close_concentrated_light-000001", "far-000000", "far-000001"]
OTHERS = ALL[:-1]


def make(dataset: Dataset, job: Job, *, seed: int = 0) -> None:
    """Make one job, with pixels from a seed."""
    header = stand_in_header(seed=seed)
    upload(StandInRenderer().make(job, header), job, dataset)


@pytest.fixture
def made(dataset: Dataset) -> Dataset:
    """A finished dataset."""
    for job in dataset.header.spec.jobs():
        make(dataset, job)
    return dataset


def ids(jobs: JobSet) -> list[str]:
    """The jobs' ids, in alphabetical order."""
    return sorted(job.id for job in jobs)


def path_of(dataset: Dataset, path: str) -> Path:
    """A file of a dataset on disk."""
    return Path(dataset.storage.location) / path


@pytest.mark.parametrize("kind", ["look", "audit"])
def test_finished_dataset(made: Dataset, kind: str) -> None:
    """All jobs of a finished dataset are done, by a look and by an audit."""
    completion = Completion(made)
    assert ids(getattr(completion, kind)()) == ids(completion.done) == ALL


@pytest.mark.parametrize("kind", ["look", "audit"])
def test_empty_dataset(dataset: Dataset, kind: str) -> None:
    """A dataset without any image, or without its folder, has no done job, and that is no error."""
    assert ids(getattr(Completion(dataset), kind)()) == []


def test_look_finds_what_is_new(dataset: Dataset) -> None:
    """A job counts from the first look after its manifest exists, and no longer once the manifest is gone."""
    completion = Completion(dataset)
    completion.look()
    make(dataset, JOB)
    assert ids(completion.look()) == [JOB.id]
    dataset.storage.remove(manifest_path(JOB))
    assert ids(completion.look()) == []


@pytest.mark.parametrize("output", OUTPUTS, ids=attrgetter("role"))
@pytest.mark.parametrize("size", [None, 0, 20])
def test_audit_finds_damage(made: Dataset, output: Output, size: int | None) -> None:
    """A picture that is gone or was cut off is found by an audit, and a look remembers it."""
    completion = Completion(made)
    completion.audit()
    if size is None:
        made.storage.remove(file_path(JOB, output))
    else:
        os.truncate(path_of(made, file_path(JOB, output)), size)
    assert ids(completion.look()) == ALL
    assert ids(completion.audit()) == OTHERS
    assert ids(completion.look()) == OTHERS


def test_audit_finds_a_longer_file(made: Dataset) -> None:
    """A picture with something after its end is found, too."""
    with path_of(made, file_path(JOB, MASK)).open("ab") as file:
        file.write(b"\0")
    assert ids(Completion(made).audit()) == OTHERS


@pytest.mark.parametrize("output", OUTPUTS, ids=attrgetter("role"))
def test_audit_reads_what_changed(made: Dataset, output: Output) -> None:
    """A picture that was changed after its manifest, in a bit, is found by an audit; one that is the same is not."""
    completion = Completion(made)
    later_s = time.time() + 60
    same, other = file_path(Job.from_id("far-000000"), output), file_path(JOB, output)
    content = bytearray(made.storage.read(other))
    content[-20] ^= 1
    made.storage.write(other, bytes(content))
    for path in (same, other):
        os.utime(path_of(made, path), (later_s, later_s))
    for _ in range(2):
        assert ids(completion.audit()) == OTHERS


def test_damaged_job_that_was_made_again(made: Dataset) -> None:
    """A look sees that a damaged job has been made again, even with pictures of other sizes."""
    completion = Completion(made)
    made.storage.remove(file_path(JOB, IMAGE))
    assert ids(completion.audit()) == OTHERS
    make(made, JOB, seed=5)
    assert ids(completion.look()) == ALL
    assert ids(completion.audit()) == ALL


def test_picture_that_came_back(made: Dataset) -> None:
    """A picture that is whole again counts from the next audit, although its manifest hasn't changed."""
    completion = Completion(made)
    path = file_path(JOB, IMAGE)
    content = made.storage.read(path)
    os.truncate(path_of(made, path), 10)
    completion.audit()
    made.storage.write(path, content)
    assert ids(completion.audit()) == ALL


@pytest.mark.parametrize("content", [b"", b"{}", b"{", b"\xff"])
def test_damaged_manifest(made: Dataset, content: bytes) -> None:
    """A manifest that can't be read vouches for nothing; a whole one in its place does."""
    whole = made.storage.read(manifest_path(JOB))
    completion = Completion(made)
    made.storage.write(manifest_path(JOB), content)
    assert ids(completion.look()) == OTHERS
    made.storage.write(manifest_path(JOB), whole)
    assert ids(completion.look()) == ALL


def test_manifest_of_another_job(made: Dataset) -> None:
    """A manifest under another job's name vouches for nothing."""
    made.storage.write(manifest_path(JOB), made.storage.read(manifest_path(Job.from_id("far-000000"))))
    assert ids(Completion(made).audit()) == OTHERS


def test_manifest_of_another_dataset(made: Dataset, tmp_path: Path) -> None:
    """A manifest that was copied from another dataset vouches for nothing."""
    other = create_dataset(Destination(str(tmp_path), "other"), stand_in_header(seed=9))
    make(other, JOB)
    for path in (manifest_path(JOB), *(file_path(JOB, output) for output in OUTPUTS)):
        made.storage.write(path, other.storage.read(path))
    assert ids(Completion(made).audit()) == OTHERS
    assert not is_done(made, JOB)


@pytest.mark.parametrize(
    "path",
    [
        "far/manifests/far-000002.json",
        "far/manifests/far-0000001.json",
        "far/manifests/close_concentrated_light-000000.json",
        "far/manifests/below/far-000001.json",
        "far/manifests/.tmp-far-000001.json.host.1",
        "far/manifests/far-000001.json.bak",
        "far/manifests/nothing-000001.json",
        "far/manifests/far-999999999.json",
        "far/images/far-000001.jpg",
        "far/images/below/far-000001.png",
        "far/images/far-000007.png",
        "far/images/.tmp-far-000001.png.host.1",
        "stray.txt",
    ],
)
def test_foreign_names_count_for_nothing(dataset: Dataset, made: Dataset, path: str) -> None:
    """Files that belong to no job, or don't lie where a job's do, change nothing."""
    made.storage.write(path, made.storage.read(manifest_path(JOB)))
    assert ids(Completion(made).audit()) == ALL
    made.storage.remove(manifest_path(JOB))
    assert ids(Completion(dataset).audit()) == OTHERS


def test_manifest_is_read_once(made: Dataset) -> None:
    """Looks and audits don't read an unchanged manifest again, and do read a touched one."""
    read: list[str] = []

    class Recording(LocalStorage):
        def read(self, path: str) -> bytes:
            read.append(path)
            return super().read(path)

    completion = Completion(replace(made, storage=Recording(Path(made.storage.location))))
    completion.audit()
    assert sorted(read) == sorted(manifest_path(Job.from_id(job_id)) for job_id in ALL)
    read.clear()
    completion.look()
    completion.audit()
    assert read == []
    os.utime(path_of(made, manifest_path(JOB)), (1, 1))
    completion.look()
    assert read == [manifest_path(JOB)]


def reads_of(dataset: Dataset, **options: int) -> tuple[list[str], JobSet]:
    """Audit as a command of its own would; return the manifests and pictures that were read, and the done jobs."""
    read: list[str] = []

    class Recording(LocalStorage):
        def read(self, path: str) -> bytes:
            read.append(path)
            return super().read(path)

    recording = replace(dataset, storage=Recording(Path(dataset.storage.location)))
    return read, Completion(recording, **options).audit()


def test_next_command_reads_what_is_new(made: Dataset) -> None:
    """A later command reads no manifest that an earlier one read, but those that came or were touched since."""
    made.storage.remove(manifest_path(JOB))
    read, done = reads_of(made, save_after=1)
    assert (len(read), ids(done)) == (3, OTHERS)
    assert reads_of(made) == ([], done)
    make(made, JOB)
    os.utime(path_of(made, manifest_path(Job.from_id("far-000000"))), (1, 1))
    read, done = reads_of(made)
    # The pictures of a manifest that seems older than they are read to compare them.
    assert {path for path in read if "manifests" in path} == {
        f"far/manifests/far-00000{index}.json" for index in (0, 1)
    }
    assert ids(done) == ALL


def test_small_datasets_have_no_cache(made: Dataset) -> None:
    """Few manifests are read again in no time, and no file is left for them."""
    reads_of(made)
    assert CACHE_FILE not in made.storage.files()


def test_vouched_pictures_are_remembered(made: Dataset) -> None:
    """Pictures that are newer than their manifest, as after a copy, are compared once, not by each command again."""
    later_s = time.time() + 60
    for job in made.header.spec.jobs():
        os.utime(path_of(made, file_path(job, MASK)), (later_s, later_s))
    assert len(reads_of(made, save_after=1)[0]) == 4 * (2 + len(OUTPUTS))
    read, done = reads_of(made)
    assert (read, ids(done)) == ([], ALL)


@pytest.mark.parametrize("field", ["sizes", "state"])
def test_lying_memory(made: Dataset, field: str) -> None:
    """No job is made again on a saved memory's word: the manifest is asked before a picture counts as damaged."""
    lying = Completion(made)
    lying.audit()
    for rows in lying.memory.rows.values():
        rows[field] = 7 if field == "sizes" else 0
    lying.memory.save()
    assert ids(reads_of(made)[1]) == ALL


def test_memory_vouches_for_no_absent_manifest(made: Dataset) -> None:
    """A job counts only while its manifest and pictures are listed, whatever the saved memory holds."""
    Completion(made, save_after=1).audit()
    made.storage.remove(manifest_path(JOB))
    made.storage.remove(file_path(Job.from_id("far-000000"), MASK))
    assert ids(reads_of(made)[1]) == ALL[:2]


def test_reads_are_many_at_a_time(made: Dataset) -> None:
    """Manifests are read at the same time: each of the four waits until all are under way."""
    together = threading.Barrier(4, timeout=20)

    class Slow(LocalStorage):
        def read(self, path: str) -> bytes:
            if "manifests" in path:
                together.wait()
            return super().read(path)

    header = stand_in_header(far=4)
    dataset = create_dataset(Destination(str(Path(made.storage.location).parent), "four"), header)
    for job in header.spec.jobs():
        make(dataset, job)
    assert len(Completion(replace(dataset, storage=Slow(Path(dataset.storage.location)))).look()) == 4


class GrowingStorage(LocalStorage):
    """A storage in which another process acts before one folder is listed."""

    def __init__(self, root: Path, watched: str, act: Callable[[], None]) -> None:
        super().__init__(root)
        self._watched = watched
        self._act: Callable[[], None] | None = act

    def scan(self, under: str = "", *, deep: bool = True) -> Iterator[tuple[str, StoredFile]]:
        """Implement `Streams.scan`."""
        if under == self._watched and self._act is not None:
            act, self._act = self._act, None
            act()
        return super().scan(under, deep=deep)


def test_job_that_is_made_during_an_audit(dataset: Dataset) -> None:
    """A job whose files appear between the listings of manifests and of pictures is done and not damaged."""
    storage = GrowingStorage(Path(dataset.storage.location), "far/images", lambda: make(dataset, JOB))
    assert ids(Completion(replace(dataset, storage=storage)).audit()) == [JOB.id]


def test_done_by_checksum(made: Dataset) -> None:
    """A single job is done if its files equal those of its manifest to the last bit."""
    assert is_done(made, JOB)
    path = file_path(JOB, IMAGE)
    content = bytearray(made.storage.read(path))
    content[-20] ^= 1
    made.storage.write(path, bytes(content))
    assert not is_done(made, JOB)
    made.storage.remove(path)
    assert not is_done(made, JOB)


@pytest.mark.parametrize(
    ("path", "job_id"),
    [("far/manifests/far-000001.json", "far-000001"), ("manifests/far-000001.json", None), ("far-000001.json", None)],
)
def test_job_of_a_path(path: str, job_id: str | None) -> None:
    """The path of a manifest gives its job if the manifest lies in the job's place."""
    job = job_of_manifest(path)
    assert (None if job is None else job.id) == job_id


def test_leftovers(made: Dataset) -> None:
    """Temporary files of done jobs are removed, and those that no living writer can own; others stay."""
    made.storage.remove(manifest_path(JOB))
    folder = "far/images/.tmp-far-"
    for name in ("000000.png.host.1", "000001.png.host.1", "000001.png.host.2"):
        made.storage.write(folder + name, b"half")
    now_s = time.time()
    os.utime(path_of(made, f"{folder}000001.png.host.2"), (now_s, now_s - STALE_TEMPORARY_S - 60))
    completion = Completion(made)
    completion.audit()
    assert completion.remove_leftovers(now_s) == 2
    assert [path for path in made.storage.files() if ".tmp-" in path] == [f"{folder}000001.png.host.1"]


def test_bucket(any_store: Callable[[str], str], header: DatasetHeader) -> None:
    """Looks and audits work in a folder and in a bucket alike."""
    dataset = create_dataset(Destination(any_store("store"), "cables"), header)
    completion = Completion(dataset)
    make(dataset, JOB)
    assert ids(completion.look()) == ids(completion.audit()) == [JOB.id]
    dataset.storage.write(file_path(JOB, IMAGE), b"half")
    assert ids(completion.audit()) == []
