"""Masks from geometry against white-on-black Cycles renders of the same scenes."""

import json
import time
from dataclasses import asdict
from pathlib import Path

from rich.progress import track

from benchmarks.bench_dataset import bench_header, bench_jobs
from benchmarks.masks.agreement import compare
from benchmarks.masks.reference import SAMPLES, render_coverage
from benchmarks.masks.results import LabelledImage, check, table, times
from benchmarks.terminal import bench_console, blender_writes_to
from farm.errors import VerificationError
from farm.run.worker_settings import DeviceChoice, RendererSettings
from farm.scene.picture_size import PictureSize
from farm.scene.scene import Scene
from farm.spec.category import Category
from farm.spec.header import DatasetHeader
from worker.blender.renderer import open_renderer
from worker.camera.view import View
from worker.geometry import SettledGeometry
from worker.label.label import label_scene
from worker.service.picture import Picture
from worker.simulate.simulate import simulate

DEFAULT_IMAGES = 2
"""Images of each category unless the command line says otherwise."""
REPEATS = 5
"""Times that a scene's labelling is timed; the fastest counts, since other processes only ever slow it down."""


def run(out: Path, *, images: int | None, seed: int) -> int:
    """Compare, print the table, write `masks.json` into `out`.

    Args:
        out: an existing folder.
        images: number of images of each category; `DEFAULT_IMAGES` if None.
        seed: seed of the dataset.

    Raises:
        VerificationError: if a mask doesn't fit its picture.
        FarmError: if an image can't be made.
    """
    count = images or DEFAULT_IMAGES
    header = bench_header(count, seed, quality="draft")
    found: list[LabelledImage] = []
    console = bench_console()
    log_file = out / "masks.log"
    with blender_writes_to(log_file):
        renderer = open_renderer(header, RendererSettings(device=DeviceChoice.CPU))
    for job in track(bench_jobs(count), "images", console=console, transient=True):
        with blender_writes_to(log_file):
            made = renderer.make(job, header)
            agreement = compare(made.files["instances"], render_coverage(made.scene.camera))
            label_ms = _label_again(made, job.category, header)
        width_px = _thinnest_px(made.scene, header.spec.resolution)
        found.append(LabelledImage(job.category, width_px, label_ms, agreement))
    console.print(table(found, f"masks against Cycles renders of {SAMPLES} samples"))
    console.print(times(found))
    content = {category: [_entry(image) for image in found if image.category is category] for category in Category}
    (out / "masks.json").write_text(json.dumps(content, indent=1) + "\n")
    check(found)
    return 0


def _label_again(made: Picture, category: Category, header: DatasetHeader) -> float:
    """Label a picture's scene again: milliseconds of CPU, the least of `REPEATS`, since other processes only ever add.

    Raises:
        VerificationError: if the labels differ from the picture's own.
    """
    shapes = simulate(made.scene, header.spec.simulator, header.spec.fall)
    detail = header.rendering[category].settings.detail
    taken_s = []
    for _ in range(REPEATS):
        start = time.thread_time()
        # Each has a geometry of its own, so that none finds anything derived already.
        labels = label_scene(SettledGeometry(made.scene, shapes, detail, header.spec.resolution))
        taken_s.append(time.thread_time() - start)
        for role, pixels in (("mask", labels.mask), ("instances", labels.instances)):
            if pixels.tobytes() != made.files[role].tobytes():
                raise VerificationError("the same scene was labelled differently a second time")
    return 1e3 * min(taken_s)


def _thinnest_px(scene: Scene, resolution: PictureSize) -> float:
    """Width in pixels of the scene's thinnest cable where it lies on the floor."""
    diameter_m = min(cable.diameter_m for cable in scene.cables)
    return diameter_m * View.of(scene.camera, resolution).pixels_per_m


def _entry(image: LabelledImage) -> dict[str, float]:
    return {"width_px": image.width_px, "label_ms": image.label_ms, **asdict(image.agreement)}
