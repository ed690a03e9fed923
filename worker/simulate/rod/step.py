"""Makes one time step: implicit Euler with contact.

The impulses of contacts and the tensions that keep the lengths depend on each other. They are found in turn: sweeps
over the contacts change impulses, then the places and tensions of each rod that the sweeps have changed are found
exactly, until a sweep finds nothing more to do, or nothing moves any more.

A step has a sound end if no rod moves much farther than its speed at the start tells, lengths are kept, rods are not
pushed far into each other or through each other, and no energy is gained, as impulses and tensions only take it. A step
that moves a rod too far is made as two steps of half the time. Another one without a sound end goes on from the
impulses it has, more carefully, then starts again from none, and is halved after that. At the finest time step the rods
stop in their places.
"""

import numpy as np
from numpy.typing import NDArray

from worker.simulate.rod.arrays import Bodies, Motion, Scratch
from worker.simulate.rod.bending import Operator, energy_of
from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.floor import catch_sunk, hold_on_floor, let_go_pulled
from worker.simulate.rod.forces import resisted
from worker.simulate.rod.impulses import correct, gather_load, predict
from worker.simulate.rod.lengths import MAX_ITERATIONS, keep_lengths
from worker.simulate.rod.model import Array
from worker.simulate.rod.passing import count_passes
from worker.simulate.rod.stirring import stir, was_stirred
from worker.simulate.rod.tally import GAINS, ITERATIONS, MISSES, PASSES, RETRIES, ROUNDS, STOPS, SWEEPS, UNKEPT, Tally
from worker.simulate.rod.touch import Touch, find_touched, work_of_depenetration, worst_miss
from worker.simulate.rod.world import World

MAX_ROUNDS = 4
"""Largest number of turns of sweeps and lengths."""

MORE_ROUNDS = 16
"""Largest number of turns of sweeps and lengths in a step whose first turns find no sound end: first they go on from
the impulses found so far, then they start without any."""

MAX_FLOOR_CHANGES = 4
"""Largest number of times that the nodes which the floor holds are chosen again, after keeping the lengths has pressed
others into the floor or would have to pull held ones down."""

STEADY_M_S = 2e-4
"""Change of all velocities in a turn, in m/s, below which turns end: a twelfth of the speed that counts as rest. Two
contacts at one place may trade impulses for ever without moving anything."""

CAREFUL_STEADY_M_S = 1e-5
"""Such a change in a step whose first turns find no sound end, m/s."""

SLACK = 50.0
"""Multiple of the tolerances of lengths that is enough while sweeps may still change the load."""

MISS_RADII = 0.1
"""Largest depth, in the smallest radius, to which a step may push a rod into another, as its impulses are not exact."""

SPEED_SPARE_M_S = 1e-3
"""Speed, in m/s, of all rods together whose energy a step may gain, as sweeps end before the impulses are exact."""


@compiled
def make_step(  # noqa: PLR0913, PLR0917 - the state of the step, and its bounds
    bodies: Bodies,
    operator: Operator,
    motion: Motion,
    world: World,
    touch: Touch,
    scratch: Scratch,
    tally: Tally,
    finest: bool,
    frame: Array,
    farthest: float,
) -> bool:
    """Move the rods by a step.

    Args:
        bodies: the rods.
        operator: operator of the time step.
        motion: state of the rods, changed in place.
        world: forces and surfaces that act on them.
        touch: contacts of this step, whose impulses are changed.
        scratch: arrays of the step; `momentum` holds the momentum at its end without contact and tension.
        tally: counts, which are added to.
        finest: whether the time step can't be made smaller; rods then stop in their places if no sound end is found.
        frame: (3,) velocity that all rods share, m/s.
        farthest: largest sound movement of a node in that frame, m: beyond it, contacts are not known.

    Returns:
        Whether the step was made; if not, nothing has moved, and impulses and tensions are 0.
    """
    scratch.start[:] = motion.x
    spare = 0.5 * bodies.mass[~bodies.pinned].sum() * SPEED_SPARE_M_S**2
    may_miss = MISS_RADII * bodies.radius.min() / operator.step
    sound = False
    for attempt in range(3):
        if attempt == 1 and finest:
            continue
        kept = _take_turns(bodies, operator, motion, world, touch, scratch, tally, attempt > 0)
        if operator.step * fastest(scratch.v, frame) > farthest:
            tally.counts[RETRIES] += 1
            _undo(motion, touch, scratch)
            return False
        gained = _energy_gained(bodies, operator, motion.v, scratch)
        given = work_of_depenetration(motion, touch, scratch.rise)
        missed = worst_miss(touch.contacts, touch.pairs, scratch.v)
        passed = count_passes(touch.contacts, touch.pairs, scratch.start, motion.x)
        sound = kept and missed <= may_miss and gained <= given + spare and passed == 0
        if sound:
            break
        tally.counts[GAINS] += gained > given + spare
        tally.counts[MISSES] += missed > may_miss
        tally.counts[PASSES] += passed > 0
        tally.counts[RETRIES] += 1
        if attempt > 0 or finest:
            _undo(motion, touch, scratch)
    if not sound:
        if not finest:
            return False
        tally.counts[STOPS] += 1
        scratch.v[:] = 0.0
    motion.v[:] = scratch.v
    find_touched(bodies, motion, touch)
    return True


