"""The time step: implicit Euler with contact, over and over until the rods rest or something else is due.

Of each step: what the known forces do to the momentum; the impulses of the floor and between rods; lengths.
"""

from enum import IntEnum
from typing import NamedTuple

import numpy as np

from worker.rod.arrays import Bodies, Integers, Motion, Scratch
from worker.rod.bending import Operator
from worker.rod.broad_phase import Candidates, drift, find_candidates
from worker.rod.compiled import compiled
from worker.rod.contact import Contacts, gather_contacts, room_for_contacts
from worker.rod.floor import catch_sunk, find_near_floor, hold_on_floor
from worker.rod.forces import momentum_to_be
from worker.rod.impulses import Touch, find_impulses
from worker.rod.lengths import AT_REST, FREE, MAX_ITERATIONS, keep_lengths, room_for_system
from worker.rod.model import Array
from worker.rod.world import World

MARGIN_RADII = 1.5
"""Candidates are gathered so much wider than needed, so that the list lasts."""

MOVE_RADII = 1.0
"""How far nodes may move against each other in a step, in the least radius; faster ones get a finer step."""

MAX_CATCHES = 4
"""How often in a step the floor is asked again whether it holds what keeping the lengths has pressed down."""


class Outcome(IntEnum):
    """Why the loop returned."""

    STEPS_DONE = 0
    RESTED = 1
    TOO_FAST = 2
    SLOW_ENOUGH = 3
    DIVERGED = 4


class Bounds(NamedTuple):
    """When the loop returns.

    Attributes:
        steps: made at most.
        rest_rms: root mean square speed below which the rods rest, m/s.
        rest_fastest: largest speed below which they do, m/s.
        rest_steps: how many steps they must have rested.
        horizon: how long before rods land they count as landing, s; whatever the time step is.
        coarsest: whether no greater time step can be had.
        finest: whether no smaller one can be had.
    """

    steps: int
    rest_rms: float
    rest_fastest: float
    rest_steps: int
    horizon: float
    coarsest: bool
    finest: bool


class Tally(NamedTuple):
    """What was done, in arrays so that compiled code can count.

    Attributes:
        counts: steps, sweeps, length iterations, lists built, contacts summed over steps, failures of the lengths.
        time: (1,) s.
        quiet: (1,) steps that the rods have been at rest.
    """

    counts: Integers
    time: Array
    quiet: Integers


@compiled
def _room(nodes: int) -> Scratch:
    return Scratch(
        np.empty((3, nodes)),
        np.empty((3, nodes)),
        np.empty((3, nodes)),
        np.empty((3, nodes)),
        np.empty(nodes, np.int64),
        np.empty(nodes, np.int8),
        room_for_system(nodes),
    )


@compiled
def _is_landing(bodies: Bodies, motion: Motion, horizon: float) -> bool:
    """Whether a node may meet the floor within a time, in s."""
    for i in range(len(bodies.owner)):
        if motion.x[2, i] - bodies.radius[bodies.owner[i]] + horizon * motion.v[2, i] < 0.0:
            return True
    return False


@compiled
def _fastest(v: Array, against_mean: bool) -> float:
    """Largest speed, or largest difference from the mean velocity: rods that fall together do not meet."""
    nodes = v.shape[1]
    mx = my = mz = 0.0
    if against_mean:
        mx, my, mz = v[0].mean(), v[1].mean(), v[2].mean()
    worst = 0.0
    for i in range(nodes):
        ax, ay, az = v[0, i] - mx, v[1, i] - my, v[2, i] - mz
        worst = max(worst, ax * ax + ay * ay + az * az)
    return float(np.sqrt(worst))


@compiled
def _speeds(v: Array) -> tuple[float, float]:
    """Root mean square and largest speed."""
    total = worst = 0.0
    for i in range(v.shape[1]):
        squared = v[0, i] ** 2 + v[1, i] ** 2 + v[2, i] ** 2
        total += squared
        worst = max(worst, squared)
    return float(np.sqrt(total / v.shape[1])), float(np.sqrt(worst))


@compiled
def _keep_all_lengths(
    bodies: Bodies, operator: Operator, motion: Motion, world: World, scratch: Scratch, tally: Tally
) -> None:
    for rod in range(len(bodies.length)):
        iterations = keep_lengths(bodies, operator, motion, scratch, rod)
        for _ in range(MAX_CATCHES if world.floor else 0):
            if not catch_sunk(bodies, motion, scratch, operator.step, rod):
                break
            iterations = keep_lengths(bodies, operator, motion, scratch, rod)
        tally.counts[2] += iterations
        if iterations > MAX_ITERATIONS:
            tally.counts[5] += 1


