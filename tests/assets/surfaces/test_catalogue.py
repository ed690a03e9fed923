import hashlib
import re
import sys
from importlib import import_module
from pathlib import Path

import numpy as np
import numpy.typing as npt
import pytest

from assets.surfaces.catalogue import SURFACES, collect
from assets.surfaces.recipe import SurfaceFamily, recipe_generator
from tests.assets.built import PIXELS, built, steps

NAMES = list(SURFACES)

FIRST_OTHERS = (
    *("oak_chevron", "maple_bench", "beech_bench", "brick_wall", "brick_paving", "circuit_board_green"),
    *("circuit_board_blue", "keyboard_black", "keyboard_white", "laminate_white", "laminate_grey", "melamine_board"),
    *("whiteboard", "cutting_mat", "antistatic_mat_blue", "antistatic_mat_green", "foam_mat", "honeycomb_mat"),
    *("paper_sheets", "squared_paper", "wiring_plan", "perforated_steel", "cable_tray", "bar_grating"),
    *("aluminium_profile", "pegboard_white"),
)


LIGHT = (
    "laminate_white",
    "melamine_board",
    "whiteboard",
    "pegboard_white",
    "paper_sheets",
    "squared_paper",
    "wiring_plan",
)


def linear(colour: npt.NDArray[np.uint8]) -> npt.NDArray[np.float64]:
    """Reflectance, 0 to 1, of a colour in sRGB."""
    value = colour / 255.0
    return np.asarray(np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4))


def test_there_are_at_least_40_surfaces_in_every_family() -> None:
    """There are at least 40 surfaces, and no family is empty."""
    assert len(SURFACES) >= 40
    assert {recipe.family for recipe in SURFACES.values()} == set(SurfaceFamily)


def test_every_recipe_is_filed_under_its_own_name() -> None:
    """No two recipes share a name, and names are in snake case."""
    for name, recipe in SURFACES.items():
        assert recipe.name == name
        assert re.fullmatch(r"[a-z]+(_[a-z]+)*", name)
    assert len({id(recipe.draw) for recipe in SURFACES.values()}) == len(SURFACES)


def test_some_surfaces_are_light_some_dark() -> None:
    """The surfaces cover the range of brightness that real floors have."""
    means = [built(name).colour.mean() for name in NAMES]
    assert sum(mean < 95 for mean in means) >= 5
    assert sum(95 <= mean < 160 for mean in means) >= 10
    assert sum(mean >= 160 for mean in means) >= 8


@pytest.mark.parametrize("name", [name for name, recipe in SURFACES.items() if recipe.light])
def test_light_surfaces_are_light(name: str) -> None:
    """The surfaces that a style prefers as light ones are light."""
    assert built(name).colour.mean() > 165


def test_the_published_surfaces_are_those_of_every_dataset_so_far() -> None:
    """66, in the order that the datasets' draws count them in, before all others: told by a checksum of the names."""
    published = [name for name, recipe in SURFACES.items() if recipe.published]
    assert published == NAMES[: len(published)]
    assert hashlib.sha256("\n".join(published).encode()).hexdigest()[:16] == "cb34a919027ad9af"


def test_the_other_surfaces_keep_their_order() -> None:
    """The first 26 of them are in every dataset of the wide style so far; new ones come between, in their families."""
    first = [name for name in NAMES if name in FIRST_OTHERS]
    assert first == list(FIRST_OTHERS)
    assert not any(SURFACES[name].published for name in first)


