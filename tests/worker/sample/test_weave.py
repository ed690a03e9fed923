"""Weaving: heights at which plans of cables pass over and under each other."""

from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline

from worker.sample.loom import GAP, STEEPEST, Loom, Weave, knot_spacings_m
from worker.sample.meetings import Array, Meeting, Plan, find_meetings, samples_of
from worker.sample.weave import weave_near
from worker.simulate.shapes import bent_rod

RADIUS_M = 0.001


def straight(x_m: float, y_m: float, bearing_deg: float, length_m: float = 0.2, radius_m: float = RADIUS_M) -> Plan:
    """A straight plan with its middle at a place."""
    along = np.linspace(-0.5, 0.5, samples_of(length_m, radius_m))[:, None] * length_m
    bearing = np.radians(bearing_deg)
    return Plan(np.array([x_m, y_m]) + along * [np.cos(bearing), np.sin(bearing)], length_m, radius_m, 1.0)


def curly(rng: np.random.Generator) -> Plan:
    """A plan of random thickness, length, place and bends, which may cross itself."""
    radius, length = float(rng.uniform(0.0006, 0.002)), float(rng.uniform(0.1, 0.3))
    bends = np.clip(rng.uniform(-40, 40, 9), -1 / (8 * radius), 1 / (8 * radius))
    turn = float(rng.uniform(0, 2 * np.pi))
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    points = bent_rod(length, tuple(bends.tolist()), samples_of(length, radius)) @ rotation
    return Plan(points + rng.uniform(-0.02, 0.02, 2), length, radius, radius**4)


def meetings_of(plans: Sequence[Plan]) -> list[Meeting]:
    """All meetings, with four places to each of a cable's heights."""
    return find_meetings(plans, [spacing / 4 for spacing in knot_spacings_m(plans)])


def height(woven: Weave, plans: Sequence[Plan], cable: int, places_m: Array) -> Array:
    """The heights of a woven cable's centreline at places along it."""
    heights = plans[cable].radius_m + woven.heights_m[cable]
    return np.asarray(
        CubicSpline(np.linspace(0, plans[cable].length_m, len(heights)), heights, bc_type="natural")(places_m)
    )


@given(seed=st.integers(0, 2**32 - 1), count=st.integers(1, 4))
@settings(max_examples=40, deadline=None)
def test_every_meeting_of_a_random_diagram_has_its_gap(seed: int, count: int) -> None:
    """The chosen strand is over the other by 1.2 sums of radii, and no cable is steeper than 0.6."""
    rng = np.random.default_rng(seed)
    plans = [curly(rng) for _ in range(count)]
    meetings = meetings_of(plans)
    wanted = (rng.random(len(meetings)) < 0.5).tolist()
    found = weave_near(plans, meetings, wanted, [each.one >= each.other for each in meetings])
    if found is None:
        # Only a cable that meets itself too close to turn over itself in time can't be laid in any order.
        assert any(each.one == each.other for each in meetings)
        return
    woven, chosen = found
    assert max(woven.slopes) <= STEEPEST
    for meeting, is_over in zip(meetings, chosen, strict=True):
        rise = height(woven, plans, meeting.one, meeting.one_m) - height(woven, plans, meeting.other, meeting.other_m)
        least = GAP * (plans[meeting.one].radius_m + plans[meeting.other].radius_m)
        assert (rise if is_over else -rise).min() >= least * (1 - 1e-3)


def test_cables_between_their_meetings_keep_apart_too() -> None:
    """All pairs of samples of two woven cables that overlap in plan view are a sum of radii apart in height."""
    plans = [straight(0, 0, 0), straight(-0.02, 0, 80), straight(0.02, 0, 80, radius_m=0.002)]
    meetings = meetings_of(plans)
    woven = Loom(plans, meetings).weave([True, False])
    assert woven is not None
    for other in (1, 2):
        apart = np.linalg.norm(plans[0].points_m[:, None] - plans[other].points_m[None], axis=2)
        both = plans[0].radius_m + plans[other].radius_m
        i, j = np.nonzero(apart < both)
        heights = [
            height(woven, plans, k, np.linspace(0, plans[k].length_m, len(plans[k].points_m))) for k in (0, other)
        ]
        assert np.abs(heights[0][i] - heights[1][j]).min() > both


def test_a_cable_that_meets_no_other_lies_level() -> None:
    """Without a meeting the least bending is none."""
    woven = Loom([straight(0, 0, 0), straight(0, 0.05, 0)], []).weave([])
    assert woven is not None
    assert [np.ptp(heights) for heights in woven.heights_m] == [0.0, 0.0]


def test_the_lowest_place_is_at_height_zero() -> None:
    """The underside of the lower of two crossing cables touches it, whatever their thickness."""
    plans = [straight(0, 0, 0), straight(0, 0, 90, radius_m=0.002)]
    woven = Loom(plans, meetings_of(plans)).weave([True])
    assert woven is not None
    assert min(float(heights.min()) for heights in woven.heights_m) == pytest.approx(0.0, abs=1e-12)


def plain_weave() -> tuple[list[Plan], list[Meeting]]:
    """Two touching cables that cross two others, and their four meetings."""
    aside = 1.2 * RADIUS_M
    plans = [straight(0, y, 0) for y in (-aside, aside)] + [straight(x, 0, 90) for x in (-aside, aside)]
    return plans, meetings_of(plans)


def test_over_and_under_within_a_diameter_gives_way() -> None:
    """Thick cables that touch can't be woven over one and under the next: some choices become the safe ones."""
    plans, meetings = plain_weave()
    found = weave_near(plans, meetings, [True, False, False, True], [True] * 4)
    assert found is not None
    assert found[1] != (True, False, False, True)


def test_a_firm_choice_does_not_give_way() -> None:
    """Where all choices must stay, there is no weave."""
    plans, meetings = plain_weave()
    assert weave_near(plans, meetings, [True, False, False, True], [True] * 4, firm=range(4)) is None


def test_the_stiffer_of_two_cables_bends_less() -> None:
    """A cable that is ten times as stiff as the one that it crosses is lifted or pressed down less."""
    plans = [straight(0, 0, 0), Plan(straight(0, 0, 90).points_m, 0.2, RADIUS_M, 10.0)]
    woven = Loom(plans, meetings_of(plans)).weave([True])
    assert woven is not None
    assert np.ptp(woven.heights_m[1]) < 0.5 * np.ptp(woven.heights_m[0])
