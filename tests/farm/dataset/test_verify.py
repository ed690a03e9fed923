"""The findings of a check of a dataset."""

import json
import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from farm.dataset.completion import Completion
from farm.dataset.dataset import Dataset, create_dataset
from farm.dataset.destination import Destination
from farm.dataset.formats import PNG
from farm.dataset.instances import VisibleInstance
from farm.dataset.manifest import Manifest, file_record
from farm.dataset.outputs import IMAGE, INSTANCES, MASK, Output
from farm.dataset.paths import CACHE_FILE, file_path, manifest_path
from farm.dataset.verify import Fault, verify
from farm.spec.header import DatasetHeader
from farm.spec.job import Job
from farm.storage import LocalStorage
from tests.object_store import ObjectStore
from tests.stand_in import StandInRenderer
from worker.service.upload import upload

JOB = Job.from_id("far-000001")
IMAGE_PATH, MASK_PATH, INSTANCES_PATH = ALL_PATHS = [file_path(JOB, output) for output in (IMAGE, MASK, INSTANCES)]


@pytest.fixture
def made(dataset: Dataset) -> Dataset:
    """A finished dataset."""
    for job in dataset.header.spec.jobs():
        upload(StandInRenderer().make(job, dataset.header), job, dataset)
    return dataset


def found(dataset: Dataset) -> list[tuple[Fault, str]]:
    """Each finding's kind and path."""
    return [(finding.fault, finding.path) for finding in verify(dataset).findings]


def replace_file(dataset: Dataset, output: Output, content: bytes) -> None:
    """Put another file in place, and have the manifest vouch for it."""
    path = manifest_path(JOB)
    manifest = Manifest.model_validate_json(dataset.storage.read(path))
    record = file_record(file_path(JOB, output), content)
    forged = manifest.model_copy(update={"files": {**manifest.files, output.folder: record}})
    dataset.storage.write(file_path(JOB, output), content)
    dataset.storage.write(path, forged.model_dump_json().encode())


def test_clean(made: Dataset) -> None:
    """A finished dataset has no findings."""
    verdict = verify(made)
    assert verdict.clean
    assert verdict.images == verdict.quota == 4


def test_unmade(dataset: Dataset) -> None:
    """The manifest of a job that wasn't made is missing."""
    assert [fault for fault, _ in found(dataset)] == [Fault.MISSING] * 4


@pytest.mark.parametrize("path", [*ALL_PATHS, manifest_path(JOB)])
def test_missing(made: Dataset, path: str) -> None:
    """A file that was removed is missing."""
    made.storage.remove(path)
    assert found(made) == [(Fault.MISSING, path)]


@pytest.mark.parametrize("path", ALL_PATHS)
@pytest.mark.parametrize("size", [0, 20])
def test_truncated(made: Dataset, path: str, size: int) -> None:
    """A file that is shorter than its manifest says is truncated."""
    os.truncate(Path(made.storage.location) / path, size)
    assert found(made) == [(Fault.TRUNCATED, path)]


@pytest.mark.parametrize("path", ALL_PATHS)
def test_altered(made: Dataset, path: str) -> None:
    """A file of the right size with one changed bit is altered."""
    content = bytearray(made.storage.read(path))
    content[-20] ^= 1
    made.storage.write(path, bytes(content))
    assert found(made) == [(Fault.ALTERED, path)]


def test_anywhere(any_store: Callable[[str], str], header: DatasetHeader) -> None:
    """The same faults are found in a folder and in a bucket."""
    dataset = create_dataset(Destination(any_store("store"), "cables"), header)
    for job in header.spec.jobs():
        upload(StandInRenderer().make(job, header), job, dataset)
    assert found(dataset) == []
    dataset.storage.write(MASK_PATH, dataset.storage.read(MASK_PATH)[:20])
    dataset.storage.write(INSTANCES_PATH, dataset.storage.read(INSTANCES_PATH)[::-1])
    dataset.storage.remove(IMAGE_PATH)
    dataset.storage.write("stray.txt", b"")
    assert dict(found(dataset)) == {
        Fault.TRUNCATED: MASK_PATH,
        Fault.ALTERED: INSTANCES_PATH,
        Fault.MISSING: IMAGE_PATH,
        Fault.EXTRA: "stray.txt",
    }


@pytest.mark.swift
def test_unfinished_upload_to_a_bucket(bucket: str, object_store: ObjectStore, header: DatasetHeader) -> None:
    """Parts of an object that its killed writer never completed are no findings."""
    dataset = create_dataset(Destination(bucket, "cables"), header)
    for job in header.spec.jobs():
        upload(StandInRenderer().make(job, header), job, dataset)
    name, prefix = bucket.removeprefix("s3://").split("/", 1)
    client = object_store.client()
    for path in (IMAGE_PATH, "far/images/far-000009.png"):
        where = {"Bucket": name, "Key": f"{prefix}/cables/{path}"}
        begun = client.call_s3("create_multipart_upload", **where)
        client.call_s3("upload_part", **where, UploadId=begun["UploadId"], PartNumber=1, Body=bytes(5 * 1024 * 1024))
    assert found(dataset) == []


