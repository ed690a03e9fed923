"""A dataset in its place: opening one that is there, or laying down the header of a new one."""

from dataclasses import dataclass

from farm.dataset.destination import Destination
from farm.dataset.header_comparison import difference
from farm.dataset.header_file import header_content, read_header
from farm.dataset.paths import HEADER_FILE
from farm.errors import ConflictError, DatasetMissingError, DestinationError, MessageError, StaleMessageError
from farm.spec.header import DatasetHeader
from farm.spec.job import Job, JobMessage
from farm.storage import Storage, open_storage


@dataclass(frozen=True, slots=True)
class Dataset:
    """A dataset whose header is in place.

    Attributes:
        name: name of its folder, which may be renamed or copied.
        storage: its folder.
        header: its header.
        identity: SHA-256 by which manifests and messages name it; see `farm.dataset.header_file`.
    """

    name: str
    storage: Storage
    header: DatasetHeader
    identity: str

    def message(self, job: Job) -> JobMessage:
        """Make the message that asks a worker for one of the dataset's images."""
        return JobMessage(dataset=self.name, spec_sha256=self.identity, job_id=job.id)

    def asks_for(self, job: Job) -> bool:
        """Whether the job is within the quotas."""
        return job.index < self.header.spec.quotas.get(job.category, 0)


def open_dataset(destination: Destination) -> Dataset:
    """Open the dataset that is there.

    Raises:
        DatasetMissingError: if there is none.
        DestinationError: if its header can't be read.
        ConflictError: if its header is damaged or of another version of the farm.
        SpecError: if its header names a simulator that the farm no longer offers.
    """
    storage = open_storage(destination.location, anchor=HEADER_FILE)
    try:
        present = read_header(storage)
    except FileNotFoundError as error:
        raise DatasetMissingError(
            f"{destination.location}: no dataset here (no {HEADER_FILE}); check the path, or make one with farm run"
        ) from error
    return Dataset(destination.name, storage, present.header, present.identity)


def open_for_message(store: str, message: JobMessage) -> Dataset:
    """Open the dataset that a job message names, in this worker's own store.

    Raises:
        DatasetMissingError: if the store does not hold it.
        DestinationError: if its header can't be read.
        StaleMessageError: if it is there with another description.
        MessageError: if it does not ask for this job.
    """
    dataset = open_dataset(Destination(store=store, name=message.dataset))
    if dataset.identity != message.spec_sha256:
        raise StaleMessageError(
            f"{message.task_id}: made for description {message.spec_sha256[:12]}, but {dataset.storage.location} holds "
            f"{dataset.identity[:12]}; submit again, or give this worker the right --store"
        )
    if not dataset.asks_for(message.job):
        raise MessageError(f"{message.task_id}: outside the dataset's quotas; submit again")
    return dataset


def find_dataset(destination: Destination, header: DatasetHeader) -> Dataset | None:
    """Find the dataset with this description in its place; None if the place is free. Writes nothing.

    The user's files are compared by content: their paths differ from machine to machine.

    Raises:
        ConflictError: if the place holds another dataset, or anything else.
        DestinationError: if it can't be read.
    """
    storage = open_storage(destination.location)
    try:
        present = read_header(storage)
    except FileNotFoundError:
        if not storage.is_empty():
            raise ConflictError(
                f"{destination.location}: holds files, but no {HEADER_FILE}; choose an empty or new folder"
            ) from None
        return None
    if found := difference(present, header):
        raise ConflictError(
            f"{destination.location}: holds another dataset: {found}; repeat the first call's options to complete it, "
            "go on with what its dataset.json says by --continue, or choose another --out"
        )
    anchored = open_storage(destination.location, anchor=HEADER_FILE)
    return Dataset(destination.name, anchored, present.header, present.identity)


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
    # Nothing but a new header may make the folder.
    storage.write(HEADER_FILE, header_content(header))
    # Of two commands that lay down different headers at once, the slower writer has the place.
    present = find_dataset(destination, header)
    if present is None:
        raise DestinationError(f"{destination.location}: the {HEADER_FILE} just written is gone; submit again")
    return present
