"""Which knot a cable holds, told by its determinant.

The determinant of a knot is a number that no motion changes as long as the cable does not pass through itself: 1 for a
cable without a knot, 3 for an overhand knot and 5 for a figure-eight knot. It is the value at -1 of Alexander's
polynomial, up to its sign (Livingston 1993, "Knot Theory", ch. 3). Other knots may share it; no simpler one does.

A knot is a closed curve, so the cable's ends are joined by an arc above all else, as if both were lifted. What an end
does under the cable counts: an end that slips out of a knot unties it, and the determinant changes.
"""

import numpy as np
from numpy.typing import NDArray

from worker.curves import Points

UNKNOTTED = 1
"""Determinant of a cable without a knot."""

OVERHAND = 3
"""Determinant of an overhand knot, a trefoil."""

FIGURE_EIGHT = 5
"""Determinant of a figure-eight knot."""

_ARC_POINTS = 12
"""Points of the arc that joins the ends around the cable."""

_ARC_EXTENTS = 10.0
"""Distance of that arc from the cable's middle, in the cable's extent."""


def determinant(curve: Points) -> int:
    """Compute the determinant of a curve's knot, seen from above.

    Args:
        curve: (N, 3) points of a centreline from end to end, N >= 2; straight lines join them.

    Returns:
        The determinant, an odd number from 1 up.
    """
    closed = _joined(curve)
    under, over = _crossings(closed)
    if len(under) == 0:
        return UNKNOTTED
    # The strand from one underpass to the next has one number; the strand after the last one is that before the first.
    order = np.sort(under)
    strands = len(order)
    into = np.searchsorted(order, under)
    above = np.searchsorted(order, over) % strands
    rows = np.arange(strands)
    colours = np.zeros((strands, strands))
    np.add.at(colours, (rows, above), 2.0)
    np.add.at(colours, (rows, into), -1.0)
    np.add.at(colours, (rows, (into + 1) % strands), -1.0)
    return round(abs(float(np.linalg.det(colours[1:, 1:]))))


def _joined(curve: Points) -> Points:
    """Close a curve by an arc around it, (N + points, 3), which is higher than all of it."""
    middle = (curve[:, :2].min(axis=0) + curve[:, :2].max(axis=0)) / 2
    extent = float(np.ptp(curve, axis=0).max())
    ends = np.stack([curve[-1], curve[0]])
    x, y = (ends[:, :2] - middle).T
    first, last = np.arctan2(y, x)
    bearing = np.linspace(first, last, _ARC_POINTS)
    arc = np.empty((_ARC_POINTS, 3))
    arc[:, 0] = middle[0] + _ARC_EXTENTS * extent * np.cos(bearing)
    arc[:, 1] = middle[1] + _ARC_EXTENTS * extent * np.sin(bearing)
    arc[:, 2] = curve[:, 2].max() + extent
    lifted = np.column_stack([ends[:, :2], arc[:2, 2]])
    return np.concatenate([curve, lifted[:1], arc, lifted[1:]])


def _crossings(closed: Points) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Find the places, (C,) each, of the lower and the upper strand at each crossing of a closed curve in plan view.

    A place is the number of a segment's first point and the share of the way along it.
    """
    start, edge = closed, np.roll(closed, -1, axis=0) - closed
    i, j = np.triu_indices(len(closed), k=2)
    beside = (i == 0) & (j == len(closed) - 1)
    i, j = i[~beside], j[~beside]
    r, s, w = edge[i], edge[j], start[j] - start[i]
    cross = r[:, 0] * s[:, 1] - r[:, 1] * s[:, 0]
    safe = np.where(cross == 0, np.inf, cross)
    t = (w[:, 0] * s[:, 1] - w[:, 1] * s[:, 0]) / safe
    u = (w[:, 0] * r[:, 1] - w[:, 1] * r[:, 0]) / safe
    met = (cross != 0) & (t >= 0) & (t < 1) & (u >= 0) & (u < 1)
    rise = (w[:, 2] + u * s[:, 2] - t * r[:, 2])[met]
    first, second = (i + t)[met], (j + u)[met]
    return np.where(rise > 0, first, second), np.where(rise > 0, second, first)
