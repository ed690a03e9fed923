"""Passages between two moments, for moves whose outcome is known."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from benchmarks.physics.passes import Passage, PassWatch, passes_between, sunk_between
from tests.worker.settled import RADIUS, looped, rod
from worker.curves import Points
from worker.simulate.checks.plan_view import END_RADII

RADII = np.full(2, RADIUS)


def crossed(rise: float, *, x: float = 0.0, end_y: float = 0.1) -> tuple[Points, Points]:
    """A cable along x, and one across it at x, `rise` radii higher, that reaches to `end_y` on one side."""
    other = rod(along_y=True, z=(10 + rise) * RADIUS) + np.array([x, end_y - 0.1, 0.0])
    return rod(z=10 * RADIUS), other


@settings(max_examples=60, deadline=None)
@given(before=st.floats(0.01, 3), after=st.floats(0.01, 3), x=st.floats(-0.08, 0.08), turn=st.integers(0, 99))
def test_a_cable_that_sinks_through_another_is_seen_in_any_attitude(
    before: float, after: float, x: float, turn: int
) -> None:
    """A passage is seen once, wherever the crossing lies between nodes, and the way back is the opposite one."""
    attitude = Rotation.random(random_state=turn)
    above, below = (tuple(attitude.apply(each) for each in crossed(rise, x=x)) for rise in (before, -after))
    (down,), (up,) = passes_between(above, below, RADII), passes_between(below, above, RADII)
    assert down.cables == (0, 1)
    assert np.array(down.along_radii) * RADIUS == pytest.approx([0.1 + x, 0.1], abs=1e-9)
    assert not down.near_end
    assert up.undoes(down)


@settings(max_examples=60, deadline=None)
@given(rises=st.tuples(st.floats(0.01, 3), st.floats(0.01, 3)), side=st.sampled_from([-1.0, 1.0]))
def test_cables_that_stay_on_their_sides_do_not_pass(rises: tuple[float, float], side: float) -> None:
    """Cables that approach or part on their own sides don't pass."""
    assert not passes_between(crossed(side * rises[0]), crossed(side * rises[1], x=0.003), RADII)


def test_a_tip_that_goes_round_does_not_pass() -> None:
    """A cable that sinks beside another's tip doesn't pass through it."""
    ahead, behind = -0.01 * RADIUS, 0.01 * RADIUS
    path = [(1.0, behind), (1.0, ahead), (-1.0, ahead), (-1.0, behind)]
    frames = [crossed(rise, end_y=end) for rise, end in path]
    assert not any(passes_between(one, next_one, RADII) for one, next_one in pairwise(frames))


@pytest.mark.parametrize(("end_radii", "near"), [(END_RADII - 0.5, True), (END_RADII + 0.5, False)])
def test_a_passage_close_to_an_end_is_told_from_others(end_radii: float, near: bool) -> None:
    """A passage is close to an end by the arc length to either cable's end."""
    end = end_radii * RADIUS
    (passage,) = passes_between(crossed(1.0, end_y=end), crossed(-1.0, end_y=end), RADII)
    (mirrored,) = passes_between(crossed(1.0, end_y=end)[::-1], crossed(-1.0, end_y=end)[::-1], RADII)
    assert (passage.near_end, mirrored.near_end) == (near, near)


def test_axes_that_met_at_the_start_part_without_passing() -> None:
    """Axes that met at the start were on no side of each other, so parting isn't a passage."""
    assert not passes_between(crossed(1e-9), crossed(-0.5), RADII)
    assert not passes_between(crossed(0.0), crossed(-0.5), RADII)


def test_a_cable_goes_through_itself() -> None:
    """A loop whose end sinks through its beginning is a passage."""
    (passage,) = passes_between((looped(step=RADIUS),), (looped(step=-RADIUS),), RADII[:1])
    assert passage.cables == (0, 0)


def test_a_kink_tighter_than_the_cable_is_no_passage() -> None:
    """A loop of a few radii, in which a round section would have been crushed, isn't a passage."""
    small = 0.04
    assert not passes_between((small * looped(step=RADIUS),), (small * looped(step=-RADIUS),), RADII[:1])


def test_a_cable_that_moves_as_it_is_does_not_pass_through_itself() -> None:
    """Neighbouring segments share a node and never pass through each other."""
    moved = rod() @ Rotation.from_rotvec([0.1, 0.2, 0.3]).as_matrix()
    assert not passes_between((rod(),), (moved,), RADII[:1])


def test_many_passages_are_all_found() -> None:
    """A grid of 20 by 20 simultaneous passages is found, more than the first array can hold."""
    one = [rod(y=0.008 * (k - 9.5), z=0.05) for k in range(20)]
    across = [rod(along_y=True) + np.array([0.008 * (k - 9.5), 0, 0]) for k in range(20)]
    above, below = (tuple(each + np.array([0, 0, z]) for each in across) for z in (0.052, 0.048))
    assert len(passes_between((*one, *above), (*one, *below), np.full(40, RADIUS))) == 400


def test_the_watch_forgives_what_is_undone() -> None:
    """A passage that is undone at its own crossing doesn't count, and another one does."""
    watch = PassWatch(crossed(1.0), RADII)
    watch.see(crossed(-1.0))
    assert (watch.passes, watch.end_slips, watch.undone) == (1, 0, 0)
    watch.see(crossed(1.0, x=0.01))
    assert (watch.passes, watch.end_slips, watch.undone) == (0, 0, 1)
    watch.see(crossed(-1.0, x=0.01))
    assert watch.passes == 1
    watch.forget()
    assert watch.passes == 0


def test_a_passage_far_away_undoes_nothing() -> None:
    """The opposite passage at another crossing of the same cables undoes nothing."""
    here = Passage((0, 1), (50.0, 50.0), 1, near_end=False)
    assert not Passage((0, 1), (150.0, 50.0), -1, near_end=False).undoes(here)
    assert not Passage((0, 2), (50.0, 50.0), -1, near_end=False).undoes(here)
    assert not Passage((0, 1), (50.0, 50.0), 1, near_end=False).undoes(here)


def test_only_nodes_that_were_above_the_floor_sink() -> None:
    """Nodes that start below the floor, or come up through it, don't count."""
    assert sunk_between((rod(z=RADIUS),), (rod(z=-RADIUS),)) == 41
    assert sunk_between((rod(z=-RADIUS),), (rod(z=-2 * RADIUS),)) == 0
    assert sunk_between((rod(z=-RADIUS),), (rod(z=RADIUS),)) == 0
