"""Finds whole pictures of another description in a dataset's folder, as they are there if its header was replaced.

Such pictures are not the dataset's, but they are somebody's work: nothing is rendered over them, and no manifest that
confirms its files is removed.
"""

import hashlib
from collections.abc import Iterable

from pydantic import ValidationError

from farm.dataset.dataset import Dataset
from farm.dataset.manifest import Receipt
from farm.dataset.outputs import outputs_of
from farm.dataset.paths import file_path, manifest_path
from farm.errors import ConflictError
from farm.spec.job import Job


def is_foreign(dataset: Dataset, job: Job) -> bool:
    """Whether the job's manifest is of another description, and confirms every file that the job would have.

    Raises:
        DestinationError: if the folder can't be read.
    """
    try:
        receipt = Receipt.model_validate_json(dataset.storage.read(manifest_path(job)))
    except (FileNotFoundError, ValidationError):
        return False
    if receipt.job_id != job.id or receipt.belongs_to(dataset, job):
        return False
    wanted = {output.folder: file_path(job, output) for output in outputs_of(dataset.header.spec)}
    if {folder: record.path for folder, record in receipt.files.items()} != wanted:
        return False
    try:
        return all(
            hashlib.sha256(dataset.storage.read(record.path)).hexdigest() == record.sha256
            for record in receipt.files.values()
        )
    except FileNotFoundError:
        return False


def refuse_foreign(dataset: Dataset, unfit: Iterable[Job]) -> None:
    """Refuse to render over whole pictures of another description.

    Args:
        dataset: the dataset.
        unfit: jobs whose manifest is there and is not the dataset's.

    Raises:
        ConflictError: if one of them is whole; it names the first.
        DestinationError: if the folder can't be read.
    """
    if (found := next((job for job in unfit if is_foreign(dataset, job)), None)) is not None:
        raise ConflictError(
            f"{dataset.storage.location}: holds whole pictures of another description than its dataset.json, such as "
            f"{found.id}: put back the dataset.json that they were made with, or move them elsewhere"
        )
