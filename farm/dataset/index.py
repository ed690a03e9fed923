"""Gathers what the manifests tell: the done images in order, and `index.jsonl`, one line for each."""

from collections.abc import Iterator
from contextlib import suppress

from pydantic import NonNegativeInt

from farm.dataset.completion import Completion, parse_manifest
from farm.dataset.dataset import Dataset
from farm.dataset.manifest import Manifest
from farm.dataset.paths import INDEX_FILE, FileRole, manifest_path
from farm.model import Model, Sha256
from farm.spec.category import Category
from farm.spec.job import Job


class IndexEntry(Model):
    """One image in the index. It tells nothing that changes from one making of the image to the next."""

    job_id: str
    category: Category
    index: NonNegativeInt
    seed: NonNegativeInt
    image: str
    mask: str
    instances: str
    image_sha256: Sha256
    mask_sha256: Sha256
    instances_sha256: Sha256
    attempt: NonNegativeInt
    cables: NonNegativeInt
    surface: str | None
    hdri: str | None
    lamp: str | None
    camera_height_m: float


def done_manifests(dataset: Dataset) -> Iterator[tuple[Job, Manifest]]:
    """The done images, by category in order and then by index.

    Raises:
        DestinationError: if the folder can't be read.
    """
    order = {category: number for number, category in enumerate(Category)}
    for job in sorted(Completion(dataset).audit(), key=lambda job: (order[job.category], job.index)):
        # It may be taken away meanwhile, as damaged.
        with suppress(FileNotFoundError):
            manifest = parse_manifest(dataset.storage.read(manifest_path(job)), dataset, job)
            if manifest is not None:
                yield job, manifest


def index_entry(job: Job, manifest: Manifest) -> IndexEntry:
    """The line of one image."""
    scene, files = manifest.scene, manifest.files
    return IndexEntry(
        job_id=job.id,
        category=job.category,
        index=job.index,
        seed=manifest.seed,
        image=files[FileRole.IMAGE].path,
        mask=files[FileRole.MASK].path,
        instances=files[FileRole.INSTANCES].path,
        image_sha256=files[FileRole.IMAGE].sha256,
        mask_sha256=files[FileRole.MASK].sha256,
        instances_sha256=files[FileRole.INSTANCES].sha256,
        attempt=scene.attempt,
        cables=len(scene.cables),
        surface=scene.floor.texture if scene.floor else None,
        hdri=scene.hdri_world.hdri if scene.hdri_world else None,
        lamp=scene.lamps[0].kind if scene.lamps else None,
        camera_height_m=scene.camera.height_m,
    )


def write_index(dataset: Dataset) -> int:
    """Write `index.jsonl`.

    Returns:
        How many images it lists.

    Raises:
        DestinationError: if the folder can't be read or written.
    """
    lines = [index_entry(job, manifest).model_dump_json() + "\n" for job, manifest in done_manifests(dataset)]
    dataset.storage.write(INDEX_FILE, "".join(lines).encode())
    return len(lines)
