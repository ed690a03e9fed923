"""One job from its message to its manifest, whatever brought the message."""

import logging
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np
from celery.exceptions import SoftTimeLimitExceeded

from farm.dataset.completion import is_done
from farm.dataset.dataset import Dataset, open_for_message
from farm.dataset.manifest import Manifest
from farm.dataset.outputs import IMAGE
from farm.dataset.quarantine import is_in_quarantine, put_in_quarantine
from farm.errors import (
    AssetError,
    BrokerError,
    ConflictError,
    DatasetMissingError,
    DestinationError,
    FarmError,
    MachineError,
    PermanentError,
    RenderError,
    RetryableError,
    StaleMessageError,
    TemplateError,
    UnfitWorkerError,
)
from farm.run.ledger.owner import is_gone, this_process
from farm.run.ledger.port import CLAIM_S, MAX_ABSENCES, Ledger, LedgerFactory
from farm.spec.header import DatasetHeader
from farm.spec.job import Job, JobMessage
from worker.service.job_log import JobLogs
from worker.service.lease import Lease, LeaseLostError
from worker.service.picture import Picture, Renderer
from worker.service.upload import upload

log = logging.getLogger(__name__)

OpenRenderer = Callable[[DatasetHeader], Renderer]

MAX_TRIES = 3
"""A job that fails in a way that may pass is tried so often."""

MAX_STARTS = 3
"""A job that ends its process, or meets the time limit, is begun so often. Redis counts, so that restarts don't."""

FAILED_IN_A_ROW = 3
"""A worker on which so many different jobs fail, one after the other, takes itself out."""

BACKOFF_S = (5.0, 30.0)
"""Pauses before the second and third try, each made up to half longer."""

_MARGIN_S = 30.0
_LOST_CLAIM_S = 2.0
_PROBE = ".tmp-probe"
_FAULTS_OF_THE_MACHINE = (AssetError, MachineError, TemplateError)


class TryLaterError(RetryableError):
    """The message is to be sent again, after `delay_s` seconds."""

    def __init__(self, reason: str, delay_s: float) -> None:
        super().__init__(reason)
        self.delay_s = delay_s

    def __reduce__(self) -> tuple[type, tuple[str]]:
        """As a plain error: Celery carries it from the child to the worker's main process by pickle."""
        return RetryableError, (str(self),)


class Outcome(NamedTuple):
    """How a job ended that did not fail.

    Attributes:
        said: one line about what was done.
        made: whether a picture was made.
    """

    said: str
    made: bool = False


