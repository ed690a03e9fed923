"""Runs one job from its message to its manifest, whatever brought the message."""

from typing import NamedTuple

from celery.exceptions import SoftTimeLimitExceeded

from farm.dataset.completion import is_done
from farm.dataset.dataset import Dataset, open_for_message
from farm.dataset.manifest import Manifest
from farm.dataset.outputs import IMAGE
from farm.dataset.place import read_place
from farm.dataset.quarantine import is_in_quarantine
from farm.errors import (
    BrokerError,
    ConflictError,
    DestinationError,
    FarmError,
    MessageError,
    PermanentError,
    RetryableError,
    SpecError,
    StaleMessageError,
    UnfitWorkerError,
)
from farm.run.ledger.owner import is_gone, this_process
from farm.run.ledger.port import CLAIM_S, Ledger, LedgerFactory
from farm.spec.job import Job, JobMessage
from worker.service.failures import Failures, TryLaterError
from worker.service.job_log import JobLogs
from worker.service.kept_renderer import KeptRenderer, defect
from worker.service.lease import Lease, LeaseLostError
from worker.service.picture import Picture
from worker.service.upload import upload

MAX_STARTS = 3
"""Maximum starts of a job of which each ends its process or meets the time limit; then the job is given up. Redis
counts the starts, so that the count outlasts restarts of the worker."""

_LOST_CLAIM_S = 2.0
"""Seconds before the message of a job whose claim was lost is delivered again."""

_PROBE = ".tmp-probe"


class Outcome(NamedTuple):
    """The outcome of a job that did not fail.

    Attributes:
        said: one line about what was done.
        made: whether a picture was made.
    """

    said: str
    made: bool = False


