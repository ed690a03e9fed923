"""Jobs that failed for good: a record each in the dataset's folder, so that it outlives Redis and every worker."""

from collections.abc import Iterable, Mapping
from typing import Annotated, Literal

from pydantic import Field, ValidationError

from farm.dataset.dataset import Dataset
from farm.dataset.paths import QUARANTINE_FOLDER, quarantine_path
from farm.errors import MessageError
from farm.model import Model, Sha256
from farm.spec.job import DatasetName, Job
from farm.storage import StoredFile, in_order

LOG_LENGTH = 16 * 1024
"""Characters of a job's log that its record keeps, from the end."""

_REASON_LENGTH = 500
_UNREADABLE = "its record in the quarantine folder can't be read"


class QuarantineRecord(Model):
    """The record of a job that is given up until a person puts it back: the reason, and the means to examine it.

    Attributes:
        attempts: number of times that the job was begun, as far as is known.
        worker: the process that gave it up.
        log: the end of what Blender printed in its last attempt; empty where it is not at hand.
        replay: the command that makes the picture again, here and now.
    """

    version: Literal[1] = 1
    dataset: DatasetName
    spec_sha256: Sha256
    job_id: str
    reason: Annotated[str, Field(max_length=_REASON_LENGTH)]
    attempts: Annotated[int, Field(ge=0)]
    worker: str
    log: Annotated[str, Field(max_length=LOG_LENGTH)]
    replay: str


def put_in_quarantine(dataset: Dataset, job: Job, reason: str, *, attempts: int, worker: str, log: str) -> None:
    """Write a job's record, in place of an older one.

    Raises:
        DestinationError: if it can't be written.
    """
    record = QuarantineRecord(
        dataset=dataset.name,
        spec_sha256=dataset.identity,
        job_id=job.id,
        reason=reason if len(reason) <= _REASON_LENGTH else reason[: _REASON_LENGTH - 3] + "...",
        attempts=attempts,
        worker=worker,
        log=log[-LOG_LENGTH:],
        replay=f"farm replay {dataset.storage.location} {job.id}",
    )
    dataset.storage.write(quarantine_path(job), record.model_dump_json(indent=1).encode() + b"\n")


def is_in_quarantine(dataset: Dataset, job: Job) -> bool:
    """Whether a job is given up.

    Raises:
        DestinationError: if the folder can't be read.
    """
    try:
        dataset.storage.read(quarantine_path(job))
    except FileNotFoundError:
        return False
    return True


class Quarantine:
    """The given-up jobs of one dataset. A look lists the records and reads those that are new."""

    def __init__(self, dataset: Dataset) -> None:
        self._dataset = dataset
        self._known: dict[str, tuple[StoredFile, str]] = {}

    def look(self) -> Mapping[str, str]:
        """List the given-up jobs: id to reason, in order.

        Raises:
            DestinationError: if the folder can't be read.
        """
        listed: dict[str, StoredFile] = {}
        for path, stored in sorted(self._dataset.storage.files(QUARANTINE_FOLDER).items()):
            job = job_of_record(path)
            if job is not None and self._dataset.asks_for(job):
                listed[job.id] = stored
        known = {job_id: self._known[job_id] for job_id in listed if job_id in self._known}
        new = [job_id for job_id, stored in listed.items() if job_id not in known or known[job_id][0] != stored]
        reasons = dict(zip(new, in_order(self._reason, new), strict=True))
        known |= {job_id: (listed[job_id], reason) for job_id, reason in reasons.items() if reason is not None}
        gone = {job_id for job_id, reason in reasons.items() if reason is None}
        self._known = {job_id: known[job_id] for job_id in listed if job_id not in gone}
        return {job_id: reason for job_id, (_, reason) in self._known.items()}

    def _reason(self, job_id: str) -> str | None:
        try:
            content = self._dataset.storage.read(quarantine_path(Job.from_id(job_id)))
            record = QuarantineRecord.model_validate_json(content)
        except FileNotFoundError:
            return None
        except ValidationError:
            return _UNREADABLE
        return record.reason if record.job_id == job_id else _UNREADABLE

    def release(self, job_ids: Iterable[str]) -> None:
        """Remove the records of jobs, which may then be made again.

        Raises:
            DestinationError: if one can't be removed.
        """
        for job_id in job_ids:
            self._dataset.storage.remove(quarantine_path(Job.from_id(job_id)))


def job_of_record(path: str) -> Job | None:
    """Return the job whose record would have this path; None if there is no such job."""
    try:
        job = Job.from_id(path.rpartition("/")[2].removesuffix(".json"))
    except MessageError:
        return None
    return job if quarantine_path(job) == path else None