class GrowingStorage(LocalStorage):
    """A storage in which another process acts at the first look at one file."""

    def __init__(self, root: Path, watched: str, act: Callable[[], None]) -> None:
        super().__init__(root)
        self._watched = watched
        self._act: Callable[[], None] | None = act

    def read(self, path: str) -> bytes:
        """Implement `Storage.read`."""
        if path == self._watched and self._act is not None:
            act, self._act = self._act, None
            act()
        return super().read(path)


def test_job_that_is_made_meanwhile(dataset: Dataset, made: Dataset) -> None:
    """A picture that is made between the listing and the look at its manifest is neither missing nor an error."""
    kept = {path: made.storage.read(path) for path in made.storage.files() if JOB.id in path}
    for path in kept:
        made.storage.remove(path)

    def make() -> None:
        for path, content in kept.items():
            dataset.storage.write(path, content)

    storage = GrowingStorage(Path(made.storage.location), manifest_path(JOB), make)
    assert verify(replace(made, storage=storage)).clean


def test_job_that_is_made_anew_meanwhile(made: Dataset) -> None:
    """A file that vanishes during the look is looked for again, and then reported, not raised."""
    content = made.storage.read(IMAGE_PATH)
    made.storage.remove(IMAGE_PATH)
    back = GrowingStorage(Path(made.storage.location), MASK_PATH, lambda: made.storage.write(IMAGE_PATH, content))
    assert verify(replace(made, storage=back)).clean
    gone = GrowingStorage(Path(made.storage.location), MASK_PATH, lambda: made.storage.remove(MASK_PATH))
    assert found(replace(made, storage=gone)) == [(Fault.MISSING, MASK_PATH)]


def test_longer(made: Dataset) -> None:
    """A file with something after its end is altered."""
    made.storage.write(MASK_PATH, made.storage.read(MASK_PATH) + b"\0")
    assert found(made) == [(Fault.ALTERED, MASK_PATH)]


@pytest.mark.parametrize("content", [b"", b"{}", b"{", b"\xff"])
def test_damaged_manifest(made: Dataset, content: bytes) -> None:
    """A manifest that can't be read is altered."""
    made.storage.write(manifest_path(JOB), content)
    assert found(made) == [(Fault.ALTERED, manifest_path(JOB))]


def test_manifest_of_another_job(made: Dataset) -> None:
    """A manifest under another job's name is altered."""
    made.storage.write(manifest_path(JOB), made.storage.read(manifest_path(Job.from_id("far-000000"))))
    assert found(made) == [(Fault.ALTERED, manifest_path(JOB))]


@pytest.mark.parametrize("path", ["stray.txt", "far/images/far-000002.png", "far/images/far-000001.jpg", "far/a/b"])
def test_extra(made: Dataset, path: str) -> None:
    """A file of no job of the dataset is extra."""
    made.storage.write(path, b"")
    assert found(made) == [(Fault.EXTRA, path)]


def test_young_temporary_file(made: Dataset) -> None:
    """A file that may still be being written is no finding."""
    made.storage.write("far/images/.tmp-far-000001.png.host.1", b"")
    assert found(made) == []


def test_old_temporary_file(made: Dataset) -> None:
    """A temporary file that no living writer can own is extra."""
    path = "far/images/.tmp-far-000001.png.host.1"
    made.storage.write(path, b"")
    os.utime(Path(made.storage.location) / path, (0, 0))
    assert found(made) == [(Fault.EXTRA, path)]


def test_cache_is_no_extra_file(made: Dataset) -> None:
    """What the farm remembers for the next command is part of a dataset."""
    Completion(made, save_after=1).audit()
    assert CACHE_FILE in made.storage.files()
    assert found(made) == []


def test_each_file_is_read_once(made: Dataset) -> None:
    """A check reads each manifest and each file once; a missing manifest once, too."""
    read: list[str] = []

    class Recording(LocalStorage):
        def read(self, path: str) -> bytes:
            read.append(path)
            return super().read(path)

    made.storage.remove(manifest_path(JOB))
    verify(replace(made, storage=Recording(Path(made.storage.location))))
    wanted = {path for path in made.storage.files() if JOB.id not in path and path != "dataset.json"}
    assert sorted(read) == sorted(wanted | {manifest_path(JOB)})


def test_never_trusts_the_memory(made: Dataset) -> None:
    """A saved memory that vouches for a damaged file hides nothing."""
    completion = Completion(made, save_after=1)
    content = bytearray(made.storage.read(IMAGE_PATH))
    content[-20] ^= 1
    made.storage.write(IMAGE_PATH, bytes(content))
    completion.memory.vouch(JOB.category, JOB.index, 4e9)
    completion.memory.save()
    assert found(made) == [(Fault.ALTERED, IMAGE_PATH)]