class JobRunner:
    """Runs jobs in one process.

    Args:
        store: folder or URL below which the datasets lie.
        renderer: renderer of the pictures of every dataset.
        open_ledger: function that opens the ledger of a run.
        logs: files for the output of jobs; None leaves their output alone.
    """

    def __init__(
        self, store: str, renderer: KeptRenderer, open_ledger: LedgerFactory, logs: JobLogs | None = None
    ) -> None:
        self._store = store
        self._renderer = renderer
        self._open_ledger = open_ledger
        self._logs = logs
        self._failures = Failures(logs)
        self._must_probe = False

    def run(self, payload: object) -> Outcome:
        """Run the job that a message asks for, unless it is done.

        Args:
            payload: the message as it came off the wire.

        Raises:
            TryLaterError: if the message is to be sent again later.
            MessageError: if it asks for no job, or for one that its dataset does not have.
            PermanentError: if the job is given up; its record is in the dataset's quarantine.
            DestinationError: if the dataset can't be read or written now; the message must go back to the queue.
            BrokerError: if the ledger can't be reached; the message must go back to the queue.
            UnfitWorkerError: if this worker can't do the job, but another may; the message must go back to the queue.
        """
        message = JobMessage.decode(payload)
        ledger = self._open_ledger(message.key)
        start = _claim(ledger, message.job_id)
        try:
            return self._run_claimed(message, ledger, start)
        except StaleMessageError as error:
            # Its dataset was replaced by another of the same name, whose own jobs were submitted then.
            ledger.give_back(message.job_id, this_process())
            return Outcome(f"dropped: {error}")
        except MessageError:
            ledger.give_back(message.job_id, this_process())
            raise
        except LeaseLostError as error:
            # Another worker has the job, or Redis came back without its memory; the next delivery finds out.
            raise TryLaterError(str(error), _LOST_CLAIM_S) from error
        except (UnfitWorkerError, DestinationError, BrokerError):
            ledger.give_back(message.job_id, this_process())
            raise
        except (SoftTimeLimitExceeded, OSError) as error:
            # Apart from the renderer, only the store takes long.
            ledger.give_back(message.job_id, this_process())
            raise DestinationError(f"{message.task_id}: {type(error).__name__}: {error}") from error
        finally:
            ledger.release(message.job_id, this_process())

    def _run_claimed(self, message: JobMessage, ledger: Ledger, start: int) -> Outcome:
        job = message.job
        dataset = self._open_dataset(message)
        self._probe(dataset, job)
        if nothing_to_do := _nothing_to_do(dataset, job):
            # A second delivery of a job's message does not count as a start.
            ledger.give_back(job.id, this_process())
            return Outcome(f"{message.task_id} {nothing_to_do}")
        if start > MAX_STARTS:
            reason = f"its process died, or met the time limit, in each of {MAX_STARTS} attempts"
            self._failures.give_up(message, dataset, ledger, reason, MAX_STARTS)
            raise PermanentError(f"{message.task_id}: {reason}")
        try:
            manifest = self._make_and_upload(message, dataset, ledger)
        except (DestinationError, BrokerError):
            self._must_probe = True
            raise
        except RetryableError as error:
            raise self._failures.postpone_or_give_up(message, dataset, ledger, error) from error
        except PermanentError as error:
            self._failures.give_up_at_once(message, dataset, ledger, error, start)
            raise
        self._failures.note_success()
        return Outcome(_note_done(message, manifest, ledger), made=True)

    def _open_dataset(self, message: JobMessage) -> Dataset:
        try:
            dataset = open_for_message(self._store, message)
        except (ConflictError, SpecError) as error:
            # The supervisor could read the header before, so it was replaced, and looks again.
            raise DestinationError(str(error)) from error
        if message.place and read_place(dataset.storage) != message.place:
            raise StaleMessageError(f"{message.task_id}: {dataset.storage.location} is another place by now")
        return dataset

    def _probe(self, dataset: Dataset, job: Job) -> None:
        """After a failure of the destination, find out by a small write whether rendering is worth the time."""
        if self._must_probe:
            path = f"{job.category}/images/{_PROBE}-{job.id}.{this_process().replace(':', '.')}"
            dataset.storage.write(path, b"is there room?")
            dataset.storage.remove(path)
            self._must_probe = False

    def _make_and_upload(self, message: JobMessage, dataset: Dataset, ledger: Ledger) -> Manifest:
        job = message.job
        with Lease(ledger, job.id, this_process()) as claim:
            made = self._make(message, dataset)
            try:
                return upload(made, job, dataset, claim)
            except (FarmError, SoftTimeLimitExceeded, OSError):
                raise
            except Exception as error:
                raise defect(job, error) from error

    def _make(self, message: JobMessage, dataset: Dataset) -> Picture:
        if self._logs is None:
            return self._renderer.make(message.job, dataset.header)
        with self._logs.taking(message):
            return self._renderer.make(message.job, dataset.header)


def _claim(ledger: Ledger, job_id: str) -> int:
    owner = this_process()
    start = ledger.claim(job_id, owner)
    if start is None:
        holder = ledger.claims().get(job_id, owner)
        if is_gone(holder):
            ledger.release(job_id, holder)
            start = ledger.claim(job_id, owner)
    if start is None:
        raise TryLaterError(f"{job_id} is claimed by another process", CLAIM_S)
    return start


def _nothing_to_do(dataset: Dataset, job: Job) -> str:
    if is_in_quarantine(dataset, job):
        return "is in quarantine"
    return "is done already" if is_done(dataset, job) else ""


def _note_done(message: JobMessage, manifest: Manifest, ledger: Ledger) -> str:
    seconds = manifest.timings_s
    said = f"{message.task_id} done in {sum(seconds.values()):.1f} s"
    try:
        if ledger.finish(message.job_id, this_process(), manifest.files[IMAGE.folder].path):
            figures = {f"seconds:{stage}": value for stage, value in seconds.items()}
            ledger.add_figures({f"images:{message.job.category}": 1, "redrawn": len(manifest.rejected), **figures})
    except BrokerError as error:
        # The folder tells that it is done.
        return f"{said}, but not noted: {error}"
    return said
