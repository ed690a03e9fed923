"""The share of each pixel that cables cover, and the use of it to lay them over a backdrop. Numpy and OpenCV.

Cycles counts a pixel's coverage in samples and denoises colours alone, so edges are ragged if samples are few. The
coverage here comes from the geometry and has no noise.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from worker.cable.piece import Piece
from worker.camera.lens import blur_px_per_m
from worker.camera.view import View
from worker.label.coverage import covered_share
from worker.label.silhouette import silhouettes

_RING_PX = 0.75
"""Distance between neighbouring places on the lens: the pixels by which their views of the blurriest point differ.

It is below 1, since each view blurs an edge by a pixel, so that no edge shows twice."""

_MOST_RINGS = 4
"""Most rings of places on the lens, 61 places in all: no two lie in line from any side, and steps are a few percent."""

_SPREAD_PX = 0.8
"""Standard deviation in pixels of the Gaussian that carries cables' colours to their edges, which few samples hit."""

_NO_COVER = 1e-3
"""Least share of a pixel by which colours are divided: where no cable is near, colour and share are both 0."""


@dataclass(frozen=True, slots=True)
class Matte:
    """A backdrop, and the share of each pixel in which cables hide it.

    Attributes:
        covered: (H, W), the share of each pixel that cables cover, 0 to 1.
        backdrop: (H, W, 3) of linear light behind the cables.
    """

    covered: NDArray[np.float32]
    backdrop: NDArray[np.float32]


def covered_by(pieces: Sequence[Piece], view: View, lens_radius_m: float, sides: int) -> NDArray[np.float32]:
    """Compute the share of each pixel that cables and their ties cover, seen through a lens.

    It is the mean over places spread evenly over the lens, each of which sees as a pinhole does; there are enough of
    them that no edge shows twice.

    Args:
        pieces: everything that is rendered.
        view: the camera.
        lens_radius_m: radius of the camera's aperture, in metres.
        sides: corners of the rendered tubes' cross-section.

    Returns:
        (H, W), 0 to 1.
    """
    highest = max((piece.top_m for piece in pieces), default=0.0)
    places = list(_on_disc(min(_MOST_RINGS, round(lens_radius_m * blur_px_per_m(view, highest) / _RING_PX))))
    covered = np.zeros(view.resolution.shape, np.float32)
    for x, y in places:
        through = replace(view, pinhole_m=(lens_radius_m * x, lens_radius_m * y))
        for rows, quads, _ in silhouettes(pieces, through, sides).bands(through):
            covered[rows] += covered_share(quads, rows.stop - rows.start, view.resolution.width)
    covered /= np.float32(len(places))
    return covered


def _on_disc(rings: int) -> Iterator[tuple[float, float]]:
    """Places spread evenly over the unit disc: its middle, and rings of 6, 12, 18 and so on around it."""
    yield 0.0, 0.0
    for ring in range(1, rings + 1):
        for step in range(6 * ring):
            angle = 2 * math.pi * (step + 0.5 * (ring % 2)) / (6 * ring)
            yield ring / (rings + 0.5) * math.cos(angle), ring / (rings + 0.5) * math.sin(angle)


def lay_over(cables: NDArray[np.float32], matte: Matte) -> NDArray[np.float32]:
    """Lay rendered cables over their backdrop.

    Args:
        cables: (H, W, 3) of linear light, black where no cable is; a pixel that cables cover in part has the light of
            the samples that hit them.
        matte: the backdrop, and the share of each pixel that hides it.

    Returns:
        (H, W, 3) of linear light. A pixel that cables cover in part takes their colour from the pixels around it, since
        few of its own samples hit them.
    """
    covered = matte.covered[:, :, None]
    near = cv2.GaussianBlur(cables, (0, 0), _SPREAD_PX)
    share = cv2.GaussianBlur(matte.covered, (0, 0), _SPREAD_PX)[:, :, None]
    colour = near / np.maximum(share, np.float32(_NO_COVER))
    laid: NDArray[np.float32] = np.where(covered < 1.0, covered * colour, cables) + (1.0 - covered) * matte.backdrop
    return laid
