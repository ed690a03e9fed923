"""The smooth curves through the nodes: the cubic splines that are measured, labelled and rendered, and their distances.

A rod's spline has the nodes' numbers as its parameter, and continuous second derivatives; its third derivative is
continuous at the second node from either end ("not-a-knot", de Boor 1978, "A Practical Guide to Splines", ch. IV). It
is the curve of `worker.curves.smooth`. Its second derivatives at the nodes, here called bends, say all of it.
"""

from typing import NamedTuple

import numpy as np

from worker.simulate.rod.arrays import Bodies
from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.model import Array

REFINEMENTS = 4
"""Steps of Newton's method from the closest places of two chords to those of their curves. In the tightest coils, of
four diameters' radius, each step leaves a tenth of the error or less."""

ENOUGH = 1e-2
"""Change of the places in a step of Newton's method, in segments, after which they are exact enough: a tenth of it or
less is left."""

ALONG = 0.02
"""Determinant of the distance's second derivatives, over the product of its diagonal, below which two curves run along
each other, within 8 degrees if they are straight: the closest places are then looked for all along."""

PARABOLAS = 2
"""Parabolas by which the closest place is refined where curves run along each other."""

SINGULAR = 1e-4
"""Such a determinant below which Newton's method does not tell where along the curves they are closest."""

Vector = tuple[float, float, float]
"""Coordinates x, y and z."""


class Polynomial(NamedTuple):
    """The curve of a segment, a + b t + c t^2 + d t^3 at the share t of it, in m."""

    a: Vector
    b: Vector
    c: Vector
    d: Vector


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
    one, other = _polynomial(x, bends, i), _polynomial(x, bends, j)
    along = False
    for _ in range(REFINEMENTS):
        # Half the squared distance has the gradient (rs, -rt) and the second derivatives (a, -b; -b, e).
        px, py, pz = _at(one, s)
        qx, qy, qz = _at(other, t)
        ax, ay, az = px - qx, py - qy, pz - qz
        px, py, pz = _slope(one, s)
        qx, qy, qz = _slope(other, t)
        kx, ky, kz = _bend(one, s)
        lx, ly, lz = _bend(other, t)
        a = px * px + py * py + pz * pz + ax * kx + ay * ky + az * kz
        e = qx * qx + qy * qy + qz * qz - ax * lx - ay * ly - az * lz
        b = px * qx + py * qy + pz * qz
        rs = ax * px + ay * py + az * pz
        rt = ax * qx + ay * qy + az * qz
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
        if abs(ds) + abs(dt) < ENOUGH:
            break
    return _closest_along(one, other, s, t) if along else (s, t)


@compiled
def _polynomial(x: Array, bends: Array, i: int) -> Polynomial:
    """Find the coefficients of a segment's curve, in m, from those of its bends at either end."""
    x2, y2, z2 = 0.5 * bends[0, i], 0.5 * bends[1, i], 0.5 * bends[2, i]
    x3, y3, z3 = (
        (bends[0, i + 1] - bends[0, i]) / 6,
        (bends[1, i + 1] - bends[1, i]) / 6,
        (bends[2, i + 1] - bends[2, i]) / 6,
    )
    return Polynomial(
        (x[0, i], x[1, i], x[2, i]),
        (x[0, i + 1] - x[0, i] - x2 - x3, x[1, i + 1] - x[1, i] - y2 - y3, x[2, i + 1] - x[2, i] - z2 - z3),
        (x2, y2, z2),
        (x3, y3, z3),
    )


@compiled
def _at(curve: Polynomial, t: float) -> Vector:
    a, b, c, d = curve
    return (
        a[0] + t * (b[0] + t * (c[0] + t * d[0])),
        a[1] + t * (b[1] + t * (c[1] + t * d[1])),
        a[2] + t * (b[2] + t * (c[2] + t * d[2])),
    )


