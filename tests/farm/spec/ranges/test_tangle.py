"""Ranges of tangles, and the simulators that can hold one."""

import pytest

from farm.errors import SpecError
from farm.spec.parse import parse_spec
from farm.spec.ranges.all import Ranges
from farm.spec.ranges.tangle import TangleRanges
from farm.spec.styles import RANGES_OF, Style


def test_the_published_style_has_no_tangles_and_the_wide_one_has() -> None:
    """The share of all kinds is 0 in the published style, and above 0 in the wide one."""
    assert RANGES_OF[Style.PUBLISHED].placement.tangle.share == 0
    assert RANGES_OF[Style.WIDE].placement.tangle.share > 0


def test_a_description_of_an_earlier_release_asks_for_no_tangles() -> None:
    """Its pictures keep their bytes: what its ranges lack is not filled in from the style."""
    written = RANGES_OF[Style.WIDE].model_dump(mode="json")
    del written["placement"]["tangle"]
    assert Ranges.model_validate(written, strict=False).placement.tangle == TangleRanges()


def test_shares_above_one_are_refused() -> None:
    """A picture has at most one kind."""
    with pytest.raises(ValueError, match=r"add up to 1\.2, above 1"):
        TangleRanges(heap_share=0.7, peg_share=0.5)


def test_cloth_refuses_tangles() -> None:
    """The text names the key, the simulator and the one to ask for."""
    ranges = {"placement": {"tangle": {"heap_share": 0.1}}}
    with pytest.raises(SpecError, match=r"placement\.tangle asks for tangles in 0\.1 .*'cloth'.*ask for 'rod'"):
        parse_spec({"images": 6, "simulator": "cloth", "ranges": ranges}, source="test")


def test_with_cloth_the_wide_style_has_no_tangles() -> None:
    """The written description says so; every other range is the style's."""
    spec = parse_spec({"images": 6, "style": "wide", "simulator": "cloth"}, source="test")
    wide = RANGES_OF[Style.WIDE]
    assert spec.ranges.placement.tangle.share == 0
    untangled = wide.placement.model_copy(update={"tangle": spec.ranges.placement.tangle})
    assert spec.ranges == wide.model_copy(update={"placement": untangled})
