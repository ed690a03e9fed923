"""Which of the candidates are near enough in a step to be contacts.

A node's reach in a step is how far around it contact must be looked for: segments that are near in this step are no
farther apart than the reaches of their nodes together.
"""

import numpy as np

from worker.simulate.rod.arrays import Bodies, Integers, Motion
from worker.simulate.rod.broad_phase import Candidates
from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.model import Array

APPROACH_SHARE = 1.5
"""Of their way against each other in a step, within which segments count as near."""

NEARBY_SHARE = 0.05
"""Of the margin within which a pair counts as near although it does not approach."""

SPARE_SHARE = 0.1
"""Of the smaller radius, within which a pair counts as near in any case."""


@compiled
def find_bulge(bodies: Bodies, x: Array, bulge: Array) -> None:
    """Find how far the smooth curve leaves the chords at each node at most, (nodes,) m.

    At fraction t the curve is off its chord by t (1 - t) / 2 times the mean of the second differences of its ends.
    """
    first, length = bodies.first, bodies.length
    for rod in range(len(length)):
        bulge[first[rod]] = bulge[first[rod + 1] - 1] = 0.0
        for i in range(first[rod] + 1, first[rod + 1] - 1):
            dx = x[0, i - 1] - 2 * x[0, i] + x[0, i + 1]
            dy = x[1, i - 1] - 2 * x[1, i] + x[1, i + 1]
            dz = x[2, i - 1] - 2 * x[2, i] + x[2, i + 1]
            # No more than of a rod folded back upon itself.
            bulge[i] = min(np.sqrt(dx * dx + dy * dy + dz * dz) / 8, length[rod] / 4)


@compiled
def find_reach(bodies: Bodies, v: Array, frame: Array, step: float, margin: float, bulge: Array, reach: Array) -> None:
    """Find how far around each node contact must be looked for in a step, in m.

    Args:
        bodies: the rods.
        v: (3, nodes) m/s.
        frame: (3,) velocity that all rods share, m/s.
        step: s.
        margin: how far apart surfaces may be that are still looked at, m.
        bulge: (nodes,) how far the curve leaves the chords, m.
        reach: (nodes,) is set.
    """
    owner, radius = bodies.owner, bodies.radius
    for i in range(len(owner)):
        vx, vy, vz = v[0, i] - frame[0], v[1, i] - frame[1], v[2, i] - frame[2]
        way = APPROACH_SHARE * step * np.sqrt(vx * vx + vy * vy + vz * vz)
        # Two of a pair share the margin and what is to spare.
        reach[i] = (1 + 0.5 * SPARE_SHARE) * radius[owner[i]] + way + 0.5 * NEARBY_SHARE * margin + bulge[i]


@compiled
def find_near(  # noqa: PLR0913, PLR0917 - all of it is needed for each pair
    bodies: Bodies,
    motion: Motion,
    candidates: Candidates,
    bulge: Array,
    reach: Array,
    step: float,
    margin: float,
    near: Integers,
    at: Array,
) -> int:
    """Find the candidates that may touch in this step; the others' impulses are forgotten.

    Args:
        bodies: the rods.
        motion: where they are, and how fast.
        candidates: what they remember is changed.
        bulge: (nodes,) how far the curve leaves the chords, m.
        reach: (nodes,) of each node in this step, m.
        step: s.
        margin: how far apart surfaces may be that are still looked at, m.
        near: (pairs,) their numbers, ascending, are set.
        at: (2, pairs) where on their segments they are closest, in [0, 1], is set.

    Returns:
        How many there are.
    """
    x, v, owner, radius = motion.x, motion.v, bodies.owner, bodies.radius
    one, other, normal, impulse = candidates.one, candidates.other, candidates.normal, candidates.impulse
    count = 0
    for k in range(_meet(_spheres(x, reach), one, other, normal, impulse, near)):
        pair = near[k]
        i, j = one[pair], other[pair]
        s, t = closest(x, i, j)
        away, fast = _between(x, i, j, s, t), _between(v, i, j, s, t)
        distance = _norm(away)
        bulges = max(bulge[i], bulge[i + 1]) + max(bulge[j], bulge[j + 1])
        if distance > _near(radius[owner[i]], radius[owner[j]], step * _norm(fast), margin) + bulges:
            for c in range(3):
                normal[pair, c] = away[c] / distance
                impulse[pair, c] = 0.0
        else:
            near[count] = pair
            at[0, count], at[1, count] = s, t
            count += 1
    return count


@compiled
def _near(one: float, other: float, way: float, margin: float) -> float:
    """How near the axes of two segments must come to each other to count as near, m.

    Args:
        one: radius of one, m.
        other: radius of the other, m.
        way: how far they move against each other in the step, m.
        margin: how far apart surfaces may be that are still looked at, m.
    """
    return one + other + SPARE_SHARE * min(one, other) + min(margin, APPROACH_SHARE * way + NEARBY_SHARE * margin)


@compiled
def _between(x: Array, i: int, j: int, s: float, t: float) -> tuple[float, float, float]:
    """The way from fraction t of segment j to fraction s of segment i; or, of velocities, the relative one."""
    return (
        x[0, i] + s * (x[0, i + 1] - x[0, i]) - x[0, j] - t * (x[0, j + 1] - x[0, j]),
        x[1, i] + s * (x[1, i + 1] - x[1, i]) - x[1, j] - t * (x[1, j + 1] - x[1, j]),
        x[2, i] + s * (x[2, i + 1] - x[2, i]) - x[2, j] - t * (x[2, j + 1] - x[2, j]),
    )


@compiled
def _norm(a: tuple[float, float, float]) -> float:
    return float(np.sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]))


@compiled
def _spheres(x: Array, reach: Array) -> Array:
    """(nodes, 4): middle of the segment that starts at each node, and radius of a sphere around its nodes' reach."""
    spheres = np.zeros((x.shape[1], 4))
    for i in range(x.shape[1] - 1):
        squared = 0.0
        for c in range(3):
            spheres[i, c] = 0.5 * (x[c, i] + x[c, i + 1])
            squared += (x[c, i] - x[c, i + 1]) ** 2
        spheres[i, 3] = 0.5 * np.sqrt(squared) + max(reach[i], reach[i + 1])
    return spheres


@compiled
def _meet(spheres: Array, one: Integers, other: Integers, normal: Array, impulse: Array, near: Integers) -> int:
    """Find the pairs whose spheres meet; the others only remember where they are. Returns how many there are."""
    count = 0
    for pair in range(len(one)):
        i, j = one[pair], other[pair]
        dx, dy, dz = spheres[i, 0] - spheres[j, 0], spheres[i, 1] - spheres[j, 1], spheres[i, 2] - spheres[j, 2]
        within = spheres[i, 3] + spheres[j, 3]
        if dx * dx + dy * dy + dz * dz <= within * within:
            near[count] = pair
            count += 1
        else:
            # Of apart spheres, any two points are on the same sides as the middles.
            normal[pair, 0], normal[pair, 1], normal[pair, 2] = dx, dy, dz
            impulse[pair, 0] = impulse[pair, 1] = impulse[pair, 2] = 0.0
    return count


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
