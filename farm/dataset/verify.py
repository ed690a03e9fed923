"""Checks every file of a dataset against its manifest, down to the pixels."""

import hashlib
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum
from operator import attrgetter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from farm.dataset.completion import STALE_TEMPORARY_S
from farm.dataset.dataset import Dataset
from farm.dataset.foreign import is_foreign
from farm.dataset.instances import find_empty_fault, list_instances
from farm.dataset.manifest import FileRecord, Manifest, parse_manifest, parse_receipt
from farm.dataset.outputs import INSTANCES, find_faults, outputs_of
from farm.dataset.paths import (
    CACHE_FILE,
    HEADER_FILE,
    INDEX_FILE,
    PLACE_FILE,
    REPORT_FILE,
    index_at,
    manifest_folder,
    manifest_path,
    output_folder,
)
from farm.dataset.quarantine import Quarantine, job_of_record
from farm.model import Model
from farm.spec.job import Job
from farm.storage import StoredFile, in_order, is_temporary, scan

_OF_DATASET = frozenset({HEADER_FILE, INDEX_FILE, REPORT_FILE, CACHE_FILE, PLACE_FILE})
"""Files of a dataset that belong to no job."""

_DECODERS = threading.BoundedSemaphore(4)
"""Limits the pictures that are decoded at a time, which take some megabytes each; many more are read at a time. OpenCV
leaves the interpreter's lock while it works."""


class Fault(StrEnum):
    """The faults that a file can have."""

    MISSING = "missing"
    EXTRA = "extra"
    TRUNCATED = "truncated"
    ALTERED = "altered"


@dataclass(frozen=True, slots=True)
class Finding:
    """One file that is not as it should be. A dataset in the making may have millions, so it is no `Model`."""

    fault: Fault
    path: str
    detail: str


class Verdict(Model):
    """The outcome of the check of a whole dataset.

    Attributes:
        images: jobs whose manifest and files are all as they should be.
        quota: jobs asked for.
        quarantined: jobs that are given up, by id with the reason; of these nothing is missing.
    """

    location: str
    images: int
    quota: int
    findings: tuple[Finding, ...]
    quarantined: Mapping[str, str] = {}

    @property
    def clean(self) -> bool:
        """Whether nothing is missing, damaged or extra; jobs that are given up don't count as missing."""
        return not self.findings


def verify(dataset: Dataset, on_checked: Callable[[int], None] = lambda _: None) -> Verdict:
    """Check a dataset, which may grow meanwhile: a file that is made before its job is checked is not missing.

    Args:
        dataset: the dataset.
        on_checked: told how many jobs were checked, after each.

    Raises:
        DestinationError: if the folder or a file in it can't be read.
    """
    findings: list[Finding] = []
    given_up = Quarantine(dataset).look()
    quarantined: dict[str, str] = {}
    clean = 0
    for count, (job, found) in enumerate(_check_all(dataset), start=1):
        if job.id in given_up and _is_missing(job, found):
            quarantined[job.id] = given_up[job.id]
        else:
            findings += found
            clean += not found
        on_checked(count)
    findings += _extra(dataset, scan(dataset.storage))
    # One key for both would make a pair for each finding.
    findings.sort(key=attrgetter("path"))
    findings.sort(key=attrgetter("fault"))
    return Verdict(
        location=dataset.storage.location,
        images=clean,
        quota=dataset.header.spec.total,
        findings=tuple(findings),
        quarantined=quarantined,
    )


def damaged_jobs(dataset: Dataset) -> Iterator[Job]:
    """Yield the jobs whose manifest is wrong, or disagrees with one of the job's files.

    Raises:
        DestinationError: if the folder or a file in it can't be read.
    """
    for job, found in _check_all(dataset):
        if found and not _is_missing(job, found):
            yield job


def _check_all(dataset: Dataset) -> Iterator[tuple[Job, list[Finding]]]:
    """Yield each job with its findings."""
    return in_order(lambda job: (job, _check_job_twice(dataset, job)), dataset.header.spec.jobs())


def _is_missing(job: Job, findings: list[Finding]) -> bool:
    return [(finding.fault, finding.path) for finding in findings] == [(Fault.MISSING, manifest_path(job))]


def _check_job_twice(dataset: Dataset, job: Job) -> list[Finding]:
    """Check a job, and again if anything seems wrong: a worker may have been replacing the files one by one."""
    found = list(_check_job(dataset, job))
    if found and not _is_missing(job, found):
        found = list(_check_job(dataset, job))
    return found


