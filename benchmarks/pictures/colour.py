"""The spread of colours over many pictures: histograms, their entropy, and their distances from each other."""

from collections.abc import Sequence
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

LEVELS = 8
"""Levels of each channel in a histogram: few enough that a picture fills its boxes."""

Histogram = NDArray[np.float64]


def colour_histogram(picture: NDArray[np.uint8]) -> Histogram:
    """Share of a picture's pixels in each of 8 x 8 x 8 boxes of RGB, (512,).

    Args:
        picture: RGB picture, (H, W, 3).
    """
    boxes = (picture // (256 // LEVELS)).astype(np.int64)
    index = (boxes[..., 0] * LEVELS + boxes[..., 1]) * LEVELS + boxes[..., 2]
    share: Histogram = np.bincount(index.ravel(), minlength=LEVELS**3) / index.size
    return share


def entropy_bits(histograms: Sequence[Histogram]) -> float:
    """Shannon's entropy of the histogram of all pictures together.

    Returns:
        0 if all pixels lie in one box, 9 if they fill all 512 boxes equally; NaN without pictures.
    """
    if not histograms:
        return float("nan")
    share = np.mean(histograms, axis=0)
    share = share[share > 0]
    return float(abs(np.sum(share * np.log2(share))))


def mean_hellinger(histograms: Sequence[Histogram]) -> float:
    """Mean Hellinger distance between two pictures' histograms, over all pairs.

    Returns:
        0 if all pictures have the same colours, 1 if no two share any; NaN for fewer than two pictures.
    """
    if len(histograms) < 2:
        return float("nan")
    roots = np.sqrt(histograms)
    distances = [np.sqrt(max(0.0, 1.0 - float(one @ other))) for one, other in combinations(roots, 2)]
    return float(np.mean(distances))
