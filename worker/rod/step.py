"""The time step: implicit Euler with contact, over and over until the rods rest or something else is due.

Of each step: forces that are known; the implicit solve without contact; impulses of the floor and between rods; lengths.
"""

from enum import IntEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from worker.rod.arrays import Bodies, Integers, Motion
from worker.rod.bending import Operator, solve
from worker.rod.broad_phase import Candidates, drift, find_candidates
from worker.rod.compiled import compiled
from worker.rod.contact import (
    Contacts,
    _room_for,
    allowed_approach,
    gather_contacts,
    project_on_cone,
    sweep_contacts,
    sweep_floor,
)
from worker.rod.forces import add_elastic, add_gravity, add_tension, add_wind
from worker.rod.lengths import AT_REST, FREE, IN_HEIGHT, MAX_ITERATIONS, keep_lengths, room_to_work
from worker.rod.model import Array

MAX_ROUNDS = 2
ENOUGH = 0.02
MAX_SWEEPS = 12
SWEEP_TOLERANCE_M_S = 3e-4
"""Sweeps end when none changes a velocity by more: a tenth of the speed at which a scene counts as resting."""

MARGIN_RADII = 1.5
"""Candidates are gathered so much wider than needed, so that the list lasts."""

MOVE_RADII = 1.0
"""How far nodes may move against each other in a step, in the least radius; faster ones get a finer step."""


MAX_CATCHES = 4
SUNK_RADII = 0.02


class Outcome(IntEnum):
    """Why the loop returned."""

    STEPS_DONE = 0
    RESTED = 1
    TOO_FAST = 2
    SLOW_ENOUGH = 3
    DIVERGED = 4


class World(NamedTuple):
    """What acts on the rods; see `worker.rod.model.Surroundings`. `air` is the wind's mean velocity."""

    gravity: Array
    floor: bool
    friction_floor: float
    friction_rods: float
    air: Array
    gusts: Array
    calm_from: float
    drag: bool


class Tally(NamedTuple):
    """What was done, in one array each so that compiled code can count.

    Attributes:
        counts: steps, sweeps, length iterations, lists built, contacts summed over steps, failures of the lengths.
        time: (1,) s.
        quiet: (1,) steps that the rods have been at rest.
    """

    counts: Integers
    time: Array
    quiet: Integers


@compiled
def _air_velocity(world: World, time: float, air: Array) -> None:
    """Mean wind with its gusts; from `calm_from` on it dies down within 0.1 s."""
    strength = 1.0
    for k in range(len(world.gusts)):
        strength += world.gusts[k, 0] * np.sin(world.gusts[k, 1] * time + world.gusts[k, 2])
    strength *= min(max(1.0 - (time - world.calm_from) / 0.1, 0.0), 1.0)
    for c in range(3):
        air[c] = strength * world.air[c]


@compiled
def _fastest_against_mean(v: Array) -> float:
    nodes = v.shape[1]
    mx, my, mz = v[0].mean(), v[1].mean(), v[2].mean()
    worst = 0.0
    for i in range(nodes):
        ax, ay, az = v[0, i] - mx, v[1, i] - my, v[2, i] - mz
        worst = max(worst, ax * ax + ay * ay + az * az)
    return float(np.sqrt(worst))


@compiled
def _near_floor(bodies: Bodies, motion: Motion, step: float, friction: float, touching: Integers) -> int:
    """Nodes that could reach the floor in this step; the others' impulses are forgotten."""
    count = 0
    up = np.array([0.0, 0.0, 1.0])
    for i in range(len(bodies.owner)):
        gap = motion.x[2, i] - bodies.radius[bodies.owner[i]]
        if not bodies.pinned[i] and gap < bodies.radius[bodies.owner[i]] + 2 * step * abs(motion.v[2, i]):
            touching[count] = i
            count += 1
            project_on_cone(motion.floor_impulse[:, i], up, friction)
        else:
            motion.floor_impulse[:, i] = 0.0
    return count


@compiled
def _momentum(bodies: Bodies, operator: Operator, motion: Motion, world: World, time: float, momentum: Array) -> None:
    """The right-hand side M v + h f of the implicit solve, without contact and tension."""
    force = np.zeros(motion.x.shape)
    add_gravity(bodies, world.gravity, force)
    for rod in range(len(bodies.length)):
        add_elastic(bodies, motion, rod, force)
    if world.drag:
        air = np.empty(3)
        _air_velocity(world, time, air)
        add_wind(bodies, motion, air, force)
    for c in range(3):
        for i in range(len(bodies.mass)):
            momentum[c, i] = bodies.mass[i] * motion.v[c, i] + operator.step * force[c, i]


@compiled
def _add_impulses(
    motion: Motion, candidates: Candidates, contacts: Contacts, count: int, touching: Integers, load: Array
) -> None:
    """Add the impulses of the floor and between rods, N s, to `load` (3, nodes)."""
    for i in touching:
        for c in range(3):
            load[c, i] += motion.floor_impulse[c, i]
    for n in range(count):
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
def _find_impulses(
    bodies: Bodies,
    operator: Operator,
    motion: Motion,
    world: World,
    candidates: Candidates,
    contacts: Contacts,
    count: int,
    touching: Integers,
    v: Array,
) -> int:
    """Sweep over the contacts until their impulses hardly change; returns how many sweeps it took."""
    stirred = np.zeros(len(bodies.length), np.int64)
    tolerance = SWEEP_TOLERANCE_M_S
    for sweep in range(MAX_SWEEPS):
        worst = sweep_contacts(bodies, contacts, count, candidates, world.friction_rods, sweep, stirred, v)
        worst = max(worst, sweep_floor(bodies, operator, motion, touching, world.friction_floor, sweep, stirred, v))
        if sweep == 0:
            tolerance = max(SWEEP_TOLERANCE_M_S, ENOUGH * worst)
        if worst < tolerance:
            return sweep + 1
    return MAX_SWEEPS


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
def _hold_on_floor(
    bodies: Bodies, motion: Motion, start: Array, h: float, touching: Integers, held: NDArray[np.int8]
) -> None:
    """Place the nodes that the floor carries where it has them at the end of the step; mark them, and pinned ones, as held."""
    for i in range(len(held)):
        held[i] = AT_REST if bodies.pinned[i] else FREE
    for i in touching:
        if motion.floor_impulse[2, i] > 0.0:
            radius = bodies.radius[bodies.owner[i]]
            held[i] = IN_HEIGHT
            motion.x[2, i] = start[2, i] + h * allowed_approach(start[2, i] - radius, h, radius)


