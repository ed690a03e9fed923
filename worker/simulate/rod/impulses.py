"""Finds the impulses of all contacts of a step, by projected Gauss-Seidel iteration in fixed order."""

from worker.simulate.rod.arrays import BY_NO_IMPULSE, Bodies, Contacts, Integers, Motion, Scratch
from worker.simulate.rod.bending import Operator, solve
from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.contact import on_cone
from worker.simulate.rod.floor import sweep_floor
from worker.simulate.rod.forces import add_tension
from worker.simulate.rod.model import Array
from worker.simulate.rod.pressing import press_through
from worker.simulate.rod.response import fill_columns, push
from worker.simulate.rod.stirring import is_calm, stir
from worker.simulate.rod.touch import Touch
from worker.simulate.rod.world import World

MAX_SWEEPS = 8
"""Largest number of sweeps at a time. The next step starts from their impulses, and makes up for what is missing."""

TOLERANCE_M_S = 3e-3
"""Change of velocity, summed over a rod, in m/s, below which sweeps end. About five nodes of a soft rod respond to a
push; each then changes by a quarter of the speed that counts as rest."""

CAREFUL_M_S = 1e-4
"""Such a change in a step whose first turns find no sound end, m/s."""

ENOUGH = 0.05
"""Share of the largest change in the step's first sweep below which sweeps end, if it is more than `TOLERANCE_M_S`."""

SMALL_CHANGE_M_S = 1e-4
"""Change of velocity, summed over a rod, in m/s, up to which sweeps do not pass a change on to other nodes. It is
small, as many small changes move a stiff rod as a whole."""

SMALL_SHARE = 0.05
"""Share of the change below which sweeps end, up to which they do not pass a change on either."""


@compiled
def _sweep_contacts(  # noqa: PLR0913, PLR0917 - in nested tuples every access would count references
    bodies: Bodies,
    operator: Operator,
    contacts: Contacts,
    pairs: int,
    impulses: Array,
    friction: float,
    sweep: int,
    small: float,
    stirred: Integers,
    v: Array,
) -> float:
    """Give each contact between rods the impulse that it needs, contact after contact.

    Args:
        bodies: the rods.
        operator: operator of this time step.
        contacts: contacts of this step, at the beginning of their arrays; those that push get their columns.
        pairs: number of contacts.
        impulses: (candidates, 3) impulse of each pair that may touch, N s, changed in place.
        friction: Coulomb's coefficient.
        sweep: number of the sweep in this step; every second sweep goes backwards.
        small: change of velocity, m/s, summed over a rod, up to which a change is not made.
        stirred: (stretches,) number of the sweep that last changed each stretch of nodes, changed in place. Contacts
            between stretches that neither this sweep nor the one before it has changed are left out.
        v: (3, nodes) velocities, m/s, changed in place as the impulses act.

    Returns:
        The largest change of velocity, m/s, summed over a rod.
    """
    base, weights, normal, compliance = contacts.base, contacts.weights, contacts.normal, contacts.compliance
    low, width, column = contacts.low, contacts.width, contacts.column
    owner, coupling = bodies.owner, operator.coupling
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
        pushes = px != 0.0 or py != 0.0 or pz != 0.0
        if not pushes and ux * nx + uy * ny + uz * nz >= least:
            continue
        if compliance[n] == BY_NO_IMPULSE:
            fill_columns(bodies, operator, contacts, n)
        if compliance[n] == 0.0:
            continue
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
            push(column[0, n], 0, low[0, n], width[0, n], dx, dy, dz, v)
            push(column[1, n], 0, low[1, n], width[1, n], -dx, -dy, -dz, v)
            stir(stirred, low[0, n], width[0, n], sweep)
            stir(stirred, low[1, n], width[1, n], sweep)
            worst = max(worst, moved)
    return worst


@compiled
def _add_impulses(impulse: Array, contacts: Contacts, pairs: int, load: Array) -> None:
    """Add the impulses between rods, (candidates, 3) N s, to `load` (3, nodes), N s."""
    for n in range(pairs):
        pair, i, j = contacts.pair[n], contacts.base[0, n], contacts.base[1, n]
        for k in range(4):
            for c in range(3):
                load[c, i + k] += contacts.weights[0, n, k] * impulse[pair, c]
                load[c, j + k] -= contacts.weights[1, n, k] * impulse[pair, c]


