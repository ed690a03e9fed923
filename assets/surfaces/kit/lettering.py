"""Printed characters: numbers on rules, names on circuit boards, lines of text on paper."""

import cv2
import numpy as np

from assets.surfaces.kit.grid import Grid
from assets.surfaces.kit.strokes import Image

CAP_HEIGHT = 21
"""Height of a capital of OpenCV's simplex font at scale 1, in texels."""
OVERSAMPLING = 4
"""Factor by which letters are drawn larger and then scaled down, so that even small ones have smooth strokes."""


def text_patch(text: str, height_mm: float, grid: Grid, weight: float = 0.14) -> Image:
    """Draw a line of text on a patch of its own.

    Args:
        text: Text in ASCII characters.
        height_mm: Height of a capital.
        grid: Grid that sets the size of a texel.
        weight: Width of the strokes, as a share of the height.

    Returns:
        Ink, 0 to 255, shape (h, w); the capitals fill it but for a narrow margin.
    """
    high = OVERSAMPLING * height_mm / grid.texel_mm
    stroke = max(1, round(weight * high))
    scale = high / CAP_HEIGHT
    (width, height), below = cv2.getTextSize(text, cv2.FONT_HERSHEY_SIMPLEX, scale, stroke)
    margin = stroke + OVERSAMPLING
    canvas = np.zeros((height + below + 2 * margin, width + 2 * margin), np.uint8)
    place = (margin, height + margin)
    cv2.putText(canvas, text, place, cv2.FONT_HERSHEY_SIMPLEX, scale, (255,), stroke, cv2.LINE_AA)
    size = (max(1, canvas.shape[1] // OVERSAMPLING), max(1, canvas.shape[0] // OVERSAMPLING))
    return np.asarray(cv2.resize(canvas, size, interpolation=cv2.INTER_AREA), np.uint8)


def stamp(image: Image, patch: Image, x_mm: float, y_mm: float, grid: Grid) -> None:
    """Print a patch on an image of the tile, in place; what leaves the tile enters at the opposite edge.

    Args:
        image: Image of the tile, shape (H, W); each texel keeps the brighter of its value and the patch's.
        patch: Image to print, shape (h, w), smaller than the tile.
        x_mm: Position of the patch's middle to the right, millimetres.
        y_mm: Position of the patch's middle downwards, millimetres.
        grid: The tile.
    """
    high, wide = patch.shape
    top = round(y_mm / grid.texel_mm - high / 2)
    left = round(x_mm / grid.texel_mm - wide / 2)
    where = np.ix_(np.arange(top, top + high) % grid.pixels, np.arange(left, left + wide) % grid.pixels)
    image[where] = np.maximum(image[where], patch)