@compiled
def _undo(motion: Motion, touch: Touch, scratch: Scratch) -> None:
    """Put the rods back to where the step starts, without impulses and tensions."""
    motion.x[:] = scratch.start
    motion.tension[:] = 0.0
    motion.floor_impulse[:] = 0.0
    touch.impulse[:] = 0.0


@compiled
def _energy_gained(bodies: Bodies, operator: Operator, before: Array, scratch: Scratch) -> float:
    """Compute the energy that rods gain in a step, J, without the part that damping takes.

    In a step from velocities v to w, with M v + h f = p and f linear in the places, the energy of motion, bending and
    weight changes by w A w / 2 - w p + w M v - v M v / 2 - h tau w K w / 2. The last term is damping.

    Args:
        bodies: the rods.
        operator: operator of the step.
        before: (3, nodes) velocities v before the step, m/s.
        scratch: arrays of the step: `momentum` is p, and `v` is w.
    """
    total = energy_of(bodies, operator.bands, scratch.v)
    for c in range(3):
        for i in range(len(bodies.mass)):
            v, w = before[c, i], scratch.v[c, i]
            total += bodies.mass[i] * v * (w - 0.5 * v) - scratch.momentum[c, i] * w
    return total


@compiled
def _take_turns(
    bodies: Bodies,
    operator: Operator,
    motion: Motion,
    world: World,
    touch: Touch,
    scratch: Scratch,
    tally: Tally,
    careful: bool,
) -> bool:
    """Find impulses, and places with tensions, in turn; return whether all lengths are kept in the end.

    Careful turns are more, and end later.
    """
    rounds, steady = (MORE_ROUNDS, CAREFUL_STEADY_M_S) if careful else (MAX_ROUNDS, STEADY_M_S)
    rods, stirred = len(bodies.length), scratch.stirred
    due, sticks = np.empty(rods, np.bool_), np.zeros(rods, np.bool_)
    predict(bodies, operator, motion, touch, scratch)
    stirred[:] = 0
    sweeps, tolerance = 0, 0.0
    for turn in range(rounds):
        before = sweeps
        scratch.last[:] = scratch.v
        if touch.pairs > 0 or len(touch.floor) > 0:
            sweeps, tolerance = correct(bodies, operator, motion, world, touch, scratch, sweeps, tolerance, careful)
            if turn > 0 and sweeps == before + 1:
                # What this last sweep has changed is little, but must not be lost.
                gather_load(motion, touch, scratch)
                break
        elif turn > 0:
            break
        tally.counts[ROUNDS] += 1
        gather_load(motion, touch, scratch)
        _find_due(bodies, operator, motion, world, scratch, turn, before, due, sticks)
        for rod in range(rods):
            if due[rod]:
                sticks[rod] = False
                _place(bodies, operator, motion, world, scratch, tally, rod)
                stir(stirred, bodies.first[rod], bodies.first[rod + 1] - bodies.first[rod], sweeps)
        if turn > 0 and largest_change(scratch.last, scratch.v) < steady:
            break
    tally.counts[SWEEPS] += sweeps
    kept = True
    for rod in range(rods):
        if not sticks[rod] and not _keep_lengths_on_floor(bodies, operator, motion, world, scratch, tally, rod, 1.0):
            tally.counts[UNKEPT] += 1
            kept = False
    return kept


