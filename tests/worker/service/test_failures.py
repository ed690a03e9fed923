"""What becomes of jobs that failed, with a ledger in memory."""

import pytest

from farm.dataset.dataset import Dataset
from farm.errors import PermanentError, RenderError
from farm.run.ledger.owner import this_process
from farm.spec.job import Job
from tests.doubles.ledger import MemoryLedger
from worker.service.failures import BACKOFF_S, MAX_TRIES, Failures, TryLaterError
from worker.service.lease import LeaseLostError

JOB = Job.from_id("far-000001")


def fail(dataset: Dataset, job: Job, ledger: MemoryLedger) -> TryLaterError | PermanentError:
    """A failure that may pass, on a worker that knows of no other."""
    ledger.claim(job.id, this_process())
    return Failures(None).postpone_or_give_up(dataset.message(job), dataset, ledger, RenderError("dark"))


def pause(dataset: Dataset, job: Job, ledger: MemoryLedger) -> float:
    """Seconds for which a job is put off."""
    later = fail(dataset, job, ledger)
    assert isinstance(later, TryLaterError)
    return later.delay_s


def test_pauses_differ_and_repeat(dataset: Dataset) -> None:
    """Jobs that failed together come back apart, each after the same pause whenever it is made."""
    jobs = list(dataset.header.spec.jobs())
    pauses = [pause(dataset, job, MemoryLedger()) for job in jobs]
    assert len(set(pauses)) == len(jobs)
    assert all(BACKOFF_S[0] <= each <= 1.5 * BACKOFF_S[0] for each in pauses)
    assert [pause(dataset, job, MemoryLedger()) for job in jobs] == pauses


def test_pauses_grow(dataset: Dataset) -> None:
    """The second pause of a job is longer than any first one."""
    ledger = MemoryLedger()
    first, second = (pause(dataset, JOB, ledger) for _ in range(2))
    assert first <= 1.5 * BACKOFF_S[0] < BACKOFF_S[1] <= second


def test_the_last_try_gives_the_job_up(dataset: Dataset) -> None:
    """Tries are counted in the ledger, so that another worker goes on counting."""
    ledger = MemoryLedger()
    ends = [fail(dataset, JOB, ledger) for _ in range(MAX_TRIES)]
    assert [type(end) for end in ends] == [TryLaterError] * (MAX_TRIES - 1) + [PermanentError]
    assert f"tried {MAX_TRIES} times" in str(ends[-1])


def test_a_job_of_another_worker_is_not_counted(dataset: Dataset) -> None:
    """Only the holder of a claim may count the job's failures."""
    ledger = MemoryLedger()
    ledger.claim(JOB.id, "elsewhere:1")
    with pytest.raises(LeaseLostError, match="another worker's"):
        fail(dataset, JOB, ledger)
    assert ledger.count_trouble(JOB.id) == 1
