"""Where the files of a dataset lie, relative to its folder. Images and masks lie as published."""

from farm.dataset.outputs import Output
from farm.spec.category import Category
from farm.spec.job import Job

HEADER_FILE = "dataset.json"
INDEX_FILE = "index.jsonl"
REPORT_FILE = "report.html"
QUARANTINE_FOLDER = "quarantine"


def file_path(job: Job, output: Output) -> str:
    """Path of the file that the job has of an output."""
    return f"{output_folder(job.category, output)}/{job.id}{output.format.suffix}"


def output_folder(category: Category, output: Output) -> str:
    """Folder of a category's files of one output."""
    return f"{category}/{output.folder}"


def manifest_path(job: Job) -> str:
    """Path of the job's manifest."""
    return f"{manifest_folder(job.category)}/{job.id}.json"


def quarantine_path(job: Job) -> str:
    """Path of the record of a job that is given up."""
    return f"{QUARANTINE_FOLDER}/{job.id}.json"


def manifest_folder(category: Category) -> str:
    """Folder of a category's manifests."""
    return f"{category}/manifests"
