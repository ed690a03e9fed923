"""Length: each segment keeps its own, exactly, while the step stays implicit Euler as a whole.

The end of a step obeys A (x - x0) = h p + h^2 F, with p the momentum and impulses of all but the tension and F the
tension of each segment along the mean of its edge before and after the step. That direction does no work, whatever the
tension: (e0 + e1) . (e1 - e0) = |e1|^2 - |e0|^2 = 0. (Along the new edge, compression would feed energy in; along the
old one, tension would.) Newton's method solves for all nodes and tensions of a rod at once:

    [A + G  J^T] [dx]   [ residual ]
    [J       0 ] [ y] = [    -C    ]

with C = |e1| - l, J the mean directions, y the change of tension times h^2, and G the stiffness that tension adds,
where it pulls. Half-bandwidth is 8 when each multiplier follows the second of its nodes; L D L^T needs no pivoting, as
each multiplier comes after the nodes that it acts on. It is the "fast projection" of Goldenthal et al. 2007 ("Efficient
simulation of inextensible cloth") with bending in the metric and momentum kept.

Nodes that the floor carries are held at their height meanwhile: an upright rod that lands is stopped as a whole.
"""

import numpy as np
from numpy.typing import NDArray

from worker.rod.arrays import Bodies, Motion, Scratch
from worker.rod.bending import Operator
from worker.rod.compiled import compiled
from worker.rod.model import Array

TOLERANCE = 1e-8
"""Of a segment's strain."""

BALANCE_TOLERANCE = 1e-7
"""Of a node's place, over a segment's length."""

FREE, IN_HEIGHT, AT_REST = 0, 1, 2

MAX_ITERATIONS = 12
BAND = 9
ROW = 2 * BAND
"""Numbers kept for each row of the upper half: the band, and zeros."""


@compiled
def room_for_system(nodes: int) -> Array:
    """Room for the equations of a rod of so many nodes."""
    return np.empty((ROW + 2) * 4 * nodes)


@compiled
def _directions(
    bodies: Bodies, start: Array, x: Array, held: NDArray[np.int8], rod: int, mean: Array, excess: Array
) -> float:
    """Mean direction, before and after the step, and excess length of each segment; returns the largest strain."""
    first, end, length = bodies.first[rod], bodies.first[rod + 1], bodies.length[rod]
    worst = 0.0
    for i in range(first, end - 1):
        squared = 0.0
        for c in range(3):
            edge = x[c, i + 1] - x[c, i]
            mean[c, i - first] = 0.5 * (edge + start[c, i + 1] - start[c, i]) / length
            squared += edge * edge
        excess[i - first] = np.sqrt(squared) - length
        if held[i] == AT_REST and held[i + 1] == AT_REST:
            excess[i - first] = 0.0
        worst = max(worst, abs(excess[i - first]) / length)
    return worst


@compiled
def _residual(
    bodies: Bodies, operator: Operator, motion: Motion, start: Array, load: Array, rod: int, mean: Array, right: Array
) -> None:
    """Fill in what the nodes' balance of momentum lacks, kg m, at the places of the nodes."""
    first, end = bodies.first[rod], bodies.first[rod + 1]
    h, bands, x = operator.step, operator.bands, motion.x
    for i in range(first, end):
        row = 4 * (i - first)
        for c in range(3):
            total = h * load[c, i] - bands[0, i] * (x[c, i] - start[c, i])
            if i > first:
                total -= bands[1, i - 1] * (x[c, i - 1] - start[c, i - 1])
                total -= h * h * motion.tension[i - 1] * mean[c, i - 1 - first]
            if i > first + 1:
                total -= bands[2, i - 2] * (x[c, i - 2] - start[c, i - 2])
            if i + 1 < end:
                total -= bands[1, i] * (x[c, i + 1] - start[c, i + 1])
                total += h * h * motion.tension[i] * mean[c, i - first]
            if i + 2 < end:
                total -= bands[2, i] * (x[c, i + 2] - start[c, i + 2])
            right[row + c] = total


@compiled
def _imbalance(bodies: Bodies, operator: Operator, held: NDArray[np.int8], rod: int, right: Array) -> float:
    """How far the nodes that are not held are from where their momentum takes them, over a segment's length."""
    first, end = bodies.first[rod], bodies.first[rod + 1]
    worst = 0.0
    for i in range(first, end):
        if held[i] != AT_REST:
            for c in range(2 if held[i] == IN_HEIGHT else 3):
                worst = max(worst, abs(right[4 * (i - first) + c]) / operator.bands[0, i])
    return float(worst / bodies.length[rod])


