"""Luminance of linear Rec. 709 light."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from assets.hdris import LUMINANCE

REC709_LUMINANCE: Final = LUMINANCE
"""Of red, green and blue, ITU-R BT.709."""

_WEIGHTS = REC709_LUMINANCE.astype(np.float32)


def luminance(light: NDArray[np.float32]) -> NDArray[np.float32]:
    """Of (..., 3) light; (...)."""
    seen: NDArray[np.float32] = light @ _WEIGHTS
    return seen
