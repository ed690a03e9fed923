"""Find where cables went through each other, or through the floor, between two moments that lie close together.

Every node is assumed to move along a straight line between the two moments. Two segments meet on the way if their four
ends come to lie in one plane, which is a cubic equation in time, and the lines through them cross within both (Provot
1997, "Collision and self-collision handling in cloth model dedicated to design garments"). A centreline that meets
another has gone through it. The method assumes nothing about the start, so cables may stand upright or start within
each other. A tip that slips round another's end meets nothing.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from worker.curves import Points
from worker.simulate.checks.contact import segment_gap
from worker.simulate.checks.plan_view import END_RADII
from worker.simulate.checks.spans import Indices
from worker.simulate.rod.compiled import compiled

UNDECIDED_RADII = 1e-6
"""Distance in radii below which neither centreline is on a side of the other: only rounding separates them."""

UNDONE_RADII = 40.0
"""Distance along both cables below which two passages the opposite ways are one that was undone."""

_BISECTIONS = 48
"""Halvings of an interval of time that narrow a meeting down to rounding."""

_EDGE = 1e-9
"""Share by which segments are taken to be longer, so that a passage exactly at a node is not lost between two."""


@dataclass(frozen=True, slots=True)
class Passage:
    """Two strands that went through each other.

    Attributes:
        cables: the cables that the two strands are of; twice the same where a cable went through itself.
        along_radii: distance along either cable, in the larger radius of the two.
        side: 1 or -1, the way that the one went.
        near_end: whether the passage was within `END_RADII` of an end of either cable.
    """

    cables: tuple[int, int]
    along_radii: tuple[float, float]
    side: int
    near_end: bool

    def undoes(self, other: "Passage") -> bool:
        """Whether this passage undoes the other: the opposite direction, at nearly the same place."""
        places = zip(self.along_radii, other.along_radii, strict=True)
        return (
            self.cables == other.cables
            and self.side == -other.side
            and all(abs(here - there) < UNDONE_RADII for here, there in places)
        )


def passes_between(
    before_m: tuple[Points, ...], after_m: tuple[Points, ...], radii_m: NDArray[np.float64]
) -> list[Passage]:
    """All passages between two moments, in the order of the cables.

    A cable that meets itself in a loop shorter than `END_RADII` is ignored. A curve that returns to its start is at
    least 2 pi times its least radius of curvature long, so such a loop bends to less than 1.6 of the cable's own radii,
    at which a round section has long been crushed.

    Args:
        before_m: each cable's nodes (N, 3) at the first moment.
        after_m: the same nodes at the second.
        radii_m: (cables,), each cable's radius.
    """
    counts = np.array([len(each) for each in before_m])
    cable = np.repeat(np.arange(len(counts)), counts)
    before, after = np.concatenate(before_m), np.concatenate(after_m)
    found = np.empty((256, 5))
    count = _meetings(before, after, cable, found)
    if count > len(found):
        found = np.empty((count, 5))
        _meetings(before, after, cable, found)
    if not count:
        return []
    found = found[:count]
    one, other = found[:, 0].astype(np.int64), found[:, 1].astype(np.int64)
    gap = segment_gap(before[one], before[one + 1], before[other], before[other + 1])
    starts = np.cumsum(counts) - counts
    passages = []
    for i, j, (s, t, side), distance in zip(one, other, found[:, 2:], gap, strict=True):
        cables = int(cable[i]), int(cable[j])
        radius = float(max(radii_m[cables[0]], radii_m[cables[1]]))
        segments = [float(np.linalg.norm(before[k + 1] - before[k])) / radius for k in (i, j)]
        places = [float(i - starts[cables[0]] + s), float(j - starts[cables[1]] + t)]
        along = places[0] * segments[0], places[1] * segments[1]
        lengths = [(counts[c] - 1) * segment for c, segment in zip(cables, segments, strict=True)]
        from_end = min(min(a, length - a) for a, length in zip(along, lengths, strict=True))
        is_kink = cables[0] == cables[1] and abs(along[1] - along[0]) < END_RADII
        if distance > UNDECIDED_RADII * radius and not is_kink:
            passages.append(Passage(cables, along, int(side), bool(from_end <= END_RADII)))
    passages.sort(key=lambda each: (each.cables, each.along_radii))
    # Both segments that share a node find a passage exactly at it.
    return [each for n, each in enumerate(passages) if not any(_is_same(each, one) for one in passages[:n])]


def _is_same(one: Passage, other: Passage) -> bool:
    places = zip(one.along_radii, other.along_radii, strict=True)
    return (one.cables, one.side) == (other.cables, other.side) and all(abs(a - b) < 1e-6 for a, b in places)


def sunk_between(before_m: tuple[Points, ...], after_m: tuple[Points, ...]) -> int:
    """Number of nodes that were above the floor's surface before and are below it now."""
    before, after = (np.concatenate(each)[:, 2] for each in (before_m, after_m))
    return int(np.count_nonzero((before > 0) & (after < 0)))


