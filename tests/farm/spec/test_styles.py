"""Styles: the ranges of a description that names none."""

import json
import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st
from typer.testing import CliRunner

from farm.cli import app
from farm.errors import SpecError
from farm.spec.dataset_spec import DatasetSpec
from farm.spec.parse import parse_spec
from farm.spec.ranges.all import Ranges
from farm.spec.styles import RANGES_OF, Style


@pytest.mark.parametrize("style", Style)
def test_a_named_style_gives_all_of_its_ranges(style: Style) -> None:
    """A style gives every range that isn't overridden."""
    spec = parse_spec({"images": 6, "style": style.value}, source="test")
    assert (spec.style, spec.ranges) == (style, RANGES_OF[style])


def test_the_published_style_has_nothing_that_the_publication_has_not() -> None:
    """Skins, bundles, bare ends, clutter, wear, other lamps, lenses and sensors are all off."""
    ranges = RANGES_OF[Style.PUBLISHED]
    shares = (
        *(ranges.cable.skin.share, ranges.cable.bundle.share, ranges.cable.ends.stripped_share),
        *(ranges.cable.ends.ferrule_share, ranges.clutter.share, ranges.floor.wear.share, ranges.floor.light_share),
        *(ranges.studio.share, ranges.development.share, ranges.placement.loop_share, ranges.placement.coil_share),
    )
    assert not any(shares)
    assert (ranges.camera.focal_lengths_mm, ranges.camera.tilt_deg, ranges.camera.distortion) == ((50,), (0, 0), (0, 0))


def test_a_new_description_has_the_least_visible_share_of_its_style() -> None:
    """Wide pictures show their cables; published ones are as published."""
    shares = {style: parse_spec({"images": 6, "style": style}, source="test").ranges.cable for style in Style}
    assert {style: cable.least_visible_share for style, cable in shares.items()} == {"published": 0.0, "wide": 0.01}
    assert not any(cable.background_share for cable in shares.values())


def test_a_description_of_an_earlier_release_asks_for_no_visible_share() -> None:
    """Its pictures keep their bytes: what its ranges lack is not filled in from the style."""
    written = parse_spec({"images": 6, "style": "wide"}, source="test").model_dump(mode="json")
    for key in ("least_visible_share", "background_share"):
        del written["ranges"]["cable"][key]
    cable = DatasetSpec.model_validate_json(json.dumps(written)).ranges.cable
    assert (cable.least_visible_share, cable.background_share) == (0.0, 0.0)


@given(share=st.floats(0, 1), style=st.sampled_from(Style))
def test_an_override_changes_one_range_alone(share: float, style: Style) -> None:
    """An override changes its own range alone, however deep it is nested."""
    data = {"images": 6, "style": style.value, "ranges": {"cable": {"skin": {"stripe_share": share}}}}
    ranges = parse_spec(data, source="test").ranges
    assert ranges.cable.skin.stripe_share == share
    skin = ranges.cable.skin.model_copy(update={"stripe_share": RANGES_OF[style].cable.skin.stripe_share})
    cable = ranges.cable.model_copy(update={"skin": skin})
    assert ranges.model_copy(update={"cable": cable}) == RANGES_OF[style]


@pytest.mark.parametrize("style", ["glossy", 3, ["wide"], {}])
def test_an_unknown_style_is_refused_by_name(style: object) -> None:
    """The error for an unknown style lists the known ones."""
    with pytest.raises(SpecError, match=r"style: expected one of published, wide"):
        parse_spec({"images": 6, "style": style}, source="test")


def test_ranges_that_are_no_table_are_refused() -> None:
    """The error names the key."""
    with pytest.raises(SpecError, match="ranges: expected a table"):
        parse_spec({"images": 6, "ranges": 3}, source="test")


def test_an_unknown_range_of_a_style_is_refused_with_its_place() -> None:
    """The error for an unknown range gives its place, as the merged tables are validated as a whole."""
    with pytest.raises(SpecError, match=r"ranges\.cable\.skin\.shine"):
        parse_spec({"images": 6, "style": "wide", "ranges": {"cable": {"skin": {"shine": 1}}}}, source="test")


@pytest.mark.parametrize("style", Style)
def test_farm_ranges_prints_what_a_description_takes(style: Style) -> None:
    """The printed ranges are complete, so that they may be changed and given back."""
    printed = CliRunner().invoke(app, ["ranges", "--style", style.value]).output
    description = tomllib.loads(printed)
    spec = parse_spec({**description, "images": 6}, source="test")
    assert (spec.style, spec.ranges) == (style, RANGES_OF[style])
    assert set(description["ranges"]) == set(Ranges.model_fields)
