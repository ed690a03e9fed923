"""Random changes to a picture before a network sees it in training: turns, mirroring, light and colour."""

import numpy as np
from numpy.typing import NDArray

_BRIGHTNESS = 0.12
"""Largest change of brightness, up or down, as a share of the whole range of levels."""

_CONTRAST = 0.2
"""Largest change of contrast, up or down, as a share."""
_TINT = 0.08
"""Largest change of a channel, up or down, as a share of its level."""


def augment(
    picture: NDArray[np.uint8], mask: NDArray[np.bool_], draw: np.random.Generator
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Change a picture and its mask at random.

    Args:
        picture: RGB picture, (H, H, 3).
        mask: mask of the cables, (H, H).
        draw: source of the randomness, always used for the same number of draws.

    Returns:
        The picture as `as_input` lays it out, (3, H, H), and the mask of 0 and 1, (1, H, H).
    """
    turns, mirrored = int(draw.integers(4)), bool(draw.integers(2))
    contrast = 1.0 + draw.uniform(-_CONTRAST, _CONTRAST)
    brightness = draw.uniform(-_BRIGHTNESS, _BRIGHTNESS)
    tint = 1.0 + draw.uniform(-_TINT, _TINT, 3)
    levels = picture.astype(np.float32) / 255.0
    mean = float(levels.mean())
    levels = np.clip(((levels - mean) * contrast + mean + brightness) * tint, 0.0, 1.0)
    turned, turned_mask = np.rot90(levels, turns), np.rot90(mask, turns)
    if mirrored:
        turned, turned_mask = turned[:, ::-1], turned_mask[:, ::-1]
    return as_input(turned.astype(np.float32)), np.ascontiguousarray(turned_mask[None], dtype=np.float32)


def as_input(levels: NDArray[np.float32]) -> NDArray[np.float32]:
    """Lay out levels (H, W, 3) from 0 to 1 for a network: channels first, mean near 0, standard deviation near 1."""
    return np.ascontiguousarray(((levels - 0.5) / 0.25).transpose(2, 0, 1), dtype=np.float32)
