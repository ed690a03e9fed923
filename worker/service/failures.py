"""The handling of failed jobs: a job is tried again later or given up, or it shows that this worker is unfit."""

import numpy as np

from farm.dataset.dataset import Dataset
from farm.dataset.quarantine import put_in_quarantine
from farm.errors import FarmError, PermanentError, RetryableError, UnfitWorkerError
from farm.run.ledger.owner import this_process
from farm.run.ledger.port import Ledger
from farm.spec.job import Job, JobMessage
from worker.service.job_log import JobLogs
from worker.service.lease import LeaseLostError

MAX_TRIES = 3
"""Maximum attempts at a job whose failures may pass; after the last, the job is given up."""

BACKOFF_S = (5.0, 30.0)
"""Seconds before the second and before the third try of a job; each pause is made up to half longer."""

FAILED_IN_A_ROW = 3
"""Number of different jobs that must fail on a worker, one after the other, before it takes itself out."""

_MARGIN_S = 30.0
"""Seconds that a postponed job's claim outlives its pause, so that the message comes back before a coordinator thinks
it lost."""


class TryLaterError(RetryableError):
    """The message is to be sent again, after `delay_s` seconds."""

    def __init__(self, reason: str, delay_s: float) -> None:
        super().__init__(reason)
        self.delay_s = delay_s

    def __reduce__(self) -> tuple[type, tuple[str]]:
        """Pickle as a plain error, which Celery carries from the child to the worker's main process."""
        return RetryableError, (str(self),)


class Failures:
    """Judges the failures of one process's jobs, and writes down those that end a job.

    Args:
        logs: logs of the jobs, for the records of those that are given up; None where jobs have none.
    """

    def __init__(self, logs: JobLogs | None) -> None:
        self._logs = logs
        self._in_a_row: dict[str, str] = {}

    def note_success(self) -> None:
        """End the row of failures: a picture was made."""
        self._in_a_row.clear()

    def postpone_or_give_up(
        self, message: JobMessage, dataset: Dataset, ledger: Ledger, error: RetryableError
    ) -> TryLaterError | PermanentError:
        """Count a failure that may pass.

        Returns:
            The error to raise: the job is tried again later, or was given up after `MAX_TRIES`.

        Raises:
            LeaseLostError: if the job is another worker's by now.
            UnfitWorkerError: if too many jobs have failed here in a row.
        """
        job_id = message.job_id
        _require_claim(ledger, job_id)
        self._count(job_id, error)
        tries = ledger.count_trouble(job_id)
        ledger.add_figures({"retries": 1})
        if tries >= MAX_TRIES:
            reason = f"{error} (tried {tries} times)"
            self.give_up(message, dataset, ledger, reason, tries)
            return PermanentError(f"{message.task_id}: {reason}")
        delay_s = BACKOFF_S[tries - 1] * (1.0 + 0.5 * _jitter(dataset, message.job, tries))
        # The claim stays, free for the taking, so that a coordinator knows the job is on its way.
        ledger.postpone(job_id, this_process(), delay_s + _MARGIN_S)
        return TryLaterError(f"{message.task_id}: {error}", delay_s)

    def give_up_at_once(
        self, message: JobMessage, dataset: Dataset, ledger: Ledger, error: PermanentError, attempts: int
    ) -> None:
        """Give up a job that would fail again.

        Args:
            message: the job.
            dataset: its dataset, whose quarantine takes the record.
            ledger: its run's ledger.
            error: the failure.
            attempts: number of times that the job was begun.

        Raises:
            LeaseLostError: if the job is another worker's by now.
            UnfitWorkerError: if too many jobs have failed here in a row. That may be the dataset's fault, too; but a
                broken worker must not give up all of it.
        """
        self._count(message.job_id, error)
        self.give_up(message, dataset, ledger, str(error), attempts)

    def give_up(self, message: JobMessage, dataset: Dataset, ledger: Ledger, reason: str, attempts: int) -> None:
        """Put a job into its dataset's quarantine.

        Raises:
            LeaseLostError: if the job is another worker's by now.
        """
        _require_claim(ledger, message.job_id)
        printed = "" if self._logs is None else self._logs.tail(message)
        put_in_quarantine(
            dataset,
            message.job,
            reason,
            attempts=attempts,
            worker=this_process(),
            log=printed or ledger.log_of(message.job_id),
        )
        # The record holds the counts by now. A job that is released from quarantine begins with none, even where the
        # command that releases it can't reach this Redis.
        ledger.forgive([message.job_id])
        ledger.add_figures({"quarantined": 1})

    def _count(self, job_id: str, error: FarmError) -> None:
        self._in_a_row[job_id] = str(error)
        if len(self._in_a_row) >= FAILED_IN_A_ROW:
            told = "; ".join(f"{failed}: {why}" for failed, why in self._in_a_row.items())
            reason = f"{len(self._in_a_row)} jobs failed here in a row: {told}"
            raise UnfitWorkerError(reason, error.exit_code) from error


def _require_claim(ledger: Ledger, job_id: str) -> None:
    """Raise LeaseLostError unless this process holds the job's claim: only the holder may count failures or give up."""
    if not ledger.refresh(job_id, this_process()):
        raise LeaseLostError(f"{job_id}: failed here, but is another worker's by now")


def _jitter(dataset: Dataset, job: Job, tries: int) -> float:
    """A number from 0 to 1 for each job and try, so that jobs that failed together don't come back together."""
    seed = np.random.SeedSequence(dataset.header.spec.seed, spawn_key=(job.category.code, job.index, tries))
    return float(np.random.Generator(np.random.PCG64(seed)).random())
