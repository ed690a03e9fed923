"""Instance maps drawn by hand."""

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

SIZE = 256

Point = tuple[float, float]

_SHIFT = 8
"""Fractional bits of the positions handed to OpenCV."""


def bar(instances: NDArray[np.uint16], number: int, start: Point, end: Point, width_px: float) -> None:
    """Draw a bar with square ends over the map; its centreline runs from `start` to `end` (x, y)."""
    along = np.subtract(end, start) / np.hypot(*np.subtract(end, start))
    across = 0.5 * width_px * np.array([-along[1], along[0]])
    rows, columns = np.mgrid[: instances.shape[0], : instances.shape[1]] + 0.5
    from_start = np.stack([columns - start[0], rows - start[1]], axis=-1)
    lengthwise = from_start @ along
    sideways = np.abs(from_start @ across) / (0.5 * width_px)
    inside = (sideways < 0.5 * width_px) & (lengthwise >= 0) & (lengthwise <= np.hypot(*np.subtract(end, start)))
    instances[inside] = number


def empty() -> NDArray[np.uint16]:
    """A map without cables."""
    return np.zeros((SIZE, SIZE), np.uint16)


def curve(instances: NDArray[np.uint16], number: int, points: Sequence[Point], width_px: int) -> None:
    """Draw a bent cable with round ends over the map."""
    line = np.rint(np.array(points) * 2**_SHIFT).astype(np.int32)
    drawn = np.zeros(instances.shape, np.uint8)
    cv2.polylines(drawn, [line], isClosed=False, color=(1,), thickness=width_px, shift=_SHIFT)
    instances[drawn > 0] = number
