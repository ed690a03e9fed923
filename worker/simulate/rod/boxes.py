"""Boxes with sides along the axes, and which of them overlap: a box is a row of least x, y, z and greatest x, y, z.

A box of NaN is empty: it overlaps none, not even one that is infinite, and adds nothing to a hull.
"""

import numpy as np

from worker.simulate.rod.arrays import Integers
from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.model import Array

RUN = 8
"""Segments that follow each other and share a box."""


@compiled
def segment_boxes(low: Array, high: Array, first: Integers) -> Array:
    """Boxes around segments, each named by its first node; a rod's last node gets an empty one.

    Args:
        low: (3, nodes) least coordinates of the boxes around nodes, m.
        high: (3, nodes) greatest.
        first: (rods + 1,) number of each rod's first node, and of all nodes.

    Returns:
        (nodes, 6) m.
    """
    boxes = np.empty((low.shape[1], 6))
    for rod in range(len(first) - 1):
        last = first[rod + 1] - 1
        for i in range(first[rod], last):
            for c in range(3):
                boxes[i, c] = min(low[c, i], low[c, i + 1])
                boxes[i, c + 3] = max(high[c, i], high[c, i + 1])
        boxes[last] = np.nan
    return boxes


@compiled
def runs_of(first: Integers) -> tuple[Integers, Integers]:
    """Cut rods into runs of segments.

    Args:
        first: (rods + 1,) number of each rod's first node, and of all nodes.

    Returns:
        (runs + 1,) first node of each run, and the number of all nodes; (rods + 1,) first run of each rod, and the
        number of all runs.
    """
    rods = len(first) - 1
    of_rod = np.zeros(rods + 1, np.int64)
    for rod in range(rods):
        of_rod[rod + 1] = of_rod[rod] + (first[rod + 1] - first[rod] + RUN - 1) // RUN
    starts = np.empty(of_rod[rods] + 1, np.int64)
    for rod in range(rods):
        for run in range(of_rod[rod], of_rod[rod + 1]):
            starts[run] = first[rod] + (run - of_rod[rod]) * RUN
    starts[of_rod[rods]] = first[rods]
    return starts, of_rod


@compiled
def hulls(boxes: Array, starts: Integers) -> Array:
    """(groups, 6): boxes around those of `boxes` (n, 6) from each of `starts` (groups + 1,) to the next."""
    around = np.empty((len(starts) - 1, 6))
    for group in range(len(starts) - 1):
        around[group, :3] = np.inf
        around[group, 3:] = -np.inf
        for i in range(starts[group], starts[group + 1]):
            for c in range(3):
                # In this order NaN is left out: it is not less than what is there, nor greater.
                around[group, c] = min(around[group, c], boxes[i, c])
                around[group, c + 3] = max(around[group, c + 3], boxes[i, c + 3])
    return around


@compiled
def add_overlapping(others: Array, begin: int, end: int, boxes: Array, one: int, found: Integers, count: int) -> int:
    """Append the numbers of those boxes that overlap one.

    It takes numbers, not views of parts of arrays: to make these would take longer than the comparisons.

    Args:
        others: (n, 6) m.
        begin: number of the first that is asked.
        end: number after the last.
        boxes: (m, 6) m.
        one: number of the one of these.
        found: the numbers, in ascending order; there must be room for all.
        count: how many of `found` there were.

    Returns:
        How many there are.
    """
    x, y, z, end_x, end_y, end_z = _sides(boxes, one)
    for i in range(begin, end):
        meet = (others[i, 0] <= end_x) & (others[i, 3] >= x) & (others[i, 1] <= end_y) & (others[i, 4] >= y)
        # Written always, counted if it overlaps: no branch that can't be foretold.
        found[count] = i
        count += meet & (others[i, 2] <= end_z) & (others[i, 5] >= z)
    return count


@compiled
def pick_overlapping(others: Array, asked: Integers, number: int, boxes: Array, one: int, found: Integers) -> int:
    """Find those of the first so many boxes `asked` that overlap one; as `add_overlapping`."""
    x, y, z, end_x, end_y, end_z = _sides(boxes, one)
    count = 0
    for k in range(number):
        i = asked[k]
        meet = (others[i, 0] <= end_x) & (others[i, 3] >= x) & (others[i, 1] <= end_y) & (others[i, 4] >= y)
        found[count] = i
        count += meet & (others[i, 2] <= end_z) & (others[i, 5] >= z)
    return count


@compiled
def _sides(boxes: Array, i: int) -> tuple[float, float, float, float, float, float]:
    return boxes[i, 0], boxes[i, 1], boxes[i, 2], boxes[i, 3], boxes[i, 4], boxes[i, 5]
