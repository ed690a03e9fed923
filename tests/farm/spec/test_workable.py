"""What a new description may ask for, and what one that is there keeps."""

import json
from typing import Any

import pytest

from farm.errors import SpecError
from farm.spec.dataset_spec import DatasetSpec
from farm.spec.parse import parse_spec
from farm.spec.ranges.all import Ranges
from farm.spec.ranges.camera import CameraRanges
from farm.spec.ranges.clutter import ClutterRanges
from farm.spec.simulation import Simulator
from farm.spec.styles import RANGES_OF, Style, merge_tables
from farm.spec.workable import BOUNDS, Bound, clear_height_m, highest_pile_m


def described(key: str, value: object, **more: object) -> dict[str, Any]:
    """A description with one key, named with dots, set to a value."""
    nested: object = value
    for name in reversed(key.split(".")):
        nested = {name: nested}
    return merge_tables({"images": 6, "style": "published", **more}, nested)  # type: ignore[arg-type]  # a table by now


def shaped(bound: Bound, value: float) -> object:
    """A value as the key takes it: a number, or both ends of a range."""
    now: object = parse_spec({"images": 6}, source="test")
    for name in bound.key.split("."):
        now = getattr(now, name)
    return [value, value] if isinstance(now, tuple) else value


@pytest.mark.parametrize("bound", BOUNDS, ids=lambda bound: f"{bound.key}-{bound.only}")
def test_a_key_beyond_its_bound_is_refused_by_name(bound: Bound) -> None:
    """With the key, the value, the bound and the unit; the bound itself is allowed."""
    simulator = (bound.only or Simulator.ROD).value
    unit = f" {bound.unit}" if bound.unit else ""
    beyond = 2 * bound.high + 1
    allowed = described(bound.key, shaped(bound, bound.high), simulator=simulator)
    if bound.key == "ranges.wind.strength":  # rods have a bound of the wind's speed, too
        allowed = merge_tables(allowed, {"ranges": {"wind": {"speed_per_strength_m_s": 0.1}}})
    parse_spec(allowed, source="spec.toml")
    with pytest.raises(SpecError) as refused:
        parse_spec(described(bound.key, shaped(bound, beyond), simulator=simulator), source="spec.toml")
    told = str(refused.value)
    assert told.startswith(f"spec.toml: {bound.key}")
    own = f"{bound.key}: {beyond:g}{unit} is above {bound.high:g}{unit}: {bound.beyond}"
    assert told == f"spec.toml: {own}" or "less than or equal to" in told


@pytest.mark.parametrize(
    ("key", "value", "told"),
    [
        ("ranges.wind.strength", [0.0, 1e5], r"ranges\.wind\.strength: 100000 is above 100: no cable comes to rest"),
        ("ranges.wind.speed_per_strength_m_s", 3.0, r"wind\.strength 10 .*a wind of 30 m/s, above 25 m/s"),
        ("ranges.wind.gust_period_s", [1e-309, 0.1], r"ranges\.wind\.gust_period_s: 1e-309 s is below 0\.002 s"),
        ("fall.rod.max_time_s", 1e-9, r"fall\.rod\.max_time_s: 1e-09 s is below 0\.03 s: no cable lands so soon"),
        ("fall.rod.segment_radii", 20.0, r"fall\.rod\.segment_radii: 20 radii is above 6 radii: .*never rest"),
        ("fall.rod", {"steps_per_s": 100_000, "max_time_s": 60.0}, r"max_time_s 60 s make 6,000,000 time steps"),
        (
            "ranges.world.rotation_deg",
            [-1.7e308, 1.7e308],
            r"ranges\.world\.rotation_deg: -1\.7e\+308 degrees is below",
        ),
        ("ranges.cable.dirt_offset", [0.0, 1e300], r"ranges\.cable\.dirt_offset: 1e\+300 is above 10000"),
        ("ranges.studio.distance_m", [0.001, 1.0], r"ranges\.studio\.distance_m: 0\.001 m is below 0\.1 m"),
        ("ranges.lamp.point_size_m", [0.1, 7.0], r"ranges\.lamp\.point_size_m 7 m reaches to 0\.071 m from the cables"),
    ],
)
def test_values_with_which_no_picture_was_made_are_refused(key: str, value: object, told: str) -> None:
    """Falls in them did not end, sampling them overflows, or the cables would lie in a lamp."""
    with pytest.raises(SpecError, match=told):
        parse_spec(described(key, value), source="spec.toml")


