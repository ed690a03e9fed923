"""Colours: written as hexadecimal sRGB, blended by masks, and spread over a field by a ramp."""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from assets.surfaces.kit.grid import Field, Labels

RAMP_STEPS = 1024
"""Entries of a colour ramp's table: finer than the 256 levels of a finished map, so no steps show."""


def rgb(code: str) -> Field:
    """Read a colour written as six hexadecimal digits, such as 'c8a064'; returns shape (3,), sRGB 0 to 1."""
    return np.array([int(code[i : i + 2], 16) / 255.0 for i in (0, 2, 4)], np.float32)


def plain(code: str, field: Field) -> Field:
    """Spread one colour over the whole of a field's grid, shape (H, W, 3)."""
    return np.broadcast_to(rgb(code), (*field.shape, 3)).copy()


def ramp(field: Field, stops: Sequence[tuple[float, str]]) -> Field:
    """Colour a field: linear interpolation in sRGB between stops.

    Args:
        field: Shape (H, W).
        stops: Value and hexadecimal colour of each stop, values rising; beyond the ends the end colours hold.

    Returns:
        Shape (H, W, 3), sRGB 0 to 1.
    """
    values = np.array([value for value, _ in stops])
    colours = np.stack([rgb(code) for _, code in stops])
    steps = np.linspace(values[0], values[-1], RAMP_STEPS)
    table = np.stack([np.interp(steps, values, colours[:, c]) for c in range(3)], axis=1).astype(np.float32)
    scale = np.float32((RAMP_STEPS - 1) / (values[-1] - values[0]))
    index = np.clip((field - np.float32(values[0])) * scale, 0, RAMP_STEPS - 1)
    return table[np.rint(index).astype(np.int32)]


def mix(below: Field, above: Field | str, mask: Field | float) -> Field:
    """Lay a colour over another.

    Args:
        below: Shape (H, W, 3).
        above: Shape (H, W, 3), or one colour as hexadecimal digits.
        mask: 0 shows `below`, 1 shows `above`: shape (H, W) or one value.

    Returns:
        Shape (H, W, 3).
    """
    top = rgb(above) if isinstance(above, str) else above
    weight = mask[..., None] if isinstance(mask, np.ndarray) else np.float32(mask)
    return below + (top - below) * weight


def shade(colour: Field, factor: Field | float) -> Field:
    """Multiply a colour, shape (H, W, 3), by a factor per texel, shape (H, W), or one factor."""
    return colour * (factor[..., None] if isinstance(factor, np.ndarray) else np.float32(factor))


def tint_each(rng: np.random.Generator, labels: Labels, brightness: float, hue: float) -> npt.NDArray[np.float32]:
    """Give every labelled piece its own slight tint.

    Args:
        rng: Source of the randomness.
        labels: Piece of each texel, shape (H, W).
        brightness: Standard deviation of the factor common to the three channels.
        hue: Standard deviation of the shift between warm and cool.

    Returns:
        Factors to multiply a colour by, shape (H, W, 3), mean near 1.
    """
    count = int(labels.max()) + 1
    light = 1.0 + brightness * rng.standard_normal((count, 1)).clip(-2.2, 2.2)
    warm = hue * rng.standard_normal((count, 1)).clip(-2.2, 2.2)
    table = light * (1.0 + warm * np.array([[1.0, 0.1, -1.1]]))
    return np.asarray(table.astype(np.float32)[labels])


def value_each(rng: np.random.Generator, labels: Labels, low: float, high: float) -> Field:
    """Give every labelled piece its own value, uniform from `low` to `high`; shape (H, W)."""
    table = rng.uniform(low, high, int(labels.max()) + 1).astype(np.float32)
    return table[labels]
