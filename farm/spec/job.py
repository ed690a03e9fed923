"""A job: one image of a dataset, and the message that asks a worker for it."""

import hashlib
import re
from collections.abc import Mapping
from typing import Annotated, Self
from urllib.parse import quote

from pydantic import AfterValidator, Field, ValidationError

from farm.errors import MessageError
from farm.model import Model, Sha256
from farm.spec.category import Category

MAX_INDEX = 10**9 - 1
"""Largest index of a job in its category: an id has at most nine digits."""


def _one_plain_name(name: str) -> str:
    if not name.isprintable() or name != name.strip() or name[:1] in {".", "-"} or {"/", "\\"} & set(name):
        raise ValueError("must be one plain name: printable, without slashes, and without '.' or '-' at its start")
    return name


DatasetName = Annotated[str, Field(min_length=1, max_length=100), AfterValidator(_one_plain_name)]
"""The name of a dataset: one folder name, which neither leaves the store nor is hidden in it.

Copies get names such as `cables (1)` and `Kopie von Kabel`, so blanks, brackets and letters of any script may be in
it."""

_KEY_CHARACTERS = 100
"""Most characters of a dataset's name in the keys of its run: Celery's ids have at most 250."""

PlaceId = Annotated[str, Field(pattern=r"^([0-9a-f]{16})?$")]
"""The id of a dataset's place, from `farm.dataset.place`; empty where none is known, as in earlier releases."""

_MOST_KEYS = 32
"""Number of keys above which a message is refused at once, as each unknown key would cost a validation error."""

_JOB_ID = re.compile(r"(?P<category>[a-z_]+)-(?P<index>\d{6,9})", re.ASCII)


class Job(Model):
    """One image to make. Its category, its index and the dataset's seed decide everything in it.

    Attributes:
        category: category of the image.
        index: number of the image in its category, from 0.
    """

    category: Category
    index: Annotated[int, Field(ge=0, le=MAX_INDEX)]

    @property
    def id(self) -> str:
        """The id, such as `far-000042`, from which the names of the image's files are made."""
        return f"{self.category}-{self.index:06d}"

    @classmethod
    def from_id(cls, job_id: str) -> Self:
        """Read an id back.

        Raises:
            MessageError: if it is not the id of a job.
        """
        match = _JOB_ID.fullmatch(job_id)
        if match is None or match["category"] not in set(Category):
            # The id may come from anybody: ascii() quotes it, so that the message stays one line.
            raise MessageError(f"{job_id[:80]!a} is no job id: expected <category>-<six digits>, as in far-000042")
        job = cls(category=Category(match["category"]), index=int(match["index"]))
        if job.id != job_id:
            raise MessageError(f"{job_id!a} is no job id: its index is padded; expected {job.id}")
        return job


class JobMessage(Model):
    """The message that asks a worker for one image. It holds names only, no path and no pixels.

    The worker looks up `dataset` in its own store, and checks that the header there has the fingerprint `spec_sha256`.

    Attributes:
        version: version of this format.
        dataset: name of the dataset.
        spec_sha256: fingerprint of the dataset's header.
        place: id of the dataset's place; empty in messages of earlier releases.
        job_id: id of the job.
    """

    version: Annotated[int, Field(ge=1, le=1)] = 1  # not Literal[1], which takes true for 1
    dataset: DatasetName
    spec_sha256: Sha256
    place: PlaceId = ""
    job_id: Annotated[str, Field(max_length=80)]

    @property
    def job(self) -> Job:
        """The job that the message asks for."""
        return Job.from_id(self.job_id)

    @property
    def key(self) -> str:
        """Tells runs apart; see `queue_key`."""
        return queue_key(self.dataset, self.spec_sha256, self.place)

    @property
    def task_id(self) -> str:
        """Id of the Celery task, readable in Flower. Its first part tells datasets of the same name apart."""
        return f"{self.key}:{self.job_id}"

    def encode(self) -> dict[str, object]:
        """Turn the message into values that JSON can hold; without a place it is as earlier releases write it."""
        return self.model_dump(mode="json", exclude=None if self.place else {"place"})

    @classmethod
    def decode(cls, payload: object) -> Self:
        """Validate a message from the wire.

        Args:
            payload: decoded JSON.

        Raises:
            MessageError: if a value has the wrong type, a key or the version is unknown, or the id is not one of a job.
        """
        if isinstance(payload, Mapping) and len(payload) > _MOST_KEYS:
            raise MessageError(f"job message refused: {len(payload)} keys; there are {len(cls.model_fields)}")
        try:
            message = cls.model_validate(payload)
        except ValidationError as error:
            first = error.errors(include_url=False, include_context=False, include_input=False)[0]
            # The error repeats an unknown key as it came, so ascii() keeps a line break in it out of the message.
            where = ascii(".".join(str(part) for part in first["loc"]))[1:80].rstrip("'") or "message"
            raise MessageError(f"job message refused: {where}: {first['msg']}") from error
        Job.from_id(message.job_id)
        return message


def queue_key(dataset: str, spec_sha256: str, place: str = "") -> str:
    """Build the prefix of a run's task ids and ledger keys: name, 12 digits of the fingerprint, and id of the place.

    Without a place it is that of earlier releases. The name is percent-encoded, since Celery's ids are plain ASCII; one
    that is long then is shortened, and told apart by its checksum.
    """
    name = quote(dataset, safe="")
    if len(name) > _KEY_CHARACTERS:
        checksum = hashlib.sha256(dataset.encode()).hexdigest()[:16]
        name = f"{name[: _KEY_CHARACTERS - len(checksum) - 1]}~{checksum}"
    return ":".join((name, spec_sha256[:12], *([place] if place else [])))