def test_two_surfaces_of_one_name_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Told by that name, though they be of two families."""
    package = tmp_path / "twins"
    package.mkdir()
    (package / "__init__.py").touch()
    for name in ("one", "other"):
        (package / f"{name}.py").write_text("from assets.surfaces.families.plaster import RECIPES\n")
    monkeypatch.syspath_prepend(str(tmp_path))
    with pytest.raises(ValueError, match="two surfaces are called 'plaster_white'"):
        collect(import_module("twins"))
    for name in ("twins", "twins.one", "twins.other"):
        sys.modules.pop(name, None)


@pytest.mark.parametrize("name", NAMES)
def test_maps_have_the_announced_shapes(name: str) -> None:
    """Colour and normal have three channels, roughness one, metallic is a share or a map."""
    maps = built(name)
    assert maps.colour.shape == maps.normal.shape == (PIXELS, PIXELS, 3)
    assert maps.roughness.shape == (PIXELS, PIXELS)
    assert {maps.colour.dtype, maps.normal.dtype, maps.roughness.dtype} == {np.dtype(np.uint8)}
    if isinstance(maps.metallic, float):
        assert 0.0 <= maps.metallic <= 1.0
    else:
        assert maps.metallic.shape == (PIXELS, PIXELS)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("axis", [0, 1])
def test_opposite_edges_meet(name: str, axis: int) -> None:
    """The step across the border is no larger than steps inside, in the map of joints too."""
    maps = built(name)
    for image in (maps.colour, maps.normal, maps.roughness):
        seam, *inside = steps(image, axis)
        assert seam <= 1.1 * max(inside) + 0.5


@pytest.mark.parametrize("name", NAMES)
def test_albedo_is_plausible(name: str) -> None:
    """The mean lies between soot and fresh paper, and hardly a texel is pure black or pure white."""
    colour = built(name).colour
    assert 45 <= colour.mean() <= 235
    assert (colour.max(axis=2) < 8).mean() < 0.02
    assert (colour.min(axis=2) > 248).mean() < 0.02


@pytest.mark.parametrize("name", NAMES)
def test_colour_varies_at_every_scale(name: str) -> None:
    """A surface varies both from texel to texel and from patch to patch."""
    grey = built(name).colour.mean(axis=2)
    patches = grey.reshape(16, PIXELS // 16, 16, PIXELS // 16).mean(axis=(1, 3))
    assert grey.std() > 3.0
    assert patches.std() > 0.8


@pytest.mark.parametrize("name", NAMES)
def test_normals_have_unit_length_and_point_up(name: str) -> None:
    """Each normal has length 1 within rounding and leaves the surface; on average they stand upright."""
    normal = built(name).normal.astype(np.float64) / 127.5 - 1.0
    assert np.abs(np.linalg.norm(normal, axis=2) - 1.0).max() < 0.02
    assert normal[..., 2].min() > -0.01
    mean = normal.mean(axis=(0, 1))
    assert np.abs(mean[:2]).max() < 0.03


@pytest.mark.parametrize("name", ["oak_planks", "gravel", "linen", "rusted_steel", "carpet_meander"])
def test_building_twice_gives_the_same_bytes(name: str) -> None:
    """The same generator gives the same bytes."""
    recipe = SURFACES[name]
    again = recipe.build(recipe_generator(recipe), PIXELS)
    for role in ("colour", "roughness", "normal"):
        assert np.array_equal(getattr(again, role), getattr(built(name), role))


def test_another_generator_gives_another_surface() -> None:
    """A recipe draws a new piece of the same material for each seed."""
    recipe = SURFACES["marble_white"]
    other = recipe.build(np.random.default_rng(5), PIXELS)
    assert not np.array_equal(other.colour, built("marble_white").colour)
    assert abs(other.colour.mean() - built("marble_white").colour.mean()) < 15


@pytest.mark.parametrize("name", LIGHT)
def test_white_tables_and_paper_are_really_white(name: str) -> None:
    """White tables and paper reflect 60 to 85 percent of the light, almost equally in all channels."""
    mean = linear(built(name).colour).mean(axis=(0, 1))
    assert 0.60 <= mean.mean() <= 0.85
    assert mean.max() - mean.min() < 0.08


@pytest.mark.parametrize(
    ("name", "share"),
    [("perforated_steel", 0.354), ("cable_tray", 0.164), ("bar_grating", 0.79), ("aluminium_profile", 0.205)],
)
def test_openings_are_dark_and_of_true_size(name: str, share: float) -> None:
    """The share of the area that is nearly black follows from the openings' sizes and pitches."""
    dark = built(name).colour.max(axis=2) < 90
    assert dark.mean() == pytest.approx(share, abs=0.06)


def test_the_cutting_mat_has_a_line_every_ten_millimetres() -> None:
    """Averaged along y, brightness has 40 peaks over 400 mm, and the highest every 50 mm."""
    profile = built("cutting_mat").colour.mean(axis=(0, 2))
    profile = profile - np.median(profile)
    spectrum = np.abs(np.fft.rfft(profile))
    assert spectrum[40] > 4 * np.median(spectrum[20:60])
    assert spectrum[8] > 2 * np.median(spectrum[2:16])


def test_keys_stand_at_their_true_pitch() -> None:
    """Averaged along x, a keyboard repeats three times down the tile, which is 20 keys of 19.05 mm wide."""
    assert SURFACES["keyboard_black"].size_m == pytest.approx(20 * 0.01905)
    profile = built("keyboard_black").colour.mean(axis=(1, 2))
    third = PIXELS // 3
    assert np.corrcoef(profile, np.roll(profile, third))[0, 1] > 0.8
