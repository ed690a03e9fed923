"""Which segments may come into contact: a grid over the floor's plane, and a list that lasts several steps."""

from typing import NamedTuple

import numpy as np

from worker.rod.arrays import Bodies, Integers
from worker.rod.compiled import compiled
from worker.rod.model import Array

NEIGHBOUR_RADII = 6.0
"""Segments of one rod nearer to each other along it than so many radii never count as touching."""


class Candidates(NamedTuple):
    """Pairs of segments, in ascending order of (one, other), with what is remembered of each.

    Attributes:
        one: (pairs,) first node of a segment.
        other: (pairs,) first node of another, > one.
        normal: (pairs, 3) unit vector from the other to the one when last seen; 0 if never.
        impulse: (pairs, 3) N s on the one in the last step.
        built_at: (3, nodes) where the nodes were when the list was made.
    """

    one: Integers
    other: Integers
    normal: Array
    impulse: Array
    built_at: Array


@compiled
def closest(x: Array, i: int, j: int) -> tuple[float, float]:
    """Where segments i and j are closest (Ericson 2005, "Real-Time Collision Detection", 5.1.9).

    Args:
        x: (3, nodes).
        i: first node of one segment.
        j: first node of the other.

    Returns:
        The fractions along them, in [0, 1].
    """
    d1x, d1y, d1z = x[0, i + 1] - x[0, i], x[1, i + 1] - x[1, i], x[2, i + 1] - x[2, i]
    d2x, d2y, d2z = x[0, j + 1] - x[0, j], x[1, j + 1] - x[1, j], x[2, j + 1] - x[2, j]
    rx, ry, rz = x[0, i] - x[0, j], x[1, i] - x[1, j], x[2, i] - x[2, j]
    a = d1x * d1x + d1y * d1y + d1z * d1z
    e = d2x * d2x + d2y * d2y + d2z * d2z
    f = d2x * rx + d2y * ry + d2z * rz
    c = d1x * rx + d1y * ry + d1z * rz
    b = d1x * d2x + d1y * d2y + d1z * d2z
    denominator = a * e - b * b
    s = 0.0
    if denominator > 1e-9 * a * e:
        s = min(max((b * f - c * e) / denominator, 0.0), 1.0)
    t = (b * s + f) / e
    if t < 0.0:
        t = 0.0
        s = min(max(-c / a, 0.0), 1.0)
    elif t > 1.0:
        t = 1.0
        s = min(max((b - c) / a, 0.0), 1.0)
    return s, t


@compiled
def _distance(x: Array, i: int, j: int) -> float:
    s, t = closest(x, i, j)
    total = 0.0
    for c in range(3):
        p = x[c, i] + s * (x[c, i + 1] - x[c, i])
        q = x[c, j] + t * (x[c, j + 1] - x[c, j])
        total += (p - q) * (p - q)
    return float(np.sqrt(total))


@compiled
def _cells(bodies: Bodies, x: Array, size: float) -> tuple[Integers, Integers, Integers, int]:
    """Sort segments into square cells: the cell of each node's segment, where cells start, their segments, columns."""
    nodes = len(bodies.owner)
    left, bottom = x[0].min(), x[1].min()
    # Rods that lie far apart would ask for more cells than there are segments; bigger ones serve as well.
    width, depth = x[0].max() - left, x[1].max() - bottom
    edge = max(size, np.sqrt(width * depth / (4.0 * nodes)), max(width, depth) / (4.0 * nodes))
    columns = int(depth / edge) + 1
    cell = np.empty(nodes, np.int64)
    starts = np.zeros((int(width / edge) + 1) * columns + 1, np.int64)
    for i in range(nodes):
        cell[i] = int((x[0, i] - left) / edge) * columns + int((x[1, i] - bottom) / edge)
        starts[cell[i] + 1] += 1
    starts = np.cumsum(starts)
    fill = starts.copy()
    members = np.empty(nodes, np.int64)
    for i in range(nodes):
        members[fill[cell[i]]] = i
        fill[cell[i]] += 1
    return cell, starts, members, columns


@compiled
def _bounding_spheres(bodies: Bodies, x: Array) -> Array:
    """(nodes, 4): middle of the segment that starts at each node, and the radius of a sphere around it."""
    spheres = np.empty((x.shape[1], 4))
    for i in range(x.shape[1]):
        j = min(i + 1, x.shape[1] - 1)
        squared = 0.0
        for c in range(3):
            spheres[i, c] = 0.5 * (x[c, i] + x[c, j])
            squared += (x[c, i] - x[c, j]) ** 2
        spheres[i, 3] = 0.5 * np.sqrt(squared) + bodies.radius[bodies.owner[i]]
    return spheres


