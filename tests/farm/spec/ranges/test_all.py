"""Ranges: the published defaults, and ranges that don't fit each other."""

import pytest

from farm.errors import SpecError
from farm.spec.parse import parse_spec
from farm.spec.ranges.all import Ranges
from farm.spec.styles import Style


def with_ranges(**ranges: object) -> Ranges:
    """Parse a description with these ranges."""
    return parse_spec({"images": 6, "style": "published", "ranges": ranges}, source="spec.toml").ranges


def test_the_defaults_are_the_published_ranges() -> None:
    """Each range equals a row of the publication's table."""
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
    """The error names both keys."""
    with pytest.raises(SpecError, match=r"camera\.heights_m .*cable\.count"):
        with_ranges(camera={"heights_m": [0.03]})


@pytest.mark.parametrize("style", Style)
def test_either_style_takes_as_many_cables_as_a_fall_brings_to_rest(style: Style) -> None:
    """24 cables are taken with the style's own cameras, and more are refused with the key."""

    def parse(most: int) -> tuple[int, int]:
        ranges = {"cable": {"count": [1, most]}}
        return parse_spec({"images": 6, "style": style, "ranges": ranges}, source="test").ranges.cable.count

    assert parse(24) == (1, 24)
    with pytest.raises(SpecError, match=r"ranges\.cable\.count\.1: .*less than or equal to 24"):
        parse(25)


@pytest.mark.parametrize(
    ("key", "hint"),
    [
        ("background_share", r"it belongs to \[ranges\.cable\]"),
        ("heights_m", r"it belongs to \[ranges\.camera\]"),
        ("tilt_deg", "the README tells"),
        ("no_such_key", "the README tells"),
    ],
)
def test_a_range_outside_its_table_is_told_its_table(key: str, hint: str) -> None:
    """The error names the table of a key that one table alone has."""
    with pytest.raises(SpecError, match=f"{key}: unknown key; {hint}"):
        parse_spec({"images": 6, key: 0.1}, source="test")


def test_cloth_takes_no_more_cables_than_it_brings_to_rest() -> None:
    """Eight are taken; of more the error names the simulator to ask for."""
    eight, nine = ({"images": 6, "simulator": "cloth", "ranges": {"cable": {"count": [1, most]}}} for most in (8, 9))
    assert parse_spec(eight, source="test").ranges.cable.count == (1, 8)
    with pytest.raises(SpecError, match=r"ranges\.cable\.count 9 is above the 8 .*'cloth' .*ask for 'rod'"):
        parse_spec(nine, source="test")


def test_a_share_that_hardly_any_scene_shows_is_refused() -> None:
    """The least visible share is a share of pixels, not of pictures."""
    with pytest.raises(SpecError, match=r"ranges\.cable\.least_visible_share"):
        with_ranges(cable={"least_visible_share": 0.5})


def test_a_range_the_wrong_way_round_is_refused() -> None:
    """The error gives the range's place in the description."""
    with pytest.raises(SpecError, match=r"ranges\.floor\.scale.*low end"):
        with_ranges(floor={"scale": [1.5, 0.7]})


def test_a_narrowest_cable_above_the_widest_is_refused() -> None:
    """The narrowest cable's share of the picture must not exceed the widest's."""
    with pytest.raises(SpecError, match=r"narrowest_share 0\.2 is above widest_share 0\.1"):
        with_ranges(cable={"narrowest_share": 0.2, "widest_share": 0.1})


def test_one_number_is_a_range_without_width() -> None:
    """The diameter and the length, of which the publication has one value, may be one number."""
    cable = with_ranges(cable={"diameter_m": 0.003, "length_m": 0.2}).cable
    assert (cable.diameter_m, cable.length_m) == ((0.003, 0.003), (0.2, 0.2))


def test_a_camera_that_would_see_the_edge_of_the_floor_is_refused() -> None:
    """The limit depends on tilt, lens and height; straight down, 1.5 m is low enough."""
    assert with_ranges(camera={"heights_m": [1.5]}).camera.heights_m == (1.5,)
    for camera in (
        {"tilt_deg": [0.0, 30.0], "heights_m": [1.5]},
        {"roll_deg": [0.0, 45.0], "heights_m": [1.5]},
        {"tilt_deg": [30.0, 30.0], "heights_m": [0.9]},
    ):
        with pytest.raises(SpecError, match=r"ranges\.camera: heights_m .*of the floor"):
            with_ranges(camera=camera)


@pytest.mark.parametrize(
    ("part", "key", "bounds"),
    [
        ("studio", "count", [0, 2]),
        ("camera", "focus_offset_share", [0.0, 1.0]),
        ("development", "key", [0.2, 2.0]),
        ("development", "chromatic_aberration", [-1.0, 0.0]),
        ("development", "exposure_ev", [0.0, 5000.0]),
        ("plate", "blur_px", [0.0, 1e5]),
        ("clutter", "stick_length_m", [0.1, 1e5]),
    ],
)
def test_what_no_scene_could_be_drawn_from_is_refused(part: str, key: str, bounds: list[float]) -> None:
    """Impossible ranges are refused when the description is read, with their place in it, and not by each worker."""
    with pytest.raises(SpecError, match=rf"ranges\.{part}\.{key}"):
        with_ranges(**{part: {key: bounds}})


@pytest.mark.parametrize(
    ("part", "key", "bounds"),
    [
        ("skin", "stripe_count", [0, 2]),
        ("skin", "stripe_count", [1, 5]),
        ("bundle", "strands", [1, 7]),
        ("bundle", "strands", [2, 8]),
        ("bundle", "strand_diameter_m", [0.001, 10.0]),
        ("bundle", "tie_width_m", [0.0025, 10.0]),
    ],
)
def test_cables_that_could_not_be_made_are_refused(part: str, key: str, bounds: list[float]) -> None:
    """Ranges of cables that could not be made are refused."""
    with pytest.raises(SpecError, match=rf"ranges\.cable\.{part}\.{key}"):
        with_ranges(cable={part: {key: bounds}})