@compiled
def _make_step(
    bodies: Bodies,
    operator: Operator,
    motion: Motion,
    world: World,
    candidates: Candidates,
    touch: Touch,
    scratch: Scratch,
    tally: Tally,
) -> None:
    h, nodes = operator.step, len(bodies.mass)
    tally.counts[1] += find_impulses(bodies, operator, motion, world, candidates, touch, scratch)
    tally.counts[4] += touch.pairs
    for c in range(3):
        for i in range(nodes):
            scratch.start[c, i] = motion.x[c, i]
            motion.x[c, i] += h * scratch.v[c, i]
    hold_on_floor(bodies, motion, scratch, h, touch.floor)
    _keep_all_lengths(bodies, operator, motion, world, scratch, tally)
    for c in range(3):
        for i in range(nodes):
            motion.v[c, i] = (motion.x[c, i] - scratch.start[c, i]) / h
    tally.counts[0] += 1
    tally.time[0] += h


@compiled
def _find_touch(
    bodies: Bodies,
    operator: Operator,
    motion: Motion,
    world: World,
    candidates: Candidates,
    contacts: Contacts,
    near: float,
    scratch: Scratch,
) -> Touch:
    count = gather_contacts(bodies, operator, motion, candidates, near, contacts)
    touching = 0
    if world.floor:
        touching = find_near_floor(bodies, motion, operator.step, world.friction_floor, scratch.near_floor)
    return Touch(contacts, count, scratch.near_floor[:touching])


@compiled
def prestress(bodies: Bodies, operator: Operator, motion: Motion, world: World) -> None:
    """Find the tension that balances the rods where they start: a curved rod at rest is under some."""
    scratch = _room(len(bodies.mass))
    momentum_to_be(bodies, motion, world, operator.step, 0.0, scratch.load)
    scratch.start[:] = motion.x
    for i in range(len(bodies.mass)):
        scratch.held[i] = AT_REST if bodies.pinned[i] else FREE
    for rod in range(len(bodies.length)):
        keep_lengths(bodies, operator, motion, scratch, rod)
    motion.x[:] = scratch.start


@compiled
def advance(
    bodies: Bodies,
    operator: Operator,
    motion: Motion,
    world: World,
    candidates: Candidates,
    tally: Tally,
    bounds: Bounds,
) -> tuple[int, Candidates]:
    """Make steps until one of the bounds is reached.

    Args:
        bodies: the rods.
        operator: of the time step.
        motion: changed in place.
        world: what acts on them.
        candidates: pairs that may touch; a new list is made when it is out of date.
        tally: counts on.
        bounds: when to return.

    Returns:
        The value of an `Outcome`, and the candidates.
    """
    smallest, skin = bodies.radius.min(), MARGIN_RADII * bodies.radius.max()
    scratch = _room(len(bodies.mass))
    contacts = room_for_contacts(len(candidates.one) + 1, operator)
    for _ in range(bounds.steps):
        landing = world.floor and _is_landing(bodies, motion, bounds.horizon)
        relative = operator.step * _fastest(motion.v, not landing)
        # Both of a pair may move, and gravity adds to it within the step.
        near = 2 * relative + 0.1 * smallest
        if drift(motion.x, candidates.built_at) + near > skin:
            candidates = find_candidates(bodies, motion.x, skin + near, candidates)
            contacts = room_for_contacts(len(candidates.one) + 1, operator)
            tally.counts[3] += 1
        if not bounds.finest and len(candidates.one) > 0 and relative > MOVE_RADII * smallest:
            return Outcome.TOO_FAST.value, candidates
        if not bounds.coarsest and 2.2 * relative < MOVE_RADII * smallest:
            return Outcome.SLOW_ENOUGH.value, candidates
        momentum_to_be(bodies, motion, world, operator.step, tally.time[0] + operator.step, scratch.momentum)
        touch = _find_touch(bodies, operator, motion, world, candidates, contacts, near, scratch)
        _make_step(bodies, operator, motion, world, candidates, touch, scratch, tally)
        rms, fastest = _speeds(motion.v)
        if not np.isfinite(rms):
            return Outcome.DIVERGED.value, candidates
        resting = rms <= bounds.rest_rms and fastest <= bounds.rest_fastest
        tally.quiet[0] = tally.quiet[0] + 1 if resting else 0
        if tally.quiet[0] >= bounds.rest_steps:
            return Outcome.RESTED.value, candidates
    return Outcome.STEPS_DONE.value, candidates
