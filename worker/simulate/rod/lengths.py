"""Keeps the length of each segment exactly, while the step as a whole stays implicit Euler.

The end of a step obeys A (x - x0) = h p + h^2 F. Here p is the momentum with all impulses but those of the tension, and
F is the tension of each segment along the mean of its edges before and after the step. Tension along that direction
does no work: (e0 + e1) . (e1 - e0) = |e1|^2 - |e0|^2 = 0. (Along the new edge compression would add energy, along the
old edge tension would.) Newton's method solves for all nodes and tensions of a rod at once:

    [A + G  J^T] [dx]   [ residual ]
    [J       0 ] [ y] = [    -C    ]

with C = |e1| - l, J the mean directions, y the change of tension times h^2, and G the stiffness that tension adds where
it pulls. Each multiplier belongs to the second node of its segment: then a node couples with two nodes on either side,
and elimination needs no pivoting, as each multiplier comes after the coordinates on which it acts. This is the "fast
projection" of Goldenthal et al. 2007 ("Efficient simulation of inextensible cloth"), with bending in the metric, and
with the momentum kept.

Nodes that the floor carries are held at their height meanwhile, so that an upright rod that lands stops as a whole.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from worker.simulate.rod.arrays import Bodies, Motion, Scratch
from worker.simulate.rod.banded import BEYOND, DIAGONAL, LATER, NEXT, OWN, RIGHT, ROW, SOLUTION, solve
from worker.simulate.rod.bending import Operator
from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.model import Array

TOLERANCE = 1e-8
"""Largest strain of a segment at the end of a step."""

BALANCE_TOLERANCE_M_S = 2e-6
"""Largest imbalance of a node's momentum over its mass, in m/s: a stiff rod as a whole then errs by this speed."""

FREE, IN_HEIGHT, AT_REST = 0, 1, 2
"""Ways in which a node is held while lengths are kept: not at all, at its height, and in its place."""

MAX_ITERATIONS = 12
"""Newton iterations after which lengths count as not kept."""

PADDING = 2
"""Number of zeros after a rod's last node, in place of the nodes with which the last ones would couple."""


class Work(NamedTuple):
    """Arrays for the computation of a rod.

    Attributes:
        free: (4, nodes + PADDING) 0.0 for coordinates that are held, and for multipliers that act on no free node, else
            1.0; the multiplier at each node is that of the segment that ends there.
        mean: (3, nodes) mean of the directions, before and after the step, of the segment that starts at each node.
        excess: (nodes,) length by which that segment is too long, m.
        moved: (nodes + PADDING,) distance by which each node has moved in the step along one axis, m.
        lack: (3, nodes) imbalance of each node's momentum times the time step, kg m.
        rows: (nodes, ROW) equations; see `worker.simulate.rod.banded`.
    """

    free: Array
    mean: Array
    excess: Array
    moved: Array
    lack: Array
    rows: Array


@compiled
def room_for_system(nodes: int) -> Array:
    """Make one array for all arrays of `Work`, for a rod with `nodes` nodes or fewer."""
    return np.empty((ROW + 3 + 1 + 3) * nodes + (4 + 1) * (nodes + PADDING))


@compiled
def _parts(room: Array, nodes: int) -> Work:
    padded = nodes + PADDING
    rows, room = room[: ROW * nodes], room[ROW * nodes :]
    mean, room = room[: 3 * nodes], room[3 * nodes :]
    lack, room = room[: 3 * nodes], room[3 * nodes :]
    excess, room = room[:nodes], room[nodes:]
    moved, free = room[:padded], room[padded : 5 * padded]
    return Work(
        free.reshape(4, padded), mean.reshape(3, nodes), excess, moved, lack.reshape(3, nodes), rows.reshape(nodes, ROW)
    )


@compiled
def _find_free(held: NDArray[np.int8], work: Work) -> None:
    """Find the coordinates and multipliers that are free, from the nodes' holds (nodes,); set `work.free`."""
    free, nodes = work.free, len(held)
    free[:, nodes:] = 0.0
    work.moved[nodes:] = 0.0
    for i in range(nodes):
        free[0, i] = free[1, i] = 0.0 if held[i] == AT_REST else 1.0
        free[2, i] = 1.0 if held[i] == FREE else 0.0
    free[3, 0] = 0.0
    for i in range(nodes - 1):
        free[3, i + 1] = max(free[0, i], free[0, i + 1])


@compiled
def _directions(bodies: Bodies, start: Array, x: Array, rod: int, slack: float, work: Work) -> int:
    """Compute the mean direction and excess length of a rod's segments; return how many do not have their length."""
    first, end, length = bodies.first[rod], bodies.first[rod + 1], bodies.length[rod]
    segments, excess, acts = end - first - 1, work.excess, work.free[3, 1:]
    excess[:] = 0.0
    for c in range(3):
        now, before, mean = x[c, first:end], start[c, first:end], work.mean[c]
        for i in range(segments):
            edge = now[i + 1] - now[i]
            mean[i] = 0.5 * (edge + before[i + 1] - before[i]) / length
            excess[i] += edge * edge
    wrong = 0
    for i in range(segments):
        excess[i] = acts[i] * (np.sqrt(excess[i]) - length)
        wrong += not abs(excess[i]) < slack * TOLERANCE * length
    return wrong


