"""Masks from the geometry itself: the silhouettes of the rendered tubes, drawn in order of height. Pure numpy.

The camera is taken as a pinhole in the middle of the lens. Opposite points of the lens see an edge moved to opposite
sides by the same, so that depth of field leaves its half-way line, and with it the mask, where the pinhole sees it.
What is left out: blur fills narrow gaps, of a pixel or so, between cables well above the floor, where the focus is.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from worker.coverage import cover
from worker.shapes import Points
from worker.silhouette import silhouettes
from worker.view import View


@dataclass(frozen=True, slots=True)
class Labels:
    """Labels of one picture.

    Attributes:
        mask: (H, W) uint8: 255 where cables cover at least half of the pixel, else 0.
        instances: (H, W) uint16: in the mask, 1 + the number of the cable that covers most of it; else 0.
    """

    mask: NDArray[np.uint8]
    instances: NDArray[np.uint16]


def label_cables(curves: Sequence[Points], radii_m: NDArray[np.float64], view: View, sides: int) -> Labels:
    """Label a picture.

    Args:
        curves: finely sampled centrelines (N, 3), metres.
        radii_m: (cables,), radius of each.
        view: the camera.
        sides: corners of the rendered tubes' cross-section, an even number; 20 are up to 0.6 % wider or narrower than
            a circle.

    Returns:
        The binary mask and the instances.
    """
    seen = silhouettes(curves, radii_m, view, sides)
    instances = np.zeros((view.resolution, view.resolution), np.uint16)
    for rows, quads, cables in seen.bands(view):
        instances[rows] = cover(quads, cables + 1, rows.stop - rows.start, view.resolution)
    return Labels(mask=(instances > 0) * np.uint8(255), instances=instances)
