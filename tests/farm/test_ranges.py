"""Ranges: the published defaults, and ranges that do not fit each other."""

import pytest

from farm.errors import SpecError
from farm.ranges import Ranges
from farm.spec import parse_spec


def with_ranges(**ranges: object) -> Ranges:
    """Parse a description with these ranges."""
    return parse_spec({"images": 6, "style": "published", "ranges": ranges}, source="spec.toml").ranges


def test_the_defaults_are_the_published_ranges() -> None:
    """A row of the publication's table each."""
    ranges = Ranges()
    assert (ranges.floor.offset_x, ranges.floor.rotation_deg, ranges.floor.scale) == ((-100, 100), (0, 360), (0.7, 1.5))
    assert (ranges.wind.distance, ranges.wind.height, ranges.wind.tilt_deg) == ((5, 8), (0, 3), (60, 120))
    assert (ranges.wind.strength, ranges.wind.flow_per_strength) == ((0, 10), 0.2)
    assert (ranges.cable.count, ranges.cable.vertex_mass) == ((1, 8), (0.3, 0.5))
    assert (ranges.placement.free_x_m, ranges.placement.free_y_m) == ((-0.025, 0.025), (-0.035, 0.035))
    assert (ranges.placement.aligned_x_m, ranges.placement.aligned_y_m) == ((-0.012, 0.012), (-0.014, 0.014))
    assert ranges.placement.aligned_deviation_deg == (-10, 10)
    assert (ranges.cable.colour, ranges.cable.dirt_colour) == ((0, 255), (0, 4))
    assert (ranges.cable.dirt_position, ranges.cable.reflection_position) == ((0.65, 0.89), (0.60, 0.70))
    assert (ranges.lamp.point_radius_m, ranges.lamp.point_height_m) == ((5, 6.5), (5, 6.5))
    assert (ranges.lamp.point_power_w, ranges.lamp.point_size_m) == ((800, 1500), (0.1, 2))
    assert (ranges.lamp.area_distance_m, ranges.lamp.area_power_w) == ((4, 15), (400, 1800))
    assert (ranges.world.rotation_deg, ranges.world.dark_brightness) == ((-180, 180), (0.10, 0.60))
    assert ranges.camera.heights_m == (0.09, 0.12, 0.15, 0.16, 0.18, 0.20, 0.22, 0.24, 0.27, 0.30, 0.33)


def test_a_camera_among_the_cables_is_refused() -> None:
    """Both keys are named."""
    with pytest.raises(SpecError, match=r"camera\.heights_m .*cable\.count"):
        with_ranges(camera={"heights_m": [0.03]})


def test_a_range_the_wrong_way_round_is_refused() -> None:
    """With its place in the description."""
    with pytest.raises(SpecError, match=r"ranges\.floor\.scale.*low end"):
        with_ranges(floor={"scale": [1.5, 0.7]})


def test_one_number_is_a_range_without_width() -> None:
    """For the diameter and the length, of which the publication has one."""
    cable = with_ranges(cable={"diameter_m": 0.003, "length_m": 0.2}).cable
    assert (cable.diameter_m, cable.length_m) == ((0.003, 0.003), (0.2, 0.2))
