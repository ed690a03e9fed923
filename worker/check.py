"""Checks of a settled scene: length, penetration, pass-through, floor, rest. Pure numpy.

Each figure is measured on the smooth centrelines that are rendered, with the cables' true radii.
"""

from itertools import combinations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from farm.manifest import SettleFigures
from worker.shapes import CableShapes, Points, smooth

SAMPLES_PER_SPAN = 12
_COARSE = 3
"""Every third sample is enough to find crossings."""

MAX_LENGTH_ERROR = 0.01
MAX_PENETRATION = 0.10
MAX_PENETRATION_ANYWHERE = 0.20
MAX_SUPPORT_GAP = 0.5
MAX_SPEED_RMS_MM_S = 1.0
MAX_SPEED_MM_S = 5.0
"""Beyond these a picture would show the fault, or the cables still move; such a scene is drawn again."""


def measure(shapes: CableShapes) -> SettleFigures:
    """Measure every figure of a settled scene; the shapes must be finite."""
    curves = [smooth(nodes, SAMPLES_PER_SPAN) for nodes in shapes.nodes_m]
    depths = [np.zeros(len(curve)) for curve in curves]
    gaps = [curve[:, 2] - radius for curve, radius in zip(curves, shapes.radii_m, strict=True)]
    floor_depths = [np.maximum(-gap, 0) / radius for gap, radius in zip(gaps, shapes.radii_m, strict=True)]
    for a, b in combinations(range(len(curves)), 2):
        reach = shapes.radii_m[a] + shapes.radii_m[b]
        smaller = min(shapes.radii_m[a], shapes.radii_m[b])
        for one, other in ((a, b), (b, a)):
            clearance = _distances(curves[one], curves[other]) - reach
            depths[one] = np.maximum(depths[one], -clearance / smaller)
            gaps[one] = np.minimum(gaps[one], clearance)
    speeds = np.concatenate(shapes.speeds_m_s) * 1000
    all_depths, all_floor_depths = np.concatenate(depths), np.concatenate(floor_depths)
    return SettleFigures(
        fall_s=shapes.fall_s,
        steps=shapes.steps,
        length_error=_length_error(shapes),
        cable_penetration=float(np.percentile(all_depths, 99.9)),
        cable_penetration_max=float(all_depths.max()),
        floor_penetration=float(np.percentile(all_floor_depths, 99.9)),
        floor_penetration_max=float(all_floor_depths.max()),
        pass_throughs=_flipped_crossings(shapes, curves),
        self_crossings=sum(_self_crossings(curve[::_COARSE]) for curve in curves),
        speed_rms_mm_s=float(np.sqrt(np.mean(speeds**2))),
        speed_max_mm_s=float(speeds.max()),
        support_gap=max(float(gap.min() / radius) for gap, radius in zip(gaps, shapes.radii_m, strict=True)),
    )


def find_fault(figures: SettleFigures) -> str | None:
    """Why a scene must be drawn again, or None if it may be shipped."""
    if figures.pass_throughs:
        return f"{figures.pass_throughs} crossing(s) of cables that passed through each other"
    if figures.self_crossings:
        return f"a cable crosses itself {figures.self_crossings} time(s)"
    limits = (
        ("length error", figures.length_error, MAX_LENGTH_ERROR),
        ("cable penetration over radius", figures.cable_penetration, MAX_PENETRATION),
        ("floor penetration over radius", figures.floor_penetration, MAX_PENETRATION),
        ("deepest cable penetration over radius", figures.cable_penetration_max, MAX_PENETRATION_ANYWHERE),
        ("deepest floor penetration over radius", figures.floor_penetration_max, MAX_PENETRATION_ANYWHERE),
        ("root mean square speed in mm/s", figures.speed_rms_mm_s, MAX_SPEED_RMS_MM_S),
        ("speed in mm/s", figures.speed_max_mm_s, MAX_SPEED_MM_S),
        ("gap below a cable over radius", figures.support_gap, MAX_SUPPORT_GAP),
    )
    for name, value, limit in limits:
        if not value <= limit:
            return f"{name} {value:.4g} is above {limit:g}"
    return None


def _length_error(shapes: CableShapes) -> float:
    lengths = [float(np.linalg.norm(np.diff(nodes, axis=0), axis=1).sum()) for nodes in shapes.nodes_m]
    return float(np.max(np.abs(np.array(lengths) / shapes.lengths_m - 1)))


def _distances(curve: Points, other: Points) -> NDArray[np.float64]:
    """Distance of each point of `curve` to the polyline `other`.

    The nearest vertex comes from a tree; the two segments that meet there hold the nearest point of a finely
    sampled curve.
    """
    _, nearest = cKDTree(other).query(curve)
    before = _segment_distance(curve, other[np.maximum(nearest - 1, 0)], other[nearest])
    after = _segment_distance(curve, other[nearest], other[np.minimum(nearest + 1, len(other) - 1)])
    return np.minimum(before, after)


def _segment_distance(points: Points, start: Points, end: Points) -> NDArray[np.float64]:
    along = end - start
    squared = np.maximum(np.einsum("ij,ij->i", along, along), 1e-30)
    fraction = np.clip(np.einsum("ij,ij->i", points - start, along) / squared, 0, 1)
    distance: NDArray[np.float64] = np.linalg.norm(points - start - fraction[:, None] * along, axis=1)
    return distance


def _flipped_crossings(shapes: CableShapes, curves: list[Points]) -> int:
    """Crossings seen from above whose lower cable started above the other.

    Cables start at stacked heights, so the order of a pair at every crossing is that of their start; another order
    means that one went through the other (or, which is as rare and as wrong in a picture, slipped around its end).
    """
    rank = {cable: level for level, cable in enumerate(shapes.start_order)}
    coarse = [curve[::_COARSE] for curve in curves]
    flipped = 0
    for a, b in combinations(range(len(curves)), 2):
        _, _, height_difference = _crossings(coarse[a], coarse[b])
        expected = 1.0 if rank[b] > rank[a] else -1.0
        flipped += int(np.count_nonzero(height_difference * expected < 0))
    return flipped


def _self_crossings(curve: Points) -> int:
    """Crossings of a cable with itself, seen from above; neighbouring segments, which share a point, do not count."""
    first, second, _ = _crossings(curve, curve)
    return int(np.count_nonzero(second > first + 1))


Indices = NDArray[np.int64]


def _crossings(one: Points, other: Points) -> tuple[Indices, Indices, NDArray[np.float64]]:
    """Where the projections of two lines on the floor cross.

    Returns:
        The segments of `one` and of `other` at each crossing, and the height of `other` above `one` there.
    """
    p, r = one[:-1, None], np.diff(one, axis=0)[:, None]
    q, s = other[None, :-1], np.diff(other, axis=0)[None]
    cross = r[..., 0] * s[..., 1] - r[..., 1] * s[..., 0]
    safe = np.where(cross == 0, np.inf, cross)
    offset = q - p
    t = (offset[..., 0] * s[..., 1] - offset[..., 1] * s[..., 0]) / safe
    u = (offset[..., 0] * r[..., 1] - offset[..., 1] * r[..., 0]) / safe
    i, j = np.nonzero((t >= 0) & (t < 1) & (u >= 0) & (u < 1) & (cross != 0))
    below = one[i, 2] + t[i, j] * np.diff(one[:, 2])[i]
    above = other[j, 2] + u[i, j] * np.diff(other[:, 2])[j]
    return i, j, above - below
