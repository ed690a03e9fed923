"""HDRIs as arrays: the light from above, and the backdrop."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from farm.scene.camera import Camera
from farm.scene.picture_size import PictureSize
from worker.backdrop.panorama import UPPER_WIDTH_PX, Panorama, panorama_backdrop, upper_world
from worker.camera.lens import lens_radius_m
from worker.camera.view import View

UPRIGHT = np.eye(3)
QUARTER_TURN: NDArray[np.float64] = Rotation.from_euler("x", 90, degrees=True).as_matrix()
"""The published tilt: a camera that looks down sees the panorama's horizon."""

PINHOLE = Camera(height_m=0.2, f_number=128.0)


def even(rows: int = 128) -> Panorama:
    """A panorama with the same light from everywhere."""
    return np.ones((rows, 2 * rows, 3), np.float32)


def spot(azimuth_deg: float, elevation_deg: float, rows: int = 256) -> Panorama:
    """A panorama with light from a few degrees about one direction; azimuth 0 is x, 90 is y."""
    azimuth = np.pi - 2 * np.pi * (np.arange(2 * rows) + 0.5) / (2 * rows)
    elevation = 0.5 * np.pi - np.pi * (np.arange(rows) + 0.5) / rows
    a, e = np.radians([azimuth_deg, elevation_deg])
    cosine = np.sin(elevation)[:, None] * np.sin(e) + np.cos(elevation)[:, None] * np.cos(e) * np.cos(azimuth - a)
    return np.repeat((cosine > np.cos(np.radians(3.0)))[..., None], 3, axis=2).astype(np.float32)


def backdrop(panorama: Panorama, turn: NDArray[np.float64], camera: Camera, resolution: int) -> NDArray[np.float32]:
    """What a camera sees of a panorama."""
    return panorama_backdrop(panorama, turn, View.of(camera, PictureSize.square(resolution)), lens_radius_m(camera))


def irradiance(panorama: Panorama) -> float:
    """Irradiance on a level floor: the integral of light times the cosine to the zenith over the upper half."""
    rows, columns = panorama.shape[:2]
    elevation = 0.5 * np.pi - np.pi * (np.arange(rows) + 0.5) / rows
    weight = np.maximum(np.sin(elevation), 0.0) * np.cos(elevation) * (np.pi / rows) * (2 * np.pi / columns)
    return float((panorama[..., 0].astype(np.float64) * weight[:, None]).sum())


def test_an_even_world_gives_a_floor_pi_times_its_light() -> None:
    """A hemisphere of unit radiance gives an irradiance of pi."""
    assert irradiance(upper_world(even(), UPRIGHT)) == pytest.approx(np.pi, rel=1e-3)


