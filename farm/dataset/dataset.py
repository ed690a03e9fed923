"""A dataset in its place: opening one that is there, or laying down the header of a new one."""

import functools
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from pydantic import TypeAdapter, ValidationError

from farm.dataset.paths import HEADER_FILE
from farm.errors import ConflictError, DatasetMissingError, DestinationError, MessageError, SpecError, StaleMessageError
from farm.spec.header import DatasetHeader
from farm.spec.job import DatasetName, Job, JobMessage
from farm.spec.simulation import WITHDRAWN_FAULT
from farm.storage import Storage, open_storage, refuse_credentials

_NAME: TypeAdapter[str] = TypeAdapter(DatasetName)


@dataclass(frozen=True, slots=True)
class Destination:
    """Where a dataset goes: the store (a folder or URL) and the dataset's own folder in it."""

    store: str
    name: str

    @property
    def location(self) -> str:
        """The dataset's folder."""
        return f"{self.store.rstrip('/')}/{self.name}"


@dataclass(frozen=True, slots=True)
class Dataset:
    """A dataset whose header is in place."""

    name: str
    storage: Storage
    header: DatasetHeader

    def message(self, job: Job) -> JobMessage:
        """What asks a worker for one of the dataset's images."""
        return JobMessage(dataset=self.name, spec_sha256=self.header.spec_sha256, job_id=job.id)

    def asks_for(self, job: Job) -> bool:
        """Whether the job is within the quotas."""
        return job.index < self.header.spec.quotas.get(job.category, 0)


def parse_destination(out: str) -> Destination:
    """Split a place, a path or URL, into the store and the dataset's name.

    Raises:
        DestinationError: if a URL names no folder in a bucket or holds credentials, or the last part can't be the name
            of a dataset.
    """
    if "://" in out:
        refuse_credentials(out)
        kind, _, rest = out.partition("://")
        store, _, name = rest.rstrip("/").rpartition("/")
        if not store.strip("/"):
            raise DestinationError(f"{out}: names no folder for the dataset; write {kind}://BUCKET/FOLDER")
        store = f"{kind}://{store}"
    else:
        try:
            path = Path(out).expanduser().resolve()
        except (ValueError, RuntimeError, OSError) as error:
            # A NUL byte, an unknown user's home, a ring of links.
            raise DestinationError(f"{out!a}: no path: {error}") from error
        store, name = str(path.parent), path.name
    try:
        return Destination(store=store, name=_NAME.validate_python(name))
    except ValidationError as error:
        raise DestinationError(
            f"{out}: '{name}' can't name a dataset; use up to 100 letters, digits, '.', '_' and '-', and begin with a "
            "letter or digit"
        ) from error


def open_dataset(destination: Destination) -> Dataset:
    """Open the dataset that is there.

    Raises:
        DatasetMissingError: if there is none.
        DestinationError: if its header can't be read.
        ConflictError: if its header is damaged or of another version of the farm.
        SpecError: if its header names a simulator that the farm no longer offers.
    """
    storage = open_storage(destination.location)
    try:
        header = _read_header(storage)
    except FileNotFoundError as error:
        raise DatasetMissingError(
            f"{destination.location}: no dataset here (no {HEADER_FILE}); check the path, or make one with farm run"
        ) from error
    return Dataset(destination.name, storage, header)


def open_for_message(store: str, message: JobMessage) -> Dataset:
    """Open the dataset that a job message names, in this worker's own store.

    Raises:
        DatasetMissingError: if the store does not hold it.
        DestinationError: if its header can't be read.
        StaleMessageError: if it is there with another description.
        MessageError: if it does not ask for this job.
    """
    dataset = open_dataset(Destination(store=store, name=message.dataset))
    if dataset.header.spec_sha256 != message.spec_sha256:
        raise StaleMessageError(
            f"{message.task_id}: made for description {message.spec_sha256[:12]}, but {dataset.storage.location} holds "
            f"{dataset.header.spec_sha256[:12]}; submit again, or give this worker the right --store"
        )
    if not dataset.asks_for(message.job):
        raise MessageError(f"{message.task_id}: outside the dataset's quotas; submit again")
    return dataset


def find_dataset(destination: Destination, header: DatasetHeader) -> Dataset | None:
    """The dataset with this description that is in the place already; None if the place is free. Writes nothing.

    Raises:
        ConflictError: if the place holds another dataset, or anything else.
        DestinationError: if it can't be read.
    """
    storage = open_storage(destination.location)
    try:
        present = _read_header(storage)
    except FileNotFoundError:
        if not storage.is_empty():
            raise ConflictError(
                f"{destination.location}: holds files, but no {HEADER_FILE}; choose an empty or new folder"
            ) from None
        return None
    if present.spec_sha256 != header.spec_sha256:
        difference = first_difference(present.model_dump(mode="json"), header.model_dump(mode="json"))
        raise ConflictError(
            f"{destination.location}: holds another dataset: {difference}; repeat the first call's options to "
            "complete it, or choose another --out"
        )
    return Dataset(destination.name, storage, present)


def create_dataset(destination: Destination, header: DatasetHeader) -> Dataset:
    """Lay down a new dataset's header, or accept the equal one that is there.

    Raises:
        ConflictError: if the place holds another dataset, or anything else.
        DestinationError: if it can't be read or written.
    """
    present = find_dataset(destination, header)
    if present is not None:
        return present
    storage = open_storage(destination.location)
    storage.write(HEADER_FILE, header.model_dump_json(indent=1).encode() + b"\n")
    return Dataset(destination.name, storage, header)


def _read_header(storage: Storage) -> DatasetHeader:
    try:
        return _parse_header(storage.read(HEADER_FILE))
    except ValidationError as error:
        first = error.errors(include_url=False, include_context=False, include_input=False)[0]
        where = ".".join(str(part) for part in first["loc"])
        if first["type"] == WITHDRAWN_FAULT:
            raise SpecError(
                f"{storage.location}/{HEADER_FILE}: {where}: {first['msg']}, in a dataset in another --out"
            ) from error
        raise ConflictError(
            f"{storage.location}/{HEADER_FILE}: not readable by this version of the farm: {where}: {first['msg']}; "
            "choose another --out"
        ) from error


@functools.lru_cache(maxsize=16)  # a worker reads it for each job, as it may have been replaced
def _parse_header(content: bytes) -> DatasetHeader:
    return DatasetHeader.model_validate_json(content)


def first_difference(present: object, asked: object, where: str = "") -> str:
    """The first key in which two JSON values differ, as `key is 1, asked 2`; empty if they are equal."""
    if isinstance(present, Mapping) and isinstance(asked, Mapping):
        for key in [*present, *(key for key in asked if key not in present)]:
            if key == "farm_version":
                continue
            path = f"{where}.{key}" if where else str(key)
            if found := first_difference(present.get(key), asked.get(key), path):
                return found
        return ""
    if isinstance(present, list) and isinstance(asked, list):
        for index, (one, other) in enumerate(zip(present, asked, strict=False)):
            if found := first_difference(one, other, f"{where}[{index}]"):
                return found
        if len(present) != len(asked):
            return f"{where} has {len(present)} entries, asked {len(asked)}"
        return ""
    return "" if present == asked else f"{where} is {_short(present)}, asked {_short(asked)}"


def _short(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."
