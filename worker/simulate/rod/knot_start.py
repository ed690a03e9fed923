"""The loose start of a knot: a smooth curve with the knot's crossings, which is then pulled.

The curves are the solver's own shapes of knots that were pulled to a loop radius of ten radii without friction, so a
pull finds the nearest shape at rest and no other: a loose overhand knot also rests as a coil of two turns.
"""

from types import MappingProxyType

import numpy as np
from scipy.interpolate import CubicSpline

from farm.scene.knot import KnotKind
from worker.simulate.rod.model import Array

HALVES = MappingProxyType(
    {
        KnotKind.OVERHAND: (
            (0.0, 14.0, 0.0),
            (-4.6, 13.1, -1.7),
            (-8.6, 10.6, -3.1),
            (-11.5, 6.6, -4.0),
            (-12.5, 1.8, -4.1),
            (-11.3, -2.9, -3.2),
            (-7.9, -6.1, -1.5),
            (-3.3, -6.9, 0.2),
            (1.5, -6.1, 1.2),
            (6.2, -4.6, 1.2),
            (11.0, -3.1, 0.8),
            (15.9, -2.1, 0.6),
            (20.8, -1.3, 0.4),
            (25.8, -0.8, 0.2),
            (30.8, -0.4, 0.1),
            (35.8, -0.1, 0.0),
            (40.8, 0.0, 0.0),
        ),
        KnotKind.FIGURE_EIGHT: (
            (0.0, 0.0, 0.0),
            (-3.8, -3.3, -0.3),
            (-8.0, -5.8, -0.1),
            (-12.8, -6.5, 1.0),
            (-16.9, -4.4, 2.7),
            (-18.6, 0.0, 3.7),
            (-17.3, 4.7, 3.7),
            (-13.7, 8.0, 2.8),
            (-9.1, 9.4, 1.5),
            (-4.3, 9.4, 0.2),
            (0.4, 8.4, -1.0),
            (5.1, 6.9, -1.7),
            (9.8, 5.2, -1.9),
            (14.6, 3.7, -1.5),
            (19.4, 2.4, -1.0),
            (24.3, 1.5, -0.6),
            (29.2, 0.9, -0.3),
            (34.2, 0.4, -0.1),
            (39.2, 0.0, 0.0),
        ),
    }
)
"""Points on each knot's second half, from the middle of the cable to its straight tail, in radii of the cable, about
five apart along it. The pull is along x."""

HALF_TURN = MappingProxyType({KnotKind.OVERHAND: (-1.0, 1.0, -1.0), KnotKind.FIGURE_EIGHT: (-1.0, -1.0, -1.0)})
"""Factors of x, y and z that turn the second half into the first: an overhand knot is the same after half a turn about
y, and a figure-eight knot after a reflection in its middle."""

TABLE_LOOP_RADII = 10.0
"""Loop radius of the knots in `HALVES`, in radii of the cable."""

LOOSE_SHARE = 1.1
"""Size of the loose knot over that of the pulled one: the rod's surfaces do not touch yet."""

_FINE_STEPS = 16
"""Points of the fine curve between two points of the table."""


def loose_knot(kind: KnotKind, loop_radii: float, segment_radii: float, tail_radii: float) -> Array:
    """Lay a loose knot, in radii of its cable.

    Args:
        kind: kind of the knot.
        loop_radii: radius of the loop to which it will be pulled.
        segment_radii: distance of neighbouring nodes.
        tail_radii: length of each straight tail.

    Returns:
        (N, 3) nodes at equal distances, N odd, which is that of the rod in reach of the knot. The chord is along x.
    """
    half = np.array(HALVES[kind]) * LOOSE_SHARE * max(loop_radii / TABLE_LOOP_RADII, 1.0)
    places = np.arange(len(half))
    fine = np.linspace(0, len(half) - 1, _FINE_STEPS * (len(half) - 1) + 1)
    curve = CubicSpline(places, half)(fine)
    end = curve[-1] + np.array([tail_radii + segment_radii, 0.0, 0.0])
    second = _equal_steps(np.concatenate([curve, [end]]), segment_radii)
    first = second[:0:-1] * HALF_TURN[kind]
    return np.concatenate([first, second])


def _equal_steps(curve: Array, step: float) -> Array:
    """Walk along a polyline (M, 3) from its first point in straight steps of one length; return the (N, 3) places."""
    places, here, reached = [curve[0]], curve[0], 0
    while True:
        beyond = np.flatnonzero(np.linalg.norm(curve[reached + 1 :] - here, axis=1) >= step)
        if not len(beyond):
            return np.array(places)
        reached += int(beyond[0])
        start, edge = curve[reached], curve[reached + 1] - curve[reached]
        to_start = start - here
        a, b, c = edge @ edge, edge @ to_start, to_start @ to_start - step**2
        here = start + (np.sqrt(max(b * b - a * c, 0.0)) - b) / a * edge
        places.append(here)
