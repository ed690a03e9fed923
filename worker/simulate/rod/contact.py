"""Contact: the places where rods touch, and the impulses that keep them apart and act as friction.

A contact lies where the smooth curves through the nodes are closest, not the chords. Its distance is that of the
splines of `worker.simulate.rod.curves`. It acts on four nodes at either side, with the weights of the mean of the two
parabolas at a segment's ends (a Catmull-Rom curve), which comes close to the spline.

The implicit operator, with bending, gives the velocity that an impulse causes, so that a contact knows how soft a rod
is there. As the operator is the same in x, y and z, a contact's own block is a multiple of the unit matrix, and
Coulomb's cone is a true cone.

Contacts are speculative: a pair that would meet within the step is stopped where it touches, whatever its speed, so
that nothing tunnels. A pair remembers its sides, and a curve on the wrong side is pushed back. Rods that start within
each other have no sides yet: the first of them counts as the lower one at every crossing.
"""

import numpy as np
from numpy.typing import NDArray

from worker.simulate.rod.arrays import BY_NO_IMPULSE, Bodies, Contacts, Integers, Motion, Scratch
from worker.simulate.rod.bending import Operator
from worker.simulate.rod.broad_phase import Candidates
from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.duplicates import find_pushing
from worker.simulate.rod.model import Array
from worker.simulate.rod.narrow_phase import find_near

DEPENETRATION_SHARE = 0.2
"""Largest share of a penetration that a step undoes."""

UNDOING_S = 0.01
"""Time constant of undoing a penetration, in seconds: a rod that is pushed out faster falls back, and never rests."""

DEEP_SHARE = 0.9
"""Distance of two rods' axes, as a share of that at which they touch, below which they have cut into each other deeply:
the direction between their axes may not lead out."""

TURN_SHARE = 0.5
"""Cosine of the largest angle between the direction between the axes of such rods and the direction remembered."""

SLOP_RADII = 0.002
"""Penetration that is not undone, in the smaller radius: lifting a rod out would give it energy."""


@compiled
def room_for_contacts(pairs: int, operator: Operator) -> Contacts:
    """Make arrays for as many contacts as there are candidate pairs."""
    widest = operator.response.shape[1] + 3
    return Contacts(
        np.empty(pairs, np.int64),
        np.empty((2, pairs), np.int64),
        np.empty((2, pairs)),
        np.empty((2, pairs), np.int64),
        np.empty((2, pairs, 4)),
        np.empty((pairs, 3)),
        np.empty(pairs),
        np.empty(pairs),
        np.empty((2, pairs)),
        np.empty((2, pairs), np.int64),
        np.empty((2, pairs), np.int64),
        np.empty((2, pairs, widest)),
    )


@compiled
def _weigh(weights: Array, side: int, n: int, i: int, t: float, first: int, end: int) -> int:
    """Find the four nodes, and their weights, that give the curve's point at a place on a segment.

    Args:
        weights: (2, n, 4) array whose entry [side, n] gets the weights.
        side: side of the contact, 0 or 1.
        n: number of the contact.
        i: number of the segment's first node.
        t: place on the segment, as a share of its length, 0 to 1.
        first: number of the rod's first node.
        end: number after that of the rod's last node.

    Returns:
        The number of the first of the four nodes.
    """
    base = min(max(i - 1, first), end - 4)
    for k in range(4):
        weights[side, n, k] = 0.0
    k = i - base
    weights[side, n, k] = 1 - t
    weights[side, n, k + 1] = t
    bulge = -0.5 * t * (1 - t)
    # An end segment has one parabola, which counts whole: the curve is about as bent there as beside.
    before = 0.0 if i == first else 1.0 if i + 2 == end else 1 - t
    after = 1.0 - before
    if before > 0.0:
        weights[side, n, k - 1] += bulge * before
        weights[side, n, k] -= 2 * bulge * before
        weights[side, n, k + 1] += bulge * before
    if after > 0.0:
        weights[side, n, k] += bulge * after
        weights[side, n, k + 1] -= 2 * bulge * after
        weights[side, n, k + 2] += bulge * after
    return int(base)


