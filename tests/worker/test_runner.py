"""One job from its message to its manifest, with queue and ledger in memory."""

import hashlib
from pathlib import Path

import pytest

from farm.completion import is_done
from farm.dataset import Dataset
from farm.errors import MessageError, PermanentError, SceneError
from farm.job import Job
from farm.layout import FileRole, file_path, manifest_path
from farm.ledger.memory import MemoryLedger
from farm.ledger.owner import this_process
from farm.ledger.port import RETRY_OWNER
from farm.manifest import Manifest
from tests.stand_in import StandInMaker
from worker.made import ImageMaker
from worker.runner import MAX_STARTS, MAX_TRIES, JobRunner, TryLaterError

JOB = Job.from_id("far-000001")


@pytest.fixture
def ledger() -> MemoryLedger:
    """An empty ledger."""
    return MemoryLedger()


@pytest.fixture
def runner(tmp_path: Path, ledger: MemoryLedger) -> JobRunner:
    """Works on the store of the `dataset` fixture."""
    return JobRunner(str(tmp_path / "store"), lambda _: StandInMaker(), lambda *_: ledger)


def test_makes_the_job(dataset: Dataset, runner: JobRunner, ledger: MemoryLedger) -> None:
    """The job's files and manifest are there, it counts as done, and nothing holds it."""
    runner.run(dataset.message(JOB).encode())
    assert is_done(dataset, JOB)
    assert ledger.claims() == {}
    assert ledger.activity().last_picture == file_path(JOB, FileRole.IMAGE)


def test_manifest_vouches_for_the_files(dataset: Dataset, runner: JobRunner) -> None:
    """The manifest's sizes and checksums are those of the files, and its job that of the message."""
    runner.run(dataset.message(JOB).encode())
    manifest = Manifest.model_validate_json(dataset.storage.read(manifest_path(JOB)))
    assert manifest.job_id == JOB.id
    assert manifest.timings_s.keys() == {"render", "write"}
    for role in FileRole:
        content = dataset.storage.read(file_path(JOB, role))
        assert manifest.files[role].bytes == len(content)
        assert manifest.files[role].sha256 == hashlib.sha256(content).hexdigest()


def test_second_time_does_nothing(dataset: Dataset, runner: JobRunner, ledger: MemoryLedger) -> None:
    """A message that comes twice makes one picture, counted once."""
    runner.run(dataset.message(JOB).encode())
    before = dataset.storage.files()
    assert "already" in runner.run(dataset.message(JOB).encode())
    assert dataset.storage.files() == before
    assert sum(ledger.activity().done.values()) == 1


def test_same_job_same_bytes(dataset: Dataset, runner: JobRunner) -> None:
    """A picture that is made again is the same."""
    runner.run(dataset.message(JOB).encode())
    first = dataset.storage.read(file_path(JOB, FileRole.IMAGE))
    dataset.storage.remove(manifest_path(JOB))
    runner.run(dataset.message(JOB).encode())
    assert dataset.storage.read(file_path(JOB, FileRole.IMAGE)) == first


def test_claimed_elsewhere(dataset: Dataset, runner: JobRunner, ledger: MemoryLedger) -> None:
    """A job that another process works on is put off without a try being spent."""
    ledger.claim(JOB.id, "elsewhere:1")
    with pytest.raises(TryLaterError, match="claimed"):
        runner.run(dataset.message(JOB).encode())
    assert ledger.claims() == {JOB.id: "elsewhere:1"}
    assert not is_done(dataset, JOB)


def test_claim_of_a_dead_process_is_taken_over(dataset: Dataset, runner: JobRunner, ledger: MemoryLedger) -> None:
    """A redelivered job does not wait for the claim of the process that died with it."""
    ledger.claim(JOB.id, f"{this_process().partition(':')[0]}:{2**22 + 1}")
    runner.run(dataset.message(JOB).encode())
    assert is_done(dataset, JOB)


