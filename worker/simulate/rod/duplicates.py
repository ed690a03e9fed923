"""Picks the pairs of segments that push where several of them touch at one place.

Where curves are closest at a node, all pairs of the segments that meet there find that place. Sweeps would hand an
impulse back and forth between such contacts for long. So only one of them pushes, and takes over the impulses that the
others remember.
"""

import numpy as np

from worker.simulate.rod.arrays import Integers
from worker.simulate.rod.compiled import compiled
from worker.simulate.rod.model import Array

ONE_PLACE = 0.02
"""Distance of the places of two contacts, in segments, summed over both rods, up to which they count as one. Contacts
that are farther apart must all push: without its neighbour, a rod turns about each of them by turns."""


@compiled
def find_pushing(
    one: Integers, other: Integers, near: Integers, count: int, at: Array, way: Array, impulse: Array, pushing: Integers
) -> None:
    """Find for each near pair the pair that pushes in its place, and hand its impulse over.

    Args:
        one: (pairs,) number of the first node of each pair's first segment.
        other: (pairs,) that of its second segment.
        near: numbers of the pairs that are near, ascending, at the beginning of the array.
        count: number of near pairs.
        at: (2, n) closest places of the near pairs' segments, as shares of the segments, 0 to 1.
        way: (n, 3) vectors from the second of these places to the first, m.
        impulse: (pairs, 3) impulse of each pair, N s, changed in place.
        pushing: (n,) array that gets the number, among the near pairs, of the pair that pushes: itself for most.
    """
    squared = np.empty(count)
    for n in range(count):
        squared[n] = way[n, 0] ** 2 + way[n, 1] ** 2 + way[n, 2] ** 2
    for n in range(count):
        i, j = one[near[n]], other[near[n]]
        beside, along = _end(at[0, n]), _end(at[1, n])
        closest = n
        if beside != 0:
            closest = _closer(one, other, near, count, at, squared, n, closest, i + beside, j)
        if along != 0:
            closest = _closer(one, other, near, count, at, squared, n, closest, i, j + along)
        if beside != 0 and along != 0:
            closest = _closer(one, other, near, count, at, squared, n, closest, i + beside, j + along)
        pushing[n] = closest
    for n in range(count):
        # The one in whose place a pair pushes may have one of its own; it is always closer, or as close and before it.
        while pushing[pushing[n]] != pushing[n]:
            pushing[n] = pushing[pushing[n]]
        if pushing[n] != n:
            for c in range(3):
                impulse[near[pushing[n]], c] += impulse[near[n], c]
                impulse[near[n], c] = 0.0


@compiled
def _end(t: float) -> int:
    """Tell the side of a segment at whose end a place lies: -1, 1, or 0 for neither."""
    if t == 0.0:
        return -1
    return 1 if t == 1.0 else 0


@compiled
def _closer(  # noqa: PLR0913, PLR0917 - all of them describe the near pairs
    one: Integers,
    other: Integers,
    near: Integers,
    count: int,
    at: Array,
    squared: Array,
    n: int,
    closest: int,
    i: int,
    j: int,
) -> int:
    """Return the near pair of segments i and j if it is at the place of pair n and closer than `closest`, or that."""
    m = _find(one, other, near, count, i, j)
    if m < 0 or (squared[m], m) >= (squared[closest], closest):
        return closest
    apart = abs(i + at[0, m] - one[near[n]] - at[0, n]) + abs(j + at[1, m] - other[near[n]] - at[1, n])
    return m if apart <= ONE_PLACE else closest


@compiled
def _find(one: Integers, other: Integers, near: Integers, count: int, i: int, j: int) -> int:
    """Find segments i and j among the near pairs, which are in ascending order; -1 if they are not there."""
    low, high = 0, count
    while low < high:
        middle = (low + high) // 2
        pair = near[middle]
        if one[pair] < i or (one[pair] == i and other[pair] < j):
            low = middle + 1
        else:
            high = middle
    if low < count and one[near[low]] == i and other[near[low]] == j:
        return low
    return -1