@compiled
def gather_contacts(
    bodies: Bodies,
    operator: Operator,
    motion: Motion,
    candidates: Candidates,
    scratch: Scratch,
    margin: float,
    contacts: Contacts,
) -> int:
    """Fill in the contacts of this step.

    Args:
        bodies: the rods.
        operator: operator of this time step.
        motion: places and velocities of the rods.
        candidates: pairs that may touch; their memory changes.
        scratch: arrays of the step: `bends`, `bulge` and `reach` are read.
        margin: largest distance of two surfaces that may count as near, m.
        contacts: arrays that get the contacts.

    Returns:
        The number of contacts.
    """
    owner, radius, first = bodies.owner, bodies.radius, bodies.first
    pairs, at, base, weights = contacts.pair, contacts.at, contacts.base, contacts.weights
    segments, remembered, impulse = (candidates.one, candidates.other), candidates.normal, candidates.impulse
    normal = contacts.normal
    near = find_near(
        bodies,
        motion,
        candidates,
        scratch.bends,
        scratch.bulge,
        scratch.reach,
        operator.step,
        margin,
        pairs,
        at,
        normal,
    )
    pushing = np.empty(near, np.int64)
    find_pushing(candidates.one, candidates.other, pairs, near, at, normal, impulse, pushing)
    count = 0
    for n in range(near):
        pair = pairs[n]
        for side in range(2):
            i = segments[side][pair]
            rod = owner[i]
            contacts.segment[side, count] = i
            base[side, count] = _weigh(weights, side, count, i, at[side, n], first[rod], first[rod + 1])
        one, other = radius[owner[segments[0][pair]]], radius[owner[segments[1][pair]]]
        # `count` is never ahead of `n`, so no pair is overwritten before it is read.
        normal[count] = normal[n]
        distance = _turn(normal, count, remembered, pair, one + other)
        _forget_pull(impulse, pair, normal, count)
        if _can_answer(bodies.pinned, base, count):
            pairs[count] = pair
            contacts.compliance[count], contacts.approach[count] = 0.0, -np.inf
            if pushing[n] == n:
                contacts.compliance[count] = BY_NO_IMPULSE
                contacts.approach[count] = allowed_approach(distance - one - other, operator.step, min(one, other))
            count += 1
    return count


@compiled
def _can_answer(pinned: NDArray[np.bool_], base: Integers, n: int) -> bool:
    """Whether a node of contact n's four at either side, from `base[side, n]` on, is not pinned."""
    for side in range(2):
        for k in range(4):
            if not pinned[base[side, n] + k]:
                return True
    return False


@compiled
def _turn(normal: Array, n: int, memory: Array, pair: int, touching: float) -> float:
    """Turn the vector `normal[n]` into the unit vector along which the first side leaves the second one.

    Args:
        normal: (n, 3) vectors from the second side to the first, m; that of the contact becomes the unit vector.
        n: number of the contact.
        memory: (pairs, 3) last such vectors or unit vectors, 0 for none; that of the pair becomes the unit vector.
        pair: number of the contact's candidate pair.
        touching: distance of the two axes at which the rods touch, m.

    Returns:
        The distance of the first side along the unit vector, m, negative if it is on the wrong side.
    """
    squared = known = side = 0.0
    for c in range(3):
        squared += normal[n, c] * normal[n, c]
        known += memory[pair, c] * memory[pair, c]
        side += normal[n, c] * memory[pair, c]
    distance, known = np.sqrt(squared), np.sqrt(known)
    if distance < DEEP_SHARE * touching and side <= TURN_SHARE * distance * known:
        if known == 0.0:
            up = 1.0 if normal[n, 2] > 0.05 * touching else -1.0
            distance = up * normal[n, 2]
            normal[n, 0], normal[n, 1], normal[n, 2] = 0.0, 0.0, up
        else:
            distance = side / known
            for c in range(3):
                normal[n, c] = memory[pair, c] / known
    else:
        # A step is too short for a rod to pass as far as this, but two hairpins touch at several places of a pair.
        for c in range(3):
            normal[n, c] /= distance
    for c in range(3):
        memory[pair, c] = normal[n, c]
    return float(distance)


@compiled
def _forget_pull(impulse: Array, pair: int, normal: Array, n: int) -> None:
    """Set the impulse of a pair, (pairs, 3) N s, to 0 if it would pull along the contact's normal, (n, 3)."""
    if impulse[pair, 0] * normal[n, 0] + impulse[pair, 1] * normal[n, 1] + impulse[pair, 2] * normal[n, 2] < 0.0:
        for c in range(3):
            impulse[pair, c] = 0.0


@compiled
def allowed_approach(gap: float, step: float, radius: float) -> float:
    """Compute the least relative speed along the normal, m/s, which just closes a gap or gently undoes a penetration.

    Args:
        gap: distance of the surfaces, m, negative for a penetration.
        step: time step, s.
        radius: smaller radius of the two rods, m.
    """
    if gap > 0.0:
        return -gap / step
    depth = max(-gap - SLOP_RADII * radius, 0.0)
    return float(min(DEPENETRATION_SHARE * depth / step, depth / UNDOING_S, np.sqrt(9.81 * radius)))


@compiled
def on_cone(
    x: float, y: float, z: float, nx: float, ny: float, nz: float, friction: float
) -> tuple[float, float, float]:
    """Project an impulse (x, y, z) into Coulomb's cone about the unit normal (nx, ny, nz).

    Returns:
        An impulse that pushes along the normal, with a part across it of at most `friction` times the push; or zero.
    """
    along = x * nx + y * ny + z * nz
    if along <= 0.0:
        return 0.0, 0.0, 0.0
    tx, ty, tz = x - along * nx, y - along * ny, z - along * nz
    rubbing, most = np.sqrt(tx * tx + ty * ty + tz * tz), friction * along
    share = most / rubbing if rubbing > most else 1.0
    return along * nx + share * tx, along * ny + share * ty, along * nz + share * tz
