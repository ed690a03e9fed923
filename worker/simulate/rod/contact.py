"""Contact: where rods touch, and the impulses that keep them apart and rub.

A contact acts on the smooth curves through the nodes, not on the chords: a point of a segment is moved by the mean of
the two parabolas at its ends (a Catmull-Rom curve), so that its weights act on four nodes.

The velocity that an impulse causes is that of the implicit operator, bending and all, so that it says how soft a rod is
there. As the operator is the same in x, y and z, a contact's own block is a multiple of the unit matrix, and Coulomb's
cone a true cone.

Contacts are speculative: a pair that would meet within the step is stopped at the touch, whatever its speed, so that
nothing tunnels. A pair remembers which side it was on; a curve that got to the wrong side is pushed back. Rods that
start within each other have no side: the first of them is taken for the lower one, wherever they cross.
"""

from typing import NamedTuple

import numpy as np

from worker.simulate.rod.arrays import Bodies, Integers, Motion
from worker.simulate.rod.bending import Operator
from worker.simulate.rod.broad_phase import Candidates
from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.model import Array
from worker.simulate.rod.narrow_phase import find_near

DEPENETRATION_SHARE = 0.2
"""Of a penetration that is undone in a step at most."""

UNDOING_S = 0.01
"""Time constant of undoing a penetration: what is pushed out faster keeps moving, falls back, and never rests."""

DEEP_SHARE = 0.9
"""Of the distance at which two rods touch. Nearer ones have cut into each other so deep that the way between their
axes may not be the way out."""

TURN_SHARE = 0.5
"""Cosine of the greatest angle between the way between the axes of such rods and the last one that was remembered."""

STRETCH = 8
"""So many nodes in a row are looked at together when sweeps ask where anything has changed."""

SLOP_RADII = 0.002
"""Depth that is left as it is: to lift a rod out would give it energy."""


class Contacts(NamedTuple):
    """The touching pairs of one step; only the first `count` are meant.

    Attributes:
        pair: number of the candidate pair.
        at: (2, n) where on their segments they are closest, in [0, 1].
        base: (2, n) first of the four nodes on either side.
        weights: (2, n, 4) of these nodes.
        normal: (n, 3) unit vector from the second side to the first.
        approach: (n,) relative speed along the normal that must not be undercut, m/s.
        compliance: (n,) relative velocity per impulse, 1/kg.
        low: (2, n) first node that responds.
        width: (2, n) how many do.
        column: (2, n, max) their velocity per impulse, 1/kg.
    """

    pair: Integers
    at: Array
    base: Integers
    weights: Array
    normal: Array
    approach: Array
    compliance: Array
    low: Integers
    width: Integers
    column: Array


@compiled
def room_for_contacts(pairs: int, operator: Operator) -> Contacts:
    """Room for as many contacts as there are candidate pairs."""
    widest = operator.response.shape[1] + 3
    return Contacts(
        np.empty(pairs, np.int64),
        np.empty((2, pairs)),
        np.empty((2, pairs), np.int64),
        np.empty((2, pairs, 4)),
        np.empty((pairs, 3)),
        np.empty(pairs),
        np.empty(pairs),
        np.empty((2, pairs), np.int64),
        np.empty((2, pairs), np.int64),
        np.empty((2, pairs, widest)),
    )


@compiled
def _weigh(weights: Array, side: int, n: int, i: int, t: float, first: int, end: int) -> int:
    """Weights of four nodes that give the curve's point at fraction t of segment i; returns the first node.

    They become `weights[side, n]`. The rod's nodes are those from `first` on, before `end`.
    """
    base = min(max(i - 1, first), end - 4)
    for k in range(4):
        weights[side, n, k] = 0.0
    k = i - base
    weights[side, n, k] = 1 - t
    weights[side, n, k + 1] = t
    bulge = -0.5 * t * (1 - t)
    if i > first:
        weights[side, n, k - 1] += bulge * (1 - t)
        weights[side, n, k] -= 2 * bulge * (1 - t)
        weights[side, n, k + 1] += bulge * (1 - t)
    if i + 2 < end:
        weights[side, n, k] += bulge * t
        weights[side, n, k + 1] -= 2 * bulge * t
        weights[side, n, k + 2] += bulge * t
    return int(base)