class PassWatch:
    """Follows a fall from moment to moment and counts the passages of cables through each other and the floor.

    Attributes:
        undone: number of passages that a later one undid, so that the cables lie as they should.
        sunk_nodes: number of times that a node went below the floor's surface, whether or not it came up again.
    """

    def __init__(self, nodes_m: tuple[Points, ...], radii_m: NDArray[np.float64]) -> None:
        """Begin to watch.

        Args:
            nodes_m: nodes of each cable at the start, (N, 3) each.
            radii_m: radius of each cable, (cables,).
        """
        self.undone = 0
        self.sunk_nodes = 0
        self._before = nodes_m
        self._radii = radii_m
        self._standing: list[Passage] = []

    @property
    def standing(self) -> tuple[Passage, ...]:
        """All passages that weren't undone, in the order in which they were seen."""
        return tuple(self._standing)

    @property
    def passes(self) -> int:
        """Number of passages away from all ends that weren't undone."""
        return sum(not each.near_end for each in self._standing)

    @property
    def end_slips(self) -> int:
        """Number of passages close to an end that weren't undone."""
        return sum(each.near_end for each in self._standing)

    def forget(self) -> None:
        """Take the cables' present order as the right one: earlier passages no longer count."""
        self._standing.clear()

    def see(self, nodes_m: tuple[Points, ...]) -> None:
        """Count the passages since the last moment; between two moments nodes should move by a radius at most."""
        for passage in passes_between(self._before, nodes_m, self._radii):
            earlier = next((each for each in self._standing if passage.undoes(each)), None)
            if earlier is None:
                self._standing.append(passage)
            else:
                self._standing.remove(earlier)
                self.undone += 1
        self.sunk_nodes += sunk_between(self._before, nodes_m)
        self._before = nodes_m


@compiled
def _swept_boxes(before: Points, after: Points) -> tuple[Points, Points]:
    """Least and greatest coordinates of each segment, from a node to the next, over both moments."""
    low, high = np.empty(before.shape), np.empty(before.shape)
    for i in range(len(before) - 1):
        for c in range(3):
            low[i, c] = min(before[i, c], before[i + 1, c], after[i, c], after[i + 1, c])
            high[i, c] = max(before[i, c], before[i + 1, c], after[i, c], after[i + 1, c])
    return low, high


@compiled
def _meetings(before: Points, after: Points, cable: Indices, found: NDArray[np.float64]) -> int:
    """Find all meetings of segments and return their number.

    `found` receives a row for each, as many as it has: both segments, the fractions along them, and the side. The swept
    boxes are sorted along the axis on which the cables spread farthest.
    """
    nodes = len(cable)
    low, high = _swept_boxes(before, after)
    axis = 0
    for c in (1, 2):
        if np.ptp(after[:, c]) > np.ptp(after[:, axis]):
            axis = c
    second, third = (axis + 1) % 3, (axis + 2) % 3
    order = np.argsort(low[: nodes - 1, axis])
    meeting = np.empty((3, 3))
    count = 0
    for place in range(len(order)):
        here = order[place]
        if cable[here] != cable[here + 1]:
            continue
        for ahead in range(place + 1, len(order)):
            there = order[ahead]
            if low[there, axis] > high[here, axis]:
                break
            if low[there, second] > high[here, second] or low[here, second] > high[there, second]:
                continue
            if low[there, third] > high[here, third] or low[here, third] > high[there, third]:
                continue
            i, j = min(here, there), max(here, there)
            # Neighbouring segments share a node, at which they always meet.
            if cable[there] != cable[there + 1] or (j - i < 2 and cable[i] == cable[j]):
                continue
            for n in range(_meet(before, after, i, j, meeting)):
                if count < len(found):
                    found[count, 0], found[count, 1] = i, j
                    found[count, 2:] = meeting[n]
                count += 1
    return count


