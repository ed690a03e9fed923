"""Settled cables as curves: the result of the fall, which checks, renderer and labels read."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from worker.curves import Points


@dataclass(frozen=True, slots=True)
class CableShapes:
    """The shapes of settled cables and sticks.

    Attributes:
        nodes_m: for each cable (N, 3) metres, nodes of the centreline from end to end.
        radii_m: (cables,) metres, radius of each cable.
        lengths_m: (cables,) metres, length of each cable without strain.
        speeds_m_s: for each cable (N,), speed of each node when the shape was captured, in m/s.
        start_order: numbers of the cables and sticks from the lowest start to the highest; sticks count on after the
            cables.
        fall_s: time from the start to the capture, in seconds of true scale.
        steps: number of time steps of the rod solver, or of frames of the cloth.
        sticks_m: for each stick (N, 3) metres, nodes of the axis from end to end; none if the simulator has no sticks.
        stick_radii_m: (sticks,) metres, radius of each stick.
        rested: whether the fall ended because all rested, and not because its time was over.
        passages: number of times that cables or sticks went through each other and stayed so, as the simulator watched
            it; None if it does not watch.
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
    rested: bool = True
    passages: int | None = None


NOTHING_FELL = CableShapes(
    nodes_m=(),
    radii_m=np.zeros(0),
    lengths_m=np.zeros(0),
    speeds_m_s=(),
    start_order=(),
    fall_s=0.0,
    steps=0,
)
"""The shapes of a scene without cables and sticks."""


def bent_rod(length_m: float, bends_per_m: tuple[float, ...], nodes: int) -> NDArray[np.float64]:
    """Make a plane polyline of given length and curvature, with its middle at the origin and its chord along x.

    Args:
        length_m: length of the polyline, in metres.
        bends_per_m: curvature at equally spaced points from end to end, in 1/m, interpolated smoothly between them.
        nodes: number of points, 2 or more, at equal distances.

    Returns:
        (nodes, 2) metres.
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