@compiled
def _velocities(bodies: Bodies, operator: Operator, motion: Motion, load: Array, v: Array) -> None:
    """Compute the velocities `v`, m/s, that a load, N s, and the present tension give, both (3, nodes).

    Lengths are not kept.
    """
    v[:] = load
    add_tension(bodies, motion, operator.step, v)
    for i in range(len(bodies.mass)):
        if bodies.pinned[i]:
            v[:, i] = 0.0
    for rod in range(len(bodies.length)):
        solve(bodies, operator.factors, rod, v)


@compiled
def predict(bodies: Bodies, operator: Operator, motion: Motion, touch: Touch, scratch: Scratch) -> None:
    """Predict the velocities at the end of the step with all impulses and tensions of the step before.

    Args:
        bodies: the rods.
        operator: operator of this time step.
        motion: places and tension of the rods, and the floor's impulses.
        touch: contacts of this step.
        scratch: arrays of the step: `momentum` is read; `load` gets it with all impulses, and `v` the velocities.
    """
    gather_load(motion, touch, scratch)
    _velocities(bodies, operator, motion, scratch.load, scratch.v)


@compiled
def gather_load(motion: Motion, touch: Touch, scratch: Scratch) -> None:
    """Set `scratch.load` to `scratch.momentum` with the impulses of all contacts, N s."""
    for c in range(3):
        for i in range(scratch.load.shape[1]):
            scratch.load[c, i] = scratch.momentum[c, i] + motion.floor_impulse[c, i]
    _add_impulses(touch.impulse, touch.contacts, touch.pairs, scratch.load)


@compiled
def correct(  # noqa: PLR0913, PLR0917 - the state of the step, and of its sweeps
    bodies: Bodies,
    operator: Operator,
    motion: Motion,
    world: World,
    touch: Touch,
    scratch: Scratch,
    done: int,
    tolerance: float,
    careful: bool,
) -> tuple[int, float]:
    """Sweep over the contacts until their impulses hardly change, at most `MAX_SWEEPS` times.

    Args:
        bodies: the rods.
        operator: operator of this time step.
        motion: state of the rods, whose `floor_impulse` is changed.
        world: coefficients of friction.
        touch: contacts of this step, whose `impulse` is changed.
        scratch: arrays of the step, whose `v` and `stirred` are changed: the impulses act on the nodes nearby.
        done: number of sweeps in this step so far.
        tolerance: change of velocity, m/s, that the last call returned; 0 in the step's first call.
        careful: whether the first turns of the step have found no sound end.

    Returns:
        The number of sweeps in this step so far, and the change of velocity, m/s, below which they end.
    """
    last = done + MAX_SWEEPS
    scratch.owed[:] = 0.0
    while done < last:
        done += 1
        worst = _sweep(bodies, operator, motion, world, touch, scratch, done, tolerance)
        if tolerance == 0.0:
            tolerance = CAREFUL_M_S if careful else max(TOLERANCE_M_S, ENOUGH * worst)
        if worst < tolerance:
            break
    return done, tolerance


@compiled
def _sweep(
    bodies: Bodies,
    operator: Operator,
    motion: Motion,
    world: World,
    touch: Touch,
    scratch: Scratch,
    sweep: int,
    tolerance: float,
) -> float:
    """Sweep once over all contacts; return the largest change of velocity, m/s, summed over a rod."""
    small = max(SMALL_CHANGE_M_S, SMALL_SHARE * tolerance)
    through = press_through(
        bodies,
        operator,
        touch.contacts,
        touch.pairs,
        touch.impulse,
        motion.floor_impulse,
        scratch.rise,
        world.friction_floor,
        sweep,
        small,
        scratch.stirred,
        scratch.v,
    )
    between = _sweep_contacts(
        bodies,
        operator,
        touch.contacts,
        touch.pairs,
        touch.impulse,
        world.friction_rods,
        sweep,
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
        sweep,
        small,
        scratch.owed,
        scratch.stirred,
        scratch.v,
    )
    return max(through, between, below)
