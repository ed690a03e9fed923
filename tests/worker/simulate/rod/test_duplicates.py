"""Of several pairs of segments that touch at one place, one pushes."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from worker.simulate.rod.arrays import Integers
from worker.simulate.rod.duplicates import find_pushing
from worker.simulate.rod.model import Array

Near = tuple[int, int, float, float, float]
"""A near pair: its segments, its place on either, and the distance there."""


def pushing_of(pairs: list[Near], impulses: list[float]) -> tuple[list[int], list[float]]:
    """For each near pair, in ascending order, the pair that pushes for it, and its impulse after that."""
    one, other = np.array([p[0] for p in pairs]), np.array([p[1] for p in pairs])
    at: Array = np.array([[p[2] for p in pairs], [p[3] for p in pairs]])
    way = np.array([[0.0, 0.0, p[4]] for p in pairs])
    impulse = np.array([[0.0, 0.0, each] for each in impulses])
    pushing: Integers = np.zeros(len(pairs), np.int64)
    find_pushing(one, other, np.arange(len(pairs)), len(pairs), at, way, impulse, pushing)
    return pushing.tolist(), impulse[:, 2].tolist()


def test_four_pairs_that_meet_at_a_node_push_as_one() -> None:
    """The first of four equally close pairs pushes, with the sum of all impulses."""
    pairs = [(4, 20, 1.0, 1.0, 0.01), (4, 21, 1.0, 0.0, 0.01), (5, 20, 0.0, 1.0, 0.01), (5, 21, 0.0, 0.0, 0.01)]
    pushing, impulses = pushing_of(pairs, [1.0, 2.0, 3.0, 4.0])
    assert pushing == [0, 0, 0, 0]
    assert impulses == [10.0, 0.0, 0.0, 0.0]


def test_the_closest_of_them_pushes() -> None:
    """A pair whose closest place lies just beside the node takes over from one that ends there."""
    pairs = [(4, 20, 1.0, 0.5, 0.0101), (5, 20, 0.01, 0.5, 0.01)]
    assert pushing_of(pairs, [1.0, 0.5]) == ([1, 1], [0.0, 1.5])


def test_pairs_that_touch_at_places_of_their_own_all_push() -> None:
    """Neighbouring segments with different places keep a contact each, although one of them is at its end."""
    pairs = [(4, 20, 1.0, 0.5, 0.0101), (5, 20, 0.4, 0.9, 0.01)]
    assert pushing_of(pairs, [1.0, 0.5]) == ([0, 1], [1.0, 0.5])


PLACES = st.sampled_from([0.0, 0.005, 0.4, 1.0])
PAIRS = st.dictionaries(
    st.tuples(st.integers(0, 3), st.integers(10, 13)),
    st.tuples(PLACES, PLACES, st.sampled_from([0.01, 0.011, 0.012]), st.floats(0.0, 1.0)),
    min_size=1,
)


@given(PAIRS)
def test_no_impulse_is_lost_and_what_pushes_pushes_for_itself(
    found: dict[tuple[int, int], tuple[float, float, float, float]],
) -> None:
    """The sum of the impulses stays, only pairs that push have one, and each pushes in its own place."""
    order = sorted(found)
    pairs = [(*each, *found[each][:3]) for each in order]
    before = [found[each][3] for each in order]
    pushing, after = pushing_of(pairs, before)
    assert sum(after) == pytest.approx(sum(before))
    assert all(pushing[n] == n for n in pushing)
    assert all(impulse == 0.0 for n, impulse in enumerate(after) if pushing[n] != n)
