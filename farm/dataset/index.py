"""The index of a dataset: its done images in order, and the file `index.jsonl` with one line for each."""

import hashlib
import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import TypeVar

from pydantic import NonNegativeInt, SerializerFunctionWrapHandler, model_serializer

from farm.dataset.completion import Completion
from farm.dataset.dataset import Dataset
from farm.dataset.manifest import Manifest, Receipt, parse_manifest, parse_receipt
from farm.dataset.memory import LISTED, Memory
from farm.dataset.outputs import outputs_of
from farm.dataset.paths import INDEX_FILE, manifest_path
from farm.errors import DestinationError
from farm.model import Model, Sha256
from farm.spec.category import Category
from farm.spec.job import Job
from farm.spec.job_set import JobSet
from farm.storage import in_order, read_parts, write_parts

_LINE_START = b'{"job_id":"'
"""Start of every line, up to the job's id."""

_BATCH = 1000
"""Lines that are written at a time."""

T = TypeVar("T")
_Parse = Callable[[bytes, Dataset, Job], T | None]


class IndexedFile(Model):
    """One file of an image: where it is below the dataset's folder, and its checksum."""

    path: str
    sha256: Sha256


class IndexEntry(Model):
    """One image in the index. It tells nothing that changes from one making of the image to the next.

    Attributes:
        files: the image's files by role. In JSON they are keys of the entry itself: each file's path under its role,
            then each file's checksum under its role and `_sha256`.
        cables: number of cables in the scene, a bundle counted as one; 0 for a picture of the background alone.
        visible_instances: number of cables and strands of bundles that the picture shows; None if its manifest is of a
            farm that did not list them.
    """

    job_id: str
    category: Category
    index: NonNegativeInt
    seed: NonNegativeInt
    files: Mapping[str, IndexedFile]
    attempt: NonNegativeInt
    cables: NonNegativeInt
    surface: str | None
    hdri: str | None
    lamp: str | None
    camera_height_m: float
    visible_instances: NonNegativeInt | None = None

    @model_serializer(mode="wrap")
    def _with_files_as_keys(self, as_declared: SerializerFunctionWrapHandler) -> dict[str, object]:
        line: dict[str, object] = {}
        for key, value in as_declared(self).items():
            if key == "files":
                line |= {role: file.path for role, file in self.files.items()}
                line |= {f"{role}_sha256": file.sha256 for role, file in self.files.items()}
            else:
                line[key] = value
        return line


def done_manifests(dataset: Dataset) -> Iterator[tuple[Job, Manifest]]:
    """Yield the done images with their manifests, by category in order and then by index.

    Those that only another release can read are left out.

    Raises:
        DestinationError: if the folder can't be read.
    """
    done = Completion(dataset).audit().by_category()
    for job, manifest in in_order(lambda job: (job, _read(dataset, job, parse_manifest)), done):
        if manifest is not None:
            yield job, manifest


def _read(dataset: Dataset, job: Job, parse: _Parse[T]) -> T | None:
    try:
        return parse(dataset.storage.read(manifest_path(job)), dataset, job)
    except FileNotFoundError:
        return None  # taken away meanwhile, as damaged


def index_entry(dataset: Dataset, job: Job, receipt: Receipt) -> IndexEntry:
    """Make the index entry of one image of a dataset, whichever release made it."""
    scene = receipt.scene
    records = {output.role: receipt.files[output.folder] for output in outputs_of(dataset.header.spec)}
    return IndexEntry(
        job_id=job.id,
        category=job.category,
        index=job.index,
        seed=receipt.seed,
        files={role: IndexedFile(path=record.path, sha256=record.sha256) for role, record in records.items()},
        attempt=scene.attempt,
        cables=len(scene.cables),
        surface=scene.floor.texture if scene.floor else None,
        hdri=scene.hdri_world.hdri if scene.hdri_world else None,
        lamp=scene.first_lamp,
        camera_height_m=scene.camera.height_m,
        visible_instances=None if receipt.instances is None else len(receipt.instances),
    )


def index_line(entry: IndexEntry) -> bytes:
    """Make the line of the index that holds an entry."""
    return entry.model_dump_json().encode() + b"\n"


