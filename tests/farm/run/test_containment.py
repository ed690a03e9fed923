"""Names in messages, manifests, headers and commands lead to no file outside their dataset."""

import json
from pathlib import Path, PurePosixPath

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from pydantic import TypeAdapter, ValidationError

from assets.surfaces.baked import load_surface
from farm.dataset.completion import is_done
from farm.dataset.dataset import Dataset
from farm.dataset.destination import parse_destination
from farm.dataset.manifest import parse_manifest
from farm.dataset.outputs import IMAGE, MASK, OUTPUTS, Output
from farm.dataset.paths import file_path, manifest_path
from farm.errors import AssetError, DestinationError, MessageError
from farm.spec.job import DatasetName, Job, JobMessage
from tests.stand_in import SHA, StandInRenderer
from worker.service.upload import upload

HOSTILE = [
    "..",
    "../x",
    "a/../../x",
    "/etc/passwd",
    "~/x",
    "a\\..\\x",
    "a\0b",
    "a\n",
    "%2e%2e/x",
    "file:///etc/passwd",
    "C:\\x",
    ".",
    "",
    "\uff0e\uff0e/x",
    "far/images/../../../x",
]
NAMES = st.sampled_from(HOSTILE) | st.text(max_size=20) | st.text("./\\~\0\n%af-0", max_size=20)
BORROWED = settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=60, deadline=None)


def is_one_name(name: str) -> bool:
    """Assert that the name, joined to any folder, is a child of it."""
    inside = PurePosixPath("/store") / name
    return inside.parent == PurePosixPath("/store") and inside.name == name and name not in {"", ".", ".."}


@given(NAMES)
def test_a_dataset_name_is_one_plain_name(name: str) -> None:
    """An accepted name is one visible folder, which can be printed in one line."""
    try:
        accepted = TypeAdapter(DatasetName).validate_python(name)
    except ValidationError:
        return
    assert is_one_name(accepted)
    assert accepted.isprintable()
    assert not accepted.startswith(".")


@given(NAMES, NAMES)
def test_a_message_names_a_job_of_a_dataset_and_nothing_else(dataset: str, job_id: str) -> None:
    """An accepted message leads into the dataset's folder, whatever stands in for its names."""
    try:
        message = JobMessage.decode({"version": 1, "dataset": dataset, "spec_sha256": SHA, "job_id": job_id})
    except MessageError:
        return
    paths = [manifest_path(message.job), *(file_path(message.job, output) for output in OUTPUTS)]
    assert is_one_name(message.dataset)
    assert all(is_one_name(part) for path in paths for part in path.split("/"))


@given(NAMES)
def test_a_destination_is_a_folder_in_its_store(out: str) -> None:
    """However odd the place, the dataset's own folder is a child of the store."""
    try:
        place = parse_destination(out)
    except DestinationError:
        return
    assert is_one_name(place.name)
    assert place.location == f"{place.store.rstrip('/')}/{place.name}"


@pytest.fixture
def manifest(dataset: Dataset) -> bytes:
    """The manifest of a done job."""
    job = Job.from_id("far-000000")
    upload(StandInRenderer().make(job, dataset.header), job, dataset)
    return dataset.storage.read(manifest_path(job))


@BORROWED
@given(output=st.sampled_from(OUTPUTS), path=NAMES | st.sampled_from([file_path(Job.from_id("far-000001"), MASK)]))
def test_a_manifest_names_its_own_files_alone(dataset: Dataset, manifest: bytes, output: Output, path: str) -> None:
    """One that names another file, be it another job's of this dataset, is none of this job."""
    job = Job.from_id("far-000000")
    assert parse_manifest(manifest, dataset, job) is not None
    altered = json.loads(manifest)
    altered["files"][output.folder]["path"] = path
    assert parse_manifest(json.dumps(altered).encode(), dataset, job) is None


@BORROWED
@given(key=st.sampled_from(["job_id", "spec_sha256"]), value=NAMES)
def test_a_manifest_of_another_is_none(dataset: Dataset, manifest: bytes, key: str, value: str) -> None:
    """A manifest that names another description or job is refused."""
    altered = json.loads(manifest) | {key: value}
    assert parse_manifest(json.dumps(altered).encode(), dataset, Job.from_id("far-000000")) is None


def test_a_manifest_that_names_a_secret_file_is_not_followed(dataset: Dataset, manifest: bytes) -> None:
    """A worker that asks whether the job is done doesn't read the file to which a manifest leads."""
    job = Job.from_id("far-000000")
    assert is_done(dataset, job)
    altered = json.loads(manifest)
    altered["files"][IMAGE.folder]["path"] = "/dev/zero"  # reading it would never end
    dataset.storage.write(manifest_path(job), json.dumps(altered).encode())
    assert not is_done(dataset, job)


@pytest.mark.parametrize("name", ["..", "../x", "baked/../../x", "/etc", ".", ""])
def test_a_headers_surface_is_in_the_folder_of_surfaces(tmp_path: Path, name: str) -> None:
    """A header's surface name leads nowhere but into the folder of surfaces, before any file is looked for."""
    with pytest.raises(AssetError, match="can't name a surface"):
        load_surface(tmp_path, name)