@compiled
def _respond(
    response: Array, reach: int, weights: Array, side: int, n: int, base: int, span: tuple[int, int], column: Array
) -> float:
    """Fill in the column of one side of a contact; returns its compliance.

    Args:
        response: (nodes, width) of the operator, 1/kg.
        reach: how far it is not negligible, in nodes.
        weights: (2, n, 4).
        side: of the contact.
        n: number of the contact.
        base: first of the four nodes.
        span: the first node that responds, and the one after the last.
        column: (2, n, max); that of the contact is set.
    """
    centre = (response.shape[1] - 1) // 2
    low, high = span
    for j in range(high - low):
        column[side, n, j] = 0.0
    for k in range(4):
        node, weight = base + k, weights[side, n, k]
        if weight != 0.0:
            for j in range(max(low, node - reach), min(high, node + reach + 1)):
                column[side, n, j - low] += weight * response[node, j - node + centre]
    total = 0.0
    for k in range(4):
        total += weights[side, n, k] * column[side, n, base + k - low]
    return total


@compiled
def gather_contacts(
    bodies: Bodies,
    operator: Operator,
    motion: Motion,
    candidates: Candidates,
    bulge: Array,
    reach: Array,
    margin: float,
    contacts: Contacts,
) -> int:
    """Fill in the contacts of this step.

    Args:
        bodies: the rods.
        operator: of this time step.
        motion: where they are, and how fast.
        candidates: what they remember is changed.
        bulge: (nodes,) how far the curve leaves the chords, m.
        reach: (nodes,) how far around each node contact is looked for, m.
        margin: how far apart surfaces may be that are still looked at, m.
        contacts: is filled in.

    Returns:
        How many there are.
    """
    x, owner, radius, first = motion.x, bodies.owner, bodies.radius, bodies.first
    pairs, at, base, weights = contacts.pair, contacts.at, contacts.base, contacts.weights
    segments, remembered, impulse = (candidates.one, candidates.other), candidates.normal, candidates.impulse
    near = find_near(bodies, motion, candidates, bulge, reach, operator.step, margin, pairs, at)
    count = 0
    for n in range(near):
        pair = pairs[n]
        for side in range(2):
            i = segments[side][pair]
            rod = owner[i]
            base[side, count] = _weigh(weights, side, count, i, at[side, n], first[rod], first[rod + 1])
        one, other = radius[owner[segments[0][pair]]], radius[owner[segments[1][pair]]]
        _point(x, base, weights, count, contacts.normal)
        distance = _turn(contacts.normal, count, remembered, pair, one + other)
        _forget_pull(impulse, pair, contacts.normal, count)
        compliance = 0.0
        for side in range(2):
            rod, middle = owner[base[side, count]], base[side, count]
            low, high = (
                max(first[rod], middle - operator.reach[rod]),
                min(first[rod + 1], middle + 4 + operator.reach[rod]),
            )
            contacts.low[side, count], contacts.width[side, count] = low, high - low
            compliance += _respond(
                operator.response, operator.reach[rod], weights, side, count, middle, (low, high), contacts.column
            )
        if compliance > 0.0:
            # Never ahead of what is still to be read.
            pairs[count] = pair
            contacts.compliance[count] = compliance
            contacts.approach[count] = allowed_approach(distance - one - other, operator.step, min(one, other))
            count += 1
    return count


