"""Blender's images as arrays."""

from typing import Any

import numpy as np
from numpy.typing import NDArray


def rgb_of(image: Any) -> NDArray[np.float32]:
    """An image's values (H, W, 3), the top row first, as Blender reads them from the file."""
    columns, rows = image.size
    pixels = np.empty(rows * columns * 4, np.float32)
    image.pixels.foreach_get(pixels)
    # Blender has four channels, and its rows count from below.
    return np.ascontiguousarray(pixels.reshape(rows, columns, 4)[::-1, :, :3])
