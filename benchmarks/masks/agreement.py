"""The agreement of a mask with a reference's coverage."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

PLAIN_ERROR_PX = 0.5
"""Distance, pixels, from the reference's half-way line beyond which a differing pixel is no mere rounding."""


@dataclass(frozen=True, slots=True)
class Agreement:
    """The agreement of a mask with a reference.

    Attributes:
        iou: intersection over union of the mask and the reference thresholded at a half.
        edge_error_px: largest distance of the mask's edge from the reference's half-way line, where only one cable
            is near.
        gap_error_px: error between two cables, in whole pixels: the edge of the largest square of differing pixels.
            A gap about one pixel wide that is closed in only one of mask and reference counts 1.
        gap_pixels: number of differing pixels between two cables that are farther than `PLAIN_ERROR_PX` from the
            half-way line: in narrow gaps that are closed in only one of mask and reference.
        area_ratio: area of the mask, relative to the reference's coverage.
    """

    iou: float
    edge_error_px: float
    gap_error_px: int
    gap_pixels: int
    area_ratio: float


def compare(instances: NDArray[np.uint16], coverage: NDArray[np.float64]) -> Agreement:
    """Compare a mask with a reference.

    A pixel's middle lies |c - 1/2| / |grad c| from the reference's half-way line. Where mask and reference differ, the
    mask's edge is at least that far off. In a gap the gradient vanishes, so the differing pixels are counted instead.

    Args:
        instances: the mask's instance map, (H, W); the mask is where it isn't 0.
        coverage: the reference's coverage c by cables, (H, W), 0 to 1.
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
    """Number of cables within two pixels of each pixel."""
    reach = np.ones((5, 5), np.uint8)
    nearby = [cv2.dilate((instances == number).astype(np.uint8), reach) for number in np.unique(instances) if number]
    return np.sum(nearby, axis=0, dtype=np.int64) if nearby else np.zeros(instances.shape, np.int64)


def _largest_square(pixels: NDArray[np.bool_]) -> int:
    """Edge of the largest square of set pixels."""
    left, edge = pixels.astype(np.uint8), 0
    while left.any():
        edge += 1
        # Four squares of edge n at a pixel and its three neighbours make one of edge n + 1, so each round shrinks by 1.
        left = left[1:, 1:] & left[:-1, 1:] & left[1:, :-1] & left[:-1, :-1]
    return edge
