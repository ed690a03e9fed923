"""A job: one image of a dataset, and the message that asks a worker for it."""

import re
from collections.abc import Mapping
from typing import Annotated, Self

from pydantic import Field, ValidationError

from farm.errors import MessageError
from farm.model import Model, Sha256
from farm.spec.category import Category

MAX_INDEX = 10**9 - 1

DatasetName = Annotated[str, Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9._-]{0,99}$")]
"""One folder name, which can neither climb out of the store nor hide in it."""

_MOST_KEYS = 32
"""Above this an object is not looked at key by key: each unknown one would cost an error."""

_JOB_ID = re.compile(r"(?P<category>[a-z_]+)-(?P<index>\d{6,9})", re.ASCII)


class Job(Model):
    """One image to make. Category and index, with the dataset's seed, decide everything in it."""

    category: Category
    index: Annotated[int, Field(ge=0, le=MAX_INDEX)]

    @property
    def id(self) -> str:
        """For example `far-000042`; also the stem of the files."""
        return f"{self.category}-{self.index:06d}"

    @classmethod
    def from_id(cls, job_id: str) -> Self:
        """Read an id back.

        Raises:
            MessageError: if it is not the id of a job.
        """
        match = _JOB_ID.fullmatch(job_id)
        if match is None or match["category"] not in set(Category):
            # As it may come from anybody: quoted, so that it stays one line.
            raise MessageError(f"{job_id[:80]!a} is no job id: expected <category>-<six digits>, as in far-000042")
        job = cls(category=Category(match["category"]), index=int(match["index"]))
        if job.id != job_id:
            raise MessageError(f"{job_id!a} is no job id: its index is padded; expected {job.id}")
        return job


class JobMessage(Model):
    """What goes on the wire: names only, no path and no pixels.

    The worker looks `dataset` up in its own store and checks that the spec it finds there has `spec_sha256`.
    """

    version: Annotated[int, Field(ge=1, le=1)] = 1  # not Literal[1], which takes true for 1
    dataset: DatasetName
    spec_sha256: Sha256
    job_id: Annotated[str, Field(max_length=80)]

    @property
    def job(self) -> Job:
        """The job that is asked for."""
        return Job.from_id(self.job_id)

    @property
    def task_id(self) -> str:
        """The Celery task's id, readable in Flower. The fingerprint keeps datasets of one name apart."""
        return f"{queue_key(self.dataset, self.spec_sha256)}:{self.job_id}"

    def encode(self) -> dict[str, object]:
        """As JSON-ready values."""
        return self.model_dump(mode="json")

    @classmethod
    def decode(cls, payload: object) -> Self:
        """Validate what came off the wire.

        Raises:
            MessageError: on a wrong type, an unknown key or version, or an id that is none.
        """
        if isinstance(payload, Mapping) and len(payload) > _MOST_KEYS:
            raise MessageError(f"job message refused: {len(payload)} keys; there are {len(cls.model_fields)}")
        try:
            message = cls.model_validate(payload)
        except ValidationError as error:
            first = error.errors(include_url=False, include_context=False, include_input=False)[0]
            # An unknown key is told as it came, so it may hold a line break.
            where = ascii(".".join(str(part) for part in first["loc"]))[1:80].rstrip("'") or "message"
            raise MessageError(f"job message refused: {where}: {first['msg']}") from error
        Job.from_id(message.job_id)
        return message


def queue_key(dataset: str, spec_sha256: str) -> str:
    """What task ids and ledger keys of one dataset begin with: its name and its description's fingerprint, short."""
    return f"{dataset}:{spec_sha256[:12]}"