class JobRunner:
    """Runs jobs in one process, with the renderer of the last dataset kept open.

    Args:
        store: folder or URL below which the datasets lie.
        open_renderer: opens a dataset's renderer; called in this process, at the dataset's first job.
        open_ledger: opens the ledger of a dataset.
        logs: folder for what jobs print; None leaves their output alone.
    """

    def __init__(
        self, store: str, open_renderer: OpenRenderer, open_ledger: LedgerFactory, logs: Path | None = None
    ) -> None:
        self._store = store
        self._open_renderer = open_renderer
        self._open_ledger = open_ledger
        self._logs = None if logs is None else JobLogs(logs)
        self._renderer: tuple[str, Renderer] | None = None
        self._failed: dict[str, str] = {}
        self._must_probe = False
        self._found: set[str] = set()

    def run(self, payload: object) -> Outcome:
        """Run the job that a message asks for, unless it is done.

        Args:
            payload: the message as it came off the wire.

        Raises:
            TryLaterError: when the message is to be sent again.
            MessageError: it asks for no job, or for one that its dataset does not.
            PermanentError: the job is given up; its record is in the dataset's quarantine.
            DestinationError: the dataset can't be read or written now; the message must go back to the queue.
            BrokerError: if the ledger can't be reached; the message must go back to the queue.
            UnfitWorkerError: this worker can't do the job, but another may; the message must go back to the queue.
        """
        message = JobMessage.decode(payload)
        ledger = self._open_ledger(message.dataset, message.spec_sha256)
        start = _claim(ledger, message.job_id)
        try:
            return self._run_claimed(message, ledger, start)
        except StaleMessageError as error:
            # Its dataset was replaced by another of the same name; whoever replaced it has submitted that one.
            return Outcome(f"dropped: {error}")
        except LeaseLostError as error:
            # Another has it, or Redis came back without its memory: whoever is next sees.
            raise TryLaterError(str(error), _LOST_CLAIM_S) from error
        except (UnfitWorkerError, DestinationError, BrokerError):
            ledger.give_back(message.job_id, this_process())
            raise
        except (SoftTimeLimitExceeded, OSError) as error:
            # Outside of the renderer nothing but the store takes long.
            ledger.give_back(message.job_id, this_process())
            raise DestinationError(f"{message.task_id}: {type(error).__name__}: {error}") from error
        finally:
            ledger.release(message.job_id, this_process())

    def _run_claimed(self, message: JobMessage, ledger: Ledger, start: int) -> Outcome:
        job = message.job
        dataset = self._open_dataset(message, ledger)
        if dataset is None:
            ledger.give_back(job.id, this_process())
            return Outcome(f"dropped: {message.task_id}: {MAX_ABSENCES} other workers lacked its dataset, too")
        self._probe(dataset, job)
        if nothing_to_do := _nothing_to_do(dataset, job):
            # A second delivery is no start.
            ledger.give_back(job.id, this_process())
            return Outcome(f"{message.task_id} {nothing_to_do}")
        if start > MAX_STARTS:
            reason = f"its process died, or met the time limit, in each of {MAX_STARTS} attempts"
            self._give_up(message, dataset, ledger, reason, MAX_STARTS)
            raise PermanentError(f"{message.task_id}: {reason}")
        try:
            manifest = self._make_and_upload(message, dataset, ledger)
        except (DestinationError, BrokerError):
            self._must_probe = True
            raise
        except RetryableError as error:
            raise self._postponed(message, dataset, ledger, error) from error
        except PermanentError as error:
            # Three in a row may be the dataset's fault, too; but a broken worker must not give up all of it.
            self._count_failure(job.id, error)
            self._give_up(message, dataset, ledger, str(error), start)
            raise
        self._failed.clear()
        return Outcome(_note_done(message, manifest, ledger), made=True)

    def _open_dataset(self, message: JobMessage, ledger: Ledger) -> Dataset | None:
        """The message's dataset; None if so many workers lack it that its run has ended."""
        try:
            dataset = open_for_message(self._store, message)
        except DatasetMissingError as error:
            if message.dataset in self._found:
                # It was there before: the store has gone, say a mount, and may come back.
                raise DestinationError(str(error)) from error
            if ledger.count_absence() > MAX_ABSENCES:
                return None
            raise UnfitWorkerError(f"{error}; or give this worker the right --store", error.exit_code) from error
        except ConflictError as error:
            # Its header is of another version of the farm, or damaged: another worker may read it.
            raise UnfitWorkerError(str(error), error.exit_code) from error
        self._found.add(message.dataset)
        return dataset

    def _probe(self, dataset: Dataset, job: Job) -> None:
        """After a failure of the destination a small write tells whether rendering is worth the time."""
        if self._must_probe:
            path = f"{job.category}/images/{_PROBE}-{job.id}.{this_process().replace(':', '.')}"
            dataset.storage.write(path, b"is there room?")
            dataset.storage.remove(path)
            self._must_probe = False

    def _make_and_upload(self, message: JobMessage, dataset: Dataset, ledger: Ledger) -> Manifest:
        job = message.job
        with Lease(ledger, job.id, this_process()) as claim:
            if self._logs is None:
                made = self._make(dataset, job)
            else:
                with self._logs.taking(message):
                    made = self._make(dataset, job)
            try:
                return upload(made, job, dataset, claim)
            except (FarmError, SoftTimeLimitExceeded, OSError):
                raise
            except Exception as error:
                raise _defect(job, error) from error

    def _postponed(
        self, message: JobMessage, dataset: Dataset, ledger: Ledger, error: RetryableError
    ) -> TryLaterError | PermanentError:
        job_id = message.job_id
        _require_claim(ledger, job_id)
        self._count_failure(job_id, error)
        troubles = ledger.count_trouble(job_id)
        ledger.add_figures({"retries": 1})
        if troubles >= MAX_TRIES:
            reason = f"{error} (tried {troubles} times)"
            self._give_up(message, dataset, ledger, reason, troubles)
            return PermanentError(f"{message.task_id}: {reason}")
        delay_s = BACKOFF_S[troubles - 1] * (1.0 + 0.5 * _jitter(dataset, message.job, troubles))
        # The claim stays, free for the taking, so that a coordinator knows the job is on its way.
        ledger.postpone(job_id, this_process(), delay_s + _MARGIN_S)
        return TryLaterError(f"{message.task_id}: {error}", delay_s)

    def _count_failure(self, job_id: str, error: FarmError) -> None:
        self._failed[job_id] = str(error)
        if len(self._failed) >= FAILED_IN_A_ROW:
            told = "; ".join(f"{failed}: {why}" for failed, why in self._failed.items())
            raise UnfitWorkerError(f"{len(self._failed)} jobs failed here in a row: {told}", error.exit_code) from error

    def _give_up(self, message: JobMessage, dataset: Dataset, ledger: Ledger, reason: str, attempts: int) -> None:
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
        # The record holds it by now; put back, even where this Redis can't be reached, it begins anew.
        ledger.forgive([message.job_id])
        ledger.add_figures({"quarantined": 1})

    def _make(self, dataset: Dataset, job: Job) -> Picture:
        renderer = self._renderer_for(dataset.header)
        try:
            return renderer.make(job, dataset.header)
        except _FAULTS_OF_THE_MACHINE as error:
            # Textures and HDRIs are looked up when a scene first shows them.
            raise UnfitWorkerError(str(error), error.exit_code) from error
        except FarmError:
            raise
        except SoftTimeLimitExceeded as error:
            raise RenderError("took longer than the time limit") from error
        except Exception as error:
            raise _defect(job, error) from error

    def _renderer_for(self, header: DatasetHeader) -> Renderer:
        fingerprint = header.spec_sha256
        if self._renderer is None or self._renderer[0] != fingerprint:
            self._renderer = None  # two open templates at once would need twice the memory
            self._renderer = (fingerprint, self._opened(header))
        return self._renderer[1]

    def _opened(self, header: DatasetHeader) -> Renderer:
        try:
            return self._open_renderer(header)
        except FarmError as error:
            raise UnfitWorkerError(str(error), error.exit_code) from error
        except SoftTimeLimitExceeded as error:
            raise RenderError("opening the template took longer than the time limit") from error
        except Exception as error:
            # Blender's libraries, the driver, the memory: nothing of it is the job's doing.
            log.exception("nothing can be rendered here")
            reason = f"can't open Blender: {type(error).__name__}: {error}"
            raise UnfitWorkerError(reason, MachineError.exit_code) from error


