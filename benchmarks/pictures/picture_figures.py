"""The figures of one picture: its light, cables and clutter as a network sees them."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from benchmarks.pictures.cable_figures import crossings, median_width_px

_CLEARANCE = 0.02
"""Distance from a cable, as a share of the picture's edge, within which the background isn't searched for edges, since
the cable's own outline lies there."""

_CANNY = (50.0, 150.0)
"""Least gradients, in grey levels times four, at which an edge continues and at which one begins."""


@dataclass(frozen=True, slots=True)
class PictureFigures:
    """The figures of one picture.

    Attributes:
        coverage: share of pixels that show a cable.
        grey_level: mean of the grey levels, 0 to 255.
        grey_deviation: standard deviation of the grey levels.
        width_px: median width of the cables; NaN if none is visible.
        crossings: number of times that a cable visibly lies across another.
        background_edges: share of the background's pixels that are edges; NaN if cables fill the picture.
    """

    coverage: float
    grey_level: float
    grey_deviation: float
    width_px: float
    crossings: float
    background_edges: float


def measure(picture: NDArray[np.uint8], mask: NDArray[np.uint8], instances: NDArray[np.uint16]) -> PictureFigures:
    """Measure a picture.

    Args:
        picture: RGB picture, (H, W, 3).
        mask: mask of the cables, (H, W), 0 or 255.
        instances: number of the cable at each pixel, 0 without one, (H, W).
    """
    grey = cv2.cvtColor(picture, cv2.COLOR_RGB2GRAY).astype(np.uint8)
    return PictureFigures(
        coverage=float(np.mean(mask > 0)),
        grey_level=float(grey.mean()),
        grey_deviation=float(grey.std()),
        width_px=median_width_px(instances),
        crossings=float(crossings(instances)),
        background_edges=background_edges(grey, mask),
    )


def background_edges(grey: NDArray[np.uint8], mask: NDArray[np.uint8]) -> float:
    """Share of the pixels well away from cables that are edges (Canny's, after a Gaussian blur of one pixel).

    Args:
        grey: grey levels, (H, W).
        mask: mask of the cables, (H, W), 0 without a cable.

    Returns:
        0 to 1; NaN if no pixel is away from cables.
    """
    clearance_px = max(1, round(_CLEARANCE * max(grey.shape)))
    disc = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * clearance_px + 1, 2 * clearance_px + 1))
    background = cv2.dilate(mask, disc) == 0
    edges = cv2.Canny(cv2.GaussianBlur(grey, (0, 0), 1.0), *_CANNY) > 0
    return float(edges[background].mean()) if background.any() else float("nan")
