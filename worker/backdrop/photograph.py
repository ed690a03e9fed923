"""A photograph as the backdrop. Numpy and OpenCV."""

import cv2
import numpy as np
from numpy.typing import NDArray

from assets.colour import REC709_LUMINANCE
from farm.scene.backdrop import Plate
from farm.scene.picture_size import PictureSize
from worker.backdrop.panorama import disc
from worker.colour import light_of

DARKEST = 1e-3
"""Least mean luminance that a crop is taken to have, white having 1: a darker one, brightened, shows its levels."""

_STRIP_ROWS = 512
"""Rows of a photograph that are converted to floats at once."""


def photograph_backdrop(
    pixels: NDArray[np.uint8], plate: Plate, resolution: PictureSize, blur_px: float, luminance: float
) -> NDArray[np.float32]:
    """Cut a part out of a photograph, blur it, and scale it to a mean luminance.

    The computation is in linear light. At the edges the blur sees the picture mirrored.

    Args:
        pixels: (H, W, 3) of sRGB, the top row first.
        plate: the part to take.
        resolution: size of the picture.
        blur_px: radius of the lens's disc, in pixels of the picture.
        luminance: mean luminance of the result, in scene-linear units; a crop darker than `DARKEST` stays darker.

    Returns:
        (H, W, 3) of linear light, of the picture's size, the top row first.
    """
    light = _resample(_crop(pixels, plate, resolution), resolution)
    if plate.mirror:
        light = light[:, ::-1]
    blurred = cv2.filter2D(light, -1, disc(blur_px), borderType=cv2.BORDER_REFLECT_101)
    mean = max(float((blurred @ REC709_LUMINANCE).mean()), DARKEST)
    scaled: NDArray[np.float32] = (blurred * (luminance / mean)).astype(np.float32)
    return scaled


def _crop(pixels: NDArray[np.uint8], plate: Plate, resolution: PictureSize) -> NDArray[np.uint8]:
    height, width = pixels.shape[:2]
    across, along = resolution.shares
    longer = plate.zoom * min(width / across, height / along)
    columns, rows = (max(1, round(longer * share)) for share in (across, along))
    top, left = round(plate.y * (height - rows)), round(plate.x * (width - columns))
    return pixels[top : top + rows, left : left + columns]


def _resample(part: NDArray[np.uint8], resolution: PictureSize) -> NDArray[np.float32]:
    """Resample to (H, W, 3) of linear light, of the picture's size: means of areas, or cubic between pixels."""
    rows, columns = resolution.shape
    light = _shrunk(part, max(1, min(part.shape[0] // (2 * rows), part.shape[1] // (2 * columns))))
    if light.shape[:2] == resolution.shape:
        return light
    is_finer = light.shape[0] * light.shape[1] > rows * columns
    method = cv2.INTER_AREA if is_finer else cv2.INTER_CUBIC
    resized = cv2.resize(light, (columns, rows), interpolation=method)
    # Beside a bright line the cubic falls below 0.
    return np.maximum(resized, 0.0).astype(np.float32, copy=False)


def _shrunk(part: NDArray[np.uint8], factor: int) -> NDArray[np.float32]:
    """Means of factor x factor pixels, a strip at a time, since a large photograph takes a gigabyte in floats.

    Rows and columns at the end that fill no such block are left out.
    """
    rows, columns = part.shape[0] // factor, part.shape[1] // factor
    shrunk = np.empty((rows, columns, 3), np.float32)
    at_once = max(1, _STRIP_ROWS // factor)
    for first in range(0, rows, at_once):
        last = min(rows, first + at_once)
        strip = light_of(part[first * factor : last * factor, : columns * factor])
        shrunk[first:last] = cv2.resize(strip, (columns, last - first), interpolation=cv2.INTER_AREA)
    return shrunk
