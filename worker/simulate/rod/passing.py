"""Finds rods that would pass through each other in a step, so that no step in which they do is made.

Every node moves along a straight line in a step. Two segments' centrelines pass through each other if their four ends
come to lie in one plane, which is a cubic equation in time, while the segments cross (Provot 1997, "Collision and
self-collision handling in cloth model dedicated to design garments"). Whether the volume that the four ends span has
changed its sign tells, as steps are so short that it changes once.
"""

import numpy as np

from worker.simulate.rod.arrays import Contacts
from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.model import Array
from worker.simulate.rod.narrow_phase import closest

BISECTIONS = 40
"""Halvings of the step that narrow the time of a meeting down to rounding."""


@compiled
def count_passes(contacts: Contacts, pairs: int, start: Array, end: Array) -> int:
    """Count the contacts whose segments pass through each other in a step, to the wrong side.

    Rods that start within each other have to pass to get to their sides.

    Args:
        contacts: contacts between rods, at the beginning of their arrays.
        pairs: number of contacts.
        start: (3, nodes) places of the nodes at the start of the step, m.
        end: (3, nodes) places of the nodes at its end, m.
    """
    count = 0
    for n in range(pairs):
        i, j = contacts.segment[0, n], contacts.segment[1, n]
        s, t = closest(start, i, j)
        squared = rise = 0.0
        for c in range(3):
            before, after = _between(start, i, j, s, t, c), _between(end, i, j, s, t, c)
            squared += before * before
            rise += contacts.normal[n, c] * (after - before)
        # Segments that move less than they are apart can't meet.
        way = max(_way(start, end, i), _way(start, end, i + 1)) + max(_way(start, end, j), _way(start, end, j + 1))
        if rise < 0.0 and squared <= way * way and _pass(start, end, i, j):
            count += 1
    return count


@compiled
def _between(x: Array, i: int, j: int, s: float, t: float, c: int) -> float:
    """Compute a coordinate of the vector, m, from the place t on segment j to the place s on segment i."""
    return float((1 - s) * x[c, i] + s * x[c, i + 1] - (1 - t) * x[c, j] - t * x[c, j + 1])


@compiled
def _way(start: Array, end: Array, i: int) -> float:
    """Compute the distance by which a node moves, m."""
    return float(
        np.sqrt((end[0, i] - start[0, i]) ** 2 + (end[1, i] - start[1, i]) ** 2 + (end[2, i] - start[2, i]) ** 2)
    )


@compiled
def _pass(start: Array, end: Array, i: int, j: int) -> bool:
    """Whether two segments change sides while they cross."""
    before, after = _volume(start, end, i, j, 0.0), _volume(start, end, i, j, 1.0)
    if before * after >= 0.0:
        return False
    low, high = 0.0, 1.0
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        if _volume(start, end, i, j, middle) * before > 0.0:
            low = middle
        else:
            high = middle
    uu = vv = uv = uw = vw = 0.0
    for c in range(3):
        u, v, w = _edges(start, end, i, j, low, c)
        uu, vv, uv, uw, vw = uu + u * u, vv + v * v, uv + u * v, uw + u * w, vw + v * w
    spread = uu * vv - uv * uv
    if spread <= 1e-12 * uu * vv:
        return False
    s, t = (uw * vv - uv * vw) / spread, (uv * uw - uu * vw) / spread
    return bool(0.0 <= s <= 1.0 and 0.0 <= t <= 1.0)


@compiled
def _edges(start: Array, end: Array, i: int, j: int, time: float, c: int) -> tuple[float, float, float]:
    """Compute a coordinate of two segments and of the vector between their first ends, at a share of the step, m."""
    p, p_end = (
        start[c, i] + time * (end[c, i] - start[c, i]),
        start[c, i + 1] + time * (end[c, i + 1] - start[c, i + 1]),
    )
    q, q_end = (
        start[c, j] + time * (end[c, j] - start[c, j]),
        start[c, j + 1] + time * (end[c, j + 1] - start[c, j + 1]),
    )
    return p_end - p, q_end - q, q - p


@compiled
def _volume(start: Array, end: Array, i: int, j: int, time: float) -> float:
    """Compute the triple product of two segments and the vector between their first ends, at a share of the step."""
    u0, v0, w0 = _edges(start, end, i, j, time, 0)
    u1, v1, w1 = _edges(start, end, i, j, time, 1)
    u2, v2, w2 = _edges(start, end, i, j, time, 2)
    return w0 * (u1 * v2 - u2 * v1) + w1 * (u2 * v0 - u0 * v2) + w2 * (u0 * v1 - u1 * v0)
