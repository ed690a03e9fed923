"""Checks every file of a dataset against its manifest, down to the pixels."""

import hashlib
import itertools
import time
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from enum import StrEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from farm.dataset.completion import STALE_TEMPORARY_S
from farm.dataset.dataset import Dataset
from farm.dataset.instances import find_empty_fault, list_instances
from farm.dataset.manifest import FileRecord, Manifest, parse_manifest, parse_receipt
from farm.dataset.outputs import INSTANCES, find_faults, outputs_of
from farm.dataset.paths import (
    HEADER_FILE,
    INDEX_FILE,
    PLACE_FILE,
    REPORT_FILE,
    file_path,
    manifest_path,
    quarantine_path,
)
from farm.dataset.quarantine import Quarantine
from farm.model import Model
from farm.spec.job import Job
from farm.storage import StoredFile, is_temporary

_THREADS = 4  # OpenCV and hashing leave the interpreter's lock while they work
_AT_A_TIME = 1000


class Fault(StrEnum):
    """The faults that a file can have."""

    MISSING = "missing"
    EXTRA = "extra"
    TRUNCATED = "truncated"
    ALTERED = "altered"


class Finding(Model):
    """One file that is not as it should be."""

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
    findings += _extra(dataset, dataset.storage.files())
    return Verdict(
        location=dataset.storage.location,
        images=clean,
        quota=dataset.header.spec.total,
        findings=tuple(sorted(findings, key=lambda finding: (finding.fault, finding.path))),
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
    """Yield each job with its findings; check some jobs at a time, so that a large dataset does not fill the memory."""
    jobs = dataset.header.spec.jobs()
    with ThreadPoolExecutor(_THREADS) as threads:
        while some := list(itertools.islice(jobs, _AT_A_TIME)):
            yield from zip(some, threads.map(lambda job: list(_check_job_twice(dataset, job)), some), strict=True)


def _is_missing(job: Job, findings: list[Finding]) -> bool:
    return [(finding.fault, finding.path) for finding in findings] == [(Fault.MISSING, manifest_path(job))]


def _check_job_twice(dataset: Dataset, job: Job) -> Iterator[Finding]:
    """Check a job, and again if anything seems wrong: a worker may have been replacing the files one by one."""
    if list(_check_job(dataset, job)):
        yield from _check_job(dataset, job)


def _check_job(dataset: Dataset, job: Job) -> Iterator[Finding]:
    path = manifest_path(job)
    try:
        written = dataset.storage.read(path)
        receipt = parse_receipt(written, dataset, job)
    except FileNotFoundError:
        yield Finding(fault=Fault.MISSING, path=path, detail="not rendered yet, or its manifest is lost")
        return
    if receipt is None:
        yield Finding(fault=Fault.ALTERED, path=path, detail="not a manifest of this job of this dataset")
        return
    spec = dataset.header.spec
    contents: dict[str, Any] = {}
    for output in outputs_of(spec):
        record = receipt.files[output.folder]
        read = _read_file(dataset, record)
        if isinstance(read, Finding):
            yield read
            continue
        content = output.format.decode(read)
        if content is None:
            yield Finding(fault=Fault.ALTERED, path=record.path, detail=f"no readable {output.format.name}")
        else:
            contents[output.role] = content
    faulty = set()
    for output, detail in find_faults(outputs_of(spec), contents, spec.resolution):
        faulty.add(output.role)
        yield Finding(fault=Fault.ALTERED, path=receipt.files[output.folder].path, detail=detail)
    # One of an earlier release lists no instances, and its scene may be one that only that release can read.
    manifest = None if receipt.instances is None else parse_manifest(written, dataset, job)
    if manifest is not None and INSTANCES.role in contents.keys() - faulty:
        instances = contents[INSTANCES.role]
        if (fault := find_empty_fault(manifest.scene, instances, spec)) is not None:
            yield Finding(fault=Fault.ALTERED, path=manifest.files[INSTANCES.folder].path, detail=fault)
        elif not _lists_instances(manifest, instances):
            detail = "its list of instances is not what the instance map shows"
            yield Finding(fault=Fault.ALTERED, path=path, detail=detail)


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


def _extra(dataset: Dataset, files: dict[str, StoredFile]) -> Iterator[Finding]:
    known = {HEADER_FILE, INDEX_FILE, REPORT_FILE, PLACE_FILE}
    outputs = outputs_of(dataset.header.spec)
    for job in dataset.header.spec.jobs():
        known.add(manifest_path(job))
        known.add(quarantine_path(job))
        known.update(file_path(job, output) for output in outputs)
    now_s = time.time()
    for path in files.keys() - known:
        if not is_temporary(path):
            yield Finding(fault=Fault.EXTRA, path=path, detail="belongs to no job of this dataset")
        elif now_s - files[path].modified_s > STALE_TEMPORARY_S:
            # A younger one may be somebody's work in progress.
            yield Finding(fault=Fault.EXTRA, path=path, detail="left by a killed writer; farm submit or run removes it")
