"""Windows on textures give the same picture from only the texels in view."""

import math
from dataclasses import replace

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from farm.scene.floor import Floor
from farm.scene.picture_size import PictureSize
from worker.camera.view import View
from worker.floor.window import TextureWindow, texels_to_floor, tile_coordinates, window_on

SIZE_M = 0.4
SIZE = (256, 256)
TILE = np.random.default_rng(0).integers(0, 256, (*SIZE, 3), dtype=np.uint8)


def floor(*, x: float = 0.3, y: float = -7.8, turn: float = 30.0, scale: float = 1.0) -> Floor:
    """A floor with a texture."""
    return Floor(texture="any", offset_x=x, offset_y=y, rotation_deg=turn, scale=scale)


def look_up(texels: NDArray[np.uint8], uvs: NDArray[np.float64]) -> NDArray[np.uint8]:
    """The nearest texel at coordinates (N, 2), repeated beyond the edges, v upwards."""
    rows, columns = texels.shape[:2]
    column = np.floor(uvs[:, 0] * columns).astype(int) % columns
    row = rows - 1 - np.floor(uvs[:, 1] * rows).astype(int) % rows
    found: NDArray[np.uint8] = texels[row, column]
    return found


@given(
    x=st.floats(-100, 100),
    y=st.floats(-100, 100),
    turn=st.floats(0, 360),
    scale=st.floats(0.7, 1.5),
    height=st.sampled_from([0.09, 0.15, 0.33]),
)
def test_a_window_shows_what_the_whole_texture_shows(
    x: float, y: float, turn: float, scale: float, height: float
) -> None:
    """Every place in view has the same texel as in the tile, wherever the texture lies."""
    lying = floor(x=x, y=y, turn=turn, scale=scale)
    window = window_on(lying, SIZE_M, View(height_m=height, resolution=PictureSize.square(512)), (SIZE,))
    half = 0.5 * height * 36 / 50
    points = np.random.default_rng(1).uniform(-half, half, (200, 2))
    uvs = tile_coordinates(points, lying, SIZE_M)
    placed = window.place(uvs)
    # At the very edge of a texel, rounding decides the side.
    clear = (np.abs(uvs * 256 - np.round(uvs * 256)) > 1e-6).all(axis=1)
    shown = look_up(window.cut(TILE, colour=True), placed)
    assert (shown == look_up(TILE, uvs))[clear].all()
    assert window.coarser == 1


@given(x=st.floats(-10, 10), y=st.floats(-10, 10), turn=st.floats(0, 360), scale=st.floats(0.3, 1.5))
def test_texels_know_where_on_the_floor_they_lie(x: float, y: float, turn: float, scale: float) -> None:
    """The middle of a window's texel, taken to the floor and back to the window, is itself."""
    lying = floor(x=x, y=y, turn=turn, scale=scale)
    window = window_on(lying, SIZE_M, View(height_m=0.33, resolution=PictureSize.square(512)), (SIZE,), 4.0)
    rows, columns = window.cut(TILE, colour=True).shape[:2]
    to_floor = texels_to_floor(window, rows, columns, lying, SIZE_M)
    places = np.array([[0.0, 0.0], [columns - 1.0, 0.0], [3.0, rows - 1.0]])
    points = places @ to_floor[:, :2].T + to_floor[:, 2]
    uvs = window.place(tile_coordinates(points, lying, SIZE_M))
    back = np.stack([uvs[:, 0] * columns - 0.5, (1 - uvs[:, 1]) * rows - 0.5], axis=1)
    assert back == pytest.approx(places, abs=1e-6)


def test_a_window_of_many_tiles_repeats_none_of_its_texels() -> None:
    """A tile of 0.12 m under a view of 0.24 m gives a window wider than the tile, with the tile's own texels."""
    lying = floor(turn=0.0, scale=0.3)
    view = View(height_m=0.33, resolution=PictureSize.square(512))
    window = window_on(lying, SIZE_M, view, (SIZE,), 4.0)
    assert window.width > 2.0
    assert window_on(lying, SIZE_M, view, (SIZE,)).width == 1.0
    texels = window.cut(TILE, colour=True)
    assert texels.shape[1] == round(window.width * 256)
    assert (texels[:, :200] == texels[:, 256:456]).all()


