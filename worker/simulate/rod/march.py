"""Makes time steps until the rods rest, or until something must change before the next one."""

from enum import IntEnum
from typing import NamedTuple

import numpy as np

from worker.simulate.rod.arrays import Bodies, Contacts, Motion, Scratch
from worker.simulate.rod.bending import Operator
from worker.simulate.rod.broad_phase import Candidates, find_candidates, middle_of, still_hold
from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.contact import gather_contacts, room_for_contacts
from worker.simulate.rod.curves import find_bends, find_bulge
from worker.simulate.rod.floor import find_near_floor
from worker.simulate.rod.forces import momentum_to_be
from worker.simulate.rod.lengths import AT_REST, FREE, keep_lengths, room_for_system
from worker.simulate.rod.model import Array
from worker.simulate.rod.narrow_phase import find_reach
from worker.simulate.rod.step import fastest, largest_change, make_step
from worker.simulate.rod.stirring import STRETCH
from worker.simulate.rod.tally import CONTACTS, LISTS, STEPS, Tally
from worker.simulate.rod.touch import Touch
from worker.simulate.rod.world import World

FARTHER = 2.0
"""Ratio of the largest sound movement in a step to the one allowed by the speeds at its start. Wind may take a thin rod
from rest across another in one step."""

CALM_STEPS = 4
"""Number of steps with little change of velocity, before a time step longer than planned is tried."""

WARY_STEPS = 16
"""Number of steps after one without a sound end, before a larger time step is tried again."""


class Outcome(IntEnum):
    """The reason for which `march` returns."""

    STEPS_DONE = 0
    RESTED = 1
    TOO_FAST = 2
    SLOW_ENOUGH = 3
    UNSOUND = 4
    DIVERGED = 5