@compiled
def _are_neighbours(bodies: Bodies, i: int, j: int) -> bool:
    rod = bodies.owner[i]
    if rod != bodies.owner[j]:
        return False
    between = (abs(i - j) - 1) * bodies.length[rod]
    return between < NEIGHBOUR_RADII * bodies.radius[rod] or abs(i - j) < 2


@compiled
def _may_touch(bodies: Bodies, x: Array, i: int, j: int, margin: float) -> bool:
    """Whether the surfaces of two segments are nearer than `margin`, and they are no neighbours."""
    if j + 1 == len(bodies.owner) or bodies.owner[j + 1] != bodies.owner[j] or _are_neighbours(bodies, i, j):
        return False
    return bool(_distance(x, i, j) < bodies.radius[bodies.owner[i]] + bodies.radius[bodies.owner[j]] + margin)


@compiled
def _near_spheres(spheres: Array, i: int, members: Integers, margin: float, near: Integers) -> int:
    """Those of `members`, > i, whose spheres are nearer than `margin` to that of segment i; returns their number."""
    count = 0
    for j in members:
        if j > i:
            dx, dy, dz = spheres[j, 0] - spheres[i, 0], spheres[j, 1] - spheres[i, 1], spheres[j, 2] - spheres[i, 2]
            apart = spheres[i, 3] + spheres[j, 3] + margin
            if dx * dx + dy * dy + dz * dz <= apart * apart:
                near[count] = j
                count += 1
    return count


@compiled
def _longer(keys: Integers) -> Integers:
    """A copy with twice the room."""
    longer = np.empty(2 * len(keys), np.int64)
    longer[: len(keys)] = keys
    return longer


@compiled
def find_candidates(bodies: Bodies, x: Array, margin: float, before: Candidates) -> Candidates:
    """All pairs of segments with surfaces nearer than `margin`, in m; what `before` remembers of them is kept."""
    nodes = len(bodies.owner)
    cell, starts, members, columns = _cells(bodies, x, bodies.length.max() + 2 * bodies.radius.max() + margin)
    rows = (len(starts) - 1) // columns
    spheres = _bounding_spheres(bodies, x)
    keys = np.empty(8 * nodes, np.int64)
    near = np.empty(nodes, np.int64)
    count = 0
    for i in range(nodes - 1):
        if bodies.owner[i + 1] != bodies.owner[i]:
            continue
        row, column = cell[i] // columns, cell[i] % columns
        left, right = max(0, column - 1), min(columns, column + 2)
        for neighbour_row in range(max(0, row - 1), min(rows, row + 2)):
            # The cells of a row follow each other, and so do their members.
            there = members[starts[neighbour_row * columns + left] : starts[neighbour_row * columns + right]]
            for k in range(_near_spheres(spheres, i, there, margin, near)):
                if _may_touch(bodies, x, i, near[k], margin):
                    if count == len(keys):
                        keys = _longer(keys)
                    keys[count] = i * nodes + near[k]
                    count += 1
    return _with_memory(np.sort(keys[:count]), before, x)


@compiled
def _with_memory(keys: Integers, before: Candidates, x: Array) -> Candidates:
    """The pairs of ascending keys i * nodes + j, with what is remembered of those that were there before."""
    nodes, count = x.shape[1], len(keys)
    normal, impulse = np.zeros((count, 3)), np.zeros((count, 3))
    one, other = np.empty(count, np.int64), np.empty(count, np.int64)
    k = 0
    for pair in range(count):
        one[pair], other[pair] = keys[pair] // nodes, keys[pair] % nodes
        while k < len(before.one) and before.one[k] * nodes + before.other[k] < keys[pair]:
            k += 1
        if k < len(before.one) and before.one[k] * nodes + before.other[k] == keys[pair]:
            normal[pair] = before.normal[k]
            impulse[pair] = before.impulse[k]
    return Candidates(one, other, normal, impulse, x.copy())


@compiled
def drift(x: Array, built_at: Array) -> float:
    """Twice the farthest that a node has moved against the common motion of all since the list was made, m."""
    nodes = x.shape[1]
    mean = np.zeros(3)
    for c in range(3):
        for i in range(nodes):
            mean[c] += x[c, i] - built_at[c, i]
        mean[c] /= nodes
    worst = 0.0
    for i in range(nodes):
        dx = x[0, i] - built_at[0, i] - mean[0]
        dy = x[1, i] - built_at[1, i] - mean[1]
        dz = x[2, i] - built_at[2, i] - mean[2]
        worst = max(worst, dx * dx + dy * dy + dz * dz)
    return float(2 * np.sqrt(worst))


def no_candidates(x: Array) -> Candidates:
    """An empty list."""
    none = np.zeros(0, np.int64)
    return Candidates(none, none, np.zeros((0, 3)), np.zeros((0, 3)), x.copy())