@compiled
def _slope(curve: Polynomial, t: float) -> Vector:
    """Compute a curve's first derivative by the share of the segment, m."""
    _, b, c, d = curve
    return (
        b[0] + t * (2 * c[0] + t * 3 * d[0]),
        b[1] + t * (2 * c[1] + t * 3 * d[1]),
        b[2] + t * (2 * c[2] + t * 3 * d[2]),
    )


@compiled
def _bend(curve: Polynomial, t: float) -> Vector:
    """Compute a curve's second derivative by the share of the segment, m."""
    _, _, c, d = curve
    return 2 * c[0] + 6 * t * d[0], 2 * c[1] + 6 * t * d[1], 2 * c[2] + 6 * t * d[2]


@compiled
def _closest_along(one: Polynomial, other: Polynomial, s: float, t: float) -> tuple[float, float]:
    """Find the closest places of two segments' curves that run along each other; s and t are a first guess.

    Along the stretch where one is beside the other, their squared distance is about a parabola, whose lowest place is
    refined.
    """
    start, end = _closest_to_point(_at(other, 0.0), one, s), _closest_to_point(_at(other, 1.0), one, s)
    low, high = min(start, end), max(start, end)
    middle = 0.5 * (low + high)
    best_s, best_t, least = s, t, _squared(one, other, s, t)
    heights = (0.0, 0.0, 0.0)
    for place in (low, middle, high):
        beside, squared = _beside(one, other, place, t)
        heights = heights[1], heights[2], squared
        if squared < least:
            best_s, best_t, least = place, beside, squared
    at_low, at_middle, at_high = heights
    for _ in range(PARABOLAS):
        place = _lowest(low, middle, high, at_low, at_middle, at_high)
        if not low < place < high:
            break
        beside, squared = _beside(one, other, place, t)
        if squared < least:
            best_s, best_t, least = place, beside, squared
        if place < middle:
            if squared < at_middle:
                high, at_high, middle, at_middle = middle, at_middle, place, squared
            else:
                low, at_low = place, squared
        elif squared < at_middle:
            low, at_low, middle, at_middle = middle, at_middle, place, squared
        else:
            high, at_high = place, squared
    return best_s, best_t


@compiled
def _beside(one: Polynomial, other: Polynomial, s: float, t: float) -> tuple[float, float]:
    """Find the share of `other`, from a guess t, that is closest to share s of `one`, and their distance squared."""
    place = _closest_to_point(_at(one, s), other, t)
    return place, _squared(one, other, s, place)


@compiled
def _lowest(a: float, b: float, c: float, at_a: float, at_b: float, at_c: float) -> float:
    """Find the lowest place of the parabola through three points a < b < c; NaN or inf if it has none."""
    left, right = (at_b - at_a) / (b - a), (at_c - at_b) / (c - b)
    curvature = (right - left) / (c - a)
    return 0.5 * (a + b) - 0.5 * left / curvature if curvature > 0.0 else np.inf


@compiled
def _closest_to_point(place: Vector, curve: Polynomial, t: float) -> float:
    """Find the share of a segment, from a guess t, at which its curve is closest to a place."""
    for _ in range(REFINEMENTS):
        x, y, z = _at(curve, t)
        ax, ay, az = place[0] - x, place[1] - y, place[2] - z
        qx, qy, qz = _slope(curve, t)
        kx, ky, kz = _bend(curve, t)
        bend = qx * qx + qy * qy + qz * qz - ax * kx - ay * ky - az * kz
        if bend <= 0.0:
            break
        before = t
        t = min(max(t + (ax * qx + ay * qy + az * qz) / bend, 0.0), 1.0)
        if abs(t - before) < ENOUGH:
            break
    return t


@compiled
def _squared(one: Polynomial, other: Polynomial, s: float, t: float) -> float:
    """Compute the squared distance of share s of one curve from share t of the other, m^2."""
    px, py, pz = _at(one, s)
    qx, qy, qz = _at(other, t)
    return (px - qx) ** 2 + (py - qy) ** 2 + (pz - qz) ** 2
