"""Cables as curves: what the fall produces, and what checking, building and labelling read."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from worker.curves import Points


@dataclass(frozen=True, slots=True)
class CableShapes:
    """Settled cables.

    Attributes:
        nodes_m: per cable (N, 3), nodes of the centreline from end to end.
        radii_m: (cables,), radius of each cable.
        lengths_m: (cables,), unstretched length of each cable.
        speeds_m_s: per cable (N,), speed of each node when the shape was captured.
        start_order: numbers of cables, and after them of sticks, from the lowest start to the highest.
        fall_s: true seconds from the start to the capture.
        steps: time steps of the rod solver, or frames of the cloth.
        sticks_m: per stick (N, 3), nodes of its axis from end to end; none where the simulator has none.
        stick_radii_m: (sticks,), radius of each stick.
    """

    nodes_m: tuple[Points, ...]
    radii_m: NDArray[np.float64]
    lengths_m: NDArray[np.float64]
    speeds_m_s: tuple[NDArray[np.float64], ...]
    start_order: tuple[int, ...]
    fall_s: float
    steps: int
    sticks_m: tuple[Points, ...] = ()
    stick_radii_m: NDArray[np.float64] = field(default_factory=lambda: np.zeros(0))


def bent_rod(length_m: float, bends_per_m: tuple[float, ...], nodes: int) -> NDArray[np.float64]:
    """A plane polyline of given length and curvature, its middle at the origin and its mean bearing along x.

    Args:
        length_m: length of the polyline.
        bends_per_m: curvature at equally spaced points from end to end, interpolated smoothly between them.
        nodes: number of points, at least 2, at equal distances along it.

    Returns:
        (nodes, 2) coordinates in metres.
    """
    knots = np.linspace(0.0, length_m, len(bends_per_m))
    curvature = CubicSpline(knots, bends_per_m, bc_type="natural")
    step = length_m / (nodes - 1)
    bearing = curvature.antiderivative()(step * (np.arange(nodes - 1) + 0.5))
    edges = step * np.stack([np.cos(bearing), np.sin(bearing)], axis=1)
    curve = np.concatenate([np.zeros((1, 2)), np.cumsum(edges, axis=0)])
    chord = curve[-1] - curve[0]
    turn = -np.arctan2(chord[1], chord[0])
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    level: NDArray[np.float64] = (curve - curve[len(curve) // 2]) @ rotation.T
    return level
