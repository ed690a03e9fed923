"""Exact shapes that repeat across the tile: holes, slots, bars and keys, drawn from their signed distances."""

import numpy as np
import numpy.typing as npt

from assets.surfaces.kit.grid import Field, Grid


def repeated(position_mm: Field, pitch_mm: float, shift_mm: Field | float = 0.0) -> Field:
    """Measure how far each texel is from the middle of the cell that it lies in.

    Args:
        position_mm: Positions along an axis, shape (H, W).
        pitch_mm: Width of a cell; the tile's edge must be a whole number of cells.
        shift_mm: Distance by which the cells are moved along the axis, one value or shape (H, W).

    Returns:
        Millimetres from minus to plus half a pitch, shape (H, W).
    """
    return np.asarray(np.mod(position_mm - shift_mm, np.float32(pitch_mm)) - np.float32(pitch_mm / 2), np.float32)


def box(u_mm: Field, v_mm: Field, width_mm: Field | float, height_mm: Field | float, radius_mm: float) -> Field:
    """Signed distance to a rectangle with round corners, which a large radius turns into a slot or a disc.

    Args:
        u_mm: Positions along the width, from the rectangle's middle, shape (H, W).
        v_mm: Positions along the height, from the rectangle's middle, shape (H, W).
        width_mm: Full width of the rectangle.
        height_mm: Full height of the rectangle.
        radius_mm: Radius of the corners, at most half the shorter side.

    Returns:
        Millimetres, negative inside, shape (H, W).
    """
    past_u = np.abs(u_mm) - (0.5 * width_mm - radius_mm)
    past_v = np.abs(v_mm) - (0.5 * height_mm - radius_mm)
    outside = np.hypot(np.maximum(past_u, 0), np.maximum(past_v, 0))
    return np.asarray(outside + np.minimum(np.maximum(past_u, past_v), 0) - radius_mm, np.float32)


def filled(distance_mm: npt.NDArray[np.float32], grid: Grid, soft_mm: float = 0.0) -> Field:
    """Fill a shape with a smooth border.

    Args:
        distance_mm: Signed distance, negative inside, shape (H, W).
        grid: The tile.
        soft_mm: Width of the border; at least a texel.

    Returns:
        1 inside to 0 outside, a half on the border, shape (H, W).
    """
    return np.asarray(np.clip(0.5 - distance_mm / max(soft_mm, grid.texel_mm), 0.0, 1.0), np.float32)