@compiled
def _find_due(  # noqa: PLR0913, PLR0917 - the state of the step, and of its turn
    bodies: Bodies,
    operator: Operator,
    motion: Motion,
    world: World,
    scratch: Scratch,
    turn: int,
    before: int,
    due: NDArray[np.bool_],
    sticks: NDArray[np.bool_],
) -> None:
    """Find the rods to be placed in a turn: those that sweeps have stirred, or in the first turn all but those at rest.

    Args:
        bodies: the rods.
        operator: operator of the time step.
        motion: state of the rods; those at rest are put back to where the step starts.
        world: forces and surfaces that act on them.
        scratch: arrays of the step, whose `v` is the guess; that of rods at rest becomes 0.
        turn: number of the turn.
        before: number of sweeps before this turn.
        due: (rods,) array that gets whether each rod is to be placed.
        sticks: (rods,) array that gets, in the first turn, whether dry resistance keeps each rod in its place.
    """
    for rod in range(len(due)):
        # A stretch of nodes may reach from one rod into the next, so all rods are checked before any is placed.
        due[rod] = turn == 0 or was_stirred(scratch.stirred, bodies.first[rod], bodies.first[rod + 1], before)
        if turn == 0 and _sticks(bodies, motion, world, scratch.v, operator.step, rod):
            due[rod], sticks[rod] = False, True
            _stop(bodies, motion, scratch, rod)


@compiled
def _sticks(bodies: Bodies, motion: Motion, world: World, v: Array, step: float, rod: int) -> bool:
    """Whether dry resistance stops a rod whose velocities would be its part of `v` (3, nodes), m/s."""
    most = resisted(bodies, motion, world, step, rod)
    for i in range(bodies.first[rod], bodies.first[rod + 1]):
        if v[0, i] * v[0, i] + v[1, i] * v[1, i] + v[2, i] * v[2, i] >= most * most:
            return False
    return True


@compiled
def _stop(bodies: Bodies, motion: Motion, scratch: Scratch, rod: int) -> None:
    """Stop a rod where the step starts."""
    for c in range(3):
        for i in range(bodies.first[rod], bodies.first[rod + 1]):
            scratch.v[c, i] = 0.0
            motion.x[c, i] = scratch.start[c, i]


@compiled
def largest_change(before: Array, after: Array) -> float:
    """Compute the largest change of a coordinate of velocities (3, nodes), m/s."""
    largest = 0.0
    for c in range(3):
        for i in range(before.shape[1]):
            largest = max(largest, abs(after[c, i] - before[c, i]))
    return largest


@compiled
def fastest(v: Array, frame: Array) -> float:
    """Compute the largest speed, m/s, of nodes with velocities (3, nodes) relative to a velocity `frame` (3,)."""
    worst = 0.0
    for i in range(v.shape[1]):
        ax, ay, az = v[0, i] - frame[0], v[1, i] - frame[1], v[2, i] - frame[2]
        worst = max(worst, ax * ax + ay * ay + az * az)
    return float(np.sqrt(worst))


@compiled
def _place(
    bodies: Bodies, operator: Operator, motion: Motion, world: World, scratch: Scratch, tally: Tally, rod: int
) -> None:
    """Find roughly the places and velocities of a rod at the end of the step, from a guess of its velocities.

    The guess is `scratch.v`, which the velocities found replace; the load is `scratch.load`.
    """
    h, start, v, x = operator.step, scratch.start, scratch.v, motion.x
    for c in range(3):
        for i in range(bodies.first[rod], bodies.first[rod + 1]):
            x[c, i] = start[c, i] + h * v[c, i]
    hold_on_floor(bodies, motion, scratch, h, rod)
    _keep_lengths_on_floor(bodies, operator, motion, world, scratch, tally, rod, SLACK)


@compiled
def _keep_lengths_on_floor(
    bodies: Bodies,
    operator: Operator,
    motion: Motion,
    world: World,
    scratch: Scratch,
    tally: Tally,
    rod: int,
    slack: float,
) -> bool:
    """Keep a rod's lengths while the floor holds the nodes that it pushes, and no others; find its velocities.

    Returns:
        Whether the lengths are kept, to `slack` times the tolerances.
    """
    iterations = keep_lengths(bodies, operator, motion, scratch, rod, slack)
    tally.counts[ITERATIONS] += iterations
    for _ in range(MAX_FLOOR_CHANGES if world.floor else 0):
        let_go = let_go_pulled(bodies, motion, scratch, rod)
        if not catch_sunk(bodies, motion, scratch, operator.step, rod) and not let_go:
            break
        iterations = keep_lengths(bodies, operator, motion, scratch, rod, slack)
        tally.counts[ITERATIONS] += iterations
    _find_velocities(bodies, motion, scratch, operator.step, rod)
    return iterations <= MAX_ITERATIONS


@compiled
def _find_velocities(bodies: Bodies, motion: Motion, scratch: Scratch, step: float, rod: int) -> None:
    """Set a rod's part of `scratch.v` to the velocities, m/s, from `scratch.start` to its present places in a step."""
    for c in range(3):
        for i in range(bodies.first[rod], bodies.first[rod + 1]):
            scratch.v[c, i] = (motion.x[c, i] - scratch.start[c, i]) / step
