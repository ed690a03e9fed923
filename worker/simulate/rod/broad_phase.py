"""Lists the pairs of segments that may come into contact, for several steps at a time.

Each node gets a box around its expected path in some steps, enlarged by its reach (see
`worker.simulate.rod.narrow_phase`) and some slack. Segments whose boxes overlap are listed. The list is valid as long
as all nodes, with their present reach, are inside their boxes, whatever made them move.

Rods that fall together are at rest relative to each other. So until they land, boxes move with the nodes' mean.
"""

from typing import NamedTuple

import numpy as np

from worker.simulate.rod.arrays import Bodies, Integers, Motion
from worker.simulate.rod.boxes import RUN, add_overlapping, hulls, pick_overlapping, runs_of, segment_boxes
from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.model import Array

NEIGHBOUR_RADII = 6.0
"""Distance along a rod, in its radii, within which two of its segments never count as touching."""

HORIZON_STEPS = 8.0
"""Number of time steps for which a node's box holds its expected path."""

SWEEP_RADII = 8.0
"""Longest expected path in a box along each axis, in the largest radius: a node that flies off must not be near all
others."""

SLACK_RADII = 0.5
"""Distance by which nodes may leave their expected path before a new list is made, in the largest radius."""


class Candidates(NamedTuple):
    """Pairs of segments that may touch, in ascending order of (one, other), with the memory of each pair.

    Attributes:
        one: (pairs,) number of a segment's first node.
        other: (pairs,) number of another segment's first node, greater than `one`.
        normal: (pairs, 3) last direction from the other segment to the one, a unit vector if they were near; 0 for a
            pair that no step has looked at.
        impulse: (pairs, 3) impulse on the one segment in the last step, N s.
        low: (3, nodes) least coordinates of the box around each node, m.
        high: (3, nodes) greatest coordinates of these boxes, m.
        middle: (3,) mean place of the nodes when the list was made, m.
    """

    one: Integers
    other: Integers
    normal: Array
    impulse: Array
    low: Array
    high: Array
    middle: Array


def no_candidates(nodes: int) -> Candidates:
    """Make an empty list that is not valid: its boxes are empty, so no node is inside."""
    none, nowhere = np.zeros(0, np.int64), np.full((3, nodes), np.nan)
    return Candidates(none, none, np.zeros((0, 3)), np.zeros((0, 3)), nowhere, nowhere, np.zeros(3))


@compiled
def middle_of(x: Array) -> Array:
    """Compute the mean (3,) of (3, nodes)."""
    return np.array([x[0].mean(), x[1].mean(), x[2].mean()])


@compiled
def still_hold(candidates: Candidates, x: Array, reach: Array, together: bool) -> bool:
    """Whether a list is valid: all nodes, with their reach, are inside their boxes.

    Args:
        candidates: the list.
        x: (3, nodes) places of the nodes, m.
        reach: (nodes,) reach of each node in this step, m.
        together: whether the boxes move with the nodes' mean, as rods fall together.
    """
    low, high = candidates.low, candidates.high
    moved = middle_of(x) - candidates.middle if together else np.zeros(3)
    for c in range(3):
        inside = True
        for i in range(x.shape[1]):
            at = x[c, i] - moved[c]
            inside &= (at - reach[i] >= low[c, i]) & (at + reach[i] <= high[c, i])
        if not inside:
            return False
    return True


@compiled
def find_candidates(
    bodies: Bodies, motion: Motion, frame: Array, step: float, reach: Array, before: Candidates
) -> Candidates:
    """List all pairs of segments that may touch in the next steps, with the memory that the old list has of them.

    Args:
        bodies: the rods.
        motion: their places and velocities.
        frame: (3,) velocity that all rods share, m/s.
        step: time step, s.
        reach: (nodes,) reach of each node in the first of these steps, m.
        before: the old list.
    """
    low, high = _node_boxes(motion, frame, step, reach, bodies.radius.max())
    one, other = _overlapping_segments(segment_boxes(low, high, bodies.first), bodies.first, _least_apart(bodies))
    normal, impulse = _remembered(one, other, before)
    return Candidates(one, other, normal, impulse, low, high, middle_of(motion.x))


@compiled
def _node_boxes(motion: Motion, frame: Array, step: float, reach: Array, radius: float) -> tuple[Array, Array]:
    """Compute the least and greatest coordinates, (3, nodes) m, of the nodes' expected paths with reach and slack."""
    x, v = motion.x, motion.v
    low, high = np.empty_like(x), np.empty_like(x)
    slack, farthest = SLACK_RADII * radius, SWEEP_RADII * radius
    for c in range(3):
        for i in range(x.shape[1]):
            ahead = min(max(HORIZON_STEPS * step * (v[c, i] - frame[c]), -farthest), farthest)
            low[c, i] = x[c, i] + min(ahead, 0.0) - reach[i] - slack
            high[c, i] = x[c, i] + max(ahead, 0.0) + reach[i] + slack
    return low, high


