"""The time step: implicit Euler with contact, over and over until the rods rest or something else is due.

Of each step: what the known forces do to the momentum; the impulses of the floor and between rods; lengths.
"""

from enum import IntEnum
from typing import NamedTuple

import numpy as np

from worker.rod.arrays import Bodies, Integers, Motion, Scratch
from worker.rod.bending import Operator, energy_of, solve
from worker.rod.broad_phase import Candidates, find_candidates, middle_of, still_hold
from worker.rod.compiled import compiled
from worker.rod.contact import Contacts, gather_contacts, room_for_contacts
from worker.rod.floor import catch_sunk, find_near_floor, hold_on_floor, let_go_pulled
from worker.rod.forces import momentum_to_be
from worker.rod.impulses import MAX_ROUNDS, Touch, correct, find_touched, gather_load, predict, work_of_depenetration
from worker.rod.lengths import AT_REST, FREE, MAX_ITERATIONS, keep_lengths, room_for_system
from worker.rod.model import Array
from worker.rod.narrow_phase import find_bulge, find_reach
from worker.rod.world import World

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
    UNSOUND = 5


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
        np.empty(nodes),
        np.empty(nodes),
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
def _fastest(v: Array, frame: Array) -> float:
    """Largest difference of a node's velocity from that of a frame, (3,) m/s."""
    worst = 0.0
    for i in range(v.shape[1]):
        ax, ay, az = v[0, i] - frame[0], v[1, i] - frame[1], v[2, i] - frame[2]
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
) -> bool:
    kept = True
    for rod in range(len(bodies.length)):
        iterations = keep_lengths(bodies, operator, motion, scratch, rod)
        for _ in range(MAX_CATCHES if world.floor else 0):
            pulled = let_go_pulled(bodies, motion, scratch, rod)
            if not catch_sunk(bodies, motion, scratch, operator.step, rod) and not pulled:
                break
            tally.counts[2] += iterations
            iterations = keep_lengths(bodies, operator, motion, scratch, rod)
        tally.counts[2] += iterations
        if iterations > MAX_ITERATIONS:
            tally.counts[5] += 1
            kept = False
    return kept


@compiled
def _solve_step(
    bodies: Bodies,
    operator: Operator,
    motion: Motion,
    world: World,
    candidates: Candidates,
    touch: Touch,
    scratch: Scratch,
    tally: Tally,
    rounds: int,
) -> bool:
    """Find impulses, tensions and places at the end of the step, in turn until nothing changes."""
    h, nodes = operator.step, len(bodies.mass)
    kept = True
    predict(bodies, operator, motion, candidates, touch, scratch)
    for turn in range(rounds):
        sweeps = correct(bodies, operator, motion, world, candidates, touch, scratch)
        tally.counts[1] += sweeps
        if turn > 0 and sweeps == 1:
            break
        tally.counts[6] += 1
        gather_load(motion, candidates, touch, scratch)
        for c in range(3):
            for i in range(nodes):
                motion.x[c, i] = scratch.start[c, i] + h * scratch.v[c, i]
        hold_on_floor(bodies, motion, scratch, h, touch.floor)
        kept = _keep_all_lengths(bodies, operator, motion, world, scratch, tally)
        for c in range(3):
            for i in range(nodes):
                scratch.v[c, i] = (motion.x[c, i] - scratch.start[c, i]) / h
        if touch.pairs == 0 and len(touch.floor) == 0:
            break
    return kept


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
    finest: bool,
) -> bool:
    scratch.start[:] = motion.x
    free = scratch.momentum.copy()
    for rod in range(len(bodies.length)):
        solve(bodies, operator.factors, rod, free)
    most = energy_of(bodies, operator.bands, free) * (1 + 1e-3) + 0.5 * bodies.mass.sum() * 1e-6
    sound = False
    for attempt in range(2):
        kept = _solve_step(bodies, operator, motion, world, candidates, touch, scratch, tally, (1 + 3 * attempt) * MAX_ROUNDS)
        work = work_of_depenetration(bodies, operator, scratch.start, motion, candidates, touch)
        sound = kept and energy_of(bodies, operator.bands, scratch.v) <= most + work
        if sound:
            break
        tally.counts[7] += 1
        motion.x[:] = scratch.start
        motion.tension[:] = 0.0
        motion.floor_impulse[:] = 0.0
        candidates.impulse[:] = 0.0
    if not sound:
        if not finest:
            return False
        tally.counts[8] += 1
        scratch.v[:] = 0.0
    motion.v[:] = scratch.v
    find_touched(bodies, motion, candidates, touch)
    tally.counts[4] += touch.pairs
    tally.counts[0] += 1
    tally.time[0] += operator.step
    return True


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
    count = gather_contacts(bodies, operator, motion, candidates, scratch.bulge, scratch.reach, near, contacts)
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
    smallest = bodies.radius.min()
    scratch = _room(len(bodies.mass))
    contacts = room_for_contacts(len(candidates.one) + 1, operator)
    for _ in range(bounds.steps):
        landing = world.floor and _is_landing(bodies, motion, bounds.horizon)
        # Rods that fall together do not meet; but some land before others.
        frame = np.zeros(3) if landing else middle_of(motion.v)
        relative = operator.step * _fastest(motion.v, frame)
        # Both of a pair may move, and gravity adds to it within the step.
        near = 2 * relative + 0.1 * smallest
        find_bulge(bodies, motion.x, scratch.bulge)
        find_reach(bodies, motion.v, frame, operator.step, near, scratch.bulge, scratch.reach)
        if not still_hold(candidates, motion.x, scratch.reach, not landing):
            candidates = find_candidates(bodies, motion, frame, operator.step, scratch.reach, candidates)
            tally.counts[3] += 1
            if len(contacts.pair) < len(candidates.one) + 1:
                contacts = room_for_contacts(len(candidates.one) + 1, operator)
        if not bounds.finest and len(candidates.one) > 0 and relative > MOVE_RADII * smallest:
            return Outcome.TOO_FAST.value, candidates
        if not bounds.coarsest and tally.quiet[1] <= 0 and 2.2 * relative < MOVE_RADII * smallest:
            return Outcome.SLOW_ENOUGH.value, candidates
        momentum_to_be(bodies, motion, world, operator.step, tally.time[0] + operator.step, scratch.momentum)
        touch = _find_touch(bodies, operator, motion, world, candidates, contacts, near, scratch)
        if not _make_step(bodies, operator, motion, world, candidates, touch, scratch, tally, bounds.finest):
            tally.quiet[1] = 16
            return Outcome.UNSOUND.value, candidates
        tally.quiet[1] -= 1
        rms, fastest = _speeds(motion.v)
        if not np.isfinite(rms):
            return Outcome.DIVERGED.value, candidates
        resting = rms <= bounds.rest_rms and fastest <= bounds.rest_fastest
        tally.quiet[0] = tally.quiet[0] + 1 if resting else 0
        if tally.quiet[0] >= bounds.rest_steps:
            return Outcome.RESTED.value, candidates
    return Outcome.STEPS_DONE.value, candidates
