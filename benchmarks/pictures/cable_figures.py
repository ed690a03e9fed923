"""The width of cables and their crossings, from the instance map alone, so that any dataset can be measured."""

from itertools import combinations

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.spatial import KDTree

_FINER = 2
"""Factor by which instances are enlarged before measuring: any whole width then has its middle between two pixels."""

_SMOOTHING_PX = 1.0
"""Standard deviation, pixels, with which the enlarged outline is smoothed: the steps of a slanting outline would make a
cable narrower by half a pixel or more."""

_LEAST_PIECE = 0.25
"""Least area of a visible piece, as a share of the cable's squared width: smaller ones are crumbs of a cable that is
almost hidden beneath another."""

_COVERED = 0.9
"""Share of the line from one piece of a cable to the next that must run over other cables to count as a crossing."""


def median_width_px(instances: NDArray[np.uint16]) -> float:
    """Median width of the cables, over all places of their visible centrelines.

    The width at a place is twice the distance from the centreline (Zhang and Suen's thinning) to the nearest pixel
    outside the cable. A cable continues beyond the picture's edge.

    Args:
        instances: number of the cable at each pixel, 0 without one, (H, W).

    Returns:
        Pixels; NaN if the picture shows no cable.
    """
    widths = [_widths_px(instances == number) for number in numbers_of(instances)]
    found = np.concatenate(widths) if widths else np.empty(0)
    return float(np.median(found)) if found.size else float("nan")


def crossings(instances: NDArray[np.uint16]) -> int:
    """Number of times that a cable visibly lies across another.

    A cable on top interrupts the one below. So the visible pieces of each cable are joined by straight lines, the
    nearest first and without rings; a line that runs over other cables counts as one crossing with each of them. The
    instances don't show crossings of a cable with itself, nor those with one of the two sides out of the picture.

    Args:
        instances: number of the cable at each pixel, 0 without one, (H, W).
    """
    return sum(_interruptions(instances, number) for number in numbers_of(instances))


def numbers_of(instances: NDArray[np.uint16]) -> list[int]:
    """The numbers of the visible cables."""
    return [int(number) for number in np.unique(instances) if number]


def _widths_px(cable: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Widths at all places of a cable's centreline."""
    part = _cut(cable.astype(np.uint8))
    fine = cv2.resize(255 * part, None, fx=_FINER, fy=_FINER, interpolation=cv2.INTER_LINEAR)
    smooth = np.where(cv2.GaussianBlur(fine, (0, 0), _SMOOTHING_PX) > 127, 255, 0).astype(np.uint8)
    away = cv2.distanceTransform(smooth, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    # Thinning may leave a line one place beside the middle.
    away = cv2.dilate(away, np.ones((3, 3), np.uint8))
    centreline = cv2.ximgproc.thinning(smooth, thinningType=cv2.ximgproc.THINNING_ZHANGSUEN) > 0
    return 2.0 / _FINER * away[centreline].astype(np.float64)


def _cut(cable: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Crop a mask to the cable, with a margin of a pixel except at the picture's edge."""
    x, y, width, height = cv2.boundingRect(cable)
    return np.ascontiguousarray(cable[max(y - 1, 0) : y + height + 1, max(x - 1, 0) : x + width + 1])


def _interruptions(instances: NDArray[np.uint16], number: int) -> int:
    pieces = _pieces(instances == number)
    trees = [KDTree(piece) for piece in pieces]
    gaps = []
    for one, other in combinations(range(len(pieces)), 2):
        lengths, places = trees[other].query(pieces[one])
        start = int(np.argmin(lengths))
        gaps.append((float(lengths[start]), one, other, pieces[one][start], pieces[other][int(places[start])]))
    group = list(range(len(pieces)))
    found = 0
    for _, one, other, start_px, end_px in sorted(gaps, key=lambda gap: gap[:3]):
        if group[one] == group[other]:
            continue
        over = _lying_over(instances, number, start_px, end_px)
        if over:
            found += len(over)
            group = [group[one] if each == group[other] else each for each in group]
    return found


def _pieces(cable: NDArray[np.bool_]) -> list[NDArray[np.int64]]:
    """Border pixels, row and column, (n, 2), of each visible piece but crumbs; none if there is only one piece."""
    count, labels, stats, _ = cv2.connectedComponentsWithStats(cable.astype(np.uint8), connectivity=8)
    if count <= 2:
        return []
    least = _LEAST_PIECE * float(np.median(_widths_px(cable))) ** 2
    border = cable & ~cv2.erode(cable.astype(np.uint8), np.ones((3, 3), np.uint8)).astype(np.bool_)
    large = [piece for piece in range(1, count) if stats[piece, cv2.CC_STAT_AREA] >= least]
    return [np.argwhere(border & (labels == piece)) for piece in large]


def _lying_over(
    instances: NDArray[np.uint16], number: int, start_px: NDArray[np.int64], end_px: NDArray[np.int64]
) -> set[int]:
    """The other cables on the line from one piece of a cable to the next; none if it runs beside them."""
    steps = int(np.abs(end_px - start_px).max())
    way = np.rint(np.linspace(start_px, end_px, steps + 1)).astype(np.int64)[1:-1]
    seen = instances[way[:, 0], way[:, 1]]
    others = seen[(seen != 0) & (seen != number)]
    return set(others.tolist()) if others.size and others.size >= _COVERED * seen.size else set()
