"""Finds the candidate pairs that are near enough in a step to be contacts.

A node's reach in a step is the distance around it within which contact must be looked for: two segments that are near
in this step are no farther apart than the sum of their nodes' reaches. Spheres rule out most pairs, then chords; where
chords are near, the distance of the curves decides.
"""

import numpy as np

from worker.simulate.rod.arrays import Bodies, Integers, Motion
from worker.simulate.rod.broad_phase import Candidates
from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.curves import closest_on_curves, point
from worker.simulate.rod.model import Array

APPROACH_SHARE = 1.5
"""Distance of two surfaces within which segments count as near, as a multiple of their relative movement in a step."""

NEARBY_SHARE = 0.05
"""Distance of two surfaces within which segments count as near without approaching, as a share of the margin."""

SPARE_SHARE = 0.1
"""Distance of two surfaces within which segments always count as near, as a share of the smaller radius."""


@compiled
def find_reach(bodies: Bodies, v: Array, frame: Array, step: float, margin: float, bulge: Array, reach: Array) -> None:
    """Find the distance around each node within which contact must be looked for in a step.

    Args:
        bodies: the rods.
        v: (3, nodes) velocities, m/s.
        frame: (3,) velocity that all rods share, m/s.
        step: time step, s.
        margin: largest distance of two surfaces that may count as near, m.
        bulge: (nodes,) largest distance of the curve from its chords, m.
        reach: (nodes,) array that gets the distances, m.
    """
    owner, radius = bodies.owner, bodies.radius
    for i in range(len(owner)):
        vx, vy, vz = v[0, i] - frame[0], v[1, i] - frame[1], v[2, i] - frame[2]
        way = APPROACH_SHARE * step * np.sqrt(vx * vx + vy * vy + vz * vz)
        # The two segments of a pair share the margin and the spare distance.
        reach[i] = (1 + 0.5 * SPARE_SHARE) * radius[owner[i]] + way + 0.5 * NEARBY_SHARE * margin + bulge[i]


@compiled
def find_near(  # noqa: PLR0913, PLR0917 - each pair needs all of them
    bodies: Bodies,
    motion: Motion,
    candidates: Candidates,
    bends: Array,
    bulge: Array,
    reach: Array,
    step: float,
    margin: float,
    near: Integers,
    at: Array,
    way: Array,
) -> int:
    """Find the candidate pairs that may touch in this step, and set the impulses of the others to 0.

    Args:
        bodies: the rods.
        motion: places and velocities of the rods.
        candidates: pairs that may touch; their memory changes.
        bends: (3, nodes) second derivatives of the curves at the nodes, m.
        bulge: (nodes,) largest distance of the curve from its chords, m.
        reach: (nodes,) reach of each node in this step, m.
        step: time step, s.
        margin: largest distance of two surfaces that may count as near, m.
        near: (pairs,) array that gets the numbers of the pairs found, ascending, from its beginning.
        at: (2, pairs) array that gets the place on each segment whose curve is closest to the other one, as a share of
            the segment, 0 to 1.
        way: (pairs, 3) array that gets the vector from the second of these places to the first, m.

    Returns:
        The number of pairs found.
    """
    x, v, owner, radius = motion.x, motion.v, bodies.owner, bodies.radius
    one, other, normal, impulse = candidates.one, candidates.other, candidates.normal, candidates.impulse
    count = 0
    for k in range(_meet(_spheres(x, reach), one, other, normal, impulse, near)):
        pair = near[k]
        i, j = one[pair], other[pair]
        s, t = closest(x, i, j)
        away, fast = _between(x, i, j, s, t), _norm(_between(v, i, j, s, t))
        limit = _near(radius[owner[i]], radius[owner[j]], step * fast, margin)
        bulges = max(bulge[i], bulge[i + 1]) + max(bulge[j], bulge[j + 1])
        if _norm(away) <= limit + bulges:
            s, t = closest_on_curves(x, bends, i, j, s, t)
            away = _away(x, bends, i, j, s, t)
        distance = _norm(away)
        if distance > limit:
            for c in range(3):
                normal[pair, c] = away[c] / distance
                impulse[pair, c] = 0.0
        else:
            near[count] = pair
            at[0, count], at[1, count] = s, t
            way[count, 0], way[count, 1], way[count, 2] = away
            count += 1
    return count


