"""Passages of woven cables, told from the signs of their crossings."""

from dataclasses import replace

import numpy as np

from tests.worker.settled import RADIUS, rod, shapes
from worker.curves import Points
from worker.simulate.checks.measure import measure
from worker.simulate.shapes import CableShapes, WovenStart


def hooked(height_m: float, *, over_first: bool = True, over_second: bool = True, shift_m: float = 0.0) -> Points:
    """A cable that crosses the x axis at x = -0.02 and again at x = 0.02, over or under what lies there."""
    s = np.linspace(-1.0, 1.0, 81)
    level = np.where(s < 0, height_m if over_first else -height_m, height_m if over_second else -height_m)
    # It changes level far from both crossings.
    level = level * np.clip(np.abs(s) / 0.3, 0, 1) if over_first != over_second else level
    return np.stack([0.04 * s + shift_m, 0.05 * (1 - 4 * s**2), 4 * RADIUS + level], axis=1)


def fallen(start: tuple[Points, ...], end: tuple[Points, ...]) -> CableShapes:
    """Woven cables between a start and an end."""
    return replace(shapes(*end), woven=WovenStart(tuple(range(len(start))), start))


LINE = rod(z=4 * RADIUS)


def test_cables_that_keep_their_crossings_did_not_pass() -> None:
    """A cable that is under the other at one crossing and over it at the next may stay so, in any order of start."""
    hook = hooked(3 * RADIUS, over_second=False)
    figures = measure(fallen((LINE, hook), (LINE, hook)))
    assert (figures.pass_throughs, figures.end_slips) == (0, 0)


def test_a_crossing_that_turned_over_is_a_passage() -> None:
    """One of two crossings changes its sign, and the sum of the signs changes by two."""
    start = (LINE, hooked(3 * RADIUS, over_second=False))
    figures = measure(fallen(start, (LINE, hooked(3 * RADIUS))))
    assert (figures.pass_throughs, figures.end_slips) == (1, 0)


def test_crossings_that_come_apart_in_pairs_are_no_passage() -> None:
    """A cable that lies over another twice may slide off it: the two signs were opposite."""
    figures = measure(fallen((LINE, hooked(3 * RADIUS)), (LINE, hooked(3 * RADIUS) + np.array([0.0, 0.2, 0.0]))))
    assert figures.pass_throughs == 0


def test_a_passage_near_an_end_may_be_a_slip() -> None:
    """The end of the straight cable is seven radii beyond the crossing."""
    start = (LINE, hooked(3 * RADIUS, over_second=False, shift_m=0.073))
    figures = measure(fallen(start, (LINE, hooked(3 * RADIUS, shift_m=0.073))))
    assert (figures.pass_throughs, figures.end_slips) == (0, 1)


def test_woven_cables_keep_their_order_with_all_others() -> None:
    """A cable of the tangle that lies under one which started below it passed through that one."""
    low = rod(along_y=True, z=6 * RADIUS)
    tangled = replace(shapes(low, LINE, rod(y=0.05, z=4 * RADIUS)), woven=WovenStart((1, 2), (LINE, rod(y=0.05))))
    assert measure(tangled).pass_throughs == 2