def test_below_the_horizon_it_is_black() -> None:
    """Below the horizon the panorama is black, except for two degrees, which may be seen past the floor's edge."""
    lit = upper_world(even(), QUARTER_TURN)
    assert (lit[: UPPER_WIDTH_PX // 4] > 0).all()
    assert not lit[int(UPPER_WIDTH_PX / 4 * (1 + 3 / 90)) :].any()


@settings(max_examples=15, deadline=None)
@given(azimuth=st.floats(0, 360), elevation=st.floats(20, 80), turn=st.floats(-180, 180))
def test_a_small_sun_keeps_its_light_however_it_is_turned(azimuth: float, elevation: float, turn: float) -> None:
    """The light on a floor doesn't depend on the turn about the zenith, within 3 %."""
    about_z = Rotation.from_euler("z", turn, degrees=True).as_matrix()
    sun = spot(azimuth, elevation)
    assert irradiance(upper_world(sun, about_z)) == pytest.approx(irradiance(sun), rel=0.03)


@pytest.mark.parametrize("turn", [UPRIGHT, QUARTER_TURN, Rotation.from_euler("xz", [90, 40], degrees=True).as_matrix()])
def test_light_comes_from_where_the_turn_takes_it(turn: NDArray[np.float64]) -> None:
    """A spot stands in the direction of the world to which the turn takes it."""
    direction = np.array([0.3, -0.5, 0.8]) / np.linalg.norm([0.3, -0.5, 0.8])
    x, y, z = turn @ direction
    lit = upper_world(spot(np.degrees(np.arctan2(y, x)), np.degrees(np.arcsin(z))), turn)[..., 0]
    rows, columns = lit.shape
    row, column = (np.argwhere(lit > 0.5)).mean(axis=0)
    azimuth, elevation = np.pi - 2 * np.pi * (column + 0.5) / columns, 0.5 * np.pi - np.pi * (row + 0.5) / rows
    found = [np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)]
    assert np.dot(found, direction) > np.cos(np.radians(1.0))


def test_the_backdrop_is_seen_upright() -> None:
    """A spot a little above and to the right of where the camera looks is above and right of the picture's middle.

    Looking down with y up in the picture, that is the direction (0.1, 0.15, -1).
    """
    x, y, z = np.array([0.1, 0.15, -1.0]) / np.linalg.norm([0.1, 0.15, -1.0])
    seen = backdrop(spot(np.degrees(np.arctan2(y, x)), np.degrees(np.arcsin(z))), UPRIGHT, PINHOLE, 128)[..., 0]
    row, column = np.argwhere(seen > 0.5).mean(axis=0)
    pixels_per_unit = 128 / 0.72
    assert column == pytest.approx(64 + 0.1 * pixels_per_unit, abs=1.0)
    assert row == pytest.approx(64 - 0.15 * pixels_per_unit, abs=1.0)


@settings(max_examples=15, deadline=None)
@given(f_number=st.floats(2, 64), height=st.floats(0.09, 0.33))
def test_blur_keeps_an_even_light(f_number: float, height: float) -> None:
    """The blur by the lens's disc keeps an even light, also at the picture's edge."""
    seen = backdrop(even(), QUARTER_TURN, Camera(height_m=height, f_number=f_number), 64)
    assert seen.shape == (64, 64, 3)
    assert seen == pytest.approx(np.ones_like(seen), rel=1e-5)


def test_a_far_point_is_blurred_to_the_lenss_disc() -> None:
    """Its diameter is that of the aperture seen from the distance in focus: 50 mm / 4 over 0.2 m, 0.0625 in slope.

    Spreads add up, and that of a disc of radius R along an axis is R^2 / 4.
    """
    camera = Camera(height_m=0.2, f_number=4.0)
    sharp = backdrop(spot(0.0, -90.0), UPRIGHT, PINHOLE, 256)[..., 0]
    seen = backdrop(spot(0.0, -90.0), UPRIGHT, camera, 256)[..., 0]
    assert seen.sum() == pytest.approx(sharp.sum(), rel=0.01)
    place = np.arange(256)
    sharp_spread, spread = (np.average((place - 127.5) ** 2, weights=light.sum(axis=0)) for light in (sharp, seen))
    radius = 0.5 * 0.0625 * 256 / 0.72
    assert spread - sharp_spread == pytest.approx(radius**2 / 4, rel=0.03)


@pytest.mark.parametrize(("width", "height"), [(64, 48), (48, 64), (64, 16)])
def test_an_oblong_picture_sees_the_middle_of_what_a_square_one_sees(width: int, height: int) -> None:
    """Also out of focus, and looking askew."""
    camera = Camera(height_m=0.2, f_number=8.0, tilt_deg=20.0, tilt_bearing_deg=50.0, roll_deg=15.0)
    panorama = np.random.default_rng(0).random((64, 128, 3), np.float32)
    size = PictureSize(width=width, height=height)
    seen = panorama_backdrop(panorama, QUARTER_TURN, View.of(camera, size), lens_radius_m(camera))
    top, left = (64 - height) // 2, (64 - width) // 2
    square = backdrop(panorama, QUARTER_TURN, camera, 64)
    assert seen == pytest.approx(square[top : top + height, left : left + width], abs=1e-5)
