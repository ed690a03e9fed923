"""A dataset that is made up as it is read, so that a million pictures need no disk, in a store that is slow to answer.

As a program, `python -m tests.load.synthetic COMMAND IMAGES LATENCY_MS FOLDER`, it plays one command on such a dataset
and prints what that took as JSON.
"""

import io
import json
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import redirect_stdout
from dataclasses import dataclass, replace
from pathlib import Path

from farm.dataset.completion import Completion
from farm.dataset.dataset import Dataset, create_dataset
from farm.dataset.destination import Destination
from farm.dataset.outputs import Output, outputs_of
from farm.dataset.paths import HEADER_FILE, file_path, manifest_path, output_folder
from farm.dataset.quarantine import Quarantine
from farm.dataset.report import write_overview
from farm.dataset.verify import verify
from farm.run.progress import on_disk
from farm.spec.category import Category
from farm.spec.job import Job
from farm.storage import LocalStorage, StoredFile
from tests.stand_in import StandInRenderer, stand_in_header
from worker.service.upload import upload

_PAGE = 1000
"""Files in a page of an object store's listing."""

_CABLES = 5
"""Cables in each scene, about as many as a picture of the farm has."""

_STAGES = ("open", "randomize", "simulate", "mask", "render", "write")
"""Stages whose seconds each manifest tells."""

_WRITTEN_S = 1.7e9
"""Time of every file's last change, in seconds of the Unix epoch."""


@dataclass(slots=True)
class Traffic:
    """What a store was asked for: files read, manifests among them, pages of listings, and bytes written."""

    reads: int = 0
    manifests: int = 0
    pages: int = 0
    written: int = 0


class SyntheticStorage:
    """A finished dataset. Its pictures and manifests are all alike; other files lie in a folder.

    Args:
        sample: dataset of which the first job of each category is made.
        images: number of pictures of each category.
        latency_s: time that each request takes, in seconds.
        folder: storage of all files that belong to no picture.
    """

    def __init__(self, sample: Dataset, images: int, latency_s: float, folder: LocalStorage) -> None:
        self.traffic = Traffic()
        self._images = images
        self._latency_s = latency_s
        self._folder = folder
        self._lock = threading.Lock()
        self._outputs: tuple[Output, ...] = outputs_of(sample.header.spec)
        self._categories = tuple(sample.header.spec.quotas)
        first = {category: Job(category=category, index=0) for category in self._categories}
        self._header = sample.storage.read(HEADER_FILE)
        self._manifests = {job.category: sample.storage.read(manifest_path(job)) for job in first.values()}
        self._files = {
            output_folder(job.category, output): sample.storage.read(file_path(job, output))
            for job in first.values()
            for output in self._outputs
        }

    @property
    def location(self) -> str:
        """Implement `Storage.location`."""
        return "synthetic://cables"

    def _wait(self, *, reads: int = 0, manifests: int = 0, pages: int = 0, written: int = 0) -> None:
        with self._lock:
            self.traffic.reads += reads
            self.traffic.manifests += manifests
            self.traffic.pages += pages
            self.traffic.written += written
        if self._latency_s:
            time.sleep(self._latency_s)

    def read(self, path: str) -> bytes:
        """Implement `Storage.read`."""
        folder, _, name = path.rpartition("/")
        self._wait(reads=1, manifests=folder.endswith("/manifests"))
        if path == HEADER_FILE:
            return self._header
        if folder in self._files:
            return self._files[folder]
        if folder.endswith("/manifests"):
            job_id = name.removesuffix(".json")
            category = job_id.rpartition("-")[0]
            return self._manifests[Category(category)].replace(f"{category}-000000".encode(), job_id.encode())
        return self._folder.read(path)

    def read_parts(self, path: str) -> Iterator[bytes]:
        """Implement `Streams.read_parts`."""
        for part in self._folder.read_parts(path):
            self._wait(reads=1)
            yield part

    def write(self, path: str, content: bytes) -> None:
        """Implement `Storage.write`."""
        self._wait(written=len(content))
        self._folder.write(path, content)

    def create(self, path: str, content: bytes) -> bool:
        """Implement `Storage.create`."""
        self._wait(written=len(content))
        return self._folder.create(path, content)

    def write_parts(self, path: str, parts: Iterator[bytes]) -> int:
        """Implement `Streams.write_parts`."""
        written = self._folder.write_parts(path, parts)
        self._wait(written=written)
        return written

    def files(self, under: str = "", *, deep: bool = True) -> dict[str, StoredFile]:
        """Implement `Storage.files`."""
        return dict(self.scan(under, deep=deep))

    def scan(self, under: str = "", *, deep: bool = True) -> Iterator[tuple[str, StoredFile]]:
        """Implement `Streams.scan`."""
        for number, found in enumerate(self._listing(under, deep=deep)):
            if number % _PAGE == 0:
                self._wait(pages=1)
            yield found

    def _listing(self, under: str, *, deep: bool) -> Iterator[tuple[str, StoredFile]]:
        if not under or under == "quarantine":
            yield from self._folder.files(under, deep=deep).items()
        if under and not deep:
            return
        for category in self._categories:
            names = {f"{category}/manifests": (".json", len(self._manifests[category]))}
            for output in self._outputs:
                folder = output_folder(category, output)
                names[folder] = (output.format.suffix, len(self._files[folder]))
            for folder, (suffix, size) in names.items():
                if under in {"", folder}:
                    for index in range(self._images):
                        yield f"{folder}/{category}-{index:06d}{suffix}", StoredFile(size, _WRITTEN_S)

    def is_empty(self) -> bool:
        """Implement `Storage.is_empty`."""
        return False

    def remove(self, path: str) -> None:
        """Implement `Storage.remove`."""
        self._folder.remove(path)


