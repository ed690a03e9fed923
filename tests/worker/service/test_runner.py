"""One job from its message to its manifest, with queue and ledger in memory."""

import errno
import hashlib
import os
from collections.abc import Mapping
from pathlib import Path
from unittest.mock import Mock

import pytest
from celery.exceptions import SoftTimeLimitExceeded

from farm.dataset.completion import is_done
from farm.dataset.dataset import Dataset
from farm.dataset.manifest import Manifest
from farm.dataset.outputs import IMAGE, MASK, OUTPUTS
from farm.dataset.paths import file_path, manifest_path, quarantine_path
from farm.dataset.quarantine import Quarantine, QuarantineRecord, put_in_quarantine
from farm.errors import (
    AssetError,
    DestinationError,
    FarmError,
    MachineError,
    MessageError,
    PermanentError,
    RenderError,
    SceneError,
    TemplateError,
    UnfitWorkerError,
)
from farm.run.ledger.owner import this_process
from farm.run.ledger.port import MAX_ABSENCES, RETRY_OWNER
from farm.run.worker_settings import RendererSettings
from farm.spec.header import DatasetHeader
from farm.spec.job import Job
from tests.doubles.ledger import MemoryLedger
from tests.stand_in import StandInRenderer
from worker.service.failures import FAILED_IN_A_ROW, MAX_TRIES, TryLaterError
from worker.service.job_log import JobLogs
from worker.service.kept_renderer import KeptRenderer
from worker.service.picture import Picture, Renderer
from worker.service.runner import MAX_STARTS, JobRunner

JOB = Job.from_id("far-000001")


@pytest.fixture
def ledger() -> MemoryLedger:
    """An empty ledger."""
    return MemoryLedger()


def runner_with(renderer: Renderer, store: Path, ledger: MemoryLedger, logs: JobLogs | None = None) -> JobRunner:
    """A runner whose renderer can be opened."""
    return JobRunner(str(store), KeptRenderer(lambda *_: renderer, RendererSettings()), lambda *_: ledger, logs)


@pytest.fixture
def runner(tmp_path: Path, ledger: MemoryLedger) -> JobRunner:
    """Works on the store of the `dataset` fixture."""
    return runner_with(StandInRenderer(), tmp_path / "store", ledger)


def given_up(dataset: Dataset) -> Mapping[str, str]:
    """The jobs in quarantine, with their reasons."""
    return Quarantine(dataset).look()


def test_makes_the_job(dataset: Dataset, runner: JobRunner, ledger: MemoryLedger) -> None:
    """The job's files and manifest are there, it counts as done, and nothing holds it."""
    runner.run(dataset.message(JOB).encode())
    assert is_done(dataset, JOB)
    assert ledger.claims() == {}
    assert ledger.activity().last_picture == file_path(JOB, IMAGE)


def test_manifest_vouches_for_the_files(dataset: Dataset, runner: JobRunner) -> None:
    """The manifest's sizes and checksums are those of the files, and its job that of the message."""
    runner.run(dataset.message(JOB).encode())
    manifest = Manifest.model_validate_json(dataset.storage.read(manifest_path(JOB)))
    assert manifest.job_id == JOB.id
    assert manifest.timings_s.keys() == {"render", "write"}
    for output in OUTPUTS:
        content = dataset.storage.read(file_path(JOB, output))
        assert manifest.files[output.folder].bytes == len(content)
        assert manifest.files[output.folder].sha256 == hashlib.sha256(content).hexdigest()


def test_second_time_does_nothing(dataset: Dataset, runner: JobRunner) -> None:
    """A message that is delivered twice makes one picture."""
    runner.run(dataset.message(JOB).encode())
    before = dataset.storage.files()
    assert "already" in runner.run(dataset.message(JOB).encode()).said
    assert dataset.storage.files() == before


def test_same_job_same_bytes(dataset: Dataset, runner: JobRunner) -> None:
    """A picture that is made again is the same."""
    runner.run(dataset.message(JOB).encode())
    first = dataset.storage.read(file_path(JOB, IMAGE))
    dataset.storage.remove(manifest_path(JOB))
    runner.run(dataset.message(JOB).encode())
    assert dataset.storage.read(file_path(JOB, IMAGE)) == first


def test_claimed_elsewhere(dataset: Dataset, runner: JobRunner, ledger: MemoryLedger) -> None:
    """A job that another process holds is postponed without spending an attempt."""
    ledger.claim(JOB.id, "elsewhere:1")
    with pytest.raises(TryLaterError, match="claimed"):
        runner.run(dataset.message(JOB).encode())
    assert ledger.claims() == {JOB.id: "elsewhere:1"}
    assert not is_done(dataset, JOB)


