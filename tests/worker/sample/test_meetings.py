"""Meetings: the places where plans of cables are too close for one height."""

import numpy as np
import pytest

from tests.worker.sample.test_weave import RADIUS_M, meetings_of, straight
from worker.sample.meetings import Plan, samples_of
from worker.simulate.shapes import bent_rod


@pytest.mark.parametrize("bearing_deg", [25, 60, 90])
def test_two_crossing_cables_meet_once_where_they_cross(bearing_deg: float) -> None:
    """The closest pair of places is the crossing, and all others are within the overlap of the tubes."""
    (meeting,) = meetings_of([straight(0, 0, 0), straight(0.03, 0, bearing_deg)])
    assert meeting.one_m[meeting.closest] == pytest.approx(0.13, abs=RADIUS_M)
    assert meeting.other_m[meeting.closest] == pytest.approx(0.1, abs=RADIUS_M)
    reach = 1.1 * 2 * RADIUS_M / np.sin(np.radians(bearing_deg))
    assert np.abs(meeting.one_m - 0.13).max() <= reach + RADIUS_M


def test_cables_side_by_side_meet_all_along() -> None:
    """Parallel cables nearer than their thickness have one meeting from end to end."""
    (meeting,) = meetings_of([straight(0, 0, 0), straight(0, 1.5 * RADIUS_M, 0)])
    assert np.ptp(meeting.one_m) == pytest.approx(0.2)


def test_cables_apart_do_not_meet() -> None:
    """Parallel cables with air between them have no meeting."""
    assert meetings_of([straight(0, 0, 0), straight(0, 3 * RADIUS_M, 0)]) == []


def test_a_loop_meets_itself_where_it_crosses() -> None:
    """A full turn and a half of a circle meets itself, the earlier place first."""
    bends = (2 * np.pi * 0.9 / 0.1,) * 3
    count = samples_of(0.15, RADIUS_M)
    (meeting,) = meetings_of([Plan(bent_rod(0.15, bends, count), 0.15, RADIUS_M, 1.0)])
    assert (meeting.one, meeting.other) == (0, 0)
    around = meeting.other_m - meeting.one_m
    assert around == pytest.approx(np.full(len(around), 0.1 / 0.9), abs=3 * RADIUS_M)
