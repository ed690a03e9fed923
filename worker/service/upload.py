"""Writing a made picture into its dataset: image, mask, instances, and the manifest last."""

import hashlib
import time
from typing import Protocol

import cv2
import numpy as np
from numpy.typing import NDArray

from farm.dataset.completion import is_done
from farm.dataset.dataset import Dataset
from farm.dataset.manifest import FileRecord, Manifest
from farm.dataset.paths import FileRole, file_path, manifest_path
from farm.errors import BrokerError, RenderError
from farm.spec.job import Job
from worker.service.lease import LeaseLostError
from worker.service.picture import Picture

Pixels = NDArray[np.uint8] | NDArray[np.uint16]

_COMPRESSION = [cv2.IMWRITE_PNG_COMPRESSION, 1, cv2.IMWRITE_PNG_STRATEGY, cv2.IMWRITE_PNG_STRATEGY_RLE]
"""A quarter of the time of zlib's level 6 for rendered pictures, and within 5 % of its size."""


def encode_png(pixels: Pixels) -> bytes:
    """A PNG of the pixels; the same pixels give the same bytes.

    Args:
        pixels: (H, W) of 8 or 16 bits, or (H, W, 3) of 8 bits, red first.

    Raises:
        RenderError: if they can't be encoded.
    """
    ordered = pixels[:, :, ::-1] if pixels.ndim == 3 else pixels  # OpenCV has blue first
    encoded, data = cv2.imencode(".png", np.ascontiguousarray(ordered), _COMPRESSION)
    if not encoded:
        raise RenderError(f"can't encode a picture of shape {pixels.shape} and type {pixels.dtype}")
    return data.tobytes()


def _check(made: Picture) -> None:
    shape = made.mask.shape
    if made.image.shape != (*shape, 3) or made.instances.shape != shape:
        raise RenderError(f"image {made.image.shape}, mask {shape} and instances {made.instances.shape} differ in size")
    types = (made.image.dtype, made.mask.dtype, made.instances.dtype)
    if types != (np.dtype(np.uint8), np.dtype(np.uint8), np.dtype(np.uint16)):
        raise RenderError(f"image, mask and instances have types {types}, not 8, 8 and 16 bits")
    if not np.array_equal(made.mask, np.where(made.instances > 0, 255, 0)):
        raise RenderError("mask and instances do not cover the same pixels")


class Guard(Protocol):
    """Tells whether the job may still be written; see `worker.service.lease.Lease`."""

    def renew(self) -> None:
        """Ask whoever knows; raises LeaseLostError or BrokerError."""
        ...

    def check(self) -> None:
        """Ask no one; raises LeaseLostError."""
        ...


class Unguarded:
    """For a writer that has the dataset to itself."""

    def renew(self) -> None:
        """Nothing to ask."""

    def check(self) -> None:
        """Nothing to check."""


def upload(made: Picture, job: Job, dataset: Dataset, guard: Guard | None = None) -> Manifest:
    """Write the files, then the manifest that vouches for them.

    Returns:
        The manifest; its timings have the seconds of this stage as `write`.

    Raises:
        RenderError: if the picture and its labels don't fit each other.
        DestinationError: if a file can't be written.
        LeaseLostError: if the guard finds that another may be writing; then what is in place is whole, or has no
            manifest.
        BrokerError: if the guard can't find out; likewise.
    """
    _check(made)
    guard = guard or Unguarded()
    guard.renew()
    try:
        return _write(made, job, dataset, guard)
    except (LeaseLostError, BrokerError):
        # The process may have been stopped between a check and its write, which then may have met another's files.
        if not is_done(dataset, job):
            dataset.storage.remove(manifest_path(job))
        raise


def _write(made: Picture, job: Job, dataset: Dataset, guard: Guard) -> Manifest:
    start = time.perf_counter()
    pixels: dict[FileRole, Pixels] = {
        FileRole.IMAGE: made.image,
        FileRole.MASK: made.mask,
        FileRole.INSTANCES: made.instances,
    }
    files = {}
    for role, array in pixels.items():
        content = encode_png(array)
        path = file_path(job, role)
        guard.check()
        dataset.storage.write(path, content)
        files[role] = FileRecord(path=path, bytes=len(content), sha256=hashlib.sha256(content).hexdigest())
    manifest = Manifest(
        dataset=dataset.name,
        spec_sha256=dataset.header.spec_sha256,
        job_id=job.id,
        seed=dataset.header.spec.seed,
        scene=made.scene,
        settled=made.settled,
        rejected=made.rejected,
        render=made.render,
        timings_s={**made.timings_s, "write": time.perf_counter() - start},
        versions=made.versions,
        files=files,
    )
    guard.renew()
    dataset.storage.write(manifest_path(job), manifest.model_dump_json(indent=1).encode() + b"\n")
    guard.check()
    return manifest
