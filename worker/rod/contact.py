"""Contact: where rods touch, and the impulses that keep them apart and rub.

A contact acts on the smooth curves through the nodes, not on the chords: a point of a segment is moved by the mean of
the two parabolas at its ends (a Catmull-Rom curve), so that its weights act on four nodes.

The velocity that an impulse causes is that of the implicit operator, bending and all, so that it says how soft a rod is
there. As the operator is the same in x, y and z, a contact's own block is a multiple of the unit matrix, and Coulomb's
cone a true cone.

Contacts are speculative: a pair that would meet within the step is stopped at the touch, whatever its speed, so that
nothing tunnels. A pair remembers which side it was on; a curve that got to the wrong side is pushed back.
"""

from typing import NamedTuple

import numpy as np

from worker.rod.arrays import Bodies, Integers, Motion
from worker.rod.bending import Operator
from worker.rod.broad_phase import Candidates, closest
from worker.rod.compiled import compiled
from worker.rod.model import Array

DEPENETRATION_SHARE = 0.2
"""Of a penetration that is undone in a step."""

SMALL_CHANGE_M_S = 1e-4
"""A change of velocity is not carried on within the sweeps if over all nodes of a rod it adds up to less: many small
ones move a stiff rod as a whole."""

NEARBY_SHARE = 0.05
"""Of the margin within which a pair counts as near although it does not approach."""

SLOP_RADII = 0.002
"""Depth that is left as it is: to lift a rod out would give it energy."""


class Contacts(NamedTuple):
    """The touching pairs of one step; only the first `count` are meant.

    Attributes:
        pair: number of the candidate pair.
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
def _weigh(bodies: Bodies, i: int, t: float, weights: Array) -> int:
    """Weights of four nodes that give the curve's point at fraction t of segment i; returns the first node."""
    rod = bodies.owner[i]
    first, end = bodies.first[rod], bodies.first[rod + 1]
    base = min(max(i - 1, first), end - 4)
    weights[:] = 0.0
    k = i - base
    weights[k] = 1 - t
    weights[k + 1] = t
    bulge = -0.5 * t * (1 - t)
    if i > first:
        weights[k - 1] += bulge * (1 - t)
        weights[k] -= 2 * bulge * (1 - t)
        weights[k + 1] += bulge * (1 - t)
    if i + 2 < end:
        weights[k] += bulge * t
        weights[k + 1] -= 2 * bulge * t
        weights[k + 2] += bulge * t
    return int(base)


@compiled
def _respond(bodies: Bodies, operator: Operator, contacts: Contacts, side: int, n: int) -> float:
    """Fill in the column of one side of a contact; returns its compliance."""
    base, weights, column = contacts.base[side, n], contacts.weights[side, n], contacts.column[side, n]
    rod = bodies.owner[base]
    reach = operator.reach[rod]
    centre = (operator.response.shape[1] - 1) // 2
    low = max(bodies.first[rod], base - reach)
    high = min(bodies.first[rod + 1], base + 4 + reach)
    contacts.low[side, n] = low
    contacts.width[side, n] = high - low
    column[: high - low] = 0.0
    for k in range(4):
        node, weight = base + k, weights[k]
        if weight != 0.0:
            for j in range(max(low, node - reach), min(high, node + reach + 1)):
                column[j - low] += weight * operator.response[node, j - node + centre]
    total = 0.0
    for k in range(4):
        total += weights[k] * column[base + k - low]
    return total


@compiled
def _is_far(
    bodies: Bodies, motion: Motion, i: int, j: int, at: tuple[float, float], step: float, margin: float, normal: Array
) -> bool:
    """Whether two segments, by their chords, can't touch in this step; `normal` is then set by the chords."""
    s, t = at
    x, v = motion.x, motion.v
    squared = fast = 0.0
    for c in range(3):
        offset = x[c, i] + s * (x[c, i + 1] - x[c, i]) - x[c, j] - t * (x[c, j + 1] - x[c, j])
        speed = v[c, i] + s * (v[c, i + 1] - v[c, i]) - v[c, j] - t * (v[c, j + 1] - v[c, j])
        normal[c] = offset
        squared += offset * offset
        fast += speed * speed
    one, other = bodies.radius[bodies.owner[i]], bodies.radius[bodies.owner[j]]
    near = min(margin, 1.5 * step * np.sqrt(fast) + NEARBY_SHARE * margin)
    reach = one + other + near + 0.1 * min(one, other)
    if squared <= reach * reach:
        return False
    distance = np.sqrt(squared)
    for c in range(3):
        normal[c] /= distance
    return True


