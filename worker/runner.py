"""One job from its message to its manifest, whatever brought the message."""

import logging
import textwrap
from collections.abc import Callable

from celery.exceptions import SoftTimeLimitExceeded

from farm.completion import is_done
from farm.dataset import Dataset, open_for_message
from farm.errors import FarmError, PermanentError, RenderError, RetryableError
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

BACKOFF_S = (5.0, 30.0)
"""Pauses before the second and third try."""

_MARGIN_S = 30.0
_REASON_LENGTH = 500


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
            BrokerError: if the ledger can't be reached.
        """
        message = JobMessage.decode(payload)
        ledger = self._open_ledger(message.dataset, message.spec_sha256)
        attempt = _claim(ledger, message.job_id)
        try:
            return self._run_claimed(message, ledger, attempt)
        except RetryableError as error:
            if attempt >= MAX_TRIES:
                reason = f"{error} (tried {attempt} times)"
                _record_failure(ledger, message.job_id, reason)
                raise PermanentError(f"{message.task_id}: {reason}") from error
            delay_s = BACKOFF_S[attempt - 1]
            # The claim stays, free for the taking, so that a coordinator knows the job is on its way.
            ledger.postpone(message.job_id, this_process(), delay_s + _MARGIN_S)
            raise TryLaterError(f"{message.task_id}: {error}", delay_s) from error
        except PermanentError as error:
            _record_failure(ledger, message.job_id, str(error))
            raise
        finally:
            ledger.release(message.job_id, this_process())

    def _run_claimed(self, message: JobMessage, ledger: Ledger, attempt: int) -> str:
        job = message.job
        dataset = open_for_message(self._store, message)
        if is_done(dataset, job):
            return f"{message.task_id} is done already"
        if attempt > MAX_STARTS:
            raise PermanentError(f"its process died in each of {MAX_STARTS} attempts; see the worker's log")
        with Heartbeat(ledger, job.id, this_process()):
            manifest = upload(self._make(dataset, job), job, dataset)
        ledger.record_done(job.id, job.category, manifest.files[FileRole.IMAGE].path)
        return f"{message.task_id} done in {sum(manifest.timings_s.values()):.1f} s"

    def _make(self, dataset: Dataset, job: Job) -> MadeImage:
        try:
            return self._maker_for(dataset.header).make(job, dataset.header)
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
            self._maker = (fingerprint, self._open_maker(header))
        return self._maker[1]


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
