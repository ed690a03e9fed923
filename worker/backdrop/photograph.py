"""A photograph as the backdrop. Numpy and OpenCV."""

import cv2
import numpy as np
from numpy.typing import NDArray

from assets.colour import REC709_LUMINANCE
from farm.scene.backdrop import Plate
from worker.backdrop.panorama import disc
from worker.colour import light_of

DARKEST = 1e-3
"""Least mean luminance that a crop is taken to have, white having 1: a darker one, brightened, shows its levels."""

_STRIP_ROWS = 512
"""Rows of a photograph that are converted to floats at once."""


def photograph_backdrop(
    pixels: NDArray[np.uint8], plate: Plate, resolution: int, blur_px: float, luminance: float
) -> NDArray[np.float32]:
    """Cut a square out of a photograph, blur it, and scale it to a mean luminance.

    The computation is in linear light. At the edges the blur sees the picture mirrored.

    Args:
        pixels: (H, W, 3) of sRGB, the top row first.
        plate: the square to take.
        resolution: pixels along an edge of the picture.
        blur_px: radius of the lens's disc, in pixels of the picture.
        luminance: mean luminance of the result, in scene-linear units; a crop darker than `DARKEST` stays darker.

    Returns:
        (resolution, resolution, 3) of linear light, the top row first.
    """
    light = _resample(_crop(pixels, plate), resolution)
    if plate.mirror:
        light = light[:, ::-1]
    blurred = cv2.filter2D(light, -1, disc(blur_px), borderType=cv2.BORDER_REFLECT_101)
    mean = max(float((blurred @ REC709_LUMINANCE).mean()), DARKEST)
    scaled: NDArray[np.float32] = (blurred * (luminance / mean)).astype(np.float32)
    return scaled


def _crop(pixels: NDArray[np.uint8], plate: Plate) -> NDArray[np.uint8]:
    height, width = pixels.shape[:2]
    edge = max(1, round(plate.zoom * min(height, width)))
    top, left = round(plate.y * (height - edge)), round(plate.x * (width - edge))
    return pixels[top : top + edge, left : left + edge]


def _resample(square: NDArray[np.uint8], resolution: int) -> NDArray[np.float32]:
    """Resample to (resolution, resolution, 3) of linear light: means of areas, or cubic between pixels."""
    light = _shrunk(square, max(1, len(square) // (2 * resolution)))
    edge = len(light)
    if edge == resolution:
        return light
    method = cv2.INTER_AREA if edge > resolution else cv2.INTER_CUBIC
    resized = cv2.resize(light, (resolution, resolution), interpolation=method)
    # Beside a bright line the cubic falls below 0.
    return np.maximum(resized, 0.0).astype(np.float32, copy=False)


def _shrunk(square: NDArray[np.uint8], factor: int) -> NDArray[np.float32]:
    """Means of factor x factor pixels, a strip at a time, since a large photograph takes a gigabyte in floats.

    Rows and columns at the end that fill no such block are left out.
    """
    edge = len(square) // factor
    shrunk = np.empty((edge, edge, 3), np.float32)
    rows = max(1, _STRIP_ROWS // factor)
    for first in range(0, edge, rows):
        last = min(edge, first + rows)
        strip = light_of(square[first * factor : last * factor, : edge * factor])
        shrunk[first:last] = cv2.resize(strip, (edge, last - first), interpolation=cv2.INTER_AREA)
    return shrunk