def test_a_near_camera_needs_few_texels() -> None:
    """At 0.09 m, 65 mm of 400 are in view: less than a tenth of the tile, even turned by 45 degrees."""
    window = window_on(
        floor(turn=45.0), SIZE_M, View(height_m=0.09, resolution=PictureSize.square(512)), ((2048, 2048),)
    )
    assert window.width * window.height < 0.1


def test_texels_finer_than_pixels_are_averaged() -> None:
    """128 pixels across 238 mm are 1.86 mm each: they get two texels of 0.93 mm instead of 9.5 of 0.195 mm."""
    window = window_on(floor(), SIZE_M, View(height_m=0.33, resolution=PictureSize.square(128)), ((2048, 2048),))
    assert window.coarser == pytest.approx((0.33 * 36 / 50 / 128) / 2 / (SIZE_M / 2048))
    part = window.cut(np.full((2048, 2048, 3), 77, np.uint8), colour=True)
    assert part.shape[0] == round(window.height * 2048 / window.coarser)
    assert (part == 77).all()


def test_colours_are_averaged_as_light() -> None:
    """Black and white give the level of half the light, 188; plain numbers give their mean."""
    window = TextureWindow(0.0, 0.0, 1.0, 1.0, 2)
    board = np.indices((64, 64)).sum(axis=0) % 2
    board = (255 * board).astype(np.uint8)
    assert window.cut(board, colour=True) == pytest.approx(np.full((32, 32), 188.0))
    assert window.cut(board, colour=False) == pytest.approx(np.full((32, 32), 128.0), abs=1.0)


def test_maps_of_different_sizes_share_a_window() -> None:
    """A map of half the size, made from the larger one, shows the same part."""
    small = cv2.resize(TILE, (128, 128), interpolation=cv2.INTER_AREA).astype(np.uint8)
    window = window_on(floor(), SIZE_M, View(height_m=0.09, resolution=PictureSize.square(512)), (SIZE, (128, 128)))
    large_part, small_part = window.cut(TILE, colour=False), window.cut(small, colour=False)
    assert large_part.shape[0] == 2 * small_part.shape[0]
    again = cv2.resize(large_part, small_part.shape[1::-1], interpolation=cv2.INTER_AREA)
    assert np.array_equal(again, small_part)


def test_maps_whose_sizes_do_not_fit_are_taken_whole() -> None:
    """Sizes of 1000 and 1023 texels share no grid fine enough for a window."""
    view = View(height_m=0.09, resolution=PictureSize.square(512))
    assert window_on(floor(), SIZE_M, view, ((1000, 1000), (1023, 1023))) == TextureWindow.whole()


def test_a_tile_smaller_than_the_view_is_taken_whole_and_repeats() -> None:
    """No window is larger than a tile, so that the texture repeats beyond it."""
    window = window_on(floor(), 0.05, View(height_m=0.33, resolution=PictureSize.square(512)), ((256, 256),))
    assert (window.width, window.height) == (1.0, 1.0)


def test_a_turn_of_the_texture_keeps_lengths() -> None:
    """Points 10 mm apart are a fortieth of a tile of 0.4 m apart."""
    uvs = tile_coordinates(np.array([[0.0, 0.0], [0.01, 0.0]]), floor(turn=77.0), SIZE_M)
    assert math.dist(*uvs) == pytest.approx(0.025)


@given(
    turn=st.floats(0, 360),
    tilt=st.sampled_from([0.0, 15.0]),
    size=st.sampled_from([PictureSize(width=512, height=128), PictureSize(width=384, height=512)]),
)
def test_an_oblong_view_needs_a_part_of_a_square_ones_window(turn: float, tilt: float, size: PictureSize) -> None:
    """All of the floor in the picture is in the window, which is no larger than the square picture's."""
    lying = floor(turn=turn)
    square = View(height_m=0.15, resolution=PictureSize.square(512), tilt_deg=tilt, tilt_bearing_deg=70.0)
    view = replace(square, resolution=size)
    window, larger = (window_on(lying, SIZE_M, seen, (SIZE,)) for seen in (view, square))
    placed = window.place(tile_coordinates(view.floor_corners_m()[:, :2], lying, SIZE_M))
    assert placed.min() > 0
    assert placed.max() < 1
    assert window.width * window.height <= larger.width * larger.height
