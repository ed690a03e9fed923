"""The impulses of all contacts of a step: projected Gauss-Seidel iteration over them, in fixed order."""

from typing import NamedTuple

import numpy as np

from worker.rod.arrays import Bodies, Integers, Motion, Scratch
from worker.rod.bending import Operator, solve
from worker.rod.broad_phase import Candidates
from worker.rod.compiled import compiled
from worker.rod.contact import SMALL_CHANGE_M_S, Contacts, allowed_approach, project_on_cone
from worker.rod.floor import sweep_floor
from worker.rod.forces import add_tension
from worker.rod.model import Array
from worker.rod.world import World

import os
MAX_ROUNDS = int(os.environ.get('X_ROUNDS','4'))
"""The sweeps' responses end where they are small; after the sweeps of a round the impulses act in full."""

MAX_SWEEPS = int(os.environ.get('X_SWEEPS','8'))
"""Of a round. What is missing then is made up for in the next step, which starts from these impulses."""

TOLERANCE_M_S = 1.5e-3
"""Sweeps end when none changes velocities by more, summed over a rod: soft rods, of which some five nodes respond to a
push, are then slower than a third of what counts as resting."""

ENOUGH = 0.02
"""They also end when none changes a velocity by more than this share of the first one's change."""


class Touch(NamedTuple):
    """What touches in this step: the first `pairs` of the contacts, and nodes near the floor.

    Loops take its parts as arguments: out of a nested tuple, compiled code would count references at every access.
    """

    contacts: Contacts
    pairs: int
    floor: Integers


@compiled
def _push(contacts: Contacts, side: int, n: int, sign: float, impulse: Array, v: Array) -> None:
    low, width = contacts.low[side, n], contacts.width[side, n]
    column = contacts.column[side, n]
    for c in range(3):
        p = sign * impulse[c]
        if p != 0.0:
            for j in range(width):
                v[c, low + j] += p * column[j]


@compiled
def _sweep_contacts(  # noqa: PLR0913, PLR0917 - out of nested tuples every access would count references
    bodies: Bodies,
    operator: Operator,
    contacts: Contacts,
    pairs: int,
    candidates: Candidates,
    friction: float,
    sweep: int,
    stirred: Integers,
    v: Array,
) -> float:
    """One pass over all contacts between rods; returns the largest change, m/s, summed over a rod."""
    worst = 0.0
    coupling = operator.coupling
    change, wanted = np.empty(3), np.empty(3)
    for step in range(pairs):
        n = pairs - 1 - step if sweep % 2 == 1 else step
        base_i, base_j = contacts.base[0, n], contacts.base[1, n]
        one, other = bodies.owner[base_i], bodies.owner[base_j]
        if stirred[one] < sweep - 1 and stirred[other] < sweep - 1:
            continue
        normal, impulse = contacts.normal[n], candidates.impulse[contacts.pair[n]]
        for c in range(3):
            u = 0.0
            for k in range(4):
                u += contacts.weights[0, n, k] * v[c, base_i + k] - contacts.weights[1, n, k] * v[c, base_j + k]
            wanted[c] = u
        for c in range(3):
            wanted[c] = impulse[c] - (wanted[c] - contacts.approach[n] * normal[c]) / contacts.compliance[n]
        project_on_cone(wanted, normal, friction)
        moved = 0.0
        for c in range(3):
            change[c] = wanted[c] - impulse[c]
            moved = max(moved, abs(change[c]))
        moved *= contacts.compliance[n] * max(coupling[one], coupling[other])
        if moved > SMALL_CHANGE_M_S:
            for c in range(3):
                impulse[c] = wanted[c]
            _push(contacts, 0, n, 1.0, change, v)
            _push(contacts, 1, n, -1.0, change, v)
            stirred[one] = sweep
            stirred[other] = sweep
            worst = max(worst, moved)
    return worst


