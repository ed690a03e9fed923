"""How much of each pixel cables cover, and laying them over what is behind them. Numpy and OpenCV.

Cycles counts a pixel's coverage in samples and denoises colours alone: with few samples edges are ragged. From the
geometry it is exact.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from worker.backdrop.panorama import Panorama
from worker.cable.piece import Piece
from worker.camera.view import View
from worker.label.coverage import covered_share
from worker.label.silhouette import silhouettes

_RING_PX = 0.75
"""Between places on the lens, by how far apart what is most out of focus is seen from them: below a pixel, which is
what each of them blurs it by."""

_MOST_RINGS = 4
"""61 places: seen from any side, no two of them lie in line, and steps between them are a few percent."""

_SPREAD_PX = 0.8
"""Standard deviation of the Gaussian that carries cables' colours to their edges, for which few samples were taken."""

_NO_COVER = 1e-3


@dataclass(frozen=True, slots=True)
class Backdrop:
    """What is behind all that is rendered.

    Attributes:
        light: (H, W, 3), linear.
        covered: (H, W), how much of each pixel cables cover, 0 to 1.
    """

    light: Panorama
    covered: NDArray[np.float32]


def covered_by(pieces: Sequence[Piece], view: View, lens_radius_m: float, sides: int) -> NDArray[np.float32]:
    """How much of each pixel cables and what is on them cover, seen through a lens.

    It is the mean over places spread evenly over the lens, each of which sees as a pinhole does; so many of them that
    no edge shows twice.

    Args:
        pieces: all that is rendered.
        view: the camera.
        lens_radius_m: half the width of its aperture.
        sides: corners of the rendered tubes' cross-section.

    Returns:
        (H, W), 0 to 1.
    """
    highest = max(piece.top_m for piece in pieces)
    places = list(_on_disc(min(_MOST_RINGS, round(lens_radius_m * _blur_px_per_m(view, highest) / _RING_PX))))
    covered = np.zeros((view.resolution, view.resolution), np.float32)
    for x, y in places:
        through = replace(view, pinhole_m=(lens_radius_m * x, lens_radius_m * y))
        for rows, quads, _ in silhouettes(pieces, through, sides).bands(through):
            covered[rows] += covered_share(quads, rows.stop - rows.start, view.resolution)
    covered /= np.float32(len(places))
    return covered


def _blur_px_per_m(view: View, highest_m: float) -> float:
    """Pixels by which a point that is most out of focus moves for each metre on the lens.

    Args:
        view: the camera.
        highest_m: of all points above the floor.
    """
    floor_m = view.depths_m(view.floor_corners_m())
    # Along a line of sight depth falls as height rises. A cable that reaches up to the camera has no picture.
    nearest_m = max(floor_m.min() * (1.0 - highest_m / view.position_m[2]), 1e-6)
    blur = max(view.focus_m / nearest_m - 1.0, 1.0 - view.focus_m / floor_m.max())
    return float(blur * view.focal_length_px / view.focus_m)


def _on_disc(rings: int) -> Iterator[tuple[float, float]]:
    """Places spread evenly over the unit disc: its middle, and rings of 6, 12, 18 and so on around it."""
    yield 0.0, 0.0
    for ring in range(1, rings + 1):
        for step in range(6 * ring):
            angle = 2 * math.pi * (step + 0.5 * (ring % 2)) / (6 * ring)
            yield ring / (rings + 0.5) * math.cos(angle), ring / (rings + 0.5) * math.sin(angle)


def lay_over(cables: NDArray[np.float32], backdrop: Backdrop) -> NDArray[np.float32]:
    """Lay rendered cables over what is behind them.

    Args:
        cables: (H, W, 3), linear light, black where no cable is, in mixed pixels by the share of what was sampled.
        backdrop: what is behind them.

    Returns:
        (H, W, 3), linear light. A pixel that cables cover in part takes their colour from around it, as their own
        light was found by no more samples than their share.
    """
    covered = backdrop.covered[:, :, None]
    near = cv2.GaussianBlur(cables, (0, 0), _SPREAD_PX)
    share = cv2.GaussianBlur(backdrop.covered, (0, 0), _SPREAD_PX)[:, :, None]
    colour = near / np.maximum(share, np.float32(_NO_COVER))
    laid: NDArray[np.float32] = np.where(covered < 1.0, covered * colour, cables) + (1.0 - covered) * backdrop.light
    return laid
