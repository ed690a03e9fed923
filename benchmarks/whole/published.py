"""Make a picture as the published method does: eight cloths, Blender's own sampling, a second render for the mask."""

from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from benchmarks.masks.white_on_black import white_on_black
from benchmarks.physics.published_cloth import drop_cables
from benchmarks.render.stage_set import SettledScene, Stage
from benchmarks.whole.renderings import BLENDER, set_picture
from benchmarks.whole.rows import STAGES, Shot
from benchmarks.whole.writing import write_files
from farm.errors import VerificationError
from farm.spec.header import DatasetHeader
from farm.spec.job import Job
from worker.blender.render import render_picture
from worker.label.label import label_scene
from worker.sample.scene import sample_scene
from worker.simulate.settle import first_accepted
from worker.stopwatch import Stopwatch

LEAST_AGREEMENT = 0.9
"""Least share of the rendered mask near the cables, and of the cables' insides in the rendered mask."""


def make_published(stage: Stage, header: DatasetHeader, job: Job, folder: Path) -> Shot:
    """Make the picture of a job's scene, and its mask.

    Nothing is checked between the fall and the picture. If a fall diverges, the scene is drawn again, and the seconds
    of both count.

    Args:
        stage: the open renderer.
        header: header that names the assets.
        job: job whose scene is drawn.
        folder: destination of the picture and the mask.

    Raises:
        SceneError: if the fall of every drawn scene diverged.
        VerificationError: if the mask doesn't fit the picture's cables.
        RenderError: if Blender makes no picture.
    """
    watch = Stopwatch()
    settled = _settle(header, job, watch)
    with watch.stage("realize"):
        set_picture(stage, settled, BLENDER)
    with watch.stage("render"):
        picture = stage.render()
    with watch.stage("mask"):
        mask = render_mask()
    with watch.stage("write"):
        write_files(folder, image=picture, mask=mask)
    verify_mask(mask, settled)
    # The published method has no check, so that stage counts 0 s.
    return Shot(job, {stage: watch.stages_s.get(stage, 0.0) for stage in STAGES})


def _settle(header: DatasetHeader, job: Job, watch: Stopwatch) -> SettledScene:
    def attempt(number: int) -> SettledScene:
        with watch.stage("randomize"):
            scene = sample_scene(header, job, number)
        with watch.stage("simulate"):
            return SettledScene(job, scene, drop_cables(scene, header.spec.fall.cloth))

    settled, _ = first_accepted(job, attempt, header.spec.fall.max_attempts)
    return settled


def render_mask() -> NDArray[np.uint8]:
    """Render the built scene with white cables on black, at its own sampling, and threshold it: (H, W), 0 or 255.

    Raises:
        RenderError: if Blender makes no picture.
    """
    with white_on_black():
        grey = cv2.cvtColor(render_picture(), cv2.COLOR_RGB2GRAY)
    mask: NDArray[np.uint8] = np.where(grey >= 128, 255, 0).astype(np.uint8)
    return mask


def verify_mask(mask: NDArray[np.uint8], settled: SettledScene) -> None:
    """Compare a rendered mask (H, W) with the one from geometry.

    Raises:
        VerificationError: if they show different cables.
    """
    drawn = label_scene(settled.geometry(BLENDER.settings.detail, len(mask))).mask
    # Cables of a pixel or two, in small pictures, are lost in the filter of the render: they have no inside.
    inside, near = cv2.erode(drawn, np.ones((3, 3), np.uint8)), cv2.dilate(drawn, np.ones((5, 5), np.uint8))
    agreement = min(_share_within(inside, mask), _share_within(mask, near))
    if agreement < LEAST_AGREEMENT:
        raise VerificationError(
            f"{settled.job.id}: the rendered mask agrees to {agreement:.0%} with the cables it shows"
        )


def _share_within(part: NDArray[Any], whole: NDArray[Any]) -> float:
    """Share of one mask's pixels that are in another, (H, W) each; 1 if the first is empty."""
    pixels = np.count_nonzero(part)
    return np.count_nonzero((part > 0) & (whole > 0)) / pixels if pixels else 1.0