class Bounds(NamedTuple):
    """The bounds at which `march` returns.

    Attributes:
        steps: largest number of steps.
        rest_rms: root mean square distance by which the nodes may move in `rest_s` if the rods rest, m.
        rest_farthest: distance by which any node may, m.
        rest_s: time for which they must have stayed that close to their places, s.
        horizon: time before their landing from which rods count as landing, s, whatever the time step is.
        most_move: largest movement of a node in a step while others may be in its way, m; inf if the time step can't be
            made smaller.
        few_move: movement below which the time step may be larger, m; negative if it can't be made larger.
        most_jolt: distance by which the change of any node's velocity may bend its way in a step, m: the step errs by
            half of it. inf for a step that is no longer than planned.
        few_jolt: distance below which, for some steps, the time step may be longer than planned once all rods have
            landed, m; inf if the longer one is no longer than planned.
        finest: whether the time step can't be made smaller.
    """

    steps: int
    rest_rms: float
    rest_farthest: float
    rest_s: float
    horizon: float
    most_move: float
    few_move: float
    most_jolt: float
    few_jolt: float
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
        operator: operator of the time step.
        motion: state of the rods, changed in place.
        world: forces and surfaces that act on them.
        candidates: pairs that may touch; a new list replaces one that is no longer valid.
        tally: counts, which are added to.
        bounds: bounds at which to return.

    Returns:
        The value of an `Outcome`, and the present list of candidates.
    """
    smallest, step = bodies.radius.min(), operator.step
    scratch = room_for_step(len(bodies.mass))
    contacts = room_for_contacts(len(candidates.one) + 1, operator)
    for _ in range(bounds.steps):
        landing = world.floor and _is_landing(bodies, motion, bounds.horizon)
        # Rods that fall together do not meet, until the first of them lands.
        frame = np.zeros(3) if landing else middle_of(motion.v)
        move = step * fastest(motion.v, frame)
        # Both rods of a pair may move, and gravity adds to it within the step.
        near = 2 * move + 0.1 * smallest
        find_bends(bodies, motion.x, scratch.bends)
        find_bulge(scratch.bends, scratch.bulge)
        find_reach(bodies, motion.v, frame, step, near, scratch.bulge, scratch.reach)
        if not still_hold(candidates, motion.x, scratch.reach, not landing):
            candidates = find_candidates(bodies, motion, frame, step, scratch.reach, candidates)
            tally.counts[LISTS] += 1
            if len(contacts.pair) < len(candidates.one) + 1:
                contacts = room_for_contacts(len(candidates.one) + 1, operator)
        if (move > bounds.most_move and len(candidates.one) > 0) or tally.jolt[0] > bounds.most_jolt:
            tally.jolt[0], tally.calm[0] = 0.0, 0
            return Outcome.TOO_FAST.value, candidates
        is_calm = np.isinf(bounds.few_jolt) or tally.calm[0] >= CALM_STEPS
        if move < bounds.few_move and tally.wary[0] <= 0 and is_calm:
            tally.jolt[0], tally.calm[0] = 0.0, 0
            return Outcome.SLOW_ENOUGH.value, candidates
        momentum_to_be(bodies, motion, world, step, tally.time[0] + step, scratch.momentum)
        scratch.before[:] = motion.v
        touch = _find_touch(bodies, operator, motion, world, candidates, contacts, near, scratch)
        farthest = FARTHER * max(move, bounds.most_move)
        if not make_step(bodies, operator, motion, world, touch, scratch, tally, bounds.finest, frame, farthest):
            tally.wary[0] = WARY_STEPS
            tally.jolt[0], tally.calm[0] = 0.0, 0
            return Outcome.UNSOUND.value, candidates
        _count(tally, step, touch.pairs)
        tally.jolt[0] = step * largest_change(scratch.before, motion.v)
        is_calm = tally.jolt[0] < bounds.few_jolt and _has_landed(bodies, motion)
        tally.calm[0] = tally.calm[0] + 1 if is_calm else 0
        rms, farthest = _distances(motion.x, motion.anchor)
        if not np.isfinite(rms):
            return Outcome.DIVERGED.value, candidates
        if rms <= bounds.rest_rms and farthest <= bounds.rest_farthest:
            tally.quiet[0] += step
        else:
            tally.quiet[0] = 0.0
            motion.anchor[:] = motion.x
        if tally.quiet[0] >= bounds.rest_s:
            return Outcome.RESTED.value, candidates
    return Outcome.STEPS_DONE.value, candidates


@compiled
def prestress(bodies: Bodies, operator: Operator, motion: Motion, world: World) -> None:
    """Set `motion.tension` to the tension that balances the rods at the start: a curved rod at rest has some."""
    scratch = room_for_step(len(bodies.mass))
    momentum_to_be(bodies, motion, world, operator.step, 0.0, scratch.load)
    scratch.start[:] = motion.x
    for i in range(len(bodies.mass)):
        scratch.held[i] = AT_REST if bodies.pinned[i] else FREE
    for rod in range(len(bodies.length)):
        keep_lengths(bodies, operator, motion, scratch, rod, 1.0)
    motion.x[:] = scratch.start


@compiled
def room_for_step(nodes: int) -> Scratch:
    """Make the arrays of a step for rods of `nodes` nodes together."""
    return Scratch(
        momentum=np.empty((3, nodes)),
        load=np.empty((3, nodes)),
        v=np.empty((3, nodes)),
        last=np.empty((3, nodes)),
        before=np.empty((3, nodes)),
        start=np.empty((3, nodes)),
        bends=np.zeros((3, nodes)),
        bulge=np.empty(nodes),
        reach=np.empty(nodes),
        stirred=np.empty(nodes // STRETCH + 1, np.int64),
        owed=np.zeros((3, nodes)),
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
    count = gather_contacts(bodies, operator, motion, candidates, scratch, near, contacts)
    touching = 0
    if world.floor:
        touching = find_near_floor(
            bodies, motion, scratch.bends, operator.step, world.friction_floor, scratch.near_floor, scratch.rise
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
    """Whether a node may meet the floor within a time `horizon`, s."""
    for i in range(len(bodies.owner)):
        if motion.x[2, i] - bodies.radius[bodies.owner[i]] + horizon * motion.v[2, i] < 0.0:
            return True
    return False


@compiled
def _has_landed(bodies: Bodies, motion: Motion) -> bool:
    """Whether every rod has landed, or is pinned all along."""
    for rod in range(len(bodies.length)):
        if not motion.landed[rod] and not bodies.pinned[bodies.first[rod] : bodies.first[rod + 1]].all():
            return False
    return True


@compiled
def _distances(x: Array, y: Array) -> tuple[float, float]:
    """Compute the root mean square distance of places from others, (3, nodes) each, and the largest one, m."""
    total = worst = 0.0
    for i in range(x.shape[1]):
        squared = (x[0, i] - y[0, i]) ** 2 + (x[1, i] - y[1, i]) ** 2 + (x[2, i] - y[2, i]) ** 2
        total += squared
        worst = max(worst, squared)
    return float(np.sqrt(total / x.shape[1])), float(np.sqrt(worst))