@compiled
def _assemble(
    bodies: Bodies, operator: Operator, motion: Motion, rod: int, mean: Array, excess: Array, upper: Array, right: Array
) -> None:
    """The upper half of the matrix; rows of multipliers get their right-hand side."""
    first, end, length = bodies.first[rod], bodies.first[rod + 1], bodies.length[rod]
    bands = operator.bands
    pull = 0.5 * operator.step**2 / length
    for i in range(first, end):
        row = 4 * (i - first)
        before = pull * max(motion.tension[i - 1], 0.0) if i > first else 0.0
        after = pull * max(motion.tension[i], 0.0) if i + 1 < end else 0.0
        for c in range(3):
            upper[row + c] = 0.0
            upper[row + c, 0] = bands[0, i] + before + after
            upper[row + c, 4] = bands[1, i] - after
            upper[row + c, 8] = bands[2, i]
        upper[row + 3] = 0.0
        right[row + 3] = 0.0
        if i == first:
            upper[row + 3, 0] = 1.0
            continue
        right[row + 3] = -excess[i - 1 - first]
        for c in range(3):
            upper[row - 4 + c, 7 - c] = -mean[c, i - 1 - first]
            upper[row + c, 3 - c] = mean[c, i - 1 - first]


@compiled
def _hold(upper: Array, right: Array, row: int) -> None:
    """Take one coordinate out of the system: it does not move."""
    for k in range(1, BAND):
        upper[row, k] = 0.0
        if row >= k:
            upper[row - k, k] = 0.0
    upper[row, 0] = 1.0
    right[row] = 0.0


@compiled
def _solve_banded(upper: Array, right: Array, size: int) -> None:
    """Solve a symmetric banded system, of which the rows hold the upper half, in place."""
    for j in range(size):
        inverse = 1.0 / upper[j, 0]
        for a in range(1, min(BAND, size - j)):
            factor = upper[j, a] * inverse
            # Of fixed length, so that it becomes one vector operation; the columns beyond the band hold zeros.
            for b in range(BAND - 1):
                upper[j + a, b] -= factor * upper[j, a + b]
            right[j + a] -= factor * right[j]
    for j in range(size - 1, -1, -1):
        total = right[j]
        for a in range(1, min(BAND, size - j)):
            total -= upper[j, a] * right[j + a]
        right[j] = total / upper[j, 0]


@compiled
def keep_lengths(bodies: Bodies, operator: Operator, motion: Motion, scratch: Scratch, rod: int) -> int:
    """Move a rod's nodes to where they are at the end of the step, and find its tension.

    Args:
        bodies: the rods.
        operator: of this time step.
        motion: `x` is a guess of the end, `tension` that of the step before; both are changed. So is the height's
            part of `floor_impulse`, where nodes are held, to what holding them takes. A pull lets the node go in the
            next step.
        scratch: `start`; `load`, the momentum and impulses of all forces but tension; `held`, which nodes stay where
            `x` has them: `FREE`, `IN_HEIGHT`, or `AT_REST` in all directions, as pinned nodes do.
        rod: which.

    Returns:
        Newton iterations; MAX_ITERATIONS + 1 if they did not converge.
    """
    first, end = bodies.first[rod], bodies.first[rod + 1]
    nodes, size = end - first, 4 * (end - first)
    start, load, held, work = scratch.start, scratch.load, scratch.held, scratch.system
    mean, excess = work[: 3 * nodes].reshape(3, nodes), work[3 * nodes : 4 * nodes]
    right = work[4 * nodes : 8 * nodes]
    upper = work[8 * nodes : 8 * nodes + ROW * size].reshape(size, ROW)
    scale = 1.0 / (operator.step * operator.step)
    for iteration in range(MAX_ITERATIONS):
        strain = _directions(bodies, start, motion.x, held, rod, mean, excess)
        _residual(bodies, operator, motion, start, load, rod, mean, right)
        if strain < TOLERANCE and _imbalance(bodies, operator, held, rod, right) < BALANCE_TOLERANCE:
            for i in range(first, end):
                if held[i] == IN_HEIGHT:
                    motion.floor_impulse[2, i] -= right[4 * (i - first) + 2] / operator.step
            return iteration
        _assemble(bodies, operator, motion, rod, mean, excess, upper, right)
        for i in range(nodes):
            for c in range(3):
                if held[first + i] == AT_REST or (c == 2 and held[first + i] == IN_HEIGHT):
                    _hold(upper, right, 4 * i + c)
            if i > 0 and held[first + i - 1] == AT_REST and held[first + i] == AT_REST:
                _hold(upper, right, 4 * i + 3)
        _solve_banded(upper, right, size)
        for i in range(nodes):
            for c in range(3):
                motion.x[c, first + i] += right[4 * i + c]
            if i > 0:
                motion.tension[first + i - 1] += scale * right[4 * i + 3]
    return MAX_ITERATIONS + 1
