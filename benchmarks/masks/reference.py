"""The mask that the published method makes: a Cycles render in which cables emit white and all else is black."""

import cv2
import numpy as np
from numpy.typing import NDArray

from benchmarks.masks.white_on_black import white_on_black
from farm.scene.camera import Camera
from worker.blender.render import render_picture

SAMPLES = 1024
"""Samples per pixel of a reference: its noise is then far below the half level at which masks are compared."""

_SAME_SO_FAR = 128
"""Samples per pixel after which Cycles stops where all samples agree, as they do in most of the picture."""


def render_coverage(camera: Camera, samples: int = SAMPLES) -> NDArray[np.float64]:
    """Render the cables of the built scene white on black.

    The lens is the picture's, depth of field included. The floor, the lamps and the world are left out, which changes
    the open scene: build it again before another picture.

    Args:
        camera: the built scene's camera; Blender knows all of it but the distortion.
        samples: Cycles samples a pixel.

    Returns:
        Coverage by cables, (H, W), 0 to 1, as Cycles' pixel filter gives it.

    Raises:
        RenderError: if Blender makes no picture.
    """
    with white_on_black() as scene:
        scene.cycles.samples = samples
        scene.cycles.use_adaptive_sampling = True
        scene.cycles.adaptive_min_samples = min(_SAME_SO_FAR, samples)
        scene.cycles.adaptive_threshold = 1e-4
        scene.cycles.max_bounces = 0
        scene.cycles.use_denoising = False
        grey = cv2.cvtColor(render_picture(distortion=camera.distortion), cv2.COLOR_RGB2GRAY)
    coverage: NDArray[np.float64] = grey / 255.0
    return coverage
