"""Settled cables as curves: the result of the fall, which checks, renderer and labels read."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from farm.scene.cable import Cable
from worker.curves import Points

FINE_STEPS = 16
"""Steps in which a curve that is not level is integrated between two nodes."""


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
        pegs_m: for each peg (N, 3) metres, nodes of the axis from below the floor to the top.
        peg_radii_m: (pegs,) metres, radius of each peg.
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
    pegs_m: tuple[Points, ...] = ()
    peg_radii_m: NDArray[np.float64] = field(default_factory=lambda: np.zeros(0))


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


def start_nodes(cable: Cable, count: int) -> Points:
    """Lay a cable without a knot as it starts, on segments whose lengths are equal and add up to the cable's length.

    A cable that is not level keeps to the plan of the level one, about the middle, so what crosses above and below each
    other in the plan does so in space.

    Args:
        cable: the cable.
        count: number of nodes, 2 or more.

    Returns:
        (count, 3) metres, nodes of the centreline.
    """
    if cable.rise_m == 0.0 and not cable.heights_m:
        level = bent_rod(cable.length_m, cable.bends_per_m, count)
        height = np.zeros(count)
    else:
        level, height = _risen(cable, count)
    turn = np.radians(cable.rotation_deg)
    cosine, sine = np.cos(turn), np.sin(turn)
    nodes = np.empty((count, 3))
    nodes[:, 0] = cable.x_m + cosine * level[:, 0] - sine * level[:, 1]
    nodes[:, 1] = cable.y_m + sine * level[:, 0] + cosine * level[:, 1]
    nodes[:, 2] = cable.diameter_m / 2 + cable.start_height_m + height
    return nodes


def height_at(cable: Cable, along_m: NDArray[np.float64]) -> NDArray[np.float64]:
    """Compute the height (N,) of a cable above its `start_height_m` at places (N,) along its level curve, in metres."""
    if cable.heights_m:
        knots = np.linspace(0.0, cable.length_m, len(cable.heights_m))
        smooth: NDArray[np.float64] = CubicSpline(knots, cable.heights_m, bc_type="natural")(along_m)
        return smooth
    # Its length along the slope is the cable's, so that the even rise from end to end is `rise_m`.
    slope = cable.rise_m / np.sqrt(cable.length_m**2 - cable.rise_m**2)
    even: NDArray[np.float64] = cable.rise_m / 2 + slope * (along_m - cable.length_m / 2)
    return even


def _risen(cable: Cable, count: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Lay a curve that is not level: its plan (count, 2) and the heights (count,) of its nodes."""
    fine = 2 * FINE_STEPS * (count - 1)
    along = np.linspace(0.0, cable.length_m, fine + 1)
    plan = bent_rod(cable.length_m, cable.bends_per_m, fine + 1)
    rises = np.diff(height_at(cable, along))
    arc = np.concatenate([[0.0], np.cumsum(np.hypot(cable.length_m / fine, rises))])
    step, middle = cable.length_m / (count - 1), count // 2
    places = np.interp(arc[fine // 2] + step * (np.arange(count) - (count - 1) / 2), arc, along)
    height = height_at(cable, places)
    points = np.stack([np.interp(places, along, plan[:, axis]) for axis in range(2)], axis=1)
    edges = np.diff(points, axis=0)
    edges *= (np.sqrt(step**2 - np.diff(height) ** 2) / np.linalg.norm(edges, axis=1))[:, None]
    level = np.concatenate([np.zeros((1, 2)), np.cumsum(edges, axis=0)])
    return level + points[middle] - level[middle], height
