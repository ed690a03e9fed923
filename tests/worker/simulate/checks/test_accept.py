"""The acceptance of settled scenes, and the reason against a refused one."""

from dataclasses import replace

import numpy as np

from tests.worker.settled import RADIUS, looped, rod, shapes
from worker.simulate.checks.accept import find_fault
from worker.simulate.checks.measure import measure
from worker.simulate.shapes import CableShapes


def fault(settled: CableShapes) -> str:
    """The reason, or "None"."""
    return str(find_fault(measure(settled)))


def test_a_cable_on_the_floor_is_sound() -> None:
    """A cable that lies on the floor has no fault."""
    assert fault(shapes(rod())) == "None"


def test_cables_that_cross_one_diameter_apart_are_sound() -> None:
    """Cables that touch at a crossing have no fault, and the upper one doesn't float."""
    assert fault(shapes(rod(), rod(z=3 * RADIUS, along_y=True))) == "None"


def test_a_cut_at_one_crossing_is_refused() -> None:
    """Cables that overlap by half a radius at a crossing are refused."""
    assert "cable penetration" in fault(shapes(rod(), rod(z=2.5 * RADIUS, along_y=True)))


def test_cables_side_by_side_that_overlap_are_refused() -> None:
    """Parallel cables that overlap are seen, although no projections cross."""
    assert "cable penetration" in fault(shapes(rod(), rod(y=1.7 * RADIUS)))


def test_a_cable_in_the_floor_is_refused() -> None:
    """A cable that is half sunk is refused."""
    assert "floor penetration" in fault(shapes(rod(z=0.5 * RADIUS)))


def test_a_cable_below_the_floor_is_refused() -> None:
    """A cable below the floor is named so, and not as one that is deep in it."""
    assert fault(shapes(rod(z=-0.1))) == "1 cable(s) passed through the floor"


def test_a_floating_cable_is_refused() -> None:
    """A cable with one radius of air below it is refused."""
    assert "gap below" in fault(shapes(rod(z=2 * RADIUS)))


def test_a_cable_that_went_through_another_is_refused() -> None:
    """If the cable that started above lies below, it is refused."""
    assert "passed through" in fault(shapes(rod(z=3 * RADIUS), rod(along_y=True)))


def test_a_tip_that_slipped_round_another_cable_is_sound() -> None:
    """A tip 5 mm beyond the crossing on the other side than it started has slipped, and is no fault."""
    assert fault(shapes(rod(z=3 * RADIUS) + np.array([0.095, 0, 0]), rod(along_y=True))) == "None"


def test_a_stretched_cable_is_refused() -> None:
    """A cable 2 % longer than at rest is refused."""
    stretched = replace(shapes(rod()), lengths_m=np.array([0.2 / 1.02]))
    assert "length error" in fault(stretched)


def test_a_moving_cable_is_refused() -> None:
    """A cable that moves at 6 mm/s at capture is refused."""
    assert "speed" in fault(shapes(rod(), speed=0.006))


def test_a_figure_that_is_no_number_is_refused() -> None:
    """A figure of NaN, which is never above a limit, is refused."""
    assert find_fault(measure(shapes(rod())).model_copy(update={"support_gap": float("nan")})) is not None


def test_a_cable_that_lies_on_itself_is_sound() -> None:
    """A cable whose strands are a diameter apart where they cross has no fault."""
    assert fault(shapes(looped(step=2.05 * RADIUS))) == "None"


def test_a_cable_that_cuts_into_itself_is_refused() -> None:
    """A flat loop is refused."""
    assert "cable penetration" in fault(shapes(looped()))