@compiled
def _point(x: Array, base: Integers, weights: Array, n: int, normal: Array) -> None:
    """Set `normal[n]` to the way from the second side of contact n to the first, m."""
    for c in range(3):
        offset = 0.0
        for k in range(4):
            offset += weights[0, n, k] * x[c, base[0, n] + k]
            offset -= weights[1, n, k] * x[c, base[1, n] + k]
        normal[n, c] = offset


@compiled
def _turn(normal: Array, n: int, memory: Array, pair: int, touching: float) -> float:
    """Make the way `normal[n]` a unit vector, and the way out; returns how far the first side is along it, m.

    Args:
        normal: (n, 3) ways from the second side to the first, m.
        n: number of the contact.
        memory: (pairs, 3) such ways or unit vectors as last seen; 0 if never. The pair's becomes the unit vector.
        pair: its number.
        touching: the distance at which the two touch, m.

    Returns:
        The distance, negative if the first side is on the wrong one.
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
        if side < 0.0 and distance < touching:
            distance = -distance
        for c in range(3):
            normal[n, c] /= distance
    for c in range(3):
        memory[pair, c] = normal[n, c]
    return float(distance)


@compiled
def _forget_pull(impulse: Array, pair: int, normal: Array, n: int) -> None:
    """Set the impulse of a pair, (pairs, 3) N s, to 0 if it would pull along the normal, (n, 3)."""
    if impulse[pair, 0] * normal[n, 0] + impulse[pair, 1] * normal[n, 1] + impulse[pair, 2] * normal[n, 2] < 0.0:
        for c in range(3):
            impulse[pair, c] = 0.0


@compiled
def allowed_approach(gap: float, step: float, radius: float) -> float:
    """Least relative speed along the normal, m/s: to close a gap just so, or to undo a penetration gently."""
    if gap > 0.0:
        return -gap / step
    depth = max(-gap - SLOP_RADII * radius, 0.0)
    return float(min(DEPENETRATION_SHARE * depth / step, depth / UNDOING_S, np.sqrt(9.81 * radius)))


@compiled
def on_cone(
    x: float, y: float, z: float, nx: float, ny: float, nz: float, friction: float
) -> tuple[float, float, float]:
    """The admissible impulse in Coulomb's sense for one that is wanted.

    It pushes along the normal n, or is zero, and rubs no harder than `friction` times that.
    """
    along = x * nx + y * ny + z * nz
    if along <= 0.0:
        return 0.0, 0.0, 0.0
    tx, ty, tz = x - along * nx, y - along * ny, z - along * nz
    rubbing, most = np.sqrt(tx * tx + ty * ty + tz * tz), friction * along
    share = most / rubbing if rubbing > most else 1.0
    return along * nx + share * tx, along * ny + share * ty, along * nz + share * tz


@compiled
def push(column: Array, begin: int, low: int, width: int, x: float, y: float, z: float, v: Array) -> None:
    """Add what an impulse does, `column` from `begin` on, to velocities (3, nodes) of so many nodes from `low` on."""
    for j in range(width):
        share = column[begin + j]
        v[0, low + j] += x * share
        v[1, low + j] += y * share
        v[2, low + j] += z * share


@compiled
def stir(stirred: Integers, low: int, width: int, sweep: int) -> None:
    """Note that a sweep has changed the velocities of so many nodes from `low` on, by stretches of nodes."""
    for stretch in range(low // STRETCH, (low + width - 1) // STRETCH + 1):
        stirred[stretch] = sweep


@compiled
def is_calm(stirred: Integers, low: int, high: int, sweep: int) -> bool:
    """Whether neither this sweep nor the one before it has changed nodes `low` or `high`, or others close to them."""
    return bool(stirred[low // STRETCH] < sweep - 1 and stirred[high // STRETCH] < sweep - 1)


@compiled
def was_stirred(stirred: Integers, first: int, end: int, sweep: int) -> bool:
    """Whether a sweep after `sweep` has changed nodes from `first` to before `end`, or others close to them."""
    return bool(stirred[first // STRETCH : (end - 1) // STRETCH + 1].max() > sweep)
