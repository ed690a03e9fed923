"""The smooth curves through the nodes: the cubic splines that are measured, labelled and rendered, and their distances.

A rod's spline has the nodes' numbers as its parameter, and continuous second derivatives; its third derivative is
continuous at the second node from either end ("not-a-knot", de Boor 1978, "A Practical Guide to Splines", ch. IV). It
is the curve of `worker.curves.smooth`. Its second derivatives at the nodes, here called bends, say all of it.
"""

import numpy as np

from worker.simulate.rod.arrays import Bodies
from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.model import Array

REFINEMENTS = 4
"""Steps of Newton's method from the closest places of two chords to those of their curves. In the tightest coils, of
four diameters' radius, each step leaves a tenth of the error or less."""

ALONG = 0.02
"""Determinant of the distance's second derivatives, over the product of its diagonal, below which two curves run along
each other, within 8 degrees if they are straight: the closest places are then looked for at the segments' ends, too."""

SINGULAR = 1e-4
"""Such a determinant below which Newton's method does not tell where along the curves they are closest."""


@compiled
def find_bends(bodies: Bodies, x: Array, bends: Array) -> None:
    """Set `bends` (3, nodes) to the second derivatives of the rods' splines at the nodes, m.

    Inside a rod, bend[i - 1] + 4 bend[i] + bend[i + 1] is six times the second difference of the places; at the second
    node from either end, the bend is the second difference itself.
    """
    pivot = np.empty(x.shape[1])
    for rod in range(len(bodies.length)):
        first, end = bodies.first[rod], bodies.first[rod + 1]
        pivot[first + 1] = 0.0
        for i in range(first + 2, end - 2):
            pivot[i] = 1.0 / (4.0 - pivot[i - 1])
        for c in range(3):
            row, bend = x[c], bends[c]
            bend[first + 1] = row[first] - 2 * row[first + 1] + row[first + 2]
            bend[end - 2] = row[end - 3] - 2 * row[end - 2] + row[end - 1]
            for i in range(first + 2, end - 2):
                bend[i] = pivot[i] * (6.0 * (row[i - 1] - 2 * row[i] + row[i + 1]) - bend[i - 1])
            for i in range(end - 3, first + 1, -1):
                bend[i] -= pivot[i] * bend[i + 1]
            bend[first] = 2 * bend[first + 1] - bend[first + 2]
            bend[end - 1] = 2 * bend[end - 2] - bend[end - 3]


@compiled
def find_bulge(bends: Array, bulge: Array) -> None:
    """Set `bulge` (nodes,) such that a curve is no farther from a chord than the larger value of its ends, m.

    At a share t of a segment the curve leaves the chord by t (1 - t) / 2 times a mean of the bends at the two ends.
    """
    for i in range(len(bulge)):
        bulge[i] = np.sqrt(bends[0, i] ** 2 + bends[1, i] ** 2 + bends[2, i] ** 2) / 8


@compiled
def point(x: Array, bends: Array, c: int, i: int, t: float) -> float:
    """Compute a coordinate of a curve's point, m.

    Args:
        x: (3, nodes) places of the nodes, m.
        bends: (3, nodes) second derivatives at the nodes, m.
        c: number of the coordinate.
        i: number of the segment's first node.
        t: place on the segment, as a share of it, 0 to 1.
    """
    bulge = t * (1 - t) / 6 * ((2 - t) * bends[c, i] + (1 + t) * bends[c, i + 1])
    return float((1 - t) * x[c, i] + t * x[c, i + 1] - bulge)


@compiled
def _slope(x: Array, bends: Array, c: int, i: int, t: float) -> float:
    """Compute a coordinate of a curve's first derivative by the share of the segment, m."""
    return float(
        x[c, i + 1] - x[c, i] - ((2 - 6 * t + 3 * t * t) * bends[c, i] + (1 - 3 * t * t) * bends[c, i + 1]) / 6
    )


@compiled
def closest_on_curves(x: Array, bends: Array, i: int, j: int, s: float, t: float) -> tuple[float, float]:
    """Find the closest places of two segments' curves, by Newton's method from those of the chords.

    Args:
        x: (3, nodes) places of the nodes, m.
        bends: (3, nodes) second derivatives at the nodes, m.
        i: number of one segment's first node.
        j: number of the other segment's first node.
        s: closest place on one chord, as a share of its length.
        t: closest place on the other chord.

    Returns:
        The two places on the curves, as shares of the segments, 0 to 1.
    """
    along = False
    for _ in range(REFINEMENTS):
        # Half the squared distance has the gradient (rs, -rt) and the second derivatives (a, -b; -b, e).
        a = e = b = rs = rt = 0.0
        for c in range(3):
            away = point(x, bends, c, i, s) - point(x, bends, c, j, t)
            p, q = _slope(x, bends, c, i, s), _slope(x, bends, c, j, t)
            a += p * p + away * ((1 - s) * bends[c, i] + s * bends[c, i + 1])
            e += q * q - away * ((1 - t) * bends[c, j] + t * bends[c, j + 1])
            b += p * q
            rs += away * p
            rt += away * q
        determinant = a * e - b * b
        along = along or determinant < ALONG * a * e
        if a <= 0.0 or e <= 0.0 or determinant < SINGULAR * a * e:
            along = True
            break
        ds, dt = (b * rt - e * rs) / determinant, (a * rt - b * rs) / determinant
        # A place at a segment's end stays there, and the other one follows.
        if s + ds < 0.0 or s + ds > 1.0:
            ds = min(max(ds, -s), 1.0 - s)
            dt = (rt + b * ds) / e
        if t + dt < 0.0 or t + dt > 1.0:
            dt = min(max(dt, -t), 1.0 - t)
            ds = min(max((b * dt - rs) / a, -s), 1.0 - s)
        s, t = s + ds, t + dt
        if abs(ds) + abs(dt) < 1e-3:
            break
    return _closest_at_ends(x, bends, i, j, s, t) if along else (s, t)


@compiled
def _closest_at_ends(x: Array, bends: Array, i: int, j: int, s: float, t: float) -> tuple[float, float]:
    """Find the closest of two places and of each segment's ends with its closest place on the other segment's curve."""
    best_s, best_t, least = s, t, _squared(x, bends, i, j, s, t)
    for end in (0.0, 1.0):
        place = _closest_to_point(x, bends, i, end, j, t)
        squared = _squared(x, bends, i, j, end, place)
        if squared < least:
            best_s, best_t, least = end, place, squared
        place = _closest_to_point(x, bends, j, end, i, s)
        squared = _squared(x, bends, i, j, place, end)
        if squared < least:
            best_s, best_t, least = place, end, squared
    return best_s, best_t


@compiled
def _closest_to_point(x: Array, bends: Array, i: int, s: float, j: int, t: float) -> float:
    """Find the place on segment j's curve, from a guess t, that is closest to share s of segment i's curve."""
    for _ in range(REFINEMENTS):
        slope = bend = 0.0
        for c in range(3):
            away = point(x, bends, c, i, s) - point(x, bends, c, j, t)
            q = _slope(x, bends, c, j, t)
            slope += away * q
            bend += q * q - away * ((1 - t) * bends[c, j] + t * bends[c, j + 1])
        if bend <= 0.0:
            break
        t = min(max(t + slope / bend, 0.0), 1.0)
    return t


@compiled
def _squared(x: Array, bends: Array, i: int, j: int, s: float, t: float) -> float:
    """Compute the squared distance of share s of segment i's curve from share t of segment j's, m^2."""
    total = 0.0
    for c in range(3):
        total += (point(x, bends, c, i, s) - point(x, bends, c, j, t)) ** 2
    return total
