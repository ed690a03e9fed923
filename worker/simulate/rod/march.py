"""Time steps, one after the other, until the rods rest or something else is due."""

from enum import IntEnum
from typing import NamedTuple

import numpy as np

from worker.simulate.rod.arrays import Bodies, Motion, Scratch
from worker.simulate.rod.bending import Operator
from worker.simulate.rod.broad_phase import Candidates, find_candidates, middle_of, still_hold
from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.contact import STRETCH, Contacts, gather_contacts, room_for_contacts
from worker.simulate.rod.floor import find_near_floor
from worker.simulate.rod.forces import momentum_to_be
from worker.simulate.rod.impulses import Touch
from worker.simulate.rod.lengths import AT_REST, FREE, keep_lengths, room_for_system
from worker.simulate.rod.model import Array
from worker.simulate.rod.narrow_phase import find_bulge, find_reach
from worker.simulate.rod.step import make_step
from worker.simulate.rod.tally import CONTACTS, LISTS, STEPS, Tally
from worker.simulate.rod.world import World

WARY_STEPS = 16
"""So many steps are made after one for which no sound end was found before a greater one is tried."""


class Outcome(IntEnum):
    """Why `march` returned."""

    STEPS_DONE = 0
    RESTED = 1
    TOO_FAST = 2
    SLOW_ENOUGH = 3
    UNSOUND = 4
    DIVERGED = 5


class Bounds(NamedTuple):
    """When `march` returns.

    Attributes:
        steps: made at most.
        rest_rms: root mean square speed below which the rods rest, m/s.
        rest_fastest: largest speed below which they do, m/s.
        rest_s: how long they must have rested, s.
        horizon: how long before rods land they count as landing, s; whatever the time step is.
        most_move: how far nodes may move in a step against others that they may meet, m; inf if no smaller step can be
            had.
        few_move: how little they must move for a greater step, m; negative if none can be had.
        finest: whether no smaller step can be had.
    """

    steps: int
    rest_rms: float
    rest_fastest: float
    rest_s: float
    horizon: float
    most_move: float
    few_move: float
    finest: bool


@compiled
def march(
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
    smallest, step = bodies.radius.min(), operator.step
    scratch = _room(len(bodies.mass))
    contacts = room_for_contacts(len(candidates.one) + 1, operator)
    for _ in range(bounds.steps):
        landing = world.floor and _is_landing(bodies, motion, bounds.horizon)
        # Rods that fall together do not meet; but some land before others.
        frame = np.zeros(3) if landing else middle_of(motion.v)
        move = step * _fastest(motion.v, frame)
        # Both of a pair may move, and gravity adds to it within the step.
        near = 2 * move + 0.1 * smallest
        find_bulge(bodies, motion.x, scratch.bulge)
        find_reach(bodies, motion.v, frame, step, near, scratch.bulge, scratch.reach)
        if not still_hold(candidates, motion.x, scratch.reach, not landing):
            candidates = find_candidates(bodies, motion, frame, step, scratch.reach, candidates)
            tally.counts[LISTS] += 1
            if len(contacts.pair) < len(candidates.one) + 1:
                contacts = room_for_contacts(len(candidates.one) + 1, operator)
        if move > bounds.most_move and len(candidates.one) > 0:
            return Outcome.TOO_FAST.value, candidates
        if move < bounds.few_move and tally.wary[0] <= 0:
            return Outcome.SLOW_ENOUGH.value, candidates
        momentum_to_be(bodies, motion, world, step, tally.time[0] + step, scratch.momentum)
        touch = _find_touch(bodies, operator, motion, world, candidates, contacts, near, scratch)
        if not make_step(bodies, operator, motion, world, touch, scratch, tally, bounds.finest):
            tally.wary[0] = WARY_STEPS
            return Outcome.UNSOUND.value, candidates
        _count(tally, step, touch.pairs)
        rms, fastest = _speeds(motion.v)
        if not np.isfinite(rms):
            return Outcome.DIVERGED.value, candidates
        tally.quiet[0] = tally.quiet[0] + step if rms <= bounds.rest_rms and fastest <= bounds.rest_fastest else 0.0
        if tally.quiet[0] >= bounds.rest_s:
            return Outcome.RESTED.value, candidates
    return Outcome.STEPS_DONE.value, candidates


@compiled
def prestress(bodies: Bodies, operator: Operator, motion: Motion, world: World) -> None:
    """Find the tension that balances the rods where they start: a curved rod at rest is under some."""
    scratch = _room(len(bodies.mass))
    momentum_to_be(bodies, motion, world, operator.step, 0.0, scratch.load)
    scratch.start[:] = motion.x
    for i in range(len(bodies.mass)):
        scratch.held[i] = AT_REST if bodies.pinned[i] else FREE
    for rod in range(len(bodies.length)):
        keep_lengths(bodies, operator, motion, scratch, rod, 1.0)
    motion.x[:] = scratch.start


@compiled
def _room(nodes: int) -> Scratch:
    return Scratch(
        momentum=np.empty((3, nodes)),
        load=np.empty((3, nodes)),
        v=np.empty((3, nodes)),
        start=np.empty((3, nodes)),
        bulge=np.empty(nodes),
        reach=np.empty(nodes),
        stirred=np.empty(nodes // STRETCH + 1, np.int64),
        rise=np.empty(nodes),
        near_floor=np.empty(nodes, np.int64),
        held=np.empty(nodes, np.int8),
        system=room_for_system(nodes),
    )


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
        touching = find_near_floor(
            bodies, motion, operator.step, world.friction_floor, scratch.near_floor, scratch.rise
        )
    return Touch(contacts, count, candidates.impulse, scratch.near_floor[:touching])


@compiled
def _count(tally: Tally, step: float, pairs: int) -> None:
    tally.counts[STEPS] += 1
    tally.counts[CONTACTS] += pairs
    tally.time[0] += step
    tally.wary[0] -= 1


@compiled
def _is_landing(bodies: Bodies, motion: Motion, horizon: float) -> bool:
    """Whether a node may meet the floor within a time, in s."""
    for i in range(len(bodies.owner)):
        if motion.x[2, i] - bodies.radius[bodies.owner[i]] + horizon * motion.v[2, i] < 0.0:
            return True
    return False


@compiled
def _fastest(v: Array, frame: Array) -> float:
    """Largest speed, m/s, against a frame that moves at a velocity, (3,)."""
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
