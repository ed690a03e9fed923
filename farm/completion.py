"""Which jobs are done, told by the dataset's folder alone: the manifest is there and fits, and so do the files."""

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass

from pydantic import ValidationError

from farm.dataset import Dataset
from farm.errors import MessageError
from farm.job import Job
from farm.layout import FileRole, file_path, manifest_path
from farm.manifest import Manifest
from farm.storage import TEMPORARY_PREFIX, StoredFile, is_temporary

STALE_TEMPORARY_S = 3600.0
"""No writer lives this long: a job's hard time limit is half of it."""


def parse_manifest(content: bytes, dataset: Dataset, job: Job) -> Manifest | None:
    """Read a manifest; None if it is damaged, or is not that of this job of this dataset."""
    try:
        manifest = Manifest.model_validate_json(content)
    except ValidationError:
        return None
    header = dataset.header
    belongs = (
        manifest.job_id == job.id
        and manifest.dataset == dataset.name
        and manifest.spec_sha256 == header.spec_sha256
        and manifest.seed == header.spec.seed
        and all(role in manifest.files and manifest.files[role].path == file_path(job, role) for role in FileRole)
    )
    return manifest if belongs else None


def is_done(dataset: Dataset, job: Job) -> bool:
    """Whether one job is done, its files' checksums included: what a worker asks before it starts.

    Raises:
        DestinationError: if the folder can't be read.
    """
    try:
        manifest = parse_manifest(dataset.storage.read(manifest_path(job)), dataset, job)
        return manifest is not None and all(
            hashlib.sha256(dataset.storage.read(record.path)).hexdigest() == record.sha256
            for record in manifest.files.values()
        )
    except FileNotFoundError:
        return False


def job_of_manifest(path: str) -> Job | None:
    """The job whose manifest would have this path."""
    stem = path.rpartition("/")[2].removesuffix(".json")
    try:
        job = Job.from_id(stem)
    except MessageError:
        return None
    return job if manifest_path(job) == path else None


@dataclass(frozen=True, slots=True)
class _Remembered:
    manifest: StoredFile
    sizes: Mapping[str, int] | None


class Completion:
    """The done jobs of one dataset. Each refresh lists the folder, and reads only manifests that are new."""

    def __init__(self, dataset: Dataset) -> None:
        self._dataset = dataset
        self._remembered: dict[str, _Remembered] = {}
        self.done: frozenset[str] = frozenset()

    def refresh(self) -> frozenset[str]:
        """Look again.

        Returns:
            The ids of the jobs that are done.

        Raises:
            DestinationError: if the folder can't be read.
        """
        files = self._dataset.storage.files()
        done = set()
        for path, stored in files.items():
            job = job_of_manifest(path)
            if job is None or not self._dataset.asks_for(job):
                continue
            sizes = self._sizes(job, path, stored)
            if sizes is not None and all(name in files and files[name].bytes == size for name, size in sizes.items()):
                done.add(job.id)
        self.done = frozenset(done)
        return self.done

    def _sizes(self, job: Job, path: str, stored: StoredFile) -> Mapping[str, int] | None:
        remembered = self._remembered.get(job.id)
        if remembered is None or remembered.manifest != stored:
            try:
                manifest = parse_manifest(self._dataset.storage.read(path), self._dataset, job)
            except FileNotFoundError:
                return None
            sizes = None if manifest is None else {record.path: record.bytes for record in manifest.files.values()}
            remembered = self._remembered[job.id] = _Remembered(stored, sizes)
        return remembered.sizes

    def remove_leftovers(self, now_s: float) -> int:
        """Remove what killed writers left: temporary files of done jobs, and any that no living writer can own.

        Args:
            now_s: seconds of the Unix epoch.

        Returns:
            How many were removed.

        Raises:
            DestinationError: if the folder can't be read or written.
        """
        removed = 0
        for path, stored in self._dataset.storage.files().items():
            if is_temporary(path) and (now_s - stored.modified_s > STALE_TEMPORARY_S or _belongs_to(path, self.done)):
                self._dataset.storage.remove(path)
                removed += 1
        return removed


def _belongs_to(path: str, done: frozenset[str]) -> bool:
    name = path.rpartition("/")[2].removeprefix(TEMPORARY_PREFIX)
    return name.partition(".")[0] in done