def _check_job(dataset: Dataset, job: Job) -> Iterator[Finding]:
    path = manifest_path(job)
    try:
        written = dataset.storage.read(path)
        receipt = parse_receipt(written, dataset, job)
    except FileNotFoundError:
        yield Finding(fault=Fault.MISSING, path=path, detail="not rendered yet, or its manifest is lost")
        return
    if receipt is None:
        foreign = is_foreign(dataset, job)
        detail = "confirms its files, but is of another description" if foreign else "not a manifest of this job"
        yield Finding(fault=Fault.ALTERED, path=path, detail=detail)
        return
    spec = dataset.header.spec
    contents: dict[str, Any] = {}
    for output in outputs_of(spec):
        record = receipt.files[output.folder]
        read = _read_file(dataset, record)
        if isinstance(read, Finding):
            yield read
            continue
        with _DECODERS:
            content = output.format.decode(read)
        if content is None:
            yield Finding(fault=Fault.ALTERED, path=record.path, detail=f"no readable {output.format.name}")
        else:
            contents[output.role] = content
    faulty = set()
    for output, detail in find_faults(outputs_of(spec), contents, spec.resolution):
        faulty.add(output.role)
        yield Finding(fault=Fault.ALTERED, path=receipt.files[output.folder].path, detail=detail)
    # A manifest of an earlier release lists no instances, and only that release may be able to read its scene.
    manifest = None if receipt.instances is None else parse_manifest(written, dataset, job)
    if manifest is not None and INSTANCES.role in contents.keys() - faulty:
        yield from _check_instances(manifest, contents[INSTANCES.role], dataset, job)


def _check_instances(
    manifest: Manifest, instances: NDArray[np.uint16], dataset: Dataset, job: Job
) -> Iterator[Finding]:
    """Check a picture's instance map against its scene, and against the list in its manifest."""
    if (fault := find_empty_fault(manifest.scene, instances, dataset.header.spec)) is not None:
        yield Finding(fault=Fault.ALTERED, path=manifest.files[INSTANCES.folder].path, detail=fault)
    elif not _lists_instances(manifest, instances):
        detail = "its list of instances is not what the instance map shows"
        yield Finding(fault=Fault.ALTERED, path=manifest_path(job), detail=detail)


def _lists_instances(manifest: Manifest, instances: NDArray[np.uint16]) -> bool:
    """Whether a manifest lists what the picture's instance map shows."""
    try:
        return manifest.instances == list_instances(manifest.scene, instances)
    except ValueError:
        return False


def _read_file(dataset: Dataset, record: FileRecord) -> bytes | Finding:
    """Return the file's bytes if they agree with its record, else the finding that says what is wrong."""
    # Read rather than looked up in a listing, which would be older than the manifest where the dataset grows.
    try:
        content = dataset.storage.read(record.path)
    except FileNotFoundError:
        return Finding(fault=Fault.MISSING, path=record.path, detail="its manifest is there")
    if len(content) < record.bytes:
        detail = f"{len(content)} of {record.bytes} bytes"
        return Finding(fault=Fault.TRUNCATED, path=record.path, detail=detail)
    if len(content) != record.bytes or hashlib.sha256(content).hexdigest() != record.sha256:
        return Finding(fault=Fault.ALTERED, path=record.path, detail="its checksum is not the manifest's")
    return content


def _extra(dataset: Dataset, files: Iterable[tuple[str, StoredFile]]) -> Iterator[Finding]:
    is_known = _known_paths(dataset)
    now_s = time.time()
    for path, stored in files:
        if is_known(path):
            continue
        if not is_temporary(path):
            yield Finding(fault=Fault.EXTRA, path=path, detail="belongs to no job of this dataset")
        elif now_s - stored.modified_s > STALE_TEMPORARY_S:
            # A younger one may be somebody's work in progress.
            yield Finding(fault=Fault.EXTRA, path=path, detail="left by a killed writer; farm submit or run removes it")


def _known_paths(dataset: Dataset) -> Callable[[str], bool]:
    """Make a function that tells whether a path is one of a job, or of the dataset as a whole."""
    spec = dataset.header.spec
    places = {manifest_folder(category): (category, ".json") for category in spec.quotas}
    for output in outputs_of(spec):
        places |= {output_folder(category, output): (category, output.format.suffix) for category in spec.quotas}

    def is_known(path: str) -> bool:
        folder = path.rpartition("/")[0]
        if folder in places:
            category, suffix = places[folder]
            index = index_at(path, folder, category, suffix)
            return index is not None and index < spec.quotas[category]
        job = job_of_record(path)
        return path in _OF_DATASET or (job is not None and dataset.asks_for(job))

    return is_known
