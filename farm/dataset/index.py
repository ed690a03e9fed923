"""The index of a dataset: its done images in order, and the file `index.jsonl` with one line for each."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from typing import TypeVar

from pydantic import NonNegativeInt, SerializerFunctionWrapHandler, model_serializer

from farm.dataset.completion import Completion
from farm.dataset.dataset import Dataset
from farm.dataset.manifest import Manifest, Receipt, parse_manifest, parse_receipt
from farm.dataset.outputs import outputs_of
from farm.dataset.paths import INDEX_FILE, manifest_path
from farm.model import Model, Sha256
from farm.spec.category import Category
from farm.spec.job import Job

T = TypeVar("T")


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


def done_receipts(dataset: Dataset) -> Iterator[tuple[Job, Receipt]]:
    """Yield the done images with the receipts in their manifests, by category in order and then by index.

    Raises:
        DestinationError: if the folder can't be read.
    """
    return _parsed(dataset, parse_receipt)


def done_manifests(dataset: Dataset) -> Iterator[tuple[Job, Manifest]]:
    """Yield the done images with their manifests, in the same order, without those that only another release can read.

    Raises:
        DestinationError: if the folder can't be read.
    """
    return _parsed(dataset, parse_manifest)


def _parsed(dataset: Dataset, parse: Callable[[bytes, Dataset, Job], T | None]) -> Iterator[tuple[Job, T]]:
    order = {category: number for number, category in enumerate(Category)}
    for job in sorted(Completion(dataset).audit(), key=lambda job: (order[job.category], job.index)):
        # It may be taken away meanwhile, as damaged.
        with suppress(FileNotFoundError):
            parsed = parse(dataset.storage.read(manifest_path(job)), dataset, job)
            if parsed is not None:
                yield job, parsed


def index_entry(dataset: Dataset, job: Job, receipt: Receipt) -> IndexEntry:
    """Make the index entry of one image of a dataset, whichever release made it."""
    scene = receipt.scene
    # Release 0.1.0 first had one lamp, then a list of lamps.
    lamps = [scene["lamp"]] if scene.get("lamp") else scene.get("lamps") or ()
    records = {output.role: receipt.files[output.folder] for output in outputs_of(dataset.header.spec)}
    return IndexEntry(
        job_id=job.id,
        category=job.category,
        index=job.index,
        seed=receipt.seed,
        files={role: IndexedFile(path=record.path, sha256=record.sha256) for role, record in records.items()},
        attempt=scene["attempt"],
        cables=len(scene["cables"]),
        surface=scene["floor"]["texture"] if scene.get("floor") else None,
        hdri=scene["hdri_world"]["hdri"] if scene.get("hdri_world") else None,
        lamp=lamps[0]["kind"] if lamps else None,
        camera_height_m=scene["camera"]["height_m"],
        visible_instances=None if receipt.instances is None else len(receipt.instances),
    )


def write_index(dataset: Dataset) -> int:
    """Write `index.jsonl`.

    Returns:
        Number of images that it lists.

    Raises:
        DestinationError: if the folder can't be read or written.
    """
    lines = [index_entry(dataset, job, receipt).model_dump_json() + "\n" for job, receipt in done_receipts(dataset)]
    dataset.storage.write(INDEX_FILE, "".join(lines).encode())
    return len(lines)
