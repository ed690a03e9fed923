"""Where the files of a dataset lie, relative to its folder. The first two folders are the published layout."""

from enum import StrEnum

from farm.spec.category import Category
from farm.spec.job import Job

HEADER_FILE = "dataset.json"
INDEX_FILE = "index.jsonl"
REPORT_FILE = "report.html"
QUARANTINE_FOLDER = "quarantine"


class FileRole(StrEnum):
    """A kind of file that every job has one of; the value is the folder's name."""

    IMAGE = "images"
    MASK = "masks"
    INSTANCES = "instances"


def file_path(job: Job, role: FileRole) -> str:
    """Path of one of the job's pictures."""
    return f"{job.category}/{role}/{job.id}.png"


def manifest_path(job: Job) -> str:
    """Path of the job's manifest."""
    return f"{manifest_folder(job.category)}/{job.id}.json"


def quarantine_path(job: Job) -> str:
    """Path of the record of a job that is given up."""
    return f"{QUARANTINE_FOLDER}/{job.id}.json"


def manifest_folder(category: Category) -> str:
    """Folder of a category's manifests."""
    return f"{category}/manifests"