@compiled
def _least_apart(bodies: Bodies) -> Integers:
    """Compute the least distance of two segments of a rod that may touch, (rods,), in segments."""
    apart: Integers = np.maximum(2, np.ceil(NEIGHBOUR_RADII * bodies.radius / bodies.length) + 1).astype(np.int64)
    return apart


@compiled
def _overlapping_segments(segments: Array, first: Integers, least_apart: Integers) -> tuple[Integers, Integers]:
    """Find all pairs of segments with overlapping boxes, but for neighbours on a rod, in ascending order.

    The boxes around rods are compared first, then those around runs of segments, each in order, so that no sorting is
    needed.

    Args:
        segments: (nodes, 6) boxes around segments, m.
        first: (rods + 1,) number of each rod's first node; last the number of nodes.
        least_apart: (rods,) least distance of two segments of a rod that may touch, in segments.

    Returns:
        (pairs,) and (pairs,), numbers of the first nodes of the two segments of each pair.
    """
    starts, first_run = runs_of(first)
    runs = hulls(segments, starts)
    rods = hulls(runs, first_run)
    near_rods, rods_here = np.empty(len(rods), np.int64), np.empty(len(rods), np.int64)
    near_runs, runs_here = np.empty(len(runs), np.int64), np.empty(len(runs), np.int64)
    one, other = np.empty(8 * len(segments), np.int64), np.empty(8 * len(segments), np.int64)
    pairs = 0
    for rod in range(len(rods)):
        rods_near = add_overlapping(rods, rod, len(rods), rods, rod, near_rods, 0)
        for run in range(first_run[rod], first_run[rod + 1]):
            rods_met = pick_overlapping(rods, near_rods, rods_near, runs, run, rods_here)
            runs_near = _runs_near(runs, run, first_run, rods_here, rods_met, near_runs)
            if pairs + runs_near * RUN * RUN > len(other):
                one, other = _longer(one, runs_near * RUN * RUN), _longer(other, runs_near * RUN * RUN)
            for i in range(starts[run], starts[run + 1]):
                runs_met = pick_overlapping(runs, near_runs, runs_near, segments, i, runs_here)
                before = pairs
                for k in range(runs_met):
                    begin, end = starts[runs_here[k]], starts[runs_here[k] + 1]
                    if begin < first[rod + 1]:
                        begin = max(begin, i + least_apart[rod])
                    pairs = add_overlapping(segments, begin, end, segments, i, other, pairs)
                for pair in range(before, pairs):
                    one[pair] = i
    return one[:pairs].copy(), other[:pairs].copy()


@compiled
def _runs_near(runs: Array, run: int, first_run: Integers, rods: Integers, number: int, near: Integers) -> int:
    """Find the runs, from a given one on, whose boxes overlap the given run's.

    Args:
        runs: (runs, 6) boxes around runs, m.
        run: number of the given run.
        first_run: (rods + 1,) number of each rod's first run; last the number of runs.
        rods: numbers of the rods whose runs are compared.
        number: number of entries of `rods` to compare.
        near: array that gets the numbers of the runs, from its beginning.

    Returns:
        The number of runs found.
    """
    count = 0
    for k in range(number):
        rod = rods[k]
        count = add_overlapping(runs, max(run, first_run[rod]), first_run[rod + 1], runs, run, near, count)
    return count


@compiled
def _longer(numbers: Integers, least: int) -> Integers:
    """Copy an array into one of twice the length, or of `least` more entries if that is longer."""
    longer = np.empty(len(numbers) + max(len(numbers), least), np.int64)
    longer[: len(numbers)] = numbers
    return longer


@compiled
def _remembered(one: Integers, other: Integers, before: Candidates) -> tuple[Array, Array]:
    """Look up the normals and impulses, (pairs, 3), that a list remembers of pairs; 0 for those that it lacks."""
    normal, impulse = np.zeros((len(one), 3)), np.zeros((len(one), 3))
    known_one, known_other, known_normal, known_impulse = before.one, before.other, before.normal, before.impulse
    k = 0
    for pair in range(len(one)):
        i, j = one[pair], other[pair]
        while k < len(known_one) and (known_one[k] < i or (known_one[k] == i and known_other[k] < j)):
            k += 1
        if k < len(known_one) and known_one[k] == i and known_other[k] == j:
            for c in range(3):
                normal[pair, c] = known_normal[k, c]
                impulse[pair, c] = known_impulse[k, c]
    return normal, impulse
