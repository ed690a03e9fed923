"""Hands the load of a rod that lies on a thin one down to the floor.

Sweeps alone find such a load slowly: a contact pushes the thin rod away rather than lift the heavy one, and the floor
pushes it back, so that each sweep adds no more than the ratio of the two rods' compliances. An impulse from the floor
through the thin rod moves the heavy one alone. It is found at once.
"""

import numpy as np

from worker.simulate.rod.arrays import Bodies, Contacts, Integers
from worker.simulate.rod.bending import Operator
from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.contact import on_cone
from worker.simulate.rod.model import Array
from worker.simulate.rod.response import push
from worker.simulate.rod.stirring import is_calm, stir

MUCH_SOFTER = 2.0
"""Ratio of the lower rod's compliance to the upper one's, from which on the load is handed down: below it, sweeps find
it as fast."""

LEAST_SLOPE = 0.5
"""Least cosine of the angle between a contact's normal and the vertical at which one rod counts as lying under the
other."""


@compiled
def press_through(  # noqa: PLR0913, PLR0917 - in nested tuples every access would count references
    bodies: Bodies,
    operator: Operator,
    contacts: Contacts,
    pairs: int,
    impulses: Array,
    floor_impulse: Array,
    rise: Array,
    friction: float,
    sweep: int,
    small: float,
    stirred: Integers,
    v: Array,
) -> float:
    """Give each contact whose lower side the floor carries the impulse that it needs, all the way from the floor.

    Args:
        bodies: the rods.
        operator: operator of this time step.
        contacts: contacts of this step, at the beginning of their arrays.
        pairs: number of contacts.
        impulses: (candidates, 3) impulse of each pair that may touch, N s, changed in place.
        floor_impulse: (3, nodes) impulses of the floor, N s, changed in place.
        rise: (nodes,) least upward speed of each node, m/s.
        friction: Coulomb's coefficient between rods and the floor.
        sweep: number of the sweep in this step.
        small: change of velocity, m/s, summed over a rod, up to which a change is not made.
        stirred: (stretches,) number of the sweep that last changed each stretch of nodes, changed in place.
        v: (3, nodes) velocities, m/s, changed in place as the impulses act.

    Returns:
        The largest change of velocity, m/s, summed over a rod.
    """
    worst = 0.0
    for n in range(pairs):
        if contacts.compliance[n] <= 0.0:
            continue
        upper = 0 if contacts.own[1, n] > contacts.own[0, n] else 1
        lower = 1 - upper
        i, j = contacts.base[upper, n], contacts.base[lower, n]
        up = 1.0 if upper == 0 else -1.0
        if contacts.own[lower, n] < MUCH_SOFTER * contacts.own[upper, n] or bodies.owner[i] == bodies.owner[j]:
            continue
        if up * contacts.normal[n, 2] < LEAST_SLOPE:
            continue
        at = contacts.segment[lower, n]
        if floor_impulse[2, at] <= 0.0 or floor_impulse[2, at + 1] <= 0.0:
            continue
        if is_calm(stirred, i, i + 3, sweep) and is_calm(stirred, j, j + 3, sweep):
            continue
        impulse, compliance = _missing(operator, contacts, n, upper, floor_impulse, rise, impulses, v)
        moved = abs(impulse) * compliance * operator.coupling[bodies.owner[i]]
        if moved > small:
            _hand_down(
                bodies, operator, contacts, n, upper, impulse, impulses, floor_impulse, friction, sweep, stirred, v
            )
            worst = max(worst, moved)
    return worst


@compiled
def _missing(
    operator: Operator,
    contacts: Contacts,
    n: int,
    upper: int,
    floor_impulse: Array,
    rise: Array,
    impulses: Array,
    v: Array,
) -> tuple[float, float]:
    """Compute the impulse that contact n needs along its normal, N s, if the floor takes it too.

    Args:
        operator: operator of this time step.
        contacts: contacts of this step.
        n: number of the contact.
        upper: side of the contact that lies on the other one, 0 or 1.
        floor_impulse: (3, nodes) impulses of the floor, N s.
        rise: (nodes,) least upward speed of each node, m/s.
        impulses: (candidates, 3) impulse of each pair that may touch, N s.
        v: (3, nodes) velocities, m/s.

    Returns:
        The impulse, and the velocity that it causes per impulse, 1/kg.
    """
    lower, up = 1 - upper, 1.0 if upper == 0 else -1.0
    centre = (operator.response.shape[1] - 1) // 2
    i, j = contacts.base[upper, n], contacts.base[lower, n]
    excess, uncarried = -contacts.approach[n], 0.0
    for k in range(4):
        above, below = contacts.weights[upper, n, k], contacts.weights[lower, n, k]
        for c in range(3):
            excess += up * contacts.normal[n, c] * (above * v[c, i + k] - below * v[c, j + k])
        if floor_impulse[2, j + k] > 0.0:
            excess -= up * contacts.normal[n, 2] * below * rise[j + k]
            for c in range(3):
                excess += up * contacts.normal[n, c] * below * v[c, j + k]
        else:
            uncarried += abs(below) * np.sqrt(operator.response[j + k, centre])
    compliance = contacts.own[upper, n] + uncarried * uncarried
    along = 0.0
    for c in range(3):
        along += impulses[contacts.pair[n], c] * contacts.normal[n, c]
    return max(-excess / compliance, -along), compliance


@compiled
def _hand_down(  # noqa: PLR0913, PLR0917 - in nested tuples every access would count references
    bodies: Bodies,
    operator: Operator,
    contacts: Contacts,
    n: int,
    upper: int,
    impulse: float,
    impulses: Array,
    floor_impulse: Array,
    friction: float,
    sweep: int,
    stirred: Integers,
    v: Array,
) -> None:
    """Give contact n an impulse along its normal, N s, and as much to the floor; see `press_through`."""
    lower, up = 1 - upper, 1.0 if upper == 0 else -1.0
    pair, j, rod = contacts.pair[n], contacts.base[lower, n], bodies.owner[contacts.base[lower, n]]
    nx, ny, nz = impulse * contacts.normal[n, 0], impulse * contacts.normal[n, 1], impulse * contacts.normal[n, 2]
    impulses[pair, 0] += nx
    impulses[pair, 1] += ny
    impulses[pair, 2] += nz
    low, width = contacts.low[upper, n], contacts.width[upper, n]
    push(contacts.column[upper, n], 0, low, width, up * nx, up * ny, up * nz, v)
    stir(stirred, low, width, sweep)
    reach, centre = operator.reach[rod], (operator.response.shape[1] - 1) // 2
    for k in range(4):
        node, share = j + k, up * contacts.weights[lower, n, k]
        # What the floor can't take moves the lower rod.
        dx, dy, dz = -share * nx, -share * ny, -share * nz
        if floor_impulse[2, node] > 0.0:
            px, py, pz = floor_impulse[0, node], floor_impulse[1, node], floor_impulse[2, node]
            wx, wy, wz = on_cone(px - dx, py - dy, pz - dz, 0.0, 0.0, 1.0, friction)
            floor_impulse[0, node], floor_impulse[1, node], floor_impulse[2, node] = wx, wy, wz
            dx, dy, dz = dx + wx - px, dy + wy - py, dz + wz - pz
        if dx != 0.0 or dy != 0.0 or dz != 0.0:
            low, high = max(bodies.first[rod], node - reach), min(bodies.first[rod + 1], node + reach + 1)
            push(operator.response[node], low - node + centre, low, high - low, dx, dy, dz, v)
            stir(stirred, low, high - low, sweep)
