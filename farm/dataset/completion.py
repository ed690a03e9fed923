"""Finds the done jobs from the dataset's folder alone: a job is done if its manifest and files are there and fit."""

import hashlib

import numpy as np
from numpy.typing import NDArray

from farm.dataset.dataset import Dataset
from farm.dataset.manifest import parse_receipt
from farm.dataset.outputs import Output, outputs_of
from farm.dataset.paths import QUARANTINE_FOLDER, file_path, manifest_folder, manifest_path, output_folder
from farm.errors import DestinationError, MessageError
from farm.spec.category import Category
from farm.spec.job import Job
from farm.spec.job_set import JobSet
from farm.storage import TEMPORARY_PREFIX, StoredFile, is_temporary

STALE_TEMPORARY_S = 3600.0
"""No writer lives this long: a job's hard time limit is half of it."""


def _seen_type(files: int) -> np.dtype[np.void]:
    """Make the type of a remembered manifest: its own size and time, whether it fits its job, its files' sizes."""
    return np.dtype(
        [("bytes", np.int64), ("modified_s", np.float64), ("fits", np.bool_), ("sizes", np.int64, (files,))]
    )


def is_done(dataset: Dataset, job: Job) -> bool:
    """Whether one job is done, judged by its manifest and its files' checksums. A worker checks this before it starts.

    Raises:
        DestinationError: if the folder can't be read.
    """
    try:
        receipt = parse_receipt(dataset.storage.read(manifest_path(job)), dataset, job)
        return receipt is not None and all(
            hashlib.sha256(dataset.storage.read(record.path)).hexdigest() == record.sha256
            for record in receipt.files.values()
        )
    except FileNotFoundError:
        return False


def job_of_manifest(path: str) -> Job | None:
    """Return the job whose manifest would have this path; None if there is no such job."""
    stem = path.rpartition("/")[2].removesuffix(".json")
    try:
        job = Job.from_id(stem)
    except MessageError:
        return None
    return job if manifest_path(job) == path else None


class Completion:
    """The done jobs of one dataset.

    A look lists the manifests and reads those that are new. An audit lists the pictures too, and compares them with
    what the manifests tell. It remembers some 60 bytes a job.
    """

    def __init__(self, dataset: Dataset) -> None:
        self._dataset = dataset
        quotas = dataset.header.spec.quotas
        self._outputs = outputs_of(dataset.header.spec)
        seen_type = _seen_type(len(self._outputs))
        self._seen = {category: np.zeros(quota, seen_type) for category, quota in quotas.items()}
        self._damaged = {category: np.zeros(quota, np.bool_) for category, quota in quotas.items()}
        self._vouched_s = {category: np.zeros(quota) for category, quota in quotas.items()}
        self.done = JobSet(quotas)

    def look(self) -> JobSet:
        """Look for manifests again; returns the jobs that are done.

        Raises:
            DestinationError: if the folder can't be read.
        """
        self.done = JobSet.of(
            {category: self._look_at(category) & ~damaged for category, damaged in self._damaged.items()}
        )
        return self.done

    def _look_at(self, category: Category) -> NDArray[np.bool_]:
        """Find the jobs of a category whose manifest fits. A new manifest clears its job's mark of damage."""
        seen, damaged = self._seen[category], self._damaged[category]
        there = np.zeros(len(seen), np.bool_)
        for path, stored in self._dataset.storage.files(manifest_folder(category)).items():
            job = job_of_manifest(path)
            if job is None or not self._dataset.asks_for(job):
                continue
            known = seen[job.index]
            if known["bytes"] != stored.bytes or known["modified_s"] != stored.modified_s:
                if not self._read(job, path, stored):
                    continue
                damaged[job.index] = False
            there[job.index] = True
        fitting: NDArray[np.bool_] = there & seen["fits"]
        return fitting

    def _read(self, job: Job, path: str, stored: StoredFile) -> bool:
        try:
            receipt = parse_receipt(self._dataset.storage.read(path), self._dataset, job)
        except (FileNotFoundError, DestinationError):
            return False  # one that can't be read counts for nothing; the others do
        sizes = [0 if receipt is None else receipt.files[output.folder].bytes for output in self._outputs]
        self._seen[job.category][job.index] = (stored.bytes, stored.modified_s, receipt is not None, sizes)
        return True

    def audit(self) -> JobSet:
        """Look again, at the files too: a job whose picture is gone, or is not what its manifest tells, is not done.

        Sizes are compared; checksums only of files that changed after their manifest, which is written last.

        Raises:
            DestinationError: if the folder can't be read.
        """
        for category, seen in self._seen.items():
            there = self._look_at(category)
            damaged = np.zeros(len(seen), np.bool_)
            changed_s = np.zeros(len(seen))
            for place, output in enumerate(self._outputs):
                found = np.full(len(seen), -1, np.int64)
                for path, stored in self._dataset.storage.files(output_folder(category, output)).items():
                    job = _job_of_file(path, output)
                    if job is not None and self._dataset.asks_for(job):
                        found[job.index] = stored.bytes
                        changed_s[job.index] = max(changed_s[job.index], stored.modified_s)
                damaged |= found != seen["sizes"][:, place]
            suspicious = there & ~damaged & (changed_s > np.maximum(seen["modified_s"], self._vouched_s[category]))
            for index in np.flatnonzero(suspicious):
                if is_done(self._dataset, Job.model_construct(category=category, index=int(index))):
                    self._vouched_s[category][index] = changed_s[index]
                else:
                    damaged[index] = True
            # The next audit judges the files that came after the manifests were listed.
            self._damaged[category] = np.where(there, damaged, self._damaged[category])
        return self.look()

    def remove_leftovers(self, now_s: float) -> int:
        """Remove what killed writers left: temporary files of done jobs, and any that no living writer can own.

        Args:
            now_s: seconds of the Unix epoch.

        Returns:
            Number of removed files.

        Raises:
            DestinationError: if the folder can't be read or written.
        """
        removed = 0
        folders = ["", QUARANTINE_FOLDER]
        for category in self._seen:
            folders += [output_folder(category, output) for output in self._outputs]
            folders.append(manifest_folder(category))
        for folder in folders:
            for path, stored in self._dataset.storage.files(folder, deep=False).items():
                if is_temporary(path) and (now_s - stored.modified_s > STALE_TEMPORARY_S or self._is_done(path)):
                    self._dataset.storage.remove(path)
                    removed += 1
        return removed

    def _is_done(self, path: str) -> bool:
        name = path.rpartition("/")[2].removeprefix(TEMPORARY_PREFIX)
        try:
            return Job.from_id(name.partition(".")[0]) in self.done
        except MessageError:
            return False


def _job_of_file(path: str, output: Output) -> Job | None:
    try:
        job = Job.from_id(path.rpartition("/")[2].removesuffix(output.format.suffix))
    except MessageError:
        return None
    return job if file_path(job, output) == path else None
