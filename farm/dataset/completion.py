"""Finds the done jobs from the dataset's folder alone: a job is done if its manifest and files are there and fit."""

import hashlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from farm.dataset.dataset import Dataset
from farm.dataset.manifest import Receipt, parse_receipt
from farm.dataset.memory import ABSENT, FITS, KNOWN, OWN, Memory, mark_of, size_in_row
from farm.dataset.outputs import Output, outputs_of
from farm.dataset.paths import QUARANTINE_FOLDER, index_at, manifest_folder, manifest_path, output_folder
from farm.errors import DestinationError, MessageError
from farm.spec.category import Category
from farm.spec.job import Job
from farm.spec.job_set import JobSet
from farm.storage import TEMPORARY_PREFIX, StoredFile, in_order, is_temporary, scan

STALE_TEMPORARY_S = 3600.0
"""No writer lives this long: a job's hard time limit is half of it."""

SAVE_AFTER = 1000
"""Manifests read since the memory was saved, from which on an audit saves it; fewer are read again in a second."""

_SAVE_SHARE = 50
"""Part of the known manifests, as 1/50, that must be new before an audit saves: so a large dataset's memory is written
some hundred times in all."""

_LISTERS = 8
"""Folders that are listed at a time."""

_PICTURE_TYPE = np.dtype([("bytes", "<u4"), ("modified_s", "<f8")])
_MANIFEST_TYPE = np.dtype([("bytes", "<u4"), ("modified_s", "<f8"), ("mark", "<u8")])

Members = dict[Category, NDArray[np.bool_]]


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


@dataclass(frozen=True, slots=True)
class _Listing:
    """What one folder of a category holds.

    Attributes:
        files: (quota,) rows with the fields `bytes` and `modified_s`; for manifests, also `mark`. Where there is no
            file, `bytes` is `ABSENT`.
        temporary: files that are being written, or that killed writers left, by path.
    """

    files: NDArray[Any]
    temporary: dict[str, StoredFile] = field(default_factory=dict)