def read_line(line: bytes) -> IndexEntry:
    """Read an entry back from a line that `index_line` made."""
    keys = json.loads(line)
    roles = [key for key in keys if f"{key}_sha256" in keys]
    files = {role: IndexedFile(path=keys.pop(role), sha256=keys.pop(f"{role}_sha256")) for role in roles}
    return IndexEntry(category=Category(keys.pop("category")), files=files, **keys)


def index_lines(dataset: Dataset, completion: Completion, jobs: Iterable[Job]) -> Iterator[tuple[Job, bytes]]:
    """Yield the lines of done images. Those that the present index has, of unchanged manifests, are taken from there.

    Args:
        dataset: the dataset.
        completion: its done jobs, as an audit found them.
        jobs: some of them, by category in order and then by index; one whose manifest is gone meanwhile is left out.

    Raises:
        DestinationError: if the folder can't be read.
    """
    present = PresentIndex(dataset, completion.memory)

    def line_of(found: tuple[Job, bytes | None]) -> tuple[Job, bytes | None]:
        job, line = found
        if line is None:
            receipt = _read(dataset, job, parse_receipt)
            line = None if receipt is None else index_line(index_entry(dataset, job, receipt))
        return job, line

    for job, line in in_order(line_of, ((job, present.line(job)) for job in jobs)):
        if line is not None:
            yield job, line


class PresentIndex:
    """The lines of the index that is there, in its order; of one that is not as it was written, none.

    Args:
        dataset: the dataset.
        memory: knows the checksum of the index, and the jobs whose manifest has not changed since it was written.
    """

    def __init__(self, dataset: Dataset, memory: Memory) -> None:
        self._memory = memory
        wanted = memory.index_sha256
        self._lines = _lines(dataset) if wanted is not None and wanted == _checksum(dataset) else iter(())
        self._job_id, self._line = self._next()

    def _next(self) -> tuple[str, bytes]:
        try:
            line = next(self._lines, b"")
        except (FileNotFoundError, DestinationError):
            line = b""  # replaced or removed since; the manifests have it all
        return line[len(_LINE_START) :].partition(b'"')[0].decode(), line

    def line(self, job: Job) -> bytes | None:
        """Return a job's line, or None; jobs must be asked for in the index's order, which may leave some out."""
        if not self._memory.rows[job.category]["state"][job.index] & LISTED:
            return None
        while self._line and self._job_id != job.id:
            self._job_id, self._line = self._next()
        return self._line or None


def _checksum(dataset: Dataset) -> str | None:
    digest = hashlib.sha256()
    try:
        for part in read_parts(dataset.storage, INDEX_FILE):
            digest.update(part)
    except (FileNotFoundError, DestinationError):
        return None
    return digest.hexdigest()


def _lines(dataset: Dataset) -> Iterator[bytes]:
    rest = b""
    for part in read_parts(dataset.storage, INDEX_FILE):
        lines = (rest + part).splitlines(keepends=True)
        rest = lines.pop() if lines and not lines[-1].endswith(b"\n") else b""
        yield from lines


def write_index(dataset: Dataset) -> int:
    """Write `index.jsonl`.

    Returns:
        Number of images that it lists.

    Raises:
        DestinationError: if the folder can't be read or written.
    """
    completion = Completion(dataset)
    completion.audit()
    return len(write_index_of(dataset, completion))


def write_index_of(
    dataset: Dataset, completion: Completion, on_line: Callable[[Job, bytes], None] = lambda *_: None
) -> JobSet:
    """Write `index.jsonl`.

    Args:
        dataset: the dataset.
        completion: its done jobs, as an audit found them.
        on_line: told each job that is listed, with its line.

    Returns:
        The jobs that it lists.

    Raises:
        DestinationError: if the folder can't be read or written.
    """
    listed = JobSet(dataset.header.spec.quotas)
    digest = hashlib.sha256()

    def parts() -> Iterator[bytes]:
        batch: list[bytes] = []
        for job, line in index_lines(dataset, completion, completion.done.by_category()):
            listed.add(job)
            on_line(job, line)
            digest.update(line)
            batch.append(line)
            if len(batch) >= _BATCH:
                yield b"".join(batch)
                batch.clear()
        yield b"".join(batch)

    write_parts(dataset.storage, INDEX_FILE, parts())
    completion.memory.set_listed(listed.members(), digest.hexdigest())
    completion.save()
    return listed
