"""Pictures between 8-bit sRGB levels and linear Rec. 709 light, by tables. Numpy and OpenCV."""

from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

from assets.colour import LIGHT_OF_LEVEL, REC709_LUMINANCE, srgb_of_light

Texels = NDArray[np.uint8]

LUMINANCE_WEIGHTS: Final = REC709_LUMINANCE.astype(np.float32)
"""Weights of linear red, green and blue in the precision of pictures, shape (3,)."""

_ROOTS = 4096
"""Entries of the table from the square root of light to levels."""


def luminance(light: NDArray[np.float32]) -> NDArray[np.float32]:
    """The luminance (...) of linear light (..., 3)."""
    seen: NDArray[np.float32] = light @ LUMINANCE_WEIGHTS
    return seen


def light_of(levels: Texels) -> NDArray[np.float32]:
    """Linear light, 0 to 1, of 8-bit sRGB levels of the same shape."""
    light = cv2.LUT(np.ascontiguousarray(levels), LIGHT_OF_LEVEL)
    return light.astype(np.float32, copy=False).reshape(levels.shape)


def levels_of(light: NDArray[np.float32]) -> Texels:
    """8-bit sRGB levels of linear light of the same shape, which is clipped at 0 and 1.

    They come from a table over the light's square root: a power for each texel took ten times as long.
    """
    root = cv2.sqrt(np.clip(light, 0, 1)).astype(np.float32, copy=False)
    levels: Texels = _LEVEL_OF_ROOT[(root * np.float32(_ROOTS - 1) + np.float32(0.5)).astype(np.uint16)]
    return levels.reshape(light.shape)


def _level_of_root() -> Texels:
    """The level (`_ROOTS`,) of each square root of light, evenly spaced from 0 to 1."""
    rounded: Texels = np.round(255 * srgb_of_light(np.square(np.arange(_ROOTS) / (_ROOTS - 1)))).astype(np.uint8)
    return rounded


_LEVEL_OF_ROOT = _level_of_root()
