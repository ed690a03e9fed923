"""Chooses the small parts that have room between the settled cables and sticks. Pure numpy."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from farm.scene.clutter import Part
from worker.clutter.parts import part_extent
from worker.curves import Points


def parts_that_fit(
    parts: Sequence[Part], curves: Sequence[Points], radii_m: NDArray[np.float64], slope: float
) -> tuple[Part, ...]:
    """Choose the parts that neither touch a cable, a stick or an earlier part, nor hide one from the camera.

    Args:
        parts: sampled parts, in their order.
        curves: centrelines of the settled cables and sticks, (N, 3) each, in metres, finely sampled or nodes.
        radii_m: (curves,), radius of each cable and stick, in metres.
        slope: sideways distance at which an object hides another, over its height; see
            `worker.camera.view.View.steepest_slope`.

    Returns:
        The parts that have room, in their order.
    """
    kept: list[tuple[Part, float]] = []
    for part in parts:
        radius, height = part_extent(part)
        reach = radius + slope * height
        place = np.array([part.x_m, part.y_m])
        beside_rods = all(
            _is_clear(curve, float(rod), place, reach, slope) for curve, rod in zip(curves, radii_m, strict=True)
        )
        beside_parts = all(np.hypot(part.x_m - one.x_m, part.y_m - one.y_m) > reach + other for one, other in kept)
        if beside_rods and beside_parts:
            kept.append((part, reach))
    return tuple(part for part, _ in kept)


def _is_clear(curve: Points, radius_m: float, place: NDArray[np.float64], reach_m: float, slope: float) -> bool:
    """Whether a rod's polyline (N, 3) stays clear of a place (2,); a higher rod appears farther from the middle."""
    start, edge = curve[:-1, :2], np.diff(curve[:, :2], axis=0)
    share = np.einsum("ij,ij->i", place - start, edge) / np.maximum(np.einsum("ij,ij->i", edge, edge), 1e-18)
    nearest = start + np.clip(share, 0.0, 1.0)[:, None] * edge
    height = np.maximum(curve[:-1, 2], curve[1:, 2]) + radius_m
    away = np.linalg.norm(nearest - place, axis=1)
    return bool((away > reach_m + radius_m + slope * height).all())
