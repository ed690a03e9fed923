"""Length: each segment keeps its own, exactly, by the least change in the metric of the implicit operator.

Newton's method on the constraints of a whole rod at once ("fast projection", Goldenthal et al. 2007, "Efficient
simulation of inextensible cloth"), with the bending inside the metric, so that the step as a whole is implicit Euler
and not a splitting of it. The system

    [A  J^T] [dx]   [ 0 ]
    [J   0 ] [ y] = [-C ]

with C = |x[i+1] - x[i]| - l has half-bandwidth 8 when each multiplier follows the second of its nodes; L D L^T needs no
pivoting, as each multiplier comes after the nodes that it acts on.
"""

import numpy as np

from worker.rod.arrays import Bodies, Motion
from worker.rod.bending import Operator
from worker.rod.compiled import compiled
from worker.rod.model import Array

TOLERANCE = 1e-7
"""Of a segment's strain."""

MAX_ITERATIONS = 12
BAND = 9
ROW = 2 * BAND
"""Numbers kept for each row of the upper half: the band, and zeros."""


@compiled
def _residual(bodies: Bodies, x: Array, rod: int, direction: Array, residual: Array) -> float:
    """Unit directions and excess lengths of a rod's segments; returns the largest strain."""
    first, end, length = bodies.first[rod], bodies.first[rod + 1], bodies.length[rod]
    worst = 0.0
    for i in range(first, end - 1):
        dx, dy, dz = x[0, i + 1] - x[0, i], x[1, i + 1] - x[1, i], x[2, i + 1] - x[2, i]
        norm = np.sqrt(dx * dx + dy * dy + dz * dz)
        safe = max(norm, 1e-3 * length)
        direction[0, i], direction[1, i], direction[2, i] = dx / safe, dy / safe, dz / safe
        residual[i] = norm - length
        if bodies.pinned[i] and bodies.pinned[i + 1]:
            residual[i] = 0.0
        worst = max(worst, abs(residual[i]) / length)
    return worst


@compiled
def _assemble(bodies: Bodies, operator: Operator, rod: int, direction: Array, upper: Array) -> None:
    first, end = bodies.first[rod], bodies.first[rod + 1]
    bands, pinned = operator.bands, bodies.pinned
    for i in range(first, end):
        row = 4 * (i - first)
        for c in range(3):
            upper[row + c] = 0.0
            upper[row + c, 0] = bands[0, i]
            upper[row + c, 4] = bands[1, i]
            upper[row + c, 8] = bands[2, i]
        upper[row + 3] = 0.0
        if i == first or (pinned[i - 1] and pinned[i]):
            upper[row + 3, 0] = -1.0
            continue
        for c in range(3):
            if not pinned[i - 1]:
                upper[row - 4 + c, 7 - c] = -direction[c, i - 1]
            if not pinned[i]:
                upper[row + c, 3 - c] = direction[c, i - 1]


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
def restore_lengths(bodies: Bodies, operator: Operator, motion: Motion, rod: int, work: Array) -> int:
    """Move a rod's nodes until its segments have their lengths, and count what it takes as tension.

    Args:
        bodies: the rods.
        operator: of this time step.
        motion: `x` and `tension` are changed.
        rod: which.
        work: scratch of at least (ROW + 6) * 4 * nodes of the rod.

    Returns:
        Newton iterations; MAX_ITERATIONS + 1 if they did not converge.
    """
    first, end = bodies.first[rod], bodies.first[rod + 1]
    nodes, size = end - first, 4 * (end - first)
    direction = work[: 3 * bodies.first[-1]].reshape(3, bodies.first[-1])
    offset = 3 * bodies.first[-1]
    residual = work[offset : offset + bodies.first[-1]]
    offset += bodies.first[-1]
    right = work[offset : offset + size]
    offset += size
    upper = work[offset : offset + ROW * size].reshape(size, ROW)
    x, tension = motion.x, motion.tension
    scale = 1.0 / (operator.step * operator.step)
    for iteration in range(MAX_ITERATIONS):
        if _residual(bodies, x, rod, direction, residual) < TOLERANCE:
            return iteration
        _assemble(bodies, operator, rod, direction, upper)
        for i in range(nodes):
            right[4 * i] = 0.0
            right[4 * i + 1] = 0.0
            right[4 * i + 2] = 0.0
            right[4 * i + 3] = -residual[first + i - 1] if i > 0 else 0.0
        _solve_banded(upper, right, size)
        for i in range(nodes):
            for c in range(3):
                x[c, first + i] += right[4 * i + c]
            if i > 0:
                tension[first + i - 1] += scale * right[4 * i + 3]
    return MAX_ITERATIONS + 1
