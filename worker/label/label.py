"""Masks from the geometry itself: the silhouettes of the rendered tubes, drawn from far to near. Pure numpy.

The camera is taken as a pinhole in the middle of the lens. Opposite points of the lens see an edge moved by the
same distance to opposite sides, so depth of field leaves its half-way line, and with it the mask, where the pinhole
sees it. One effect is left out: between cables well above the floor, which is in focus, blur fills gaps of about a
pixel.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from farm.dataset.outputs import INSTANCES, MASK
from worker.cable.piece import Piece
from worker.camera.view import View
from worker.geometry import SettledGeometry
from worker.label.coverage import cover
from worker.label.occluders import hiding_pieces
from worker.label.silhouette import silhouettes


@dataclass(frozen=True, slots=True)
class Labels:
    """Labels of one picture.

    Attributes:
        mask: (H, W) uint8: 255 where what is seen of cables covers at least half of the pixel, else 0.
        instances: (H, W) uint16: in the mask, the instance that covers most of it; else 0.
    """

    mask: NDArray[np.uint8]
    instances: NDArray[np.uint16]


def make_mask_and_instances(geometry: SettledGeometry) -> Mapping[str, NDArray[np.uint8] | NDArray[np.uint16]]:
    """Make the mask and the instances of a picture; see `worker.label.makers.Maker`."""
    labels = label_scene(geometry)
    return {MASK.role: labels.mask, INSTANCES.role: labels.instances}


def label_scene(geometry: SettledGeometry) -> Labels:
    """Label a settled scene's cables as they are rendered."""
    pieces = [*geometry.pieces, *hiding_pieces(geometry)]
    return label_cables(pieces, geometry.view, geometry.detail.sides)


def label_cables(pieces: Sequence[Piece], view: View, sides: int) -> Labels:
    """Label a picture.

    Args:
        pieces: the cables in pieces, and what hides them.
        view: the camera.
        sides: corners of the rendered tubes' cross-section, an even number; 20 are up to 0.6 % wider or narrower than
            a circle.

    Returns:
        The binary mask and the instances.
    """
    seen = silhouettes(pieces, view, sides)
    labels = np.zeros(view.resolution.shape, np.uint16)
    for rows, quads, instances in seen.bands(view):
        labels[rows] = cover(quads, instances, rows.stop - rows.start, view.resolution.width)
    return Labels(mask=(labels > 0) * np.uint8(255), instances=labels)