def test_permanent_failure(
    dataset: Dataset, runner: JobRunner, ledger: MemoryLedger, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What can't succeed is recorded with its reason at the first try."""
    monkeypatch.setenv("STAND_IN_FAILS", f"{JOB.id}=permanent")
    with pytest.raises(SceneError):
        runner.run(dataset.message(JOB).encode())
    assert ledger.failures() == {JOB.id: "no scene passed the checks"}
    assert ledger.claims() == {}
    assert not is_done(dataset, JOB)


@pytest.mark.parametrize(("kind", "reason"), [("passing", "lost the device"), ("defect", "unexpected ZeroDivision")])
def test_passing_failure(
    dataset: Dataset,
    runner: JobRunner,
    ledger: MemoryLedger,
    monkeypatch: pytest.MonkeyPatch,
    kind: str,
    reason: str,
) -> None:
    """What may pass is put off, held meanwhile, and given up after the last try."""
    monkeypatch.setenv("STAND_IN_FAILS", f"{JOB.id}={kind}")
    for _ in range(MAX_TRIES - 1):
        with pytest.raises(TryLaterError, match=reason):
            runner.run(dataset.message(JOB).encode())
        assert ledger.claims() == {JOB.id: RETRY_OWNER}
    with pytest.raises(PermanentError, match=reason):
        runner.run(dataset.message(JOB).encode())
    assert reason in ledger.failures()[JOB.id]
    assert ledger.claims() == {}


def test_failure_that_passed(
    dataset: Dataset, runner: JobRunner, ledger: MemoryLedger, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A second try that succeeds leaves no trace of the first."""
    monkeypatch.setenv("STAND_IN_FAILS", f"{JOB.id}=passing")
    with pytest.raises(TryLaterError):
        runner.run(dataset.message(JOB).encode())
    monkeypatch.delenv("STAND_IN_FAILS")
    runner.run(dataset.message(JOB).encode())
    assert is_done(dataset, JOB)
    assert ledger.failures() == {}


def test_job_that_kills_its_process(dataset: Dataset, runner: JobRunner, ledger: MemoryLedger) -> None:
    """A job whose attempts all ended without a word is not begun for ever."""
    for number in range(MAX_STARTS):
        ledger.claim(JOB.id, f"elsewhere:{number}", ttl_s=0.0)
    with pytest.raises(PermanentError, match="died"):
        runner.run(dataset.message(JOB).encode())
    assert JOB.id in ledger.failures()


def test_dataset_that_is_not_here(dataset: Dataset, tmp_path: Path, ledger: MemoryLedger) -> None:
    """A worker whose store lacks the dataset tries later, as the store may be mounted late."""
    runner = JobRunner(str(tmp_path / "elsewhere"), lambda _: StandInMaker(), lambda *_: ledger)
    with pytest.raises(TryLaterError, match="no dataset here"):
        runner.run(dataset.message(JOB).encode())
    assert not (tmp_path / "elsewhere").exists()


def test_message_for_another_description(dataset: Dataset, runner: JobRunner, ledger: MemoryLedger) -> None:
    """A job of another description is refused, and nothing is written."""
    before = dataset.storage.files()
    message = dataset.message(JOB).encode() | {"spec_sha256": "f" * 64}
    with pytest.raises(MessageError, match="submit again"):
        runner.run(message)
    assert dataset.storage.files() == before
    assert JOB.id in ledger.failures()


@pytest.mark.parametrize(
    "payload",
    [
        None,
        "far-000001",
        [],
        {},
        {"version": 1},
        {"version": 2, "dataset": "cables", "spec_sha256": "0" * 64, "job_id": "far-000001"},
        {"version": 1, "dataset": "../cables", "spec_sha256": "0" * 64, "job_id": "far-000001"},
        {"version": 1, "dataset": "cables", "spec_sha256": "0" * 64, "job_id": "../../far-000001"},
        {"version": 1, "dataset": "cables", "spec_sha256": "0" * 64, "job_id": "far-000001", "path": "/etc"},
        {"version": 1, "dataset": "cables", "spec_sha256": "0" * 64, "job_id": 7},
        {"version": True, "dataset": "cables", "spec_sha256": "0" * 64, "job_id": "far-000001"},
    ],
)
def test_bad_message(dataset: Dataset, runner: JobRunner, payload: object) -> None:
    """A malformed message is refused in one line before anything is touched."""
    before = dataset.storage.files()
    with pytest.raises(MessageError) as refused:
        runner.run(payload)
    assert "\n" not in str(refused.value)
    assert dataset.storage.files() == before


def test_maker_is_kept(dataset: Dataset, tmp_path: Path, ledger: MemoryLedger) -> None:
    """One maker serves all jobs of a dataset."""
    opened: list[ImageMaker] = []

    def open_maker(_header: object) -> ImageMaker:
        opened.append(StandInMaker())
        return opened[-1]

    runner = JobRunner(str(tmp_path / "store"), open_maker, lambda *_: ledger)
    for job in dataset.header.spec.jobs():
        runner.run(dataset.message(job).encode())
    assert len(opened) == 1