class Completion:
    """The done jobs of one dataset.

    A look lists the manifests and reads those that are new to it and to the saved memory. An audit lists the pictures
    too, and compares them with what the manifests tell. It remembers some 70 bytes a job.

    Args:
        dataset: the dataset.
        save_after: number of manifests read, from which on an audit saves the memory.

    Attributes:
        done: jobs that were done at the last look.
        unfit: jobs whose manifest was there at the last look, and is damaged or of another dataset.
    """

    def __init__(self, dataset: Dataset, *, save_after: int = SAVE_AFTER) -> None:
        self._dataset = dataset
        self._save_after = save_after
        quotas = dataset.header.spec.quotas
        self._outputs = outputs_of(dataset.header.spec)
        self._damaged: Members = {category: np.zeros(quota, np.bool_) for category, quota in quotas.items()}
        self._temporary: dict[str, StoredFile] = {}
        self._memory: Memory | None = None
        self.done = JobSet(quotas)
        self.unfit = JobSet(quotas)

    @property
    def memory(self) -> Memory:
        """What is remembered of the manifests; at the first use, what an earlier command saved."""
        if self._memory is None:
            self._memory = Memory(self._dataset)
            self._memory.load()
        return self._memory

    def look(self) -> JobSet:
        """Look for manifests again; returns the jobs that are done.

        Raises:
            DestinationError: if the folder can't be read.
        """
        there = self._find_manifests()
        self.done = JobSet.of({category: there[category] & ~damaged for category, damaged in self._damaged.items()})
        return self.done

    def _find_manifests(self) -> Members:
        """Find the jobs whose manifest is there and fits. A new manifest clears its job's mark of damage."""
        self._temporary = {}
        found: Members = {}
        unfit: Members = {}
        categories = list(self._dataset.header.spec.quotas)
        for category, listing in zip(
            categories, in_order(self._list_manifests, categories, at_a_time=_LISTERS), strict=True
        ):
            self._temporary |= listing.temporary
            rows, files = self.memory.rows[category], listing.files
            new = rows["state"] & KNOWN == 0
            for name in ("bytes", "modified_s", "mark"):
                new |= files[name] != rows[name]
            self._read(category, files, new & (files["bytes"] != ABSENT))
            found[category] = (files["bytes"] != ABSENT) & (rows["state"] & FITS > 0)
            unfit[category] = (files["bytes"] != ABSENT) & (rows["state"] & FITS == 0)
        self.unfit = JobSet.of(unfit)
        return found

    def _read(self, category: Category, files: NDArray[Any], wanted: NDArray[np.bool_]) -> None:
        """Read manifests. One that can't be read is marked as absent: it counts for nothing, and the others do."""
        indices = np.flatnonzero(wanted).tolist()
        for index, read in zip(indices, in_order(self._receipt, self._jobs(category, indices)), strict=True):
            if isinstance(read, Exception):
                files["bytes"][index] = ABSENT
                continue
            self._damaged[category][index] = False
            self.memory.put(category, index, files[index].item(), read)

    @staticmethod
    def _jobs(category: Category, indices: list[int]) -> Iterator[Job]:
        return (Job.model_construct(category=category, index=index) for index in indices)

    def _receipt(self, job: Job) -> Receipt | Exception | None:
        try:
            return parse_receipt(self._dataset.storage.read(manifest_path(job)), self._dataset, job)
        except (FileNotFoundError, DestinationError) as error:
            return error

    def _list_manifests(self, category: Category) -> _Listing:
        return self._list(category, manifest_folder(category), ".json", _MANIFEST_TYPE)

    def _list_pictures(self, task: tuple[Category, Output]) -> _Listing:
        category, output = task
        return self._list(category, output_folder(category, output), output.format.suffix, _PICTURE_TYPE)

    def _list(self, category: Category, folder: str, suffix: str, kind: "np.dtype[np.void]") -> _Listing:
        listing = _Listing(np.zeros(self._dataset.header.spec.quotas[category], kind))
        listing.files["bytes"] = ABSENT
        for path, stored in scan(self._dataset.storage, folder):
            index = index_at(path, folder, category, suffix)
            if index is not None and index < len(listing.files):
                shown = (size_in_row(stored.bytes), stored.modified_s, mark_of(stored.tag))
                listing.files[index] = shown[: len(kind.names or ())]
            elif is_temporary(path) and path.rpartition("/")[0] == folder:
                listing.temporary[path] = stored
        return listing

    def audit(self) -> JobSet:
        """Look again, at the files too: a job whose picture is gone, or is not what its manifest tells, is not done.

        Sizes are compared; checksums only of files that changed after their manifest, which is written last.

        Raises:
            DestinationError: if the folder can't be read.
        """
        there = self._find_manifests()
        temporary = dict(self._temporary)
        damaged = {category: np.zeros(len(members), np.bool_) for category, members in there.items()}
        changed_s = {category: np.zeros(len(members)) for category, members in there.items()}
        tasks = [(category, output) for category in there for output in self._outputs]
        for (category, output), listing in zip(
            tasks, in_order(self._list_pictures, tasks, at_a_time=_LISTERS), strict=True
        ):
            temporary |= listing.temporary
            np.maximum(changed_s[category], listing.files["modified_s"], out=changed_s[category])
            damaged[category] |= self._wrong_sizes(category, output, listing, there[category])
        for category, members in there.items():
            rows = self.memory.rows[category]
            late = changed_s[category] > np.maximum(rows["modified_s"], rows["vouched_s"])
            late &= members & ~damaged[category]
            self._compare_checksums(category, late, changed_s[category], damaged[category])
            # The next audit judges the files that came after the manifests were listed.
            self._damaged[category] = np.where(members, damaged[category], self._damaged[category])
        self.look()
        self._temporary = temporary
        self.save()
        return self.done

    def _wrong_sizes(
        self, category: Category, output: Output, listing: _Listing, there: NDArray[np.bool_]
    ) -> NDArray[np.bool_]:
        """Find the jobs whose file of one output is gone, or has another size than the manifest tells."""
        rows, place = self.memory.rows[category], self._outputs.index(output)
        sizes = listing.files["bytes"]
        wrong: NDArray[np.bool_] = sizes != rows["sizes"][:, place]
        # Nothing is called damaged on a saved memory's word: the manifest itself is asked.
        for index in np.flatnonzero(wrong & there & (rows["state"] & OWN == 0)).tolist():
            receipt = self._receipt(Job.model_construct(category=category, index=index))
            if isinstance(receipt, Exception):
                continue
            row = rows[index]
            self.memory.put(category, index, (row["bytes"], row["modified_s"], row["mark"]), receipt)
            wrong[index] = receipt is None or sizes[index] != rows[index]["sizes"][place]
        return wrong

    def _compare_checksums(
        self,
        category: Category,
        wanted: NDArray[np.bool_],
        changed_s: NDArray[np.float64],
        damaged: NDArray[np.bool_],
    ) -> None:
        """Read the files of some jobs: those that agree with their manifest are remembered, the others are damaged."""
        indices = np.flatnonzero(wanted).tolist()
        judge = in_order(lambda job: is_done(self._dataset, job), self._jobs(category, indices))
        for index, done in zip(indices, judge, strict=True):
            if done:
                self.memory.vouch(category, index, float(changed_s[index]))
            else:
                damaged[index] = True

    def save(self) -> None:
        """Save the memory for the next command, if much of it is new."""
        known = sum(int(np.count_nonzero(rows["state"])) for rows in self.memory.rows.values())
        if self.memory.unsaved >= max(self._save_after, known // _SAVE_SHARE):
            self.memory.save()

    def remove_leftovers(self, now_s: float) -> int:
        """Remove what killed writers left: temporary files of done jobs, and any that no living writer can own.

        Those among the pictures and manifests are the ones that the last audit met.

        Args:
            now_s: seconds of the Unix epoch.

        Returns:
            Number of removed files.

        Raises:
            DestinationError: if the folder can't be read or written.
        """
        found = dict(self._temporary)
        for folder in ("", QUARANTINE_FOLDER):
            there = scan(self._dataset.storage, folder, deep=False)
            found |= {path: stored for path, stored in there if is_temporary(path)}
        stale = [
            path
            for path, stored in found.items()
            if now_s - stored.modified_s > STALE_TEMPORARY_S or self._is_done(path)
        ]
        for path in stale:
            self._dataset.storage.remove(path)
            self._temporary.pop(path, None)
        return len(stale)

    def _is_done(self, path: str) -> bool:
        name = path.rpartition("/")[2].removeprefix(TEMPORARY_PREFIX)
        try:
            return Job.from_id(name.partition(".")[0]) in self.done
        except MessageError:
            return False
