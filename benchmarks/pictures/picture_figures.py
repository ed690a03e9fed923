"""The figures of one picture: what a network sees of light, colour, cables and clutter."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from benchmarks.pictures.cable_figures import crossings, median_width_px

_CLEARANCE = 0.02
"""Of the picture's edge: so near to a cable, the background is not looked at, as the cable's own outline is there."""

_CANNY = (50.0, 150.0)
"""Gradients, in grey levels times four, at which an edge goes on and begins."""


@dataclass(frozen=True, slots=True)
class PictureFigures:
    """One picture, measured.

    Attributes:
        coverage: share of pixels that show a cable.
        grey_level: mean of the grey levels, 0 to 255.
        grey_deviation: their standard deviation.
        width_px: median width of the cables; NaN if none is seen.
        crossings: how many times a cable is seen to lie across another.
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
        picture: (H, W, 3), RGB.
        mask: (H, W), 0 or 255.
        instances: (H, W), 0 where no cable is seen, else its number.
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
        grey: (H, W).
        mask: (H, W), 0 where no cable is.

    Returns:
        0 to 1; NaN if no pixel is away from cables.
    """
    clearance_px = max(1, round(_CLEARANCE * max(grey.shape)))
    disc = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * clearance_px + 1, 2 * clearance_px + 1))
    background = cv2.dilate(mask, disc) == 0
    edges = cv2.Canny(cv2.GaussianBlur(grey, (0, 0), 1.0), *_CANNY) > 0
    return float(edges[background].mean()) if background.any() else float("nan")
