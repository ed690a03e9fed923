"""Records of given-up jobs in the dataset's folder."""

from collections.abc import Callable

import pytest

from farm.dataset.dataset import Dataset, create_dataset, open_dataset
from farm.dataset.destination import Destination
from farm.dataset.paths import quarantine_path
from farm.dataset.quarantine import LOG_LENGTH, Quarantine, QuarantineRecord, is_in_quarantine, put_in_quarantine
from farm.dataset.verify import verify
from farm.spec.header import DatasetHeader
from farm.spec.job import Job
from tests.stand_in import StandInRenderer
from worker.service.upload import upload

JOB = Job.from_id("far-000001")
OTHER = Job.from_id("far-000000")


def give_up(dataset: Dataset, job: Job = JOB, reason: str = "no scene passed", log: str = "the end") -> None:
    """Put a job in quarantine."""
    put_in_quarantine(dataset, job, reason, attempts=3, worker="host:1", log=log)


def record(dataset: Dataset, job: Job = JOB) -> QuarantineRecord:
    """The record of a job."""
    return QuarantineRecord.model_validate_json(dataset.storage.read(quarantine_path(job)))


def test_record_survives(any_store: Callable[[str], str], header: DatasetHeader) -> None:
    """A record is read from the folder with its reason, also in a bucket."""
    place = Destination(any_store("store"), "cables")
    give_up(create_dataset(place, header))
    dataset = open_dataset(place)
    assert Quarantine(dataset).look() == {JOB.id: "no scene passed"}
    assert is_in_quarantine(dataset, JOB)
    assert not is_in_quarantine(dataset, OTHER)


def test_record_tells_how_to_go_on(dataset: Dataset) -> None:
    """A record holds the job, its attempts, who gave it up, its output, and the command that makes it again."""
    give_up(dataset)
    found = record(dataset)
    assert (found.dataset, found.job_id, found.attempts, found.worker) == ("cables", JOB.id, 3, "host:1")
    assert found.spec_sha256 == dataset.identity
    assert found.log == "the end"
    assert found.replay == f"farm replay {dataset.storage.location} {JOB.id}"


def test_long_texts_are_cut(dataset: Dataset) -> None:
    """The beginning of a long reason is kept, and the end of a long log."""
    give_up(dataset, reason="a" + "b" * 5000, log="c" * LOG_LENGTH + "d")
    found = record(dataset)
    assert found.reason.startswith("ab")
    assert found.reason.endswith("b...")
    assert len(found.reason) == 500
    assert found.log.endswith("cd")
    assert len(found.log) == LOG_LENGTH


def test_empty_quarantine(dataset: Dataset) -> None:
    """An empty quarantine has no records."""
    assert Quarantine(dataset).look() == {}


def test_new_and_changed_records(dataset: Dataset) -> None:
    """Each look reports the records that are new, changed or gone since the last one, in order."""
    quarantine = Quarantine(dataset)
    give_up(dataset)
    assert quarantine.look() == {JOB.id: "no scene passed"}
    give_up(dataset, reason="another, longer reason")
    give_up(dataset, OTHER)
    looked = quarantine.look()
    assert looked == {OTHER.id: "no scene passed", JOB.id: "another, longer reason"}
    assert list(looked) == [OTHER.id, JOB.id]
    dataset.storage.remove(quarantine_path(JOB))
    assert list(quarantine.look()) == [OTHER.id]


@pytest.mark.parametrize("content", [b"", b"{}", b"\xff\xfe", b"no json", b"[" * 100_000])
def test_unreadable_record(dataset: Dataset, content: bytes) -> None:
    """A job whose record is damaged still counts as given up, and the reason says so."""
    dataset.storage.write(quarantine_path(JOB), content)
    assert Quarantine(dataset).look() == {JOB.id: "its record in the quarantine folder can't be read"}
    assert is_in_quarantine(dataset, JOB)


def test_record_of_another_job(dataset: Dataset) -> None:
    """A record whose name isn't its job's doesn't give that job's reason."""
    give_up(dataset, OTHER, reason="its own")
    dataset.storage.write(quarantine_path(JOB), dataset.storage.read(quarantine_path(OTHER)))
    assert Quarantine(dataset).look()[JOB.id] == "its record in the quarantine folder can't be read"


def test_release(dataset: Dataset) -> None:
    """A released job is no longer given up, and releasing it twice is no error."""
    give_up(dataset)
    give_up(dataset, OTHER)
    quarantine = Quarantine(dataset)
    quarantine.look()
    quarantine.release([JOB.id])
    quarantine.release([JOB.id])
    assert list(quarantine.look()) == [OTHER.id]


@pytest.mark.parametrize(
    "name",
    [
        "far-000007.json",
        "far-000001.JSON",
        "far-0000001.json",
        ".tmp-far-000001.json.host.1",
        "below/far-000001.json",
        "-rf.json",
        "far-000001\n.json",
        "$(touch x).json",
        "\u202egnp.json",
        "README.txt",
    ],
)
def test_foreign_names_count_for_nothing(dataset: Dataset, name: str) -> None:
    """Files in the folder that aren't records give no job up."""
    give_up(dataset, OTHER)
    content = dataset.storage.read(quarantine_path(OTHER))
    dataset.storage.write(f"quarantine/{name}", content)
    assert list(Quarantine(dataset).look()) == [OTHER.id]


def test_folder_in_the_place_of_a_record(dataset: Dataset) -> None:
    """A folder with the name of a record isn't a record."""
    dataset.storage.write(f"{quarantine_path(JOB)}/file", b"")
    assert Quarantine(dataset).look() == {}


def test_record_is_no_extra_file(dataset: Dataset) -> None:
    """A check of the dataset accepts records, and misses nothing of their jobs."""
    for job in dataset.header.spec.jobs():
        if job != JOB:
            upload(StandInRenderer().make(job, dataset.header), job, dataset)
    give_up(dataset)
    verdict = verify(dataset)
    assert verdict.clean
    assert verdict.images == 3
    assert verdict.quarantined == {JOB.id: "no scene passed"}
