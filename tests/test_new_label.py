"""A new label is one row of the table and one function: the rest of the farm goes by the row.

The label is the number of cables, in JSON, a type of file that no other output has.
"""

import json
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import pytest

from farm.dataset.completion import Completion, is_done
from farm.dataset.dataset import Dataset
from farm.dataset.formats import FileFormat
from farm.dataset.index import write_index
from farm.dataset.manifest import Manifest, file_record
from farm.dataset.outputs import OUTPUTS, Agreement, Output
from farm.dataset.paths import INDEX_FILE, file_path, manifest_path
from farm.dataset.report import write_report
from farm.dataset.verify import Fault, Finding, verify
from farm.errors import RenderError
from farm.scene.picture_size import PictureSize
from farm.spec.job import Job
from tests.stand_in import StandInRenderer, stand_in_scene
from worker.geometry import SettledGeometry
from worker.service.upload import upload

JOB = Job.from_id("far-000001")
PATH = "far/counts/far-000001.json"


def _decoded(content: bytes) -> Any:
    try:
        return json.loads(content)
    except ValueError:
        return None


JSON = FileFormat("JSON", ".json", lambda value: json.dumps(value).encode(), _decoded)


def _count_fault(content: Any, resolution: PictureSize) -> str | None:
    del resolution
    return None if isinstance(content, dict) and content.keys() == {"cables"} else "does not count cables alone"


def _fewer_than_seen(content: Any, instances: Any) -> str | None:
    return "counts fewer cables than are seen" if content["cables"] < len(set(instances.flat) - {0}) else None


def count_cables(geometry: SettledGeometry) -> Mapping[str, Any]:
    """Makes the label."""
    return {"cable_count": {"cables": len(geometry.scene.cables)}}


COUNT = Output(
    "cable_count",
    "counts",
    JSON,
    _count_fault,
    agreements=(Agreement("instances", _fewer_than_seen),),
    maker="tests.test_new_label:count_cables",
)


@pytest.fixture(autouse=True)
def _one_more_row(monkeypatch: pytest.MonkeyPatch) -> None:
    """The table with the new row."""
    monkeypatch.setattr("farm.dataset.outputs.OUTPUTS", (*OUTPUTS, COUNT))


@pytest.fixture
def made(dataset: Dataset, _one_more_row: None) -> Dataset:
    """A finished dataset."""
    for job in dataset.header.spec.jobs():
        upload(StandInRenderer().make(job, dataset.header), job, dataset)
    return dataset


def read_manifest(dataset: Dataset) -> Manifest:
    """The job's manifest."""
    return Manifest.model_validate_json(dataset.storage.read(manifest_path(JOB)))


def replace_count(dataset: Dataset, content: bytes) -> None:
    """Put another count in place, and have the manifest vouch for it."""
    record = file_record(PATH, content)
    manifest = read_manifest(dataset)
    forged = manifest.model_copy(update={"files": {**manifest.files, "counts": record}})
    dataset.storage.write(PATH, content)
    dataset.storage.write(manifest_path(JOB), forged.model_dump_json().encode())


def findings(dataset: Dataset) -> list[Finding]:
    """What a check of the dataset finds."""
    return list(verify(dataset).findings)


def test_it_is_made_and_written(made: Dataset) -> None:
    """The file lies in the row's folder and holds what the maker gives, in the row's type."""
    assert file_path(JOB, COUNT) == PATH
    assert json.loads(made.storage.read(PATH)) == {"cables": len(stand_in_scene(JOB).cables)}


def test_the_manifest_lists_it_last(made: Dataset) -> None:
    """It comes after the files of the rows before it, by the row's folder."""
    files = read_manifest(made).files
    assert list(files) == [*(output.folder for output in OUTPUTS), "counts"]
    assert files["counts"] == file_record(PATH, made.storage.read(PATH))


@pytest.mark.parametrize("damage", [lambda count: count[:-1], lambda count: count + b" "])
def test_completion_counts_it(made: Dataset, damage: Callable[[bytes], bytes]) -> None:
    """A job whose file is of another size is not done, nor is one without the file."""
    completion = Completion(made)
    assert JOB in completion.audit()
    whole = made.storage.read(PATH)
    made.storage.write(PATH, damage(whole))
    assert JOB not in completion.audit()
    made.storage.write(PATH, whole)
    assert JOB in completion.audit()
    made.storage.remove(PATH)
    assert JOB not in completion.audit()
    assert not is_done(made, JOB)


def test_leftovers_of_it_are_removed(made: Dataset) -> None:
    """What a killed writer left in the row's folder goes."""
    made.storage.write("far/counts/.tmp-far-000001.json.host.1", b"half")
    completion = Completion(made)
    completion.audit()
    assert completion.remove_leftovers(now_s=0.0) == 1


def test_a_manifest_without_it_vouches_for_nothing(made: Dataset) -> None:
    """A job that was made without the label is not done."""
    manifest = read_manifest(made)
    files = {folder: record for folder, record in manifest.files.items() if folder != "counts"}
    made.storage.write(manifest_path(JOB), manifest.model_copy(update={"files": files}).model_dump_json().encode())
    assert JOB not in Completion(made).look()


def test_verify_knows_it(made: Dataset) -> None:
    """A whole dataset is clean: the file is not one of no job."""
    assert findings(made) == []


@pytest.mark.parametrize(
    ("content", "detail"),
    [
        (b"{", "no readable JSON"),
        (b"{}", "does not count cables alone"),
        (b'{"cables": 0}', "counts fewer cables than are seen"),
    ],
)
def test_verify_checks_it(made: Dataset, content: bytes, detail: str) -> None:
    """A file that its manifest vouches for is decoded, checked alone, and compared with another output."""
    replace_count(made, content)
    assert findings(made) == [Finding(fault=Fault.ALTERED, path=PATH, detail=detail)]


def test_upload_checks_it(dataset: Dataset) -> None:
    """A label that is wrong is not written, nor is a picture that lacks it."""
    picture = StandInRenderer().make(JOB, dataset.header)
    before = dataset.storage.files()
    without = {role: content for role, content in picture.files.items() if role != "cable_count"}
    for files in ({**without, "cable_count": {"cables": 0}}, {**without, "cable_count": 1}, without):
        with pytest.raises(RenderError, match="cable_count"):
            upload(replace(picture, files=files), JOB, dataset)
    assert dataset.storage.files() == before


def test_the_index_has_it(made: Dataset) -> None:
    """A line has its path and its checksum, after those of the outputs before it."""
    write_index(made)
    line = json.loads(made.storage.read(INDEX_FILE).splitlines()[-1])
    roles = [*(output.role for output in OUTPUTS), "cable_count"]
    assert list(line)[4 : 4 + 2 * len(roles)] == [*roles, *(f"{role}_sha256" for role in roles)]
    assert line["cable_count"] == PATH
    assert line["cable_count_sha256"] == file_record(PATH, made.storage.read(PATH)).sha256


def test_the_report_shows_pictures_and_masks_still(made: Dataset) -> None:
    """The page counts every job and names no file of the label."""
    assert write_report(made) == 4
    assert b"counts/" not in made.storage.read("report.html")
