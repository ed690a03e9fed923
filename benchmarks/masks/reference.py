"""The mask as the published method makes it: cables emit white, all else is black, rendered by Cycles."""

import cv2
import numpy as np
from numpy.typing import NDArray

from benchmarks.masks.white_on_black import white_on_black
from farm.scene.camera import Camera
from worker.blender.render import render_picture

SAMPLES = 1024

_SAME_SO_FAR = 128
"""Samples after which Cycles leaves a pixel that is all black or all white, with all around it: most of the picture."""


def render_coverage(camera: Camera, samples: int = SAMPLES) -> NDArray[np.float64]:
    """Render the cables of the built scene white on black.

    The lens is the picture's, depth of field included. The floor, the lamps and the world are left out, which changes
    the open scene: build it again before another picture.

    Args:
        camera: the built scene's camera; Blender knows all of it but the distortion.
        samples: Cycles samples a pixel.

    Returns:
        (H, W) coverage by cables, 0 to 1, as filtered by Cycles' pixel filter.

    Raises:
        RenderError: if Blender gives no picture.
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
