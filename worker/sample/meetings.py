"""The places where the plans of cables meet: they cross, themselves or each other, or run side by side too close.

A meeting is one patch of places that are too close in plan view for both cables to lie at one height. Pure numpy.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

Array = NDArray[np.float64]
Integers = NDArray[np.int64]

SAMPLE_RADII = 0.5
"""Distance of the samples of a plan, in radii of its cable."""

SELF_RADII = 5.0
"""Distance along a cable, in radii, up to which it does not meet itself: a bend that tight is as narrow as it is
long."""

_ROOM = 1.1
"""Distance in plan view, in sums of radii, up to which cables meet."""


@dataclass(frozen=True, slots=True)
class Plan:
    """The plan of a cable.

    Attributes:
        points_m: (N, 2) metres, points of the centreline at equal distances along it.
        length_m: length of the cable, in metres.
        radius_m: radius of the cable, in metres.
        stiffness: bending stiffness, in any unit that all plans share.
    """

    points_m: Array
    length_m: float
    radius_m: float
    stiffness: float

    @property
    def step_m(self) -> float:
        """Distance of the points along the plan, in metres."""
        return self.length_m / (len(self.points_m) - 1)


@dataclass(frozen=True, slots=True)
class Meeting:
    """A patch of places where two strands are too close in plan view for one height.

    Attributes:
        one: number of the one strand's cable.
        other: number of the other strand's cable, not below `one`; the same where a cable meets itself.
        one_m: (K,) metres, places along the one strand; where a cable meets itself, the earlier ones.
        other_m: (K,) metres, place along the other strand close to each of them.
        closest: number of the pair of places that are closest in plan view.
    """

    one: int
    other: int
    one_m: Array
    other_m: Array
    closest: int


def samples_of(length_m: float, radius_m: float) -> int:
    """Count the samples of a plan: an odd number, so that one of them is its middle."""
    return 2 * max(8, round(length_m / (2 * SAMPLE_RADII * radius_m))) + 1


def find_meetings(plans: Sequence[Plan], spacing_m: Sequence[float]) -> list[Meeting]:
    """Find all meetings of plans, in the order of the cables and, for each pair, of the places along the first.

    Args:
        plans: the plans.
        spacing_m: for each cable, distance along it of the pairs that a long meeting keeps, in metres.
    """
    trees = [cKDTree(plan.points_m) for plan in plans]
    return [
        meeting
        for one in range(len(plans))
        for other in range(one, len(plans))
        for meeting in _meetings_of(plans, trees, one, other, spacing_m)
    ]


def _meetings_of(
    plans: Sequence[Plan], trees: Sequence[cKDTree], one: int, other: int, spacing_m: Sequence[float]
) -> Iterator[Meeting]:
    a, b = plans[one], plans[other]
    pairs = trees[one].sparse_distance_matrix(trees[other], _ROOM * (a.radius_m + b.radius_m), output_type="coo_matrix")
    i, j, distance = pairs.row.astype(np.int64), pairs.col.astype(np.int64), pairs.data
    if one == other:
        apart = (j - i) * a.step_m > SELF_RADII * a.radius_m
        i, j, distance = i[apart], j[apart], distance[apart]
    order = np.lexsort((j, i))
    i, j, distance = i[order], j[order], distance[order]
    patch = _patches(i, j)
    for number in dict.fromkeys(patch.tolist()):
        here = np.flatnonzero(patch == number)
        strides = [max(1, int(spacing_m[k] / plans[k].step_m)) for k in (one, other)]
        kept = _thinned(i[here], j[here], distance[here], strides)
        chosen = here[kept]
        yield Meeting(one, other, i[chosen] * a.step_m, j[chosen] * b.step_m, int(np.argmin(distance[chosen])))


def _patches(i: Integers, j: Integers) -> Integers:
    """Number the patches of neighbouring pairs of samples, (K,)."""
    if len(i) == 0:
        return np.zeros(0, np.int64)
    links = cKDTree(np.stack([i, j], axis=1)).query_pairs(1.5, p=np.inf, output_type="ndarray")
    graph = coo_array((np.ones(len(links)), (links[:, 0], links[:, 1])), shape=(len(i), len(i)))
    numbers: Integers = connected_components(graph, directed=False)[1].astype(np.int64)
    return numbers


def _thinned(i: Integers, j: Integers, distance: Array, strides: Sequence[int]) -> Integers:
    """Choose the pairs of a patch that stand for it: for places along either strand the closest pair, and the ends."""
    kept = {int(np.argmin(distance))}
    for places, stride in ((i, strides[0]), (j, strides[1])):
        wanted = np.unique(np.concatenate([np.arange(places.min(), places.max(), stride), [places.max()]]))
        for place in wanted:
            here = np.flatnonzero(places == place)
            if len(here):
                kept.add(int(here[np.argmin(distance[here])]))
    return np.array(sorted(kept), np.int64)
