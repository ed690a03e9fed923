"""Make the farm's own pictures as a worker does, write them and verify them."""

import resource
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from benchmarks.render.stage_set import SettledScene
from benchmarks.whole.rows import STAGES, Row, Shot, Way
from farm.dataset.dataset import Dataset
from farm.dataset.manifest import parse_manifest
from farm.dataset.outputs import IMAGE
from farm.dataset.paths import file_path, manifest_path
from farm.dataset.verify import verify
from farm.errors import VerificationError
from farm.run.worker_settings import DeviceChoice, RendererSettings
from farm.spec.job import Job
from worker.blender.renderer import open_renderer
from worker.service.upload import upload
from worker.simulate.simulate import simulate

_BYTES_PER_UNIT = 1 if sys.platform == "darwin" else 1024
"""Unit in which the kernel tells a process's peak memory."""


_WARM_UP = 1_000_000
"""Index of a scene that no benchmark uses, made first to load everything."""


@dataclass(frozen=True, slots=True)
class Standard:
    """The standard pictures.

    Attributes:
        row: the pictures.
        open_s: seconds to open the template, once per process.
        peak_mib: peak resident memory of this process when they were finished, MiB.
    """

    row: Row
    open_s: float
    peak_mib: float


def make_standard(dataset: Dataset, jobs: Sequence[Job], on_image: Callable[[], None] = lambda: None) -> Standard:
    """Make the pictures of all jobs of a dataset with all cores, and check the written dataset.

    A picture of another scene is made first and doesn't count, since it loads the solver and the renderer's kernels.

    Raises:
        VerificationError: if the dataset fails verification.
        FarmError: if an image can't be made.
    """
    start = time.perf_counter()
    renderer = open_renderer(dataset.header, RendererSettings(device=DeviceChoice.CPU))
    open_s = time.perf_counter() - start
    renderer.make(Job(category=jobs[0].category, index=_WARM_UP), dataset.header)
    shots = []
    for job in jobs:
        timings = upload(renderer.make(job, dataset.header), job, dataset).timings_s
        shots.append(Shot(job, {stage: timings.get(stage, 0.0) for stage in STAGES}))
        on_image()
    peak_mib = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * _BYTES_PER_UNIT / 2**20
    verdict = verify(dataset)
    if not verdict.clean:
        raise VerificationError(f"the benchmark's own images do not verify: {verdict.findings[0]}")
    return Standard(Row(Way.STANDARD, tuple(shots)), open_s, peak_mib)


def settled_again(dataset: Dataset, job: Job) -> SettledScene:
    """The scene of a finished picture, from its manifest, and its cables at rest, since falls repeat to the bit.

    Raises:
        VerificationError: if the picture's manifest can't be read.
    """
    manifest = parse_manifest(dataset.storage.read(manifest_path(job)), dataset, job)
    if manifest is None:
        raise VerificationError(f"{job.id}: its manifest is not readable")
    spec = dataset.header.spec
    return SettledScene(job, manifest.scene, simulate(manifest.scene, spec.simulator, spec.fall))


def written_picture(dataset: Dataset, job: Job) -> NDArray[np.uint8]:
    """A picture that was made, (H, W, 3)."""
    content = np.frombuffer(dataset.storage.read(file_path(job, IMAGE)), np.uint8)
    picture: NDArray[np.uint8] = np.ascontiguousarray(cv2.imdecode(content, cv2.IMREAD_COLOR)[:, :, ::-1])
    return picture


def start_up_s() -> float:
    """Median seconds from the start of a process until Blender and the worker's stages are loaded in it."""
    command = [sys.executable, "-c", "import os, worker.blender.renderer; os._exit(0)"]
    seconds = []
    for _ in range(3):
        start = time.perf_counter()
        subprocess.run(command, check=True, capture_output=True)  # noqa: S603  # our own program
        seconds.append(time.perf_counter() - start)
    return float(np.median(seconds))
