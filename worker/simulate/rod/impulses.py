"""The impulses of all contacts of a step: projected Gauss-Seidel iteration over them, in fixed order."""

from typing import NamedTuple

from worker.simulate.rod.arrays import Bodies, Integers, Motion, Scratch
from worker.simulate.rod.bending import Operator, solve
from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.contact import Contacts, is_calm, on_cone, push, stir
from worker.simulate.rod.floor import sweep_floor
from worker.simulate.rod.forces import add_tension
from worker.simulate.rod.model import Array
from worker.simulate.rod.world import World

MAX_SWEEPS = 8
"""At a time. What is missing then is made up for in the next step, which starts from these impulses."""

TOLERANCE_M_S = 3e-3
"""Sweeps end when none changes velocities by more, summed over a rod: soft rods, of which some five nodes respond to a
push, then move by a quarter of what counts as resting."""

ENOUGH = 0.05
"""They also end when none changes a velocity by more than this share of what the step's first one did."""

SMALL_CHANGE_M_S = 1e-4
"""A change of velocity is not carried on within the sweeps if over all nodes of a rod it adds up to less: many small
ones move a stiff rod as a whole."""

SMALL_SHARE = 0.05
"""Nor if it is less than this share of the change below which sweeps end."""


class Touch(NamedTuple):
    """What touches in this step.

    Loops take its parts as arguments: out of a nested tuple, compiled code would count references at every access.

    Attributes:
        contacts: between rods, the first `pairs` of them.
        pairs: how many.
        impulse: (candidates, 3) N s, of all pairs that may touch.
        floor: nodes that the floor may touch.
    """

    contacts: Contacts
    pairs: int
    impulse: Array
    floor: Integers


@compiled
def _sweep_contacts(  # noqa: PLR0913, PLR0917 - out of nested tuples every access would count references
    owner: Integers,
    coupling: Array,
    contacts: Contacts,
    pairs: int,
    impulses: Array,
    friction: float,
    sweep: int,
    small: float,
    stirred: Integers,
    v: Array,
) -> float:
    """Give each contact between rods the impulse that it needs, one after the other.

    Args:
        owner: (nodes,) the rod of each node.
        coupling: (rods,) how much a push moves a whole rod; see `worker.simulate.rod.bending`.
        contacts: of this step, the first `pairs` of them.
        pairs: how many.
        impulses: (candidates, 3) N s, is changed.
        friction: Coulomb's coefficient.
        sweep: its number in this step. Every other one goes backwards.
        small: smaller changes, in m/s and summed over a rod, are not made.
        stirred: (stretches,) which sweep last changed a stretch of nodes. Contacts between two that this sweep and the
            one before it left alone are left out.
        v: (3, nodes) m/s, is changed by what the impulses do.

    Returns:
        The largest change, m/s, summed over a rod.
    """
    base, weights, normal, compliance = contacts.base, contacts.weights, contacts.normal, contacts.compliance
    worst = 0.0
    for step in range(pairs):
        n = pairs - 1 - step if sweep % 2 == 1 else step
        i, j = base[0, n], base[1, n]
        if is_calm(stirred, i, i + 3, sweep) and is_calm(stirred, j, j + 3, sweep):
            continue
        ux = uy = uz = 0.0
        for k in range(4):
            a, b = weights[0, n, k], weights[1, n, k]
            ux += a * v[0, i + k] - b * v[0, j + k]
            uy += a * v[1, i + k] - b * v[1, j + k]
            uz += a * v[2, i + k] - b * v[2, j + k]
        pair = contacts.pair[n]
        nx, ny, nz, least = normal[n, 0], normal[n, 1], normal[n, 2], contacts.approach[n]
        px, py, pz = impulses[pair, 0], impulses[pair, 1], impulses[pair, 2]
        wx, wy, wz = on_cone(
            px - (ux - least * nx) / compliance[n],
            py - (uy - least * ny) / compliance[n],
            pz - (uz - least * nz) / compliance[n],
            nx,
            ny,
            nz,
            friction,
        )
        dx, dy, dz = wx - px, wy - py, wz - pz
        moved = max(abs(dx), abs(dy), abs(dz)) * compliance[n] * max(coupling[owner[i]], coupling[owner[j]])
        if moved > small:
            impulses[pair, 0], impulses[pair, 1], impulses[pair, 2] = wx, wy, wz
            low, width, column = contacts.low, contacts.width, contacts.column
            push(column[0, n], 0, low[0, n], width[0, n], dx, dy, dz, v)
            push(column[1, n], 0, low[1, n], width[1, n], -dx, -dy, -dz, v)
            stir(stirred, low[0, n], width[0, n], sweep)
            stir(stirred, low[1, n], width[1, n], sweep)
            worst = max(worst, moved)
    return worst


@compiled
def _add_impulses(impulse: Array, contacts: Contacts, pairs: int, load: Array) -> None:
    """Add the impulses between rods, (candidates, 3) N s, to `load` (3, nodes)."""
    for n in range(pairs):
        pair, i, j = contacts.pair[n], contacts.base[0, n], contacts.base[1, n]
        for k in range(4):
            for c in range(3):
                load[c, i + k] += contacts.weights[0, n, k] * impulse[pair, c]
                load[c, j + k] -= contacts.weights[1, n, k] * impulse[pair, c]