@compiled
def _sweep(
    bodies: Bodies, operator: Operator, motion: Motion, world: World, candidates: Candidates, touch: Touch, scratch: Scratch
) -> int:
    """Sweep over the contacts until their impulses hardly change; returns how many sweeps it took."""
    stirred = np.zeros(len(bodies.length), np.int64)
    v = scratch.v
    tolerance = TOLERANCE_M_S
    for sweep in range(MAX_SWEEPS):
        between = _sweep_contacts(
            bodies, operator, touch.contacts, touch.pairs, candidates, world.friction_rods, sweep, stirred, v
        )
        below = sweep_floor(bodies, operator, motion, scratch.start, touch.floor, world.friction_floor, sweep, stirred, v)
        worst = max(between, below)
        if sweep == 0:
            tolerance = max(TOLERANCE_M_S, ENOUGH * worst)
        if worst < tolerance:
            return sweep + 1
    return MAX_SWEEPS


@compiled
def _add_impulses(
    motion: Motion, candidates: Candidates, contacts: Contacts, pairs: int, floor: Integers, load: Array
) -> None:
    """Add the impulses of the floor and between rods, N s, to `load` (3, nodes)."""
    for i in floor:
        for c in range(3):
            load[c, i] += motion.floor_impulse[c, i]
    for n in range(pairs):
        push = candidates.impulse[contacts.pair[n]]
        for k in range(4):
            for c in range(3):
                load[c, contacts.base[0, n] + k] += contacts.weights[0, n, k] * push[c]
                load[c, contacts.base[1, n] + k] -= contacts.weights[1, n, k] * push[c]


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
def predict(
    bodies: Bodies,
    operator: Operator,
    motion: Motion,
    candidates: Candidates,
    touch: Touch,
    scratch: Scratch,
) -> None:
    """Velocities at the end of the step if all impulses and tensions were those of the step before.

    Args:
        bodies: the rods.
        operator: of this time step.
        motion: where they are, and their tension.
        candidates: the impulses between rods.
        touch: what touches.
        scratch: `momentum` is read; `load` and `v` receive it with all impulses, and the velocities that it gives.
    """
    gather_load(motion, candidates, touch, scratch)
    _velocities(bodies, operator, motion, scratch.load, scratch.v)


@compiled
def gather_load(motion: Motion, candidates: Candidates, touch: Touch, scratch: Scratch) -> None:
    """Put `momentum` and the impulses of all contacts, N s, into `load`."""
    scratch.load[:] = scratch.momentum
    _add_impulses(motion, candidates, touch.contacts, touch.pairs, touch.floor, scratch.load)


@compiled
def correct(
    bodies: Bodies, operator: Operator, motion: Motion, world: World, candidates: Candidates, touch: Touch, scratch: Scratch
) -> int:
    """Change the impulses, and `scratch.v` by what a change does nearby, until they hardly change; returns the sweeps."""
    return _sweep(bodies, operator, motion, world, candidates, touch, scratch)


@compiled
def work_of_depenetration(bodies: Bodies, operator: Operator, start: Array, motion: Motion, candidates: Candidates, touch: Touch) -> float:
    """What the impulses of a step do by pushing apart what had cut into each other, J at most."""
    contacts, total = touch.contacts, 0.0
    for n in range(touch.pairs):
        if contacts.approach[n] > 0.0:
            normal, impulse = contacts.normal[n], candidates.impulse[contacts.pair[n]]
            along = impulse[0] * normal[0] + impulse[1] * normal[1] + impulse[2] * normal[2]
            total += contacts.approach[n] * along
    for i in touch.floor:
        radius = bodies.radius[bodies.owner[i]]
        approach = allowed_approach(start[2, i] - radius, operator.step, radius)
        total += max(approach, 0.0) * motion.floor_impulse[2, i]
    return total


@compiled
def find_touched(bodies: Bodies, motion: Motion, candidates: Candidates, touch: Touch) -> None:
    """Note which rods were pushed by anything in this step."""
    motion.touched[:] = False
    for i in touch.floor:
        if motion.floor_impulse[2, i] > 0.0:
            motion.touched[bodies.owner[i]] = True
    for n in range(touch.pairs):
        push = candidates.impulse[touch.contacts.pair[n]]
        if push[0] != 0.0 or push[1] != 0.0 or push[2] != 0.0:
            motion.touched[bodies.owner[touch.contacts.base[0, n]]] = True
            motion.touched[bodies.owner[touch.contacts.base[1, n]]] = True