@compiled
def _catch_sunk(bodies: Bodies, motion: Motion, start: Array, h: float, rod: int, held: NDArray[np.int8]) -> bool:
    """Hold the nodes that keeping the lengths has pushed into the floor; returns whether there are any."""
    radius, found = bodies.radius[rod], False
    for i in range(bodies.first[rod], bodies.first[rod + 1]):
        if held[i] == FREE and motion.x[2, i] < min((1 - SUNK_RADII) * radius, start[2, i]):
            held[i] = IN_HEIGHT
            motion.x[2, i] = start[2, i] + h * allowed_approach(start[2, i] - radius, h, radius)
            found = True
    return found


@compiled
def advance(
    bodies: Bodies,
    operator: Operator,
    motion: Motion,
    world: World,
    candidates: Candidates,
    tally: Tally,
    steps: int,
    rest: tuple[float, float, int],
    coarsest: bool,
    finest: bool,
) -> tuple[int, Candidates]:
    """Make up to `steps` steps.

    Args:
        bodies: the rods.
        operator: of the time step.
        motion: changed in place.
        world: what acts on them.
        candidates: pairs that may touch; a new list is made when it is out of date.
        tally: counts on.
        steps: how many.
        rest: root mean square speed and largest speed in m/s under which the rods rest, and for how many steps.
        coarsest: whether a greater step can't be had.
        finest: whether a smaller step can't be had.

    Returns:
        An `Outcome`, and the candidates.
    """
    h = operator.step
    nodes = len(bodies.mass)
    smallest, largest = bodies.radius.min(), bodies.radius.max()
    touching = np.empty(nodes, np.int64)
    momentum = np.empty((3, nodes))
    v = np.empty((3, nodes))
    start = np.empty((3, nodes))
    load = np.empty((3, nodes))
    held = np.zeros(nodes, np.int8)
    work = room_to_work(nodes)
    contacts = _room_for(len(candidates.one) + 1, operator.response.shape[1] + 3)
    skin = MARGIN_RADII * largest
    rms, fastest = _speeds(motion.v)
    for _ in range(steps):
        relative = h * _fastest_against_mean(motion.v)
        # Both of a pair may move, and gravity adds to it within the step.
        near = 2 * relative + 0.1 * smallest
        if drift(motion.x, candidates.built_at) + near > skin:
            candidates = find_candidates(bodies, motion.x, skin + near, candidates)
            contacts = _room_for(len(candidates.one) + 1, operator.response.shape[1] + 3)
            tally.counts[3] += 1
        if not finest and len(candidates.one) > 0 and relative > MOVE_RADII * smallest:
            return Outcome.TOO_FAST.value, candidates
        if not coarsest and 2.2 * relative < MOVE_RADII * smallest:
            return Outcome.SLOW_ENOUGH.value, candidates
        _momentum(bodies, operator, motion, world, tally.time[0] + h, momentum)
        count = gather_contacts(bodies, operator, motion, candidates, near, contacts)
        floor = touching[: _near_floor(bodies, motion, h, world.friction_floor, touching) if world.floor else 0]
        load[:] = momentum
        _add_impulses(motion, candidates, contacts, count, floor, load)
        _velocities(bodies, operator, motion, load, v)
        for _ in range(MAX_ROUNDS if count > 0 or len(floor) > 0 else 0):
            sweeps = _find_impulses(bodies, operator, motion, world, candidates, contacts, count, floor, v)
            tally.counts[1] += sweeps
            load[:] = momentum
            _add_impulses(motion, candidates, contacts, count, floor, load)
            _velocities(bodies, operator, motion, load, v)
            if sweeps == 1:
                break
        tally.counts[4] += count
        for c in range(3):
            for i in range(nodes):
                start[c, i] = motion.x[c, i]
                motion.x[c, i] += h * v[c, i]
        _hold_on_floor(bodies, motion, start, h, floor, held)
        for rod in range(len(bodies.length)):
            iterations = keep_lengths(bodies, operator, motion, start, load, held, rod, work)
            for _ in range(MAX_CATCHES):
                if not world.floor or not _catch_sunk(bodies, motion, start, h, rod, held):
                    break
                iterations = keep_lengths(bodies, operator, motion, start, load, held, rod, work)
            tally.counts[2] += iterations
            if iterations > MAX_ITERATIONS:
                tally.counts[5] += 1
        for c in range(3):
            for i in range(nodes):
                motion.v[c, i] = (motion.x[c, i] - start[c, i]) / h
        tally.counts[0] += 1
        tally.time[0] += h
        rms, fastest = _speeds(motion.v)
        if not np.isfinite(rms):
            return Outcome.DIVERGED.value, candidates
        tally.quiet[0] = tally.quiet[0] + 1 if rms <= rest[0] and fastest <= rest[1] else 0
        if tally.quiet[0] >= rest[2]:
            return Outcome.RESTED.value, candidates
    return Outcome.STEPS_DONE.value, candidates
