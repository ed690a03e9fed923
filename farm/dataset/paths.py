"""The paths of a dataset's files, relative to its folder. Those of images and masks are as published."""

from farm.dataset.outputs import Output
from farm.spec.category import Category
from farm.spec.job import MAX_INDEX, Job

HEADER_FILE = "dataset.json"
INDEX_FILE = "index.jsonl"
REPORT_FILE = "report.html"
PLACE_FILE = ".farm-place"
"""File that tells this folder from every other; see `farm.dataset.place`. Its name starts with a dot, so that a copy of
`folder/*` leaves it behind."""

CACHE_FILE = "index.cache"
QUARANTINE_FOLDER = "quarantine"


def file_path(job: Job, output: Output) -> str:
    """Build the path of a job's file of one output."""
    return f"{output_folder(job.category, output)}/{job.id}{output.format.suffix}"


def index_at(path: str, folder: str, category: Category, suffix: str) -> int | None:
    """Return the index of the job of a category whose file, with this suffix, would have this path in the folder.

    Returns:
        The index; None if no job's file would have this path.
    """
    start = f"{folder}/{category}-"
    if not (path.startswith(start) and path.endswith(suffix)):
        return None
    digits = path[len(start) : -len(suffix)]
    if not (digits.isascii() and digits.isdigit()):
        return None
    index = int(digits[:20])
    return index if index <= MAX_INDEX and f"{index:06d}" == digits else None


def output_folder(category: Category, output: Output) -> str:
    """Build the path of the folder that holds a category's files of one output."""
    return f"{category}/{output.folder}"


def manifest_path(job: Job) -> str:
    """Build the path of a job's manifest."""
    return f"{manifest_folder(job.category)}/{job.id}.json"


def quarantine_path(job: Job) -> str:
    """Build the path of the record that a job has while it is given up."""
    return f"{QUARANTINE_FOLDER}/{job.id}.json"


def manifest_folder(category: Category) -> str:
    """Build the path of the folder that holds a category's manifests."""
    return f"{category}/manifests"
