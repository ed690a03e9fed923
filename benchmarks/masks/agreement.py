"""How a mask agrees with a reference's coverage."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

PLAIN_ERROR_PX = 0.5
"""A pixel that differs and is farther than this from the reference's half-way line does so by more than rounding."""


@dataclass(frozen=True, slots=True)
class Agreement:
    """How a mask agrees with a reference.

    Attributes:
        iou: intersection over union with the reference, thresholded at a half.
        edge_error_px: how far the mask's edge lies from the reference's half-way line where it is farthest, near one
            cable alone.
        gap_error_px: the same between two cables, in whole pixels: the edge of the largest square of pixels that
            differ. A gap of about a pixel that one of mask and reference closes counts 1.
        gap_pixels: pixels between two cables, the gap between which is a pixel or two wide, that are farther off than
            `PLAIN_ERROR_PX`: one of mask and reference closes the gap there.
        area_ratio: area of the mask over the reference's coverage.
    """

    iou: float
    edge_error_px: float
    gap_error_px: int
    gap_pixels: int
    area_ratio: float


def compare(instances: NDArray[np.uint16], coverage: NDArray[np.float64]) -> Agreement:
    """Compare instances (H, W), whose mask is what is not 0, with a reference's coverage (H, W), 0 to 1.

    A pixel's middle lies |c - 1/2| / |grad c| from the reference's half-way line. Where mask and reference differ, the
    mask's edge is at least that far off. In a gap the gradient vanishes and says nothing, so pixels are counted there.
    """
    ours, theirs = instances > 0, coverage >= 0.5
    union = np.count_nonzero(ours | theirs)
    slope = np.hypot(*np.gradient(coverage))
    distance = np.abs(coverage - 0.5) / np.maximum(slope, 1e-6)
    errors = np.where(ours != theirs, distance, 0.0)
    between = _cables_nearby(instances) > 1
    in_gaps = between & (errors > PLAIN_ERROR_PX)
    return Agreement(
        iou=np.count_nonzero(ours & theirs) / union if union else 1.0,
        edge_error_px=float(errors[~between].max(initial=0.0)),
        gap_error_px=_largest_square(in_gaps),
        gap_pixels=int(np.count_nonzero(in_gaps)),
        area_ratio=float(ours.mean() / max(coverage.mean(), 1e-12)),
    )


def _cables_nearby(instances: NDArray[np.uint16]) -> NDArray[np.int64]:
    """How many cables are within two pixels of each pixel."""
    reach = np.ones((5, 5), np.uint8)
    nearby = [cv2.dilate((instances == number).astype(np.uint8), reach) for number in np.unique(instances) if number]
    return np.sum(nearby, axis=0, dtype=np.int64) if nearby else np.zeros(instances.shape, np.int64)


def _largest_square(pixels: NDArray[np.bool_]) -> int:
    """Edge of the largest square of set pixels."""
    left, edge = pixels.astype(np.uint8), 0
    while left.any():
        edge += 1
        # A square is one larger than those around its three neighbours, so each round takes one off every square.
        left = left[1:, 1:] & left[:-1, 1:] & left[1:, :-1] & left[:-1, :-1]
    return edge