def synthetic_dataset(images: int, latency_s: float, folder: Path) -> tuple[Dataset, SyntheticStorage]:
    """Make a finished dataset up.

    Args:
        images: number of pictures, the same number for each category; rounded up.
        latency_s: time that each request takes, in seconds.
        folder: folder for the files that belong to no picture, such as the index.

    Returns:
        The dataset, and its storage.
    """
    each = -(-images // len(Category))
    header = stand_in_header(**{str(category): each for category in Category})
    with tempfile.TemporaryDirectory(prefix="cable-farm-") as temporary, redirect_stdout(io.StringIO()):
        sample = create_dataset(Destination(temporary, "cables"), header)
        for category in Category:
            job = Job(category=category, index=0)
            picture = StandInRenderer().make(job, header)
            scene = picture.scene.model_copy(update={"cables": picture.scene.cables * _CABLES})
            manifest = upload(replace(picture, scene=scene), job, sample)
            # Measured seconds would make manifests of another size in each process.
            same = manifest.model_copy(update={"timings_s": dict.fromkeys(_STAGES, 0.25)})
            sample.storage.write(manifest_path(job), same.model_dump_json(indent=1).encode())
        storage = SyntheticStorage(sample, each, latency_s, LocalStorage(folder))
    return replace(sample, storage=storage), storage


def _status(dataset: Dataset) -> int:
    return on_disk(dataset, Completion(dataset).audit(), Quarantine(dataset).look()).done


def _overview(dataset: Dataset) -> int:
    write_overview(dataset)
    with (dataset.storage._folder._root / "index.jsonl").open("rb") as lines:  # type: ignore[attr-defined]
        return sum(1 for _ in lines)


def _verify(dataset: Dataset) -> int:
    return verify(dataset).images


COMMANDS: dict[str, Callable[[Dataset], int]] = {"status": _status, "overview": _overview, "verify": _verify}
"""Commands that are measured; each returns the number of pictures that it found done."""


def _peak_mib() -> float:
    # The figure of getrusage() begins with that of the process that started this one.
    status = Path("/proc/self/status").read_text()
    return float(status.partition("VmHWM:")[2].split()[0]) / 1024


def main(arguments: list[str]) -> None:
    """Play one command, and print its cost."""
    command, images, latency_ms, folder = arguments
    dataset, storage = synthetic_dataset(int(images), float(latency_ms) / 1000.0, Path(folder))
    start_s, start_cpu_s = time.perf_counter(), time.process_time()
    done = COMMANDS[command](dataset)
    cost = {
        "command": command,
        "images": dataset.header.spec.total,
        "latency_ms": float(latency_ms),
        "done": done,
        "seconds": time.perf_counter() - start_s,
        "cpu_s": time.process_time() - start_cpu_s,
        "peak_mib": _peak_mib(),
        "reads_of_manifests": storage.traffic.manifests,
        "reads": storage.traffic.reads,
        "pages": storage.traffic.pages,
    }
    sys.stdout.write(json.dumps(cost) + "\n")


if __name__ == "__main__":
    main(sys.argv[1:])
