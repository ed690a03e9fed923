"""Colour by the standards: the curve of sRGB (IEC 61966-2-1) and the luminance of light (ITU-R BT.709)."""

from typing import Final

import numpy as np
import numpy.typing as npt

REC709_LUMINANCE: Final = np.array([0.2126, 0.7152, 0.0722])
"""Weights with which linear red, green and blue add up to luminance, shape (3,)."""


def light_of_srgb(value: float) -> float:
    """Compute the linear light of an sRGB value, both 0 to 1."""
    return value / 12.92 if value <= 0.04045 else float(((value + 0.055) / 1.055) ** 2.4)


def srgb_of_light(light: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Compute the sRGB values of linear light, both 0 to 1, of any shape."""
    values: npt.NDArray[np.float64] = np.where(
        light <= 0.0031308, 12.92 * light, 1.055 * np.maximum(light, 1e-9) ** (1 / 2.4) - 0.055
    )
    return values


def _light_of_level() -> npt.NDArray[np.float32]:
    light = np.array([light_of_srgb(level / 255.0) for level in range(256)], np.float32)
    light.setflags(write=False)  # it is shared
    return light


LIGHT_OF_LEVEL: Final = _light_of_level()
"""Linear light, 0 to 1, of each 8-bit level of sRGB, shape (256,)."""
