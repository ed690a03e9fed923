"""Whole pictures of another description in a dataset's folder."""

import json

import pytest

from farm.dataset.completion import Completion
from farm.dataset.dataset import Dataset, open_dataset
from farm.dataset.destination import Destination
from farm.dataset.foreign import is_foreign, refuse_foreign
from farm.dataset.header_file import header_content
from farm.dataset.outputs import MASK
from farm.dataset.paths import HEADER_FILE, file_path, manifest_path
from farm.dataset.verify import verify
from farm.errors import ConflictError
from farm.spec.job import Job
from tests.stand_in import StandInRenderer, stand_in_header
from worker.service.upload import upload

JOB = Job.from_id("far-000000")


@pytest.fixture
def replaced(dataset: Dataset) -> Dataset:
    """A finished dataset, opened after its header was replaced by that of another seed."""
    for job in dataset.header.spec.jobs():
        upload(StandInRenderer().make(job, dataset.header), job, dataset)
    dataset.storage.write(HEADER_FILE, header_content(stand_in_header(seed=7)))
    store, _, name = dataset.storage.location.rpartition("/")
    return open_dataset(Destination(store, name))


def test_whole_pictures_of_another_description_are_foreign(replaced: Dataset) -> None:
    """They are none of the dataset's, and their manifests confirm them; verify says so."""
    assert all(is_foreign(replaced, job) for job in replaced.header.spec.jobs())
    assert "of another description" in verify(replaced).findings[0].detail


def test_nothing_is_rendered_over_them(replaced: Dataset) -> None:
    """They are undone and unfit, and the refusal says what to put back."""
    completion = Completion(replaced)
    assert len(completion.audit()) == 0
    assert len(completion.unfit) == 4
    with pytest.raises(ConflictError, match="whole pictures of another description"):
        refuse_foreign(replaced, completion.unfit)


def test_what_is_not_whole_is_not_foreign(replaced: Dataset) -> None:
    """A file that is altered, or gone, makes its picture one to make again."""
    replaced.storage.write(file_path(JOB, MASK), b"altered")
    assert not is_foreign(replaced, JOB)
    replaced.storage.remove(file_path(JOB, MASK))
    assert not is_foreign(replaced, JOB)


@pytest.mark.parametrize("content", [b"", b"no json", b"{}"])
def test_damaged_manifests_are_not_foreign(replaced: Dataset, content: bytes) -> None:
    """A manifest that nobody can read confirms nothing."""
    replaced.storage.write(manifest_path(JOB), content)
    assert not is_foreign(replaced, JOB)


def test_a_manifest_that_names_files_elsewhere_is_not_followed(replaced: Dataset) -> None:
    """Only the job's own files are read, whatever paths a manifest holds."""
    manifest = json.loads(replaced.storage.read(manifest_path(JOB)))
    manifest["files"]["masks"]["path"] = "../../secret.png"
    replaced.storage.write(manifest_path(JOB), json.dumps(manifest).encode())
    assert not is_foreign(replaced, JOB)


def test_pictures_of_the_dataset_are_its_own(dataset: Dataset) -> None:
    """A good picture is no foreign one."""
    upload(StandInRenderer().make(JOB, dataset.header), JOB, dataset)
    assert not is_foreign(dataset, JOB)
