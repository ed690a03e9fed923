"""Parts without room are left out."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from farm.scene.clutter import PartKind
from tests.worker.clutter.things import make_part
from worker.clutter.fit import parts_that_fit
from worker.clutter.parts import part_extent, part_solid

CABLE_M = 0.001
SLOPE = 0.75
NO_CURVES: list[np.ndarray[tuple[int, int], np.dtype[np.float64]]] = []

place = st.floats(-0.03, 0.03)


def cable(y_m: float) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    """A cable on the floor, along x."""
    return np.array([[-0.2, y_m, CABLE_M], [0.2, y_m, CABLE_M]])


def test_a_part_below_a_cable_is_left_out() -> None:
    """A part below a cable is left out, also between two nodes that are far apart."""
    assert parts_that_fit([make_part()], [cable(0.001)], np.array([CABLE_M]), SLOPE) == ()


def test_a_part_far_from_all_is_kept() -> None:
    """A washer of 12 mm, 15 mm away from a cable, is kept."""
    part = make_part()
    assert parts_that_fit([part], [cable(0.015)], np.array([CABLE_M]), SLOPE) == (part,)


def test_a_cable_in_the_air_needs_more_room() -> None:
    """The camera may see a cable 40 mm above the floor 30 mm aside."""
    assert parts_that_fit([make_part()], [cable(0.015) + np.array([0.0, 0.0, 0.04])], np.array([CABLE_M]), SLOPE) == ()


def test_a_slanting_view_needs_more_room() -> None:
    """Seen from 62 degrees off the vertical, a thing hides the floor behind it over nearly twice its height."""
    part = make_part(PartKind.NUT)
    assert parts_that_fit([part], [cable(0.015)], np.array([CABLE_M]), 0.5) == (part,)
    assert parts_that_fit([part], [cable(0.015)], np.array([CABLE_M]), 1.9) == ()


def test_of_two_parts_in_one_place_the_first_is_kept() -> None:
    """Of two parts in one place the second is left out."""
    one, other = make_part(), make_part(PartKind.NUT, x_m=0.004)
    assert parts_that_fit([one, other], NO_CURVES, np.zeros(0), SLOPE) == (one,)


@given(st.lists(st.tuples(st.sampled_from(PartKind), place, place), max_size=8), place)
def test_parts_that_fit_touch_nothing(drawn: list[tuple[PartKind, float, float]], y_m: float) -> None:
    """No vertex of a kept part is in the cable, or within the circle of another part."""
    parts = [make_part(kind, x_m=x, y_m=y, seed=k) for k, (kind, x, y) in enumerate(drawn)]
    kept = parts_that_fit(parts, [cable(y_m)], np.array([CABLE_M]), SLOPE)
    for k, part in enumerate(kept):
        vertices = part_solid(part)[0].vertices_m[:, :2] + [part.x_m, part.y_m]
        assert np.abs(vertices[:, 1] - y_m).min() > CABLE_M
        for other in kept[:k]:
            assert np.hypot(*(vertices - [other.x_m, other.y_m]).T).min() > part_extent(other)[0]
