"""What of an HDRI lights a scene on a floor: no more texels than light needs, and none that the floor hides.

Cycles looks for bright parts of the world wherever they are. Under a floor half of what it finds lights nothing, so
black there halves the noise at the same samples. Pure numpy and OpenCV.
"""

import cv2
import numpy as np
from numpy.typing import NDArray

WIDTH_PX = 512
"""0.7 degrees a texel: sharper than any reflection on the farm's floors and cables."""

BELOW = np.sin(np.radians(2.0))
"""How far below the horizon is left in: what is seen past the edge of the floor from a pile's height."""


def upper_world(panorama: NDArray[np.float32], turn: NDArray[np.float64]) -> NDArray[np.float32]:
    """Reduce a panorama to what lights a floor from above.

    Args:
        panorama: (H, 2H, 3) linear light, equirectangular, the zenith's row first.
        turn: (3, 3), takes a direction in the world to one in the panorama.

    Returns:
        The same in the panorama's own frame, at most `WIDTH_PX` wide.
    """
    height, width = panorama.shape[:2]
    if width > WIDTH_PX:
        size = (WIDTH_PX, max(1, round(height * WIDTH_PX / width)))
        panorama = cv2.resize(panorama, size, interpolation=cv2.INTER_AREA).astype(np.float32, copy=False)
    up_in_panorama = turn @ np.array([0.0, 0.0, 1.0])
    hidden = directions(*panorama.shape[:2]) @ up_in_panorama < -BELOW
    lit: NDArray[np.float32] = np.where(hidden[..., None], np.float32(0.0), panorama)
    return lit


def directions(rows: int, columns: int) -> NDArray[np.float64]:
    """Unit vectors (rows, columns, 3) of the middles of a panorama's texels, as Cycles maps them.

    The middle column looks along x, those right of it towards -y.
    """
    azimuth = np.pi - 2 * np.pi * (np.arange(columns) + 0.5) / columns
    elevation = 0.5 * np.pi - np.pi * (np.arange(rows) + 0.5) / rows
    across = np.cos(elevation)[:, None]
    return np.stack(
        np.broadcast_arrays(across * np.cos(azimuth), across * np.sin(azimuth), np.sin(elevation)[:, None]), axis=-1
    )
