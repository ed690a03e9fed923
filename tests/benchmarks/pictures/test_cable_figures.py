"""Widths and crossings of cables drawn by hand."""

import math

import numpy as np
import pytest

from benchmarks.pictures.cable_figures import crossings, median_width_px
from tests.benchmarks.pictures.drawn import SIZE, Point, bar, curve, empty

MIDDLE = SIZE / 2


def across(angle_deg: float, length_px: float = 400.0, x: float = MIDDLE, y: float = MIDDLE) -> tuple[Point, Point]:
    """The ends of a line through a point."""
    reach = 0.5 * length_px * np.array([math.cos(math.radians(angle_deg)), math.sin(math.radians(angle_deg))])
    return (x - reach[0], y - reach[1]), (x + reach[0], y + reach[1])


@pytest.mark.parametrize("width_px", [3, 4, 7, 10, 18, 41])
def test_a_level_bars_width_is_told_to_the_pixel(width_px: int) -> None:
    """The width of a level bar is exact, whether odd or even."""
    instances = empty()
    instances[60 : 60 + width_px, :] = 1
    assert median_width_px(instances) == pytest.approx(width_px, abs=0.5)


@pytest.mark.parametrize("angle_deg", [0.0, 13.0, 30.0, 45.0, 71.0, 90.0])
@pytest.mark.parametrize("width_px", [5.0, 9.5, 16.0, 40.0])
def test_a_slanting_bars_width(width_px: float, angle_deg: float) -> None:
    """The width of a slanting bar is right within 0.6 px at all angles, also between pixels."""
    instances = empty()
    bar(instances, 3, *across(angle_deg, x=128.3, y=127.9), width_px)
    assert median_width_px(instances) == pytest.approx(width_px, abs=0.6)


def test_touching_cables_are_not_one_wide_cable() -> None:
    """Two cables of 10 px side by side have a width of 10 px."""
    instances = empty()
    instances[100:110], instances[110:120] = 1, 2
    assert median_width_px(instances) == pytest.approx(10, abs=0.5)


def test_a_cable_below_another_keeps_its_width() -> None:
    """A cable below another keeps its width, since few places are near a crossing."""
    instances = empty()
    bar(instances, 1, *across(20.0), 8)
    bar(instances, 2, *across(100.0), 8)
    assert median_width_px(instances) == pytest.approx(8, abs=0.6)


def test_no_cable_has_no_width() -> None:
    """Without a cable the width is NaN and not 0."""
    assert math.isnan(median_width_px(empty()))


def test_one_cable_crosses_nothing() -> None:
    """A single cable, or none, has no crossing."""
    instances = empty()
    assert crossings(instances) == 0
    bar(instances, 1, *across(30.0), 10)
    assert crossings(instances) == 0


@pytest.mark.parametrize("angle_deg", [90.0, 60.0, 35.0, 20.0])
@pytest.mark.parametrize("width_px", [4.0, 12.0, 30.0])
def test_two_that_cross_do_so_once(width_px: float, angle_deg: float) -> None:
    """Two cables that cross once count once, whatever the angle and the width."""
    instances = empty()
    bar(instances, 1, *across(10.0), width_px)
    bar(instances, 2, *across(10.0 + angle_deg), width_px)
    assert crossings(instances) == 1


def test_side_by_side_is_no_crossing() -> None:
    """Cables that touch side by side don't cross."""
    instances = empty()
    instances[100:110], instances[110:120] = 1, 2
    assert crossings(instances) == 0


def test_a_cable_that_ends_at_another_does_not_cross_it() -> None:
    """A cable that ends at another one, as in a T, doesn't cross it."""
    instances = empty()
    bar(instances, 1, (MIDDLE, 0), (MIDDLE, MIDDLE), 10)
    bar(instances, 2, *across(0.0), 10)
    assert crossings(instances) == 0


def test_a_bundle_is_crossed_once_for_each_of_its_cables() -> None:
    """A bundle of three touching cables that crosses another one counts three times."""
    instances = empty()
    bar(instances, 9, *across(90.0), 10)
    for number, top in enumerate((90, 100, 110), start=1):
        instances[top : top + 10] = number
    assert crossings(instances) == 3


def test_two_that_cross_again_do_so_twice() -> None:
    """A straight cable and one like an S cross twice."""
    instances = empty()
    wave = [(x, MIDDLE + 50 * math.cos(x / SIZE * 2 * math.pi)) for x in range(SIZE)]
    curve(instances, 1, wave, 9)
    bar(instances, 2, *across(0.0), 9)
    assert crossings(instances) == 2


def test_weaving_over_and_under_counts_both() -> None:
    """A cable that goes over one cable and under the next counts twice."""
    instances = empty()
    bar(instances, 1, *across(90.0, x=80), 10)
    bar(instances, 2, *across(0.0), 10)
    bar(instances, 3, *across(90.0, x=170), 10)
    assert crossings(instances) == 2


def test_a_hairpin_round_another_does_not_cross_it() -> None:
    """A cable that turns back and touches another on both sides doesn't cross it."""
    instances = empty()
    curve(instances, 1, [(255, 100), (60, 100), (60, 120), (255, 120)], 10)
    instances[106:115, 75:] = 2
    assert crossings(instances) == 0


def test_a_grid_of_three_by_three() -> None:
    """Three cables across three others cross nine times."""
    instances = empty()
    for number, place in enumerate((50.0, 120.0, 200.0), start=1):
        bar(instances, number, *across(85.0, x=place), 12)
    for number, place in enumerate((60.0, 130.0, 190.0), start=4):
        bar(instances, number, *across(3.0, y=place), 12)
    assert crossings(instances) == 9


def test_crumbs_of_a_cable_below_are_no_pieces() -> None:
    """A single pixel that shows within a bundle isn't a piece of a cable."""
    instances = empty()
    bar(instances, 9, *across(90.0), 10)
    instances[90:100], instances[101:111] = 1, 2
    instances[100] = np.where(instances[100] == 9, 0, instances[100])
    instances[100, 128] = 9
    assert crossings(instances) == 2
