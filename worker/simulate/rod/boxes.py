"""Boxes with sides along the axes, and the search for boxes that overlap.

A box is a row of its least x, y, z and its greatest x, y, z. A box of NaN is empty: it overlaps no box, not even an
infinite one, and adds nothing to a hull.
"""

import numpy as np

from worker.simulate.rod.arrays import Integers
from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.model import Array

RUN = 8
"""Number of consecutive segments that share a box."""


@compiled
def segment_boxes(low: Array, high: Array, first: Integers) -> Array:
    """Make the boxes around segments.

    Args:
        low: (3, nodes) least coordinates of the boxes around nodes, m.
        high: (3, nodes) greatest coordinates of these boxes, m.
        first: (rods + 1,) number of each rod's first node; last the number of nodes.

    Returns:
        (nodes, 6) box around the segment that starts at each node, m; a rod's last node has an empty one.
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
        first: (rods + 1,) number of each rod's first node; last the number of nodes.

    Returns:
        (runs + 1,) number of each run's first node, last the number of nodes; and (rods + 1,) number of each rod's
        first run, last the number of runs.
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
    """Make the box around each group of boxes.

    Args:
        boxes: (n, 6) boxes, m.
        starts: (groups + 1,) number of each group's first box; last the number of boxes.

    Returns:
        (groups, 6) boxes, m.
    """
    around = np.empty((len(starts) - 1, 6))
    for group in range(len(starts) - 1):
        around[group, :3] = np.inf
        around[group, 3:] = -np.inf
        for i in range(starts[group], starts[group + 1]):
            for c in range(3):
                # In this order NaN is ignored, as it is neither less nor greater than the value before.
                around[group, c] = min(around[group, c], boxes[i, c])
                around[group, c + 3] = max(around[group, c + 3], boxes[i, c + 3])
    return around


@compiled
def add_overlapping(others: Array, begin: int, end: int, boxes: Array, one: int, found: Integers, count: int) -> int:
    """Append the numbers of the boxes that overlap a given box.

    The arguments are numbers, not views of parts of arrays: making views would take longer than the comparisons.

    Args:
        others: (n, 6) boxes that are compared, m.
        begin: number of the first of them.
        end: number after the last of them.
        boxes: (m, 6) boxes among which the given one is, m.
        one: number of the given box.
        found: array that gets the numbers, in ascending order; it must have room for all.
        count: number of entries that `found` has before.

    Returns:
        The number of entries that `found` has now.
    """
    x, y, z, end_x, end_y, end_z = _sides(boxes, one)
    for i in range(begin, end):
        meet = (others[i, 0] <= end_x) & (others[i, 3] >= x) & (others[i, 1] <= end_y) & (others[i, 4] >= y)
        # Every number is written, and counted if its box overlaps: so the processor has no branch to predict.
        found[count] = i
        count += meet & (others[i, 2] <= end_z) & (others[i, 5] >= z)
    return count


@compiled
def pick_overlapping(others: Array, asked: Integers, number: int, boxes: Array, one: int, found: Integers) -> int:
    """Find the boxes among some that overlap a given box.

    Args:
        others: (n, 6) boxes, m.
        asked: numbers of the boxes that are compared.
        number: number of entries of `asked` to compare.
        boxes: (m, 6) boxes among which the given one is, m.
        one: number of the given box.
        found: array that gets the numbers, from its beginning; it must have room for all.

    Returns:
        The number of boxes found.
    """
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
