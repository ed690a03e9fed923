"""Length: each segment keeps its own, exactly, while the step stays implicit Euler as a whole.

The end of a step obeys A (x - x0) = h p + h^2 F, with p the momentum and impulses of all but the tension and F the
tension of each segment along the mean of its edge before and after the step. That direction does no work, whatever the
tension: (e0 + e1) . (e1 - e0) = |e1|^2 - |e0|^2 = 0. (Along the new edge, compression would feed energy in; along the
old one, tension would.) Newton's method solves for all nodes and tensions of a rod at once:

    [A + G  J^T] [dx]   [ residual ]
    [J       0 ] [ y] = [    -C    ]

with C = |e1| - l, J the mean directions, y the change of tension times h^2, and G the stiffness that tension adds,
where it pulls. A node couples with two on either side when each multiplier stands at the second of its nodes, and
elimination needs no pivoting, as each multiplier comes after the coordinates that it acts on. It is the "fast
projection" of Goldenthal et al. 2007 ("Efficient simulation of inextensible cloth") with bending in the metric and
momentum kept.

Nodes that the floor carries are held at their height meanwhile: an upright rod that lands is stopped as a whole.
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
"""Of a segment's strain."""

BALANCE_TOLERANCE_M_S = 2e-6
"""Of a node's speed, if all that its momentum lacks were to move it alone: a stiff rod moves so as a whole."""

FREE, IN_HEIGHT, AT_REST = 0, 1, 2

MAX_ITERATIONS = 12

PADDING = 2
"""Zeros after a rod's last node, for the nodes that others would couple with."""


class Work(NamedTuple):
    """What is computed for a rod.

    Attributes:
        free: (4, nodes + PADDING) 0.0 for coordinates that are held and multipliers that have nothing to act on, else
            1.0. The multiplier at each node is that of the segment that ends there.
        mean: (3, nodes) direction of the segment that starts at each node, before and after the step.
        excess: (nodes,) by how much that segment is too long, m.
        moved: (nodes + PADDING,) how far the nodes have moved in the step, in one direction, m.
        lack: (3, nodes) what the nodes' balance of momentum lacks, kg m, at the places of the nodes.
        rows: (nodes, ROW) the equations.
    """

    free: Array
    mean: Array
    excess: Array
    moved: Array
    lack: Array
    rows: Array


@compiled
def room_for_system(nodes: int) -> Array:
    """Room for the equations of a rod of so many nodes."""
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
    """What the equations leave out."""
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
    """Mean direction and excess length of each segment; returns how many have not kept their length."""
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
    """What the balance of momentum lacks; returns in how many coordinates nodes are not where momentum takes them."""
    first, end = bodies.first[rod], bodies.first[rod + 1]
    h, nodes, moved = operator.step, end - first, work.moved
    # The last two are zero where there is no node to couple with.
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
    """Fill in the equations of what is free; what is held gets those of not moving."""
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
    """Add the solution to the places and the tension."""
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
    """Move a rod's nodes to where they are at the end of the step, and find its tension.

    Args:
        bodies: the rods.
        operator: of this time step.
        motion: `x` is a guess of the end, `tension` that of the step before; both are changed. So is the height's
            part of `floor_impulse`, where nodes are held, to what holding them takes, be it a pull.
        scratch: `start`; `load`, the momentum and impulses of all forces but tension, changed with `floor_impulse`;
            `held`, which nodes stay where `x` has them: `FREE`, `IN_HEIGHT`, or `AT_REST` in all directions, as pinned
            nodes do.
        rod: which.
        slack: how many times the tolerances will do for now.

    Returns:
        Newton iterations; MAX_ITERATIONS + 1 if they did not converge.
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
