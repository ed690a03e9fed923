"""Luminance of linear Rec. 709 light."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

REC709_LUMINANCE: Final = np.array([0.2126, 0.7152, 0.0722])
"""Of red, green and blue, ITU-R BT.709."""

_WEIGHTS = REC709_LUMINANCE.astype(np.float32)


def luminance(light: NDArray[np.float32]) -> NDArray[np.float32]:
    """Of (..., 3) light; (...)."""
    seen: NDArray[np.float32] = light @ _WEIGHTS
    return seen