@compiled
def _volume(before: Points, after: Points, i: int, j: int, time: float, edges: Points) -> float:
    """Triple product of the two segments and the vector between their first ends; `edges` receives these three."""
    for c in range(3):
        p = before[i, c] + time * (after[i, c] - before[i, c])
        q = before[j, c] + time * (after[j, c] - before[j, c])
        edges[0, c] = before[i + 1, c] + time * (after[i + 1, c] - before[i + 1, c]) - p
        edges[1, c] = before[j + 1, c] + time * (after[j + 1, c] - before[j + 1, c]) - q
        edges[2, c] = q - p
    u, v, w = edges[0], edges[1], edges[2]
    return float(
        w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2]) + w[2] * (u[0] * v[1] - u[1] * v[0])
    )


@compiled
def _meet(before: Points, after: Points, i: int, j: int, meeting: Points) -> int:
    """Number of times that two segments meet; `meeting` receives the fractions along them and the side of each time."""
    edges = np.empty((3, 3))
    f0 = _volume(before, after, i, j, 0.0, edges)
    f1 = _volume(before, after, i, j, 1 / 3, edges)
    f2 = _volume(before, after, i, j, 2 / 3, edges)
    f3 = _volume(before, after, i, j, 1.0, edges)
    # Coefficients in Bernstein's form: if they all have one sign, the cubic has no zero.
    b1, b2 = (-5 * f0 + 18 * f1 - 9 * f2 + 2 * f3) / 6, (2 * f0 - 9 * f1 + 18 * f2 - 5 * f3) / 6
    if min(f0, f3, b1, b2) > 0 or max(f0, f3, b1, b2) < 0:
        return 0
    # Between its turning points the cubic is monotone.
    third, twice, slope = f3 - 3 * b2 + 3 * b1 - f0, 2 * (b2 - 2 * b1 + f0), b1 - f0
    bounds = np.array([0.0, 1.0, 1.0, 1.0])
    inner = 1
    root = twice * twice - 4 * third * slope
    if root > 0:
        middle = -0.5 * (twice + (np.sqrt(root) if twice > 0 else -np.sqrt(root)))
        first = middle / third if third != 0 else 2.0
        second = slope / middle if middle != 0 else 2.0
        for time in (min(first, second), max(first, second)):
            if 0 < time < 1:
                bounds[inner] = time
                inner += 1
    count = 0
    for piece in range(inner):
        low, high = bounds[piece], bounds[piece + 1]
        at_low = _volume(before, after, i, j, low, edges)
        at_high = _volume(before, after, i, j, high, edges)
        if (at_low < 0) == (at_high < 0):
            continue
        for _ in range(_BISECTIONS):
            time = 0.5 * (low + high)
            if (_volume(before, after, i, j, time, edges) < 0) == (at_low < 0):
                low = time
            else:
                high = time
        _volume(before, after, i, j, high, edges)
        u, v, w = edges[0], edges[1], edges[2]
        uu, vv, uv = (u * u).sum(), (v * v).sum(), (u * v).sum()
        uw, vw = (u * w).sum(), (v * w).sum()
        spread = uu * vv - uv * uv
        if spread <= 1e-12 * uu * vv:
            continue
        s, t = (uw * vv - uv * vw) / spread, (uv * uw - uu * vw) / spread
        if -_EDGE <= s <= 1 + _EDGE and -_EDGE <= t <= 1 + _EDGE:
            meeting[count, 0], meeting[count, 1] = s, t
            meeting[count, 2] = 1.0 if at_low < 0 else -1.0
            count += 1
    return count