@compiled
def _velocities(bodies: Bodies, operator: Operator, motion: Motion, load: Array, v: Array) -> None:
    """What velocities a load, in N s, gives to the rods with the tension that they have; lengths are not kept."""
    v[:] = load
    add_tension(bodies, motion, operator.step, v)
    for i in range(len(bodies.mass)):
        if bodies.pinned[i]:
            v[:, i] = 0.0
    for rod in range(len(bodies.length)):
        solve(bodies, operator.factors, rod, v)


@compiled
def predict(bodies: Bodies, operator: Operator, motion: Motion, touch: Touch, scratch: Scratch) -> None:
    """Velocities at the end of the step if all impulses and tensions were those of the step before.

    Args:
        bodies: the rods.
        operator: of this time step.
        motion: where they are, and their tension.
        touch: what touches.
        scratch: `momentum` is read; `load` and `v` receive it with all impulses, and the velocities that it gives.
    """
    gather_load(motion, touch, scratch)
    _velocities(bodies, operator, motion, scratch.load, scratch.v)


@compiled
def gather_load(motion: Motion, touch: Touch, scratch: Scratch) -> None:
    """Put `momentum` and the impulses of all contacts, N s, into `load`."""
    for c in range(3):
        for i in range(scratch.load.shape[1]):
            scratch.load[c, i] = scratch.momentum[c, i] + motion.floor_impulse[c, i]
    _add_impulses(touch.impulse, touch.contacts, touch.pairs, scratch.load)


@compiled
def correct(
    bodies: Bodies,
    operator: Operator,
    motion: Motion,
    world: World,
    touch: Touch,
    scratch: Scratch,
    done: int,
    tolerance: float,
) -> tuple[int, float]:
    """Sweep over the contacts until their impulses hardly change.

    Args:
        bodies: the rods.
        operator: of this time step.
        motion: `floor_impulse` is changed.
        world: how strong friction is.
        touch: what touches; `impulse` is changed.
        scratch: `v` is changed by what the impulses' changes do nearby. Contacts where neither this sweep nor the one
            before it has `stirred` anything are left alone.
        done: sweeps of this step so far.
        tolerance: what this returned before, m/s; 0 in the step's first call.

    Returns:
        The sweeps of this step so far, and the change of velocity below which they end.
    """
    last = done + MAX_SWEEPS
    while done < last:
        done += 1
        small = max(SMALL_CHANGE_M_S, SMALL_SHARE * tolerance)
        between = _sweep_contacts(
            bodies.owner,
            operator.coupling,
            touch.contacts,
            touch.pairs,
            touch.impulse,
            world.friction_rods,
            done,
            small,
            scratch.stirred,
            scratch.v,
        )
        below = sweep_floor(
            bodies,
            operator,
            motion.floor_impulse,
            scratch.rise,
            touch.floor,
            world.friction_floor,
            done,
            small,
            scratch.stirred,
            scratch.v,
        )
        worst = max(between, below)
        if tolerance == 0.0:
            tolerance = max(TOLERANCE_M_S, ENOUGH * worst)
        if worst < tolerance:
            break
    return done, tolerance


@compiled
def work_of_depenetration(motion: Motion, touch: Touch, rise: Array) -> float:
    """What the impulses of a step do at most, J, by pushing apart what had cut into each other."""
    contacts, total = touch.contacts, 0.0
    for n in range(touch.pairs):
        if contacts.approach[n] > 0.0:
            normal, impulse = contacts.normal[n], touch.impulse[contacts.pair[n]]
            along = impulse[0] * normal[0] + impulse[1] * normal[1] + impulse[2] * normal[2]
            total += contacts.approach[n] * along
    for i in touch.floor:
        total += max(rise[i], 0.0) * motion.floor_impulse[2, i]
    return total


@compiled
def find_touched(bodies: Bodies, motion: Motion, touch: Touch) -> None:
    """Note which rods were pushed by anything in this step."""
    motion.touched[:] = False
    for i in touch.floor:
        if motion.floor_impulse[2, i] > 0.0:
            motion.touched[bodies.owner[i]] = True
    for n in range(touch.pairs):
        push = touch.impulse[touch.contacts.pair[n]]
        if push[0] != 0.0 or push[1] != 0.0 or push[2] != 0.0:
            motion.touched[bodies.owner[touch.contacts.base[0, n]]] = True
            motion.touched[bodies.owner[touch.contacts.base[1, n]]] = True


@compiled
def worst_miss(contacts: Contacts, pairs: int, v: Array) -> float:
    """How much faster rods approach at velocities `v` (3, nodes) than any of the first `pairs` contacts allows, m/s."""
    base, weights, normal = contacts.base, contacts.weights, contacts.normal
    worst = 0.0
    for n in range(pairs):
        i, j = base[0, n], base[1, n]
        along = 0.0
        for k in range(4):
            a, b = weights[0, n, k], weights[1, n, k]
            for c in range(3):
                along += normal[n, c] * (a * v[c, i + k] - b * v[c, j + k])
        worst = max(worst, contacts.approach[n] - along)
    return worst
