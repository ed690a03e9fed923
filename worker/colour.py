"""Linear Rec. 709 light, its luminance, and its sRGB levels."""

from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

from assets.scan.hdris import LUMINANCE

REC709_LUMINANCE: Final = LUMINANCE
"""Of red, green and blue, ITU-R BT.709."""

_WEIGHTS = REC709_LUMINANCE.astype(np.float32)


def luminance(light: NDArray[np.float32]) -> NDArray[np.float32]:
    """Of (..., 3) light; (...)."""
    seen: NDArray[np.float32] = light @ _WEIGHTS
    return seen


_ROOTS = 4096
"""Entries of the table from the square root of light to levels."""


Texels = NDArray[np.uint8]


def light_of(levels: Texels) -> NDArray[np.float32]:
    """Linear light, 0 to 1, of 8-bit sRGB levels."""
    light = cv2.LUT(np.ascontiguousarray(levels), _LIGHT_OF_LEVEL)
    return light.astype(np.float32, copy=False).reshape(levels.shape)


def levels_of(light: NDArray[np.float32]) -> Texels:
    """8-bit sRGB levels of linear light, which is clipped at 0 and 1.

    By a table over its square root: a power a texel took ten times as long.
    """
    root = cv2.sqrt(np.clip(light, 0, 1)).astype(np.float32, copy=False)
    levels: Texels = _LEVEL_OF_ROOT[(root * np.float32(_ROOTS - 1) + np.float32(0.5)).astype(np.uint16)]
    return levels.reshape(light.shape)


def _light_of_levels() -> NDArray[np.float32]:
    """Linear light of each 8-bit sRGB level (IEC 61966-2-1)."""
    level = np.arange(256) / 255.0
    return np.where(level <= 0.04045, level / 12.92, ((level + 0.055) / 1.055) ** 2.4).astype(np.float32)


_LIGHT_OF_LEVEL = _light_of_levels()


def _levels_of_roots() -> Texels:
    """The level of each square root of light, evenly spaced from 0 to 1 (IEC 61966-2-1)."""
    light = np.square(np.arange(_ROOTS) / (_ROOTS - 1))
    levels = np.where(light <= 0.0031308, 12.92 * light, 1.055 * np.maximum(light, 1e-9) ** (1 / 2.4) - 0.055)
    rounded: Texels = np.round(255 * levels).astype(np.uint8)
    return rounded


_LEVEL_OF_ROOT = _levels_of_roots()


def srgb(light: NDArray[np.float64]) -> NDArray[np.float64]:
    """Levels of light between 0 and 1, IEC 61966-2-1."""
    levels: NDArray[np.float64] = np.where(
        light <= 0.0031308, 12.92 * light, 1.055 * np.maximum(light, 1e-9) ** (1 / 2.4) - 0.055
    )
    return levels
