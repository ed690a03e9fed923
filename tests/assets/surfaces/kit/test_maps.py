import numpy as np
import pytest

from assets.surfaces.kit.colour import plain, ramp, rgb
from assets.surfaces.kit.grid import Grid
from assets.surfaces.kit.maps import finish, hollows, normal_from_height

GRID = Grid(256, 100.0)


def test_level_ground_points_straight_up() -> None:
    """Level ground gives the normal (128, 128, 255)."""
    normal = normal_from_height(GRID.zeros(), GRID)
    assert set(map(tuple, normal.reshape(-1, 3).tolist())) == {(128, 128, 255)}


def test_slopes_are_true() -> None:
    """On a wave of known slope the normal leans by the slope's angle, whatever the resolution."""
    for pixels in (256, 512):
        grid = Grid(pixels, 100.0)
        x, _ = grid.coordinates()
        height = (2.0 * np.sin(2 * np.pi * x / 100.0)).astype(np.float32)
        normal = normal_from_height(height, grid).astype(np.float64) / 127.5 - 1
        steepest = np.arctan(2.0 * 2 * np.pi / 100.0)
        assert np.arcsin(np.abs(normal[..., 0]).max()) == pytest.approx(steepest, abs=0.01)


def test_green_grows_towards_the_top_row() -> None:
    """Ground that falls towards the top row has green above 128, as OpenGL's convention says."""
    _, y = GRID.coordinates()
    height = np.abs(y - 50.0).astype(np.float32) * np.float32(-0.5) + 25
    normal = normal_from_height(height, GRID)
    # In the upper half height grows with y, downwards, so the surface faces the top.
    assert normal[64, 128, 1] > 150
    assert normal[192, 128, 1] < 105


def test_red_grows_to_the_right() -> None:
    """Ground that falls to the right has red above 128."""
    x, _ = GRID.coordinates()
    height = np.abs(x - 50.0).astype(np.float32)
    normal = normal_from_height(height, GRID)
    assert normal[128, 64, 0] > 150
    assert normal[128, 192, 0] < 105


def test_hollows_are_found_below_the_surroundings() -> None:
    """A groove is a hollow, and a ridge isn't."""
    height = GRID.zeros()
    height[:, 60:64] = -1.0
    height[:, 180:184] = 1.0
    found = hollows(height, 5.0, 0.5, GRID)
    assert found[100, 62] > 0.9
    assert found[100, 182] == 0.0


def test_finish_clips_to_eight_bits() -> None:
    """Values outside 0 to 1 don't wrap round."""
    field = GRID.zeros()
    maps = finish(GRID, plain("ffffff", field) * 2 - np.float32(0.5), field - 1, field, 0.5)
    assert maps.colour.min() == 255
    assert maps.roughness.max() == 0
    assert maps.metallic == 0.5


def test_a_texel_is_of_metal_or_it_is_not() -> None:
    """Metal that hardly shows counts as none, thinly covered metal as bare; the border between them is narrow."""
    field = GRID.zeros()
    shown = np.linspace(0.0, 1.0, GRID.pixels, dtype=np.float32)[None, :] + field
    metallic = finish(GRID, plain("ffffff", field), field, field, shown).metallic
    assert isinstance(metallic, np.ndarray)
    assert (metallic[shown < 0.35] == 0).all()
    assert (metallic[shown > 0.65] == 255).all()
    assert (np.diff(metallic[0].astype(int)) >= 0).all()


def test_a_ramp_passes_through_its_stops() -> None:
    """At a stop's value the ramp has the stop's colour."""
    values = np.array([[-1.0, 0.0, 0.5, 1.0, 2.0]], np.float32)
    found = ramp(values, ((0.0, "000000"), (0.5, "ff8000"), (1.0, "ffffff")))
    expected = np.stack([rgb(code) for code in ("000000", "000000", "ff8000", "ffffff", "ffffff")])
    assert np.abs(found[0] - expected).max() < 0.01