def _claim(ledger: Ledger, job_id: str) -> int:
    owner = this_process()
    attempt = ledger.claim(job_id, owner)
    if attempt is None:
        holder = ledger.claims().get(job_id, owner)
        if is_gone(holder):
            ledger.release(job_id, holder)
            attempt = ledger.claim(job_id, owner)
    if attempt is None:
        raise TryLaterError(f"{job_id} is claimed by another process", CLAIM_S)
    return attempt


def _defect(job: Job, error: Exception) -> RenderError:
    """A defect must end as a reason in quarantine, not as a message lost without a word."""
    log.error("%s: unexpected error", job.id, exc_info=error)
    return RenderError(f"unexpected {type(error).__name__}: {error}")


def _require_claim(ledger: Ledger, job_id: str) -> None:
    """Only the holder may count a job's failures or give it up."""
    if not ledger.refresh(job_id, this_process()):
        raise LeaseLostError(f"{job_id}: failed here, but is another worker's by now")


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


def _jitter(dataset: Dataset, job: Job, tries: int) -> float:
    """From 0 to 1, another for each job and try, so that jobs that failed together don't come back together."""
    seed = np.random.SeedSequence(dataset.header.spec.seed, spawn_key=(job.category.code, job.index, tries))
    return float(np.random.Generator(np.random.PCG64(seed)).random())