@compiled
def gather_contacts(
    bodies: Bodies, operator: Operator, motion: Motion, candidates: Candidates, margin: float, contacts: Contacts
) -> int:
    """Fill in the contacts of this step: all candidates with surfaces nearer than `margin`; returns their number."""
    x = motion.x
    count = 0
    for pair in range(len(candidates.one)):
        i, j = candidates.one[pair], candidates.other[pair]
        s, t = closest(x, i, j)
        normal = contacts.normal[count]
        if _is_far(bodies, motion, i, j, (s, t), operator.step, margin, normal):
            candidates.impulse[pair] = 0.0
            candidates.normal[pair] = normal
            continue
        base_i = _weigh(bodies, i, s, contacts.weights[0, count])
        base_j = _weigh(bodies, j, t, contacts.weights[1, count])
        squared = 0.0
        for c in range(3):
            offset = 0.0
            for k in range(4):
                offset += contacts.weights[0, count, k] * x[c, base_i + k]
                offset -= contacts.weights[1, count, k] * x[c, base_j + k]
            normal[c] = offset
            squared += offset * offset
        distance = np.sqrt(squared)
        one, other = bodies.radius[bodies.owner[i]], bodies.radius[bodies.owner[j]]
        memory = candidates.normal[pair]
        if distance < 1e-6 * (one + other):
            if memory[0] == 0.0 and memory[1] == 0.0 and memory[2] == 0.0:
                memory[2] = -1.0
            normal[:] = memory
        else:
            side = normal[0] * memory[0] + normal[1] * memory[1] + normal[2] * memory[2]
            if side < 0.0 and distance < one + other:
                distance = -distance
            for c in range(3):
                normal[c] /= distance
        gap = distance - one - other
        memory[:] = normal
        push = candidates.impulse[pair]
        if push[0] * normal[0] + push[1] * normal[1] + push[2] * normal[2] < 0.0:
            push[:] = 0.0
        contacts.pair[count] = pair
        contacts.base[0, count] = base_i
        contacts.base[1, count] = base_j
        contacts.compliance[count] = _respond(bodies, operator, contacts, 0, count)
        contacts.compliance[count] += _respond(bodies, operator, contacts, 1, count)
        if contacts.compliance[count] <= 0.0:
            continue
        contacts.approach[count] = allowed_approach(gap, operator.step, min(one, other))
        count += 1
    return count


@compiled
def allowed_approach(gap: float, step: float, radius: float) -> float:
    """Least relative speed along the normal, m/s: to close a gap just so, or to undo a penetration gently."""
    if gap > 0.0:
        return -gap / step
    depth = max(-gap - SLOP_RADII * radius, 0.0)
    return float(min(DEPENETRATION_SHARE * depth / step, np.sqrt(9.81 * radius)))


@compiled
def project_on_cone(impulse: Array, normal: Array, friction: float) -> None:
    """Nearest admissible impulse in Coulomb's sense: pushing, and rubbing no harder than `friction` times that."""
    along = impulse[0] * normal[0] + impulse[1] * normal[1] + impulse[2] * normal[2]
    if along <= 0.0:
        impulse[:] = 0.0
        return
    tx, ty, tz = impulse[0] - along * normal[0], impulse[1] - along * normal[1], impulse[2] - along * normal[2]
    rubbing = np.sqrt(tx * tx + ty * ty + tz * tz)
    if rubbing > friction * along:
        shrink = friction * along / rubbing
        tx, ty, tz = shrink * tx, shrink * ty, shrink * tz
    impulse[0] = along * normal[0] + tx
    impulse[1] = along * normal[1] + ty
    impulse[2] = along * normal[2] + tz