def test_claim_of_a_dead_process_is_taken_over(dataset: Dataset, runner: JobRunner, ledger: MemoryLedger) -> None:
    """A redelivered job doesn't wait for the claim of the process that died with it."""
    ledger.claim(JOB.id, f"{this_process().partition(':')[0]}:{2**22 + 1}")
    runner.run(dataset.message(JOB).encode())
    assert is_done(dataset, JOB)


def test_permanent_failure(
    dataset: Dataset, runner: JobRunner, ledger: MemoryLedger, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A failure that can't pass gives the job up with its reason at the first attempt."""
    monkeypatch.setenv("STAND_IN_FAILS", f"{JOB.id}=permanent")
    with pytest.raises(SceneError):
        runner.run(dataset.message(JOB).encode())
    assert given_up(dataset) == {JOB.id: "no scene passed the checks"}
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
    """A failure that may pass postpones the job, which is held meanwhile and given up after the last attempt."""
    monkeypatch.setenv("STAND_IN_FAILS", f"{JOB.id}={kind}")
    for _ in range(MAX_TRIES - 1):
        with pytest.raises(TryLaterError, match=reason):
            runner.run(dataset.message(JOB).encode())
        assert ledger.claims() == {JOB.id: RETRY_OWNER}
    with pytest.raises(PermanentError, match=reason):
        runner.run(dataset.message(JOB).encode())
    assert reason in given_up(dataset)[JOB.id]
    assert ledger.figures() == {"retries": MAX_TRIES, "quarantined": 1}
    assert ledger.claims() == {}


def test_failure_that_passed(dataset: Dataset, runner: JobRunner, monkeypatch: pytest.MonkeyPatch) -> None:
    """If the second attempt succeeds, no trace of the first is left."""
    monkeypatch.setenv("STAND_IN_FAILS", f"{JOB.id}=passing")
    with pytest.raises(TryLaterError):
        runner.run(dataset.message(JOB).encode())
    monkeypatch.delenv("STAND_IN_FAILS")
    runner.run(dataset.message(JOB).encode())
    assert is_done(dataset, JOB)
    assert given_up(dataset) == {}


def test_job_that_kills_its_process(dataset: Dataset, runner: JobRunner, ledger: MemoryLedger) -> None:
    """A job whose attempts all ended with their process isn't begun for ever."""
    for number in range(MAX_STARTS):
        ledger.claim(JOB.id, f"elsewhere:{number}", ttl_s=0.0)
    with pytest.raises(PermanentError, match="died"):
        runner.run(dataset.message(JOB).encode())
    assert f"in each of {MAX_STARTS} attempts" in given_up(dataset)[JOB.id]


def test_lost_processes_are_no_failed_tries(
    dataset: Dataset, runner: JobRunner, ledger: MemoryLedger, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Starts that ended with their process don't count as attempts at a failure that may pass."""
    monkeypatch.setenv("STAND_IN_FAILS", f"{JOB.id}=passing")
    for number in range(2):
        ledger.claim(JOB.id, f"elsewhere:{number}", ttl_s=0.0)
    for _ in range(MAX_TRIES - 1):
        with pytest.raises(TryLaterError):
            runner.run(dataset.message(JOB).encode())
    with pytest.raises(PermanentError, match=f"tried {MAX_TRIES} times"):
        runner.run(dataset.message(JOB).encode())


@pytest.mark.parametrize(
    "fault", [AssetError("torn"), MachineError("no GPU"), TemplateError("bent"), RenderError("dark")]
)
def test_renderer_that_cannot_be_opened(
    dataset: Dataset, tmp_path: Path, ledger: MemoryLedger, runner: JobRunner, fault: FarmError
) -> None:
    """A machine's fault isn't the job's: nothing is recorded or spent, and another worker makes the job."""

    def open_renderer(*_: object) -> Renderer:
        raise fault

    unfit = JobRunner(str(tmp_path / "store"), KeptRenderer(open_renderer, RendererSettings()), lambda *_: ledger)
    for _ in range(MAX_STARTS + 1):
        with pytest.raises(UnfitWorkerError, match=str(fault)) as refused:
            unfit.run(dataset.message(JOB).encode())
        assert type(refused.value.as_fault()) is type(fault)
    assert given_up(dataset) == ledger.claims() == {}
    runner.run(dataset.message(JOB).encode())
    assert is_done(dataset, JOB)


def test_blender_that_does_not_load(dataset: Dataset, tmp_path: Path, ledger: MemoryLedger) -> None:
    """A library that is missing when the renderer is opened is a fault of the machine, too."""

    def open_renderer(*_: object) -> Renderer:
        raise ImportError("libXi.so.6")

    with pytest.raises(UnfitWorkerError, match=r"libXi\.so\.6") as refused:
        JobRunner(str(tmp_path / "store"), KeptRenderer(open_renderer, RendererSettings()), lambda *_: ledger).run(
            dataset.message(JOB).encode()
        )
    assert isinstance(refused.value.as_fault(), MachineError)


def test_asset_that_this_machine_lacks(
    dataset: Dataset, runner: JobRunner, ledger: MemoryLedger, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A texture that turns out to be missing during a picture isn't a failure of the job."""
    monkeypatch.setenv("STAND_IN_FAILS", f"{JOB.id}=asset")
    with pytest.raises(UnfitWorkerError, match="not baked"):
        runner.run(dataset.message(JOB).encode())
    assert given_up(dataset) == ledger.claims() == {}


def test_dataset_that_is_not_here(dataset: Dataset, tmp_path: Path, ledger: MemoryLedger) -> None:
    """A store that lacks the dataset is the worker's fault; that all stores lack it is found out in the end."""
    runner = runner_with(StandInRenderer(), tmp_path / "elsewhere", ledger)
    for _ in range(MAX_ABSENCES):
        with pytest.raises(UnfitWorkerError, match=r"no dataset here.*--store"):
            runner.run(dataset.message(JOB).encode())
    assert given_up(dataset) == {}
    assert "other workers lacked it" in runner.run(dataset.message(JOB).encode()).said
    assert ledger.absences() == MAX_ABSENCES + 1
    assert not (tmp_path / "elsewhere").exists()


def test_restarted_worker_with_a_wrong_store(
    dataset: Dataset, tmp_path: Path, runner: JobRunner, ledger: MemoryLedger
) -> None:
    """While another worker makes pictures, one that is started over and over fails none."""
    wrong = runner_with(StandInRenderer(), tmp_path / "elsewhere", ledger)
    jobs = list(dataset.header.spec.jobs())
    for number in range(2 * MAX_ABSENCES):
        with pytest.raises(UnfitWorkerError):
            wrong.run(dataset.message(jobs[-1]).encode())
        if number % 4 == 0:
            runner.run(dataset.message(jobs[number // 4]).encode())
    assert given_up(dataset) == {}


def test_message_for_another_description(dataset: Dataset, runner: JobRunner, ledger: MemoryLedger) -> None:
    """A message of a dataset that was replaced is dropped: nothing is written or recorded."""
    before = dataset.storage.files()
    assert runner.run(dataset.message(JOB).encode() | {"spec_sha256": "f" * 64}).said.startswith("dropped")
    assert dataset.storage.files() == before
    assert given_up(dataset) == ledger.claims() == {}


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


def test_given_up_job_is_dropped(dataset: Dataset, runner: JobRunner, ledger: MemoryLedger) -> None:
    """A message of a job in quarantine is acknowledged and has no other effect."""
    put_in_quarantine(dataset, JOB, "died", attempts=3, worker="host:1", log="")
    before = dataset.storage.files()
    assert "in quarantine" in runner.run(dataset.message(JOB).encode()).said
    assert dataset.storage.files() == before
    assert ledger.claims() == {}


class PrintingRenderer(StandInRenderer):
    """Writes as C code does, before it fails or not."""

    def make(self, job: Job, header: DatasetHeader) -> Picture:
        """Implement `Renderer.make`."""
        os.write(2, f"GPU fell off the bus in {job.id}".encode())
        return super().make(job, header)


def test_record_has_the_log_and_how_to_replay(
    dataset: Dataset, tmp_path: Path, ledger: MemoryLedger, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A record holds the output of the last attempt, the worker, and the command that makes the job again."""
    monkeypatch.setenv("STAND_IN_FAILS", f"{JOB.id}=permanent")
    runner = runner_with(PrintingRenderer(), tmp_path / "store", ledger, JobLogs(tmp_path / "logs"))
    with pytest.raises(SceneError):
        runner.run(dataset.message(JOB).encode())
    record = QuarantineRecord.model_validate_json(dataset.storage.read(quarantine_path(JOB)))
    assert record.log == f"GPU fell off the bus in {JOB.id}"
    assert record.worker == this_process()
    assert record.replay == f"farm replay {dataset.storage.location} {JOB.id}"


def test_record_has_the_log_of_a_process_that_died(dataset: Dataset, runner: JobRunner, ledger: MemoryLedger) -> None:
    """The record holds what the main process kept of the dead child's output."""
    for number in range(MAX_STARTS):
        ledger.claim(JOB.id, f"elsewhere:{number}", ttl_s=0.0)
    ledger.keep_log(JOB.id, "Segmentation fault")
    with pytest.raises(PermanentError):
        runner.run(dataset.message(JOB).encode())
    record = QuarantineRecord.model_validate_json(dataset.storage.read(quarantine_path(JOB)))
    assert record.log == "Segmentation fault"


@pytest.mark.parametrize("kind", ["permanent", "passing", "defect"])
def test_different_jobs_that_fail_in_a_row(
    dataset: Dataset, runner: JobRunner, ledger: MemoryLedger, monkeypatch: pytest.MonkeyPatch, kind: str
) -> None:
    """If one job after the other fails, the worker is at fault: the last job goes back as if it had not begun."""
    jobs = list(dataset.header.spec.jobs())[:FAILED_IN_A_ROW]
    monkeypatch.setenv("STAND_IN_FAILS", " ".join(f"{job.id}={kind}" for job in jobs))
    for job in jobs[:-1]:
        with pytest.raises((PermanentError, TryLaterError)):
            runner.run(dataset.message(job).encode())
    with pytest.raises(UnfitWorkerError, match="3 jobs failed here in a row") as unfit:
        runner.run(dataset.message(jobs[-1]).encode())
    assert all(f"{job.id}: " in str(unfit.value) for job in jobs)
    assert jobs[-1].id not in given_up(dataset)
    assert jobs[-1].id not in ledger.claims()
    assert ledger.claim(jobs[-1].id, "elsewhere:1") == ledger.count_trouble(jobs[-1].id) == 1


def test_success_in_between(dataset: Dataset, runner: JobRunner, monkeypatch: pytest.MonkeyPatch) -> None:
    """A job that succeeds shows that the worker is fit, whatever fails around it."""
    jobs = list(dataset.header.spec.jobs())
    monkeypatch.setenv("STAND_IN_FAILS", " ".join(f"{job.id}=permanent" for job in (jobs[0], jobs[1], jobs[3])))
    for job in jobs:
        if job == jobs[2]:
            runner.run(dataset.message(job).encode())
        else:
            with pytest.raises(SceneError):
                runner.run(dataset.message(job).encode())
    assert len(given_up(dataset)) == 3


class CountingRenderer(StandInRenderer):
    """Counts what it is asked for."""

    asked = 0

    def make(self, job: Job, header: DatasetHeader) -> Picture:
        """Implement `Renderer.make`."""
        self.asked += 1
        return super().make(job, header)


def test_store_that_cannot_be_written(dataset: Dataset, tmp_path: Path, ledger: MemoryLedger) -> None:
    """A job whose files can't be written goes back uncounted; the next ones are not rendered until a write succeeds."""
    renderer = CountingRenderer()
    runner = runner_with(renderer, tmp_path / "store", ledger)
    images = tmp_path / "store/cables/far/images"
    images.parent.mkdir()
    images.write_text("in the way")
    for _ in range(2 * MAX_STARTS):
        with pytest.raises(DestinationError, match="images"):
            runner.run(dataset.message(JOB).encode())
    assert renderer.asked == 1
    assert given_up(dataset) == ledger.claims() == {}
    assert ledger.figures() == {}
    images.unlink()
    runner.run(dataset.message(JOB).encode())
    assert renderer.asked == 2
    assert is_done(dataset, JOB)
    assert not [path for path in dataset.storage.files() if "probe" in path]
    assert ledger.claim(JOB.id, "elsewhere:1") == 1


def test_claim_that_was_lost_meanwhile(dataset: Dataset, tmp_path: Path, ledger: MemoryLedger) -> None:
    """If another worker has claimed the job by the end of its render, nothing is written, and the job is postponed."""

    class SlowRenderer(StandInRenderer):
        def make(self, job: Job, header: DatasetHeader) -> Picture:
            ledger.release(job.id, this_process())
            ledger.claim(job.id, "elsewhere:1")
            return super().make(job, header)

    before = dataset.storage.files()
    runner = runner_with(SlowRenderer(), tmp_path / "store", ledger)
    with pytest.raises(TryLaterError, match=r"another's|lost its claim"):
        runner.run(dataset.message(JOB).encode())
    assert dataset.storage.files() == before
    assert ledger.claims() == {JOB.id: "elsewhere:1"}


def test_job_that_was_put_back_begins_anew(dataset: Dataset, runner: JobRunner, ledger: MemoryLedger) -> None:
    """A given-up job whose record is removed is made, whatever the number of its earlier starts."""
    for number in range(MAX_STARTS):
        ledger.claim(JOB.id, f"elsewhere:{number}", ttl_s=0.0)
    with pytest.raises(PermanentError):
        runner.run(dataset.message(JOB).encode())
    Quarantine(dataset).release([JOB.id])
    runner.run(dataset.message(JOB).encode())
    assert is_done(dataset, JOB)


def test_figures(dataset: Dataset, runner: JobRunner, ledger: MemoryLedger) -> None:
    """A finished job adds its image, its redrawn scenes and the seconds of its stages."""
    runner.run(dataset.message(JOB).encode())
    figures = ledger.figures()
    assert figures["images:far"] == figures["redrawn"] == 1
    assert figures["seconds:render"] == pytest.approx(0.01)
    assert figures["seconds:write"] > 0


def test_duplicates_are_no_starts(dataset: Dataset, runner: JobRunner) -> None:
    """However often a finished job is delivered again, it may be made again when its picture is damaged."""
    for _ in range(MAX_STARTS + 2):
        runner.run(dataset.message(JOB).encode())
    dataset.storage.write(file_path(JOB, MASK), b"damaged")
    assert runner.run(dataset.message(JOB).encode()).made
    assert given_up(dataset) == {}


@pytest.mark.parametrize("content", [b"{}", b"no json"])
def test_header_that_this_worker_cannot_read(dataset: Dataset, runner: JobRunner, content: bytes) -> None:
    """A worker of another version takes itself out and spends none of the job's starts."""
    good = dataset.storage.read("dataset.json")
    dataset.storage.write("dataset.json", content)
    for _ in range(MAX_STARTS + 1):
        with pytest.raises(UnfitWorkerError, match="not readable by cable-farm"):
            runner.run(dataset.message(JOB).encode())
    dataset.storage.write("dataset.json", good)
    assert runner.run(dataset.message(JOB).encode()).made


def test_dataset_that_was_here_before(dataset: Dataset, runner: JobRunner, tmp_path: Path) -> None:
    """A store that vanishes during the work is waited for, and the worker isn't unfit."""
    runner.run(dataset.message(JOB).encode())
    (tmp_path / "store/cables").rename(tmp_path / "gone")
    with pytest.raises(DestinationError, match="no dataset here"):
        runner.run(dataset.message(JOB).encode())


def test_late_failure_is_not_counted(dataset: Dataset, tmp_path: Path, ledger: MemoryLedger) -> None:
    """A failure after the job has become another worker's isn't counted and doesn't give the job up."""

    class LateRenderer(StandInRenderer):
        def make(self, job: Job, header: DatasetHeader) -> Picture:
            del header
            ledger.release(job.id, this_process())
            ledger.claim(job.id, "elsewhere:1")
            raise SceneError("too late")

    runner = runner_with(LateRenderer(), tmp_path / "store", ledger)
    with pytest.raises(TryLaterError, match="another worker's"):
        runner.run(dataset.message(JOB).encode())
    assert given_up(dataset) == {}
    assert ledger.claims() == {JOB.id: "elsewhere:1"}


def test_slow_store_fails_no_job(dataset: Dataset, runner: JobRunner, monkeypatch: pytest.MonkeyPatch) -> None:
    """A time limit that is reached while files are written is the store's fault."""
    monkeypatch.setattr("worker.service.runner.upload", Mock(side_effect=SoftTimeLimitExceeded()))
    for _ in range(MAX_STARTS + 1):
        with pytest.raises(DestinationError, match="SoftTimeLimitExceeded"):
            runner.run(dataset.message(JOB).encode())
    monkeypatch.undo()
    assert runner.run(dataset.message(JOB).encode()).made


def test_full_disk_of_the_renderer_fails_no_job(dataset: Dataset, tmp_path: Path, ledger: MemoryLedger) -> None:
    """While a disk of this machine is full no try or start is counted and nothing is given up; then all goes on."""
    full = [True]

    class FullRenderer(StandInRenderer):
        def make(self, job: Job, header: DatasetHeader) -> Picture:
            if full[0]:
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), "/scratch/made")
            return super().make(job, header)

    runner = runner_with(FullRenderer(), tmp_path / "store", ledger)
    for _ in range(2 * MAX_STARTS):
        with pytest.raises(DestinationError, match="/scratch/made: can't write: No space left on device"):
            runner.run(dataset.message(JOB).encode())
    assert given_up(dataset) == ledger.claims() == {}
    assert ledger.figures() == {}
    full[0] = False
    assert runner.run(dataset.message(JOB).encode()).made