def test_findings_are_sorted(made: Dataset) -> None:
    """Findings come by kind, then by path."""
    for path in ("b", "a", "far/images/far-000000.png", *ALL_PATHS[1:]):
        made.storage.write(path, b"") if len(path) == 1 else made.storage.remove(path)
    findings = found(made)
    assert findings == sorted(findings)
    assert len(findings) == 5


def test_no_png(made: Dataset) -> None:
    """What is no PNG is found even where the manifest vouches for it."""
    replace_file(made, IMAGE, b"no picture")
    assert found(made) == [(Fault.ALTERED, IMAGE_PATH)]


@pytest.mark.parametrize("shape", [(16, 16), (32, 32, 3)])
def test_wrong_shape(made: Dataset, shape: tuple[int, ...]) -> None:
    """A mask of another size or with colours is found."""
    replace_file(made, MASK, PNG.encode(np.zeros(shape, np.uint8)))
    assert found(made) == [(Fault.ALTERED, MASK_PATH)]


def test_grey_mask(made: Dataset) -> None:
    """A mask with values between is found."""
    replace_file(made, MASK, PNG.encode(np.full((32, 32), 7, np.uint8)))
    assert found(made) == [(Fault.ALTERED, MASK_PATH)]


def test_instances_that_do_not_agree(made: Dataset) -> None:
    """Instances that cover other pixels than the mask are found."""
    replace_file(made, INSTANCES, PNG.encode(np.full((32, 32), 3, np.uint16)))
    assert found(made) == [(Fault.ALTERED, INSTANCES_PATH)]


def forge(dataset: Dataset, **changes: object) -> None:
    """Change fields of the job's manifest."""
    manifest = Manifest.model_validate_json(dataset.storage.read(manifest_path(JOB)))
    dataset.storage.write(manifest_path(JOB), manifest.model_copy(update=changes).model_dump_json().encode())


@pytest.mark.parametrize(
    "listed",
    [
        (),
        (VisibleInstance(id=1, cable=0, strand=None, pixels=127),),
        (VisibleInstance(id=1, cable=0, strand=2, pixels=128),),
        (VisibleInstance(id=2, cable=0, strand=None, pixels=128),),
    ],
)
def test_list_of_instances_that_does_not_agree(made: Dataset, listed: tuple[VisibleInstance, ...]) -> None:
    """A manifest that lists other instances than the map shows is altered."""
    forge(made, instances=listed)
    (finding,) = verify(made).findings
    assert (finding.fault, finding.path) == (Fault.ALTERED, manifest_path(JOB))
    assert finding.detail == "its list of instances is not what the instance map shows"


def test_instance_of_no_cable(made: Dataset) -> None:
    """A map that agrees with the mask and has a number of nothing in the scene is found."""
    instances = PNG.decode(made.storage.read(INSTANCES_PATH))
    assert instances is not None
    replace_file(made, INSTANCES, PNG.encode(instances * np.uint16(3)))
    assert found(made) == [(Fault.ALTERED, manifest_path(JOB))]


def empty_labels(dataset: Dataset, scene: dict[str, object]) -> None:
    """Put labels in place that show nothing, with a manifest that agrees but for `scene`."""
    replace_file(dataset, MASK, PNG.encode(np.zeros((32, 32), np.uint8)))
    replace_file(dataset, INSTANCES, PNG.encode(np.zeros((32, 32), np.uint16)))
    manifest = Manifest.model_validate_json(dataset.storage.read(manifest_path(JOB)))
    forge(dataset, instances=(), scene=manifest.scene.model_copy(update=scene))


def test_empty_picture(tmp_path: Path, header: DatasetHeader) -> None:
    """Labels that show nothing are found where a share must be visible, unless the scene has no cables."""
    cable = header.spec.ranges.cable.model_copy(update={"least_visible_share": 0.01})
    ranges = header.spec.ranges.model_copy(update={"cable": cable})
    picky = header.model_copy(update={"spec": header.spec.model_copy(update={"ranges": ranges})})
    dataset = create_dataset(Destination(str(tmp_path / "store"), "cables"), picky)
    for job in picky.spec.jobs():
        upload(StandInRenderer().make(job, picky), job, dataset)
    empty_labels(dataset, {})
    assert found(dataset) == [(Fault.ALTERED, INSTANCES_PATH)]
    empty_labels(dataset, {"cables": ()})
    assert found(dataset) == []


def test_manifest_of_an_earlier_release(made: Dataset) -> None:
    """A manifest that lists no instances, as its farm did not, is clean."""
    content = json.loads(made.storage.read(manifest_path(JOB)))
    del content["instances"]
    made.storage.write(manifest_path(JOB), json.dumps(content).encode())
    assert verify(made).clean


def test_tells_how_far_it_is(made: Dataset) -> None:
    """Each checked job is counted."""
    counts: list[int] = []
    verify(made, counts.append)
    assert counts == [1, 2, 3, 4]
