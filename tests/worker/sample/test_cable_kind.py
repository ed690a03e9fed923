"""Sampling kinds of cables."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from farm.scene.cable import Bundle, CableMaterial, EndKind, Sheath, Skin, StripeKind, envelope_ratio
from farm.scene.camera import Camera
from farm.spec.styles import RANGES_OF, Style
from worker.sample.cable_kind import CableKind, sample_ends, sample_kinds

WIDE = RANGES_OF[Style.WIDE].cable
CAMERA = Camera(height_m=0.2, f_number=8.0)


def many(count: int = 400, camera: Camera = CAMERA) -> list[CableKind]:
    """The kinds of the cables of many pictures."""
    rng = np.random.default_rng(0)
    return [kind for _ in range(count) for kind in sample_kinds(WIDE, 4, camera, rng)]


def test_the_wide_style_has_every_sheath_stripe_bundle_and_the_published_surface() -> None:
    """Each of them occurs among 1,600 cables."""
    looks = [kind.look for kind in many()]
    skins = [look for look in looks if isinstance(look, Skin)]
    assert {skin.sheath for skin in skins} == set(Sheath)
    assert {skin.stripe.kind for skin in skins if skin.stripe} == set(StripeKind)
    assert {len(look.strands) for look in looks if isinstance(look, Bundle)} == set(range(2, 8))
    assert any(skin.marking for skin in skins)
    assert any(look is None for look in looks)


@given(seed=st.integers(0, 2**32), height=st.floats(0.05, 1.0))
def test_no_single_cable_is_wider_than_40_of_512_pixels(seed: int, height: float) -> None:
    """The limit holds at any distance of the camera; a bundle may be half as wide again."""
    camera = Camera(height_m=height, f_number=8.0)
    for kind in sample_kinds(WIDE, 8, camera, np.random.default_rng(seed)):
        width_px = kind.diameter_m / (height * 36 / 50) * 512
        assert width_px <= (60 if isinstance(kind.look, Bundle) else 40) * 1.0001


@given(seed=st.integers(0, 2**32), height=st.floats(0.05, 1.0))
def test_no_cable_and_no_strand_is_narrower_than_4_of_512_pixels(seed: int, height: float) -> None:
    """All cables are as wide as the published ones at least, whose labels can be learned."""
    camera = Camera(height_m=height, f_number=8.0)
    for kind in sample_kinds(WIDE, 8, camera, np.random.default_rng(seed)):
        seen_m = kind.look.strand_diameter_m if isinstance(kind.look, Bundle) else kind.diameter_m
        assert seen_m / (height * 36 / 50) * 512 >= 4 * 0.9999


@pytest.mark.parametrize("strands", range(2, 8))
def test_circles_fit_into_their_envelope(strands: int) -> None:
    """The ring of n circles, or six around one, is the best packing.

    Graham, 1968, "Sets of points with given minimum separation".
    """
    ring = 1 + 1 / np.sin(np.pi / strands)
    assert envelope_ratio(strands) == pytest.approx(3.0 if strands == 7 else ring)


def test_a_bundle_is_softer_and_lighter_than_a_full_section_of_its_width() -> None:
    """A bundle has the stiffness of its strands, which slide on each other."""
    bundles = [kind for kind in many() if isinstance(kind.look, Bundle)]
    assert all(0 < kind.density_ratio <= 1 and 0 < kind.stiffness_ratio < 1 for kind in bundles)


def test_cables_of_one_make_differ_in_colour_alone() -> None:
    """With an `alike_share` of 1, all cables of a picture differ in colour alone."""
    ranges = WIDE.model_copy(update={"skin": WIDE.skin.model_copy(update={"alike_share": 1.0, "share": 1.0})})
    ranges = ranges.model_copy(update={"bundle": ranges.bundle.model_copy(update={"share": 0.0})})
    kinds = sample_kinds(ranges, 6, CAMERA, np.random.default_rng(0))
    skins = [kind.look for kind in kinds if isinstance(kind.look, Skin)]
    assert len({(kind.diameter_m, skin.sheath, skin.roughness) for kind, skin in zip(kinds, skins, strict=True)}) == 1
    assert len({skin.colour for skin in skins}) > 1


def test_only_skins_end_in_copper_or_a_ferrule() -> None:
    """A bundle and a cable with the published surface end in a plain cut."""
    rng = np.random.default_rng(0)
    ranges = WIDE.ends.model_copy(update={"stripped_share": 0.5, "ferrule_share": 0.5})
    for kind in many(50):
        published = CableMaterial(
            colour=(0, 0, 0),
            dirt_colour=(0, 0, 0),
            dirt_position=0.7,
            dirt_mapping=(0.0, 0.0, 0.0),
            dirt_offset=0.0,
            reflection_position=0.6,
        )
        ends = sample_ends(ranges, kind.look or published, kind.diameter_m, rng)
        assert {end.kind for end in ends} <= (
            {EndKind.STRIPPED, EndKind.FERRULE} if isinstance(kind.look, Skin) else {EndKind.CUT}
        )