@compiled
def _imbalance(
    bodies: Bodies, operator: Operator, motion: Motion, start: Array, load: Array, rod: int, slack: float, work: Work
) -> int:
    """Compute the imbalance of each node's momentum; return the number of free coordinates in which it is too large."""
    first, end = bodies.first[rod], bodies.first[rod + 1]
    h, nodes, moved = operator.step, end - first, work.moved
    # `beside` and `beyond` are zero where there is no node to couple with.
    diagonal, beside, beyond = operator.bands[0, first:end], operator.bands[1, first:end], operator.bands[2, first:end]
    tension, mass, limit = motion.tension[first:end], bodies.mass[first:end], slack * BALANCE_TOLERANCE_M_S * h
    wrong = 0
    for c in range(3):
        x, x0, p, mean = motion.x[c, first:end], start[c, first:end], load[c, first:end], work.mean[c]
        lack, free = work.lack[c], work.free[c]
        for i in range(nodes):
            moved[i] = x[i] - x0[i]
        for i in range(nodes):
            lack[i] = h * p[i] - diagonal[i] * moved[i] - beside[i] * moved[i + 1] - beyond[i] * moved[i + 2]
        for i in range(nodes - 1):
            lack[i] += h * h * tension[i] * mean[i]
        for i in range(nodes - 1):
            lack[i + 1] -= h * h * tension[i] * mean[i] + beside[i] * moved[i]
        for i in range(nodes - 2):
            lack[i + 2] -= beyond[i] * moved[i]
        for i in range(nodes):
            wrong += not free[i] * abs(lack[i]) < limit * mass[i]
    return wrong


@compiled
def _assemble(bodies: Bodies, operator: Operator, motion: Motion, rod: int, work: Work) -> None:
    """Fill in a rod's equations; those of a held coordinate say that it does not move."""
    first, end = bodies.first[rod], bodies.first[rod + 1]
    free, mean, rows, nodes = work.free, work.mean, work.rows, end - first
    diagonal, beside, beyond = operator.bands[0, first:end], operator.bands[1, first:end], operator.bands[2, first:end]
    tension, stiffness = motion.tension[first:end], 0.5 * operator.step**2 / bodies.length[rod]
    before = 0.0
    for i in range(nodes):
        row = rows[i]
        after = stiffness * max(tension[i], 0.0) if i + 1 < nodes else 0.0
        for c in range(3):
            own = free[c, i]
            row[DIAGONAL + c] = own * (diagonal[i] + before + after) + (1.0 - own)
            row[RIGHT + c] = own * work.lack[c, i]
            row[NEXT + c] = own * free[c, i + 1] * (beside[i] - after)
            row[BEYOND + c] = own * free[c, i + 2] * beyond[i]
            row[LATER + c] = -own * free[3, i + 1] * mean[c, i] if i + 1 < nodes else 0.0
            row[OWN + c] = own * free[3, i] * mean[c, i - 1] if i > 0 else 0.0
        row[DIAGONAL + 3] = 1.0 - free[3, i]
        row[RIGHT + 3] = -work.excess[i - 1] if i > 0 else 0.0
        before = after


@compiled
def _move(bodies: Bodies, operator: Operator, motion: Motion, rod: int, rows: Array) -> None:
    """Add the solution of a rod's equations to its places and its tension."""
    first, end = bodies.first[rod], bodies.first[rod + 1]
    scale = 1.0 / (operator.step * operator.step)
    for c in range(3):
        x = motion.x[c, first:end]
        for i in range(end - first):
            x[i] += rows[i, SOLUTION + c]
    tension = motion.tension[first:end]
    for i in range(end - first - 1):
        tension[i] += scale * rows[i + 1, SOLUTION + 3]


@compiled
def keep_lengths(bodies: Bodies, operator: Operator, motion: Motion, scratch: Scratch, rod: int, slack: float) -> int:
    """Move a rod's nodes to their places at the end of the step, and find its tension.

    Args:
        bodies: the rods.
        operator: operator of this time step.
        motion: state of the rods. `x` is a guess of the end, and `tension` that of the step before; both are changed.
            For nodes that are held at their height, `floor_impulse` gets the vertical impulse that holds them, which
            may be a pull.
        scratch: arrays of the step: `start`; `load`, momentum with all impulses but those of the tension, which changes
            with `floor_impulse`; and `held`, which nodes stay where `x` has them: `FREE`, `IN_HEIGHT`, or `AT_REST`,
            as pinned nodes do.
        rod: number of the rod.
        slack: multiple of the tolerances that is enough for now.

    Returns:
        The number of Newton iterations; MAX_ITERATIONS + 1 if they did not converge.
    """
    first, end = bodies.first[rod], bodies.first[rod + 1]
    start, load, held = scratch.start, scratch.load, scratch.held[first:end]
    work = _parts(scratch.system, end - first)
    _find_free(held, work)
    for iteration in range(MAX_ITERATIONS):
        wrong = _directions(bodies, start, motion.x, rod, slack, work)
        wrong += _imbalance(bodies, operator, motion, start, load, rod, slack, work)
        if wrong == 0:
            for i in range(end - first):
                if held[i] == IN_HEIGHT:
                    too_much = work.lack[2, i] / operator.step
                    motion.floor_impulse[2, first + i] -= too_much
                    load[2, first + i] -= too_much
            return iteration
        _assemble(bodies, operator, motion, rod, work)
        solve(work.rows)
        _move(bodies, operator, motion, rod, work.rows)
    return MAX_ITERATIONS + 1
