"""The overlap of boxes."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from worker.simulate.rod.boxes import add_overlapping, hulls, pick_overlapping, runs_of, segment_boxes
from worker.simulate.rod.model import Array

SEED = st.integers(0, 2**32 - 1)


def drawn(seed: int, number: int) -> Array:
    """Boxes of which some overlap; every seventh is infinite, and every fifth empty."""
    draw = np.random.default_rng(seed)
    corners = draw.uniform(-1, 1, (number, 3))
    boxes: Array = np.concatenate([corners, corners + draw.uniform(0, 1, (number, 3))], axis=1)
    boxes[::7] = [-np.inf] * 3 + [np.inf] * 3
    boxes[::5] = np.nan
    return boxes


def overlap(a: Array, b: Array) -> bool:
    """Whether two boxes share a point."""
    return bool(np.all(a[:3] <= b[3:]) and np.all(b[:3] <= a[3:]))


@settings(max_examples=50, deadline=None)
@given(seed=SEED, begin=st.integers(0, 30), end=st.integers(0, 30))
def test_all_boxes_that_overlap_are_found_in_order(seed: int, begin: int, end: int) -> None:
    """Overlapping boxes in a range of numbers are appended in order; an empty box overlaps not even an infinite one."""
    boxes = drawn(seed, 30)
    for one in range(30):
        expected = [k for k in range(begin, end) if overlap(boxes[k], boxes[one])]
        found = np.full(31, -1)
        assert add_overlapping(boxes, begin, end, boxes, one, found, 1) == 1 + len(expected)
        assert found[: 1 + len(expected)].tolist() == [-1, *expected]
        asked = np.arange(begin, end)
        assert pick_overlapping(boxes, asked, len(asked), boxes, one, found) == len(expected)
        assert found[: len(expected)].tolist() == expected


@settings(max_examples=50, deadline=None)
@given(seed=SEED)
def test_a_hull_overlaps_whatever_a_box_in_it_does(seed: int) -> None:
    """A hull overlaps everything that a box inside does, and empty boxes change nothing, wherever they are."""
    boxes = drawn(seed, 30)
    starts = np.array([0, 3, 10, 11, 30])
    around = hulls(boxes, starts)
    for group in range(4):
        for k in range(starts[group], starts[group + 1]):
            for one in boxes:
                assert overlap(around[group], one) or not overlap(boxes[k], one)


def test_runs_do_not_cross_from_one_rod_to_the_next() -> None:
    """Rods of 4, 8, 9 and 20 nodes each start a run of their own, and each run has at most eight nodes."""
    starts, first_run = runs_of(np.array([0, 4, 12, 21, 41]))
    assert starts.tolist() == [0, 4, 12, 20, 21, 29, 37, 41]
    assert first_run.tolist() == [0, 1, 2, 4, 7]


def test_a_segments_box_is_around_the_boxes_of_its_nodes() -> None:
    """The box of a segment holds its nodes' boxes, and between two rods there is none."""
    x = np.array([[0.0, 1.0, 2.0, 5.0, 4.0], [0.0, 0.0, 1.0, 0.0, 1.0], [0.0, 0.0, 0.0, 3.0, 3.0]])
    boxes = segment_boxes(x - 0.5, x + 0.5, np.array([0, 3, 5]))
    assert boxes[[0, 1, 3]].tolist() == [
        [-0.5, -0.5, -0.5, 1.5, 0.5, 0.5],
        [0.5, -0.5, -0.5, 2.5, 1.5, 0.5],
        [3.5, -0.5, 2.5, 5.5, 1.5, 3.5],
    ]
    assert np.isnan(boxes[[2, 4]]).all()
