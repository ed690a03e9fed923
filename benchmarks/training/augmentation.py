"""What is done to a picture before a network sees it in training: turned, mirrored, its light and colour changed."""

import numpy as np
from numpy.typing import NDArray

_BRIGHTNESS = 0.12
"""Of the whole range of levels, up or down."""

_CONTRAST = 0.2
_TINT = 0.08
"""Of a channel's own level."""


def augment(
    picture: NDArray[np.uint8], mask: NDArray[np.bool_], draw: np.random.Generator
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """A picture and its mask, changed at random.

    Args:
        picture: (H, H, 3), RGB.
        mask: (H, H).
        draw: what the changes are drawn from; always the same number of draws.

    Returns:
        The picture (3, H, H), as `as_input` gives it, and the mask (1, H, H) of 0 and 1.
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
    """Levels (H, W, 3) from 0 to 1 as a network takes them: channels first, about 0, with a deviation of about 1."""
    return np.ascontiguousarray(((levels - 0.5) / 0.25).transpose(2, 0, 1), dtype=np.float32)