@compiled
def _near(one: float, other: float, way: float, margin: float) -> float:
    """Compute the distance of two segments' axes up to which they count as near, m.

    Args:
        one: radius of one segment, m.
        other: radius of the other segment, m.
        way: relative movement of the two in the step, m.
        margin: largest distance of two surfaces that may count as near, m.
    """
    return one + other + SPARE_SHARE * min(one, other) + min(margin, APPROACH_SHARE * way + NEARBY_SHARE * margin)


@compiled
def _between(x: Array, i: int, j: int, s: float, t: float) -> tuple[float, float, float]:
    """Compute the vector from share t of segment j to share s of segment i; from velocities, the relative velocity."""
    return (
        x[0, i] + s * (x[0, i + 1] - x[0, i]) - x[0, j] - t * (x[0, j + 1] - x[0, j]),
        x[1, i] + s * (x[1, i + 1] - x[1, i]) - x[1, j] - t * (x[1, j + 1] - x[1, j]),
        x[2, i] + s * (x[2, i + 1] - x[2, i]) - x[2, j] - t * (x[2, j + 1] - x[2, j]),
    )


@compiled
def _away(x: Array, bends: Array, i: int, j: int, s: float, t: float) -> tuple[float, float, float]:
    """Compute the vector from share t of segment j's curve to share s of segment i's, m."""
    return (
        point(x, bends, 0, i, s) - point(x, bends, 0, j, t),
        point(x, bends, 1, i, s) - point(x, bends, 1, j, t),
        point(x, bends, 2, i, s) - point(x, bends, 2, j, t),
    )


@compiled
def _norm(a: tuple[float, float, float]) -> float:
    return float(np.sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]))


@compiled
def _spheres(x: Array, reach: Array) -> Array:
    """Make the sphere around each segment and its nodes' reach, (nodes, 4): middle and radius, by its first node."""
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
    """Find the pairs whose spheres meet; the others get their present direction as memory, and no impulse.

    Args:
        spheres: (nodes, 4) middle and radius of the sphere around each segment, m.
        one: (pairs,) number of the first segment's first node.
        other: (pairs,) number of the second segment's first node.
        normal: (pairs, 3) remembered directions, changed in place.
        impulse: (pairs, 3) impulses, N s, changed in place.
        near: (pairs,) array that gets the numbers of the pairs found, ascending, from its beginning.

    Returns:
        The number of pairs found.
    """
    count = 0
    for pair in range(len(one)):
        i, j = one[pair], other[pair]
        dx, dy, dz = spheres[i, 0] - spheres[j, 0], spheres[i, 1] - spheres[j, 1], spheres[i, 2] - spheres[j, 2]
        within = spheres[i, 3] + spheres[j, 3]
        if dx * dx + dy * dy + dz * dz <= within * within:
            near[count] = pair
            count += 1
        else:
            # Of two separate spheres, any two points lie on the same sides of each other as the middles.
            normal[pair, 0], normal[pair, 1], normal[pair, 2] = dx, dy, dz
            impulse[pair, 0] = impulse[pair, 1] = impulse[pair, 2] = 0.0
    return count


@compiled
def closest(x: Array, i: int, j: int) -> tuple[float, float]:
    """Find the closest points of two segments (Ericson 2005, "Real-Time Collision Detection", 5.1.9).

    Args:
        x: (3, nodes) places of the nodes, m.
        i: number of one segment's first node.
        j: number of the other segment's first node.

    Returns:
        The place of each point on its segment, as a share of the length, 0 to 1.
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
