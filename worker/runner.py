"""One job from its message to its manifest, whatever brought the message."""

import logging
import textwrap
from collections.abc import Callable

from celery.exceptions import SoftTimeLimitExceeded

from farm.completion import is_done
from farm.dataset import Dataset, open_for_message
from farm.errors import (
    AssetError,
    DatasetMissingError,
    EnvironmentMissingError,
    FarmError,
    PermanentError,
    RenderError,
    RetryableError,
    StaleMessageError,
    TemplateError,
    UnfitWorkerError,
)
from farm.header import DatasetHeader
from farm.job import Job, JobMessage
from farm.layout import FileRole
from farm.ledger.owner import is_gone, this_process
from farm.ledger.port import CLAIM_S, Ledger, LedgerFactory
from worker.heartbeat import Heartbeat
from worker.made import ImageMaker, MadeImage
from worker.upload import upload

log = logging.getLogger(__name__)

MakerFactory = Callable[[DatasetHeader], ImageMaker]

MAX_TRIES = 3
"""A job that fails in a way that may pass is tried so often."""

MAX_STARTS = 6
"""A job is begun so often at most, as one that kills its process can't be counted at its end."""

MAX_ABSENCES = 6
"""So many workers in a row may end since their store lacks a dataset; then it is gone, and its jobs fail."""

BACKOFF_S = (5.0, 30.0)
"""Pauses before the second and third try."""

_MARGIN_S = 30.0
_REASON_LENGTH = 500
_FAULTS_OF_THE_MACHINE = (AssetError, EnvironmentMissingError, TemplateError)


class TryLaterError(RetryableError):
    """The message is to be sent again, after `delay_s` seconds."""

    def __init__(self, reason: str, delay_s: float) -> None:
        super().__init__(reason)
        self.delay_s = delay_s

    def __reduce__(self) -> tuple[type, tuple[str]]:
        """As a plain error: Celery carries it from the child to the worker's main process by pickle."""
        return RetryableError, (str(self),)


class JobRunner:
    """Runs jobs in one process, with the maker of the last dataset kept open.

    Args:
        store: folder or URL below which the datasets lie.
        open_maker: opens what makes a dataset's pictures; called in this process, at its first job.
        open_ledger: opens the ledger of a dataset.
    """

    def __init__(self, store: str, open_maker: MakerFactory, open_ledger: LedgerFactory) -> None:
        self._store = store
        self._open_maker = open_maker
        self._open_ledger = open_ledger
        self._maker: tuple[str, ImageMaker] | None = None

    def run(self, payload: object) -> str:
        """Run the job that a message asks for, unless it is done.

        Args:
            payload: the message as it came off the wire.

        Returns:
            One line about what was done.

        Raises:
            TryLaterError: when the message is to be sent again.
            PermanentError: the job failed for good; the ledger has the reason.
            UnfitWorkerError: this worker can't do the job, but another may; the message must go back to the queue.
            BrokerError: if the ledger can't be reached.
        """
        message = JobMessage.decode(payload)
        ledger = self._open_ledger(message.dataset, message.spec_sha256)
        start = _claim(ledger, message.job_id)
        try:
            return self._run_claimed(message, ledger, start)
        except StaleMessageError as error:
            # Its dataset was replaced by another of the same name; whoever replaced it has submitted that one.
            return f"dropped: {error}"
        except UnfitWorkerError:
            ledger.give_back(message.job_id, this_process())
            raise
        except RetryableError as error:
            troubles = ledger.count_trouble(message.job_id)
            if troubles >= MAX_TRIES:
                reason = f"{error} (tried {troubles} times)"
                _record_failure(ledger, message.job_id, reason)
                raise PermanentError(f"{message.task_id}: {reason}") from error
            delay_s = BACKOFF_S[troubles - 1]
            # The claim stays, free for the taking, so that a coordinator knows the job is on its way.
            ledger.postpone(message.job_id, this_process(), delay_s + _MARGIN_S)
            raise TryLaterError(f"{message.task_id}: {error}", delay_s) from error
        except PermanentError as error:
            _record_failure(ledger, message.job_id, str(error))
            raise
        finally:
            ledger.release(message.job_id, this_process())

    def _run_claimed(self, message: JobMessage, ledger: Ledger, start: int) -> str:
        job = message.job
        dataset = self._open_dataset(message, ledger)
        if is_done(dataset, job):
            return f"{message.task_id} is done already"
        if start > MAX_STARTS:
            raise PermanentError(
                f"its process died, or met the time limit, in each of {MAX_STARTS} attempts; see the worker's log"
            )
        with Heartbeat(ledger, job.id, this_process()):
            manifest = upload(self._make(dataset, job), job, dataset)
        ledger.record_done(job.id, manifest.files[FileRole.IMAGE].path)
        return f"{message.task_id} done in {sum(manifest.timings_s.values()):.1f} s"

    def _open_dataset(self, message: JobMessage, ledger: Ledger) -> Dataset:
        try:
            return open_for_message(self._store, message)
        except DatasetMissingError as error:
            if ledger.count_absence() > MAX_ABSENCES:
                raise PermanentError(f"{error}; {MAX_ABSENCES} other workers lacked it, too") from error
            raise UnfitWorkerError(f"{error}; or give this worker the right --store", error.exit_code) from error

    def _make(self, dataset: Dataset, job: Job) -> MadeImage:
        maker = self._maker_for(dataset.header)
        try:
            return maker.make(job, dataset.header)
        except _FAULTS_OF_THE_MACHINE as error:
            # Textures and HDRIs are looked up when a scene first shows them.
            raise UnfitWorkerError(str(error), error.exit_code) from error
        except FarmError:
            raise
        except SoftTimeLimitExceeded as error:
            raise RenderError("took longer than the time limit") from error
        except Exception as error:
            # A defect of the maker must end as a reason in the ledger, not as a message lost without a word.
            log.exception("%s: unexpected error", job.id)
            raise RenderError(f"unexpected {type(error).__name__}: {error}") from error

    def _maker_for(self, header: DatasetHeader) -> ImageMaker:
        fingerprint = header.spec_sha256
        if self._maker is None or self._maker[0] != fingerprint:
            self._maker = None  # two open templates at once would need twice the memory
            self._maker = (fingerprint, self._opened(header))
        return self._maker[1]

    def _opened(self, header: DatasetHeader) -> ImageMaker:
        try:
            return self._open_maker(header)
        except FarmError as error:
            raise UnfitWorkerError(str(error), error.exit_code) from error
        except SoftTimeLimitExceeded as error:
            raise RenderError("opening the template took longer than the time limit") from error
        except Exception as error:
            # Blender's libraries, the driver, the memory: nothing of it is the job's doing.
            log.exception("nothing can be rendered here")
            reason = f"can't open Blender: {type(error).__name__}: {error}"
            raise UnfitWorkerError(reason, EnvironmentMissingError.exit_code) from error


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


def _record_failure(ledger: Ledger, job_id: str, reason: str) -> None:
    ledger.record_failure(job_id, textwrap.shorten(reason, _REASON_LENGTH))
