"""Which segments may come into contact: a list that lasts several steps.

Each node gets a box around the way that it would go within some steps, with its reach (see
`worker.simulate.rod.narrow_phase`) and some slack. Segments whose boxes overlap are listed. The list holds for as long
as all nodes, with the reach that they have by then, are inside their boxes: whatever made them move, and whether they
went all the way or stopped.

Rods that fall together meet as little as if they were at rest. So until they land, boxes move along with the mean.
"""

from typing import NamedTuple

import numpy as np

from worker.simulate.rod.arrays import Bodies, Integers, Motion
from worker.simulate.rod.boxes import RUN, add_overlapping, hulls, pick_overlapping, runs_of, segment_boxes
from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.model import Array

NEIGHBOUR_RADII = 6.0
"""Segments of one rod nearer to each other along it than so many radii never count as touching."""

HORIZON_STEPS = 8.0
"""How far ahead boxes reach."""

SWEEP_RADII = 8.0
"""How far ahead boxes reach at most, in the greatest radius: a node that flies off must not be near all others."""

SLACK_RADII = 0.5
"""How far nodes may leave the way foreseen before the list is made anew, in the greatest radius."""


class Candidates(NamedTuple):
    """Pairs of segments, in ascending order of (one, other), with what is remembered of each.

    Attributes:
        one: (pairs,) first node of a segment.
        other: (pairs,) first node of another, > one.
        normal: (pairs, 3) from the other to the one when last seen, a unit vector if they were near; 0 if never seen.
        impulse: (pairs, 3) N s on the one in the last step.
        low: (3, nodes) least coordinates of the box around each node, m.
        high: (3, nodes) greatest.
        middle: (3,) mean of the nodes when the list was made, m.
    """

    one: Integers
    other: Integers
    normal: Array
    impulse: Array
    low: Array
    high: Array
    middle: Array


def no_candidates(nodes: int) -> Candidates:
    """An empty list that does not hold: no node is inside an empty box."""
    none, nowhere = np.zeros(0, np.int64), np.full((3, nodes), np.nan)
    return Candidates(none, none, np.zeros((0, 3)), np.zeros((0, 3)), nowhere, nowhere, np.zeros(3))


@compiled
def middle_of(x: Array) -> Array:
    """(3,): mean of (3, nodes)."""
    return np.array([x[0].mean(), x[1].mean(), x[2].mean()])


@compiled
def still_hold(candidates: Candidates, x: Array, reach: Array, together: bool) -> bool:
    """Whether all nodes are inside their boxes, with their reach; `together`, if these move along with the mean."""
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
    """List all pairs of segments that may touch in the next steps; what `before` remembers of them is kept.

    Args:
        bodies: the rods.
        motion: where they are, and how fast.
        frame: (3,) velocity that all rods share, m/s.
        step: s.
        reach: (nodes,) of each node in the first of these steps, m.
        before: the list until now.
    """
    low, high = _node_boxes(motion, frame, step, reach, bodies.radius.max())
    one, other = _overlapping_segments(segment_boxes(low, high, bodies.first), bodies.first, _least_apart(bodies))
    normal, impulse = _remembered(one, other, before)
    return Candidates(one, other, normal, impulse, low, high, middle_of(motion.x))


@compiled
def _node_boxes(motion: Motion, frame: Array, step: float, reach: Array, radius: float) -> tuple[Array, Array]:
    """Least and greatest coordinates, (3, nodes) m, of where nodes will soon be, with their reach and slack."""
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
    """(rods,): how many segments apart those of one rod are at least that may touch."""
    apart: Integers = np.maximum(2, np.ceil(NEIGHBOUR_RADII * bodies.radius / bodies.length) + 1).astype(np.int64)
    return apart


@compiled
def _overlapping_segments(segments: Array, first: Integers, least_apart: Integers) -> tuple[Integers, Integers]:
    """All pairs of segments with boxes that overlap, but for neighbours on a rod, in ascending order.

    Boxes around rods are asked first, then those around runs of segments, all in order: so nothing needs sorting.

    Args:
        segments: (nodes, 6) boxes, m.
        first: (rods + 1,) number of each rod's first node, and of all nodes.
        least_apart: (rods,) how many segments apart those of one rod must be.
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
    """Find those runs of the first so many `rods` whose boxes overlap that of a run, from it on; returns how many."""
    count = 0
    for k in range(number):
        rod = rods[k]
        count = add_overlapping(runs, max(run, first_run[rod]), first_run[rod + 1], runs, run, near, count)
    return count


@compiled
def _longer(numbers: Integers, least: int) -> Integers:
    """A copy with twice the room, or at least so much more."""
    longer = np.empty(len(numbers) + max(len(numbers), least), np.int64)
    longer[: len(numbers)] = numbers
    return longer


@compiled
def _remembered(one: Integers, other: Integers, before: Candidates) -> tuple[Array, Array]:
    """Normals and impulses, (pairs, 3), that a list remembers of pairs; 0 of those that it does not have."""
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