def test_a_bound_of_one_simulator_leaves_the_other_alone() -> None:
    """The wind of cloth does not die down; rods know no vertex mass."""
    parse_spec(described("ranges.wind.strength", [0.0, 60.0]), source="test")
    with pytest.raises(SpecError, match="60 is above 40"):
        parse_spec(described("ranges.wind.strength", [0.0, 60.0], simulator="cloth"), source="test")


def test_a_dataset_that_is_there_keeps_its_values() -> None:
    """Bounds hold when a description is read; a header of any release parses as it did."""
    spec = parse_spec({"images": 6}, source="test").model_dump(mode="json")
    old = merge_tables(spec, {"ranges": {"wind": {"strength": [0.0, 500.0]}, "camera": {"focal_lengths_mm": [24.0]}}})
    assert DatasetSpec.model_validate_json(json.dumps(old)).ranges.wind.strength == (0.0, 500.0)


@pytest.mark.parametrize("style", Style)
def test_every_style_can_be_asked_for(style: Style) -> None:
    """No bound refuses a style's own ranges."""
    assert parse_spec({"images": 6, "style": style}, source="test").ranges == RANGES_OF[style]


@pytest.mark.parametrize(
    ("ranges", "named"),
    [
        ({"camera": {"focal_lengths_mm": [10.0]}}, r"heights_m 0\.09 with focal_lengths_mm 10 .*cable\.diameter_m is"),
        ({"camera": {"focal_lengths_mm": [50.0, 10.0]}}, r"focal_lengths_mm 10 "),
        ({"camera": {"heights_m": [0.02], "focal_lengths_mm": [12.0]}, "cable": {"count": [1, 1]}}, r"above 0 m"),
        (
            {
                "camera": {"focal_lengths_mm": [20.0]},
                "cable": {"skin": {"share": 1.0}, "bundle": {"share": 0.5, "strand_diameter_m": [0.002, 0.008]}},
            },
            r"cable\.bundle",
        ),
        (
            {
                "camera": {"focal_lengths_mm": [18.0]},
                "clutter": {"share": 0.5, "sticks": [0, 20], "stick_diameter_m": [0.003, 0.02]},
            },
            r"clutter\.sticks",
        ),
    ],
)
def test_a_lens_among_the_cables_is_refused(ranges: dict[str, object], named: str) -> None:
    """The focal length sets the camera's distance; bundles and sticks are piled with the cables."""
    with pytest.raises(SpecError, match=named):
        parse_spec({"images": 6, "style": "published", "ranges": ranges}, source="spec.toml")


def test_tilt_and_aperture_lower_what_a_camera_sees() -> None:
    """Straight down, 5 mm before the lens are not seen; tilted, a corner and the lens's rim reach farther down."""
    assert clear_height_m(CameraRanges(), 0.09, 50.0) == pytest.approx(0.085)
    assert clear_height_m(CameraRanges(), 0.09, 10.0) == pytest.approx(0.013)
    tilted = CameraRanges(tilt_deg=(0.0, 30.0), f_number=(2.0, 8.0), heights_m=(0.09,))
    assert clear_height_m(tilted, 0.09, 50.0) < 0.085 * 0.87 - 0.0125 / 2 + 1e-3


def test_the_highest_pile_counts_the_thickest_of_all() -> None:
    """Eight cables of 2.4 mm, three quarters of them high; what is beyond eight spreads out, sticks as well."""
    assert highest_pile_m(Ranges(), 0.0648) == pytest.approx(0.75 * 8 * 0.0024)
    sticks = ClutterRanges(share=1.0, sticks=(0, 20), stick_diameter_m=(0.003, 0.004))
    assert highest_pile_m(Ranges(clutter=sticks), 0.0648) == pytest.approx(0.75 * 8 * 0.004)
