"""The places at which a camera sees things."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from farm.scene.camera import Camera
from farm.scene.picture_size import PictureSize
from worker.camera.view import View

HEIGHT = 0.2
RESOLUTION = PictureSize.square(512)

tilts = st.floats(0, 30)
angles = st.floats(-360, 360)


def turned(tilt: float = 0.0, bearing: float = 0.0, roll: float = 0.0, **more: float) -> View:
    """A camera that looks at the origin from `HEIGHT`."""
    camera = Camera(height_m=HEIGHT, f_number=8.0, tilt_deg=tilt, tilt_bearing_deg=bearing, roll_deg=roll, **more)
    return View.of(camera, RESOLUTION)


def test_a_camera_of_the_published_kind_is_the_plain_view() -> None:
    """The published camera looks straight down, without rotation to the last bit."""
    view = turned()
    assert view == View(height_m=HEIGHT, resolution=RESOLUTION)
    assert (view.rotation == np.eye(3)).all()
    assert (view.position_m == [0.0, 0.0, HEIGHT]).all()


@given(tilt=tilts, bearing=angles, roll=angles)
def test_it_looks_at_the_origin_from_its_distance(tilt: float, bearing: float, roll: float) -> None:
    """The origin is in the picture's middle at the same depth, and the frame of directions is right-handed."""
    view = turned(tilt, bearing, roll)
    assert view.project(np.zeros((1, 3)))[0] == pytest.approx([256.0, 256.0])
    assert view.depths_m(np.zeros((1, 3)))[0] == pytest.approx(HEIGHT)
    assert view.rotation.T @ view.rotation == pytest.approx(np.eye(3), abs=1e-12)
    assert np.linalg.det(view.rotation) == pytest.approx(1.0)


@given(tilt=st.floats(1, 30), bearing=angles)
def test_it_stands_where_it_is_tilted_to(tilt: float, bearing: float) -> None:
    """The camera stands at its angle from the vertical, on the side of its bearing."""
    x, y, z = turned(tilt, bearing).position_m
    assert math.degrees(math.acos(z / HEIGHT)) == pytest.approx(tilt)
    assert math.remainder(math.degrees(math.atan2(y, x)) - bearing, 360) == pytest.approx(0.0, abs=1e-6)


def test_a_roll_turns_the_picture_the_other_way() -> None:
    """After a quarter turn of the camera counter-clockwise, what was on the right is below."""
    right = np.array([[0.01, 0.0, 0.0]])
    moved = turned(roll=90.0).project(right)[0] - 256
    assert moved == pytest.approx([0.0, 0.01 * turned().pixels_per_m])


def test_twice_the_focal_length_shows_things_twice_as_large() -> None:
    """From the same place, twice the focal length doubles the size."""
    place = np.array([[0.01, 0.02, 0.005]])
    longer = turned(focal_length_mm=100.0).project(place)[0] - 256
    assert longer == pytest.approx(2 * (turned().project(place)[0] - 256))


@given(tilt=tilts, bearing=angles, x=st.floats(-1, 1), y=st.floats(-1, 1))
def test_what_is_in_focus_is_seen_alike_through_all_of_the_lens(
    tilt: float, bearing: float, x: float, y: float
) -> None:
    """A point of the plane in focus stays; one 10 mm closer moves against the pinhole by the thin lens's formula."""
    middle = turned(tilt, bearing, focus_offset_m=0.01)
    beside = replace(middle, pinhole_m=(0.003, -0.002))
    across = 0.05 * (x * middle.rotation[:, 0] + y * middle.rotation[:, 1])
    in_focus = across + 0.01 * middle.rotation[:, 2]
    assert beside.project(in_focus[None]) == pytest.approx(middle.project(in_focus[None]))
    nearer = in_focus + 0.01 * middle.rotation[:, 2]
    moved = beside.project(nearer[None]) - middle.project(nearer[None])
    expected = (1 - 0.19 / 0.18) * np.array([0.003, 0.002]) * middle.focal_length_px / 0.19
    assert moved[0] == pytest.approx(expected)


@given(tilt=tilts, bearing=angles, roll=angles)
def test_the_seen_floor_fills_the_picture(tilt: float, bearing: float, roll: float) -> None:
    """The corners of the seen floor are the picture's corners."""
    view = turned(tilt, bearing, roll)
    corners = view.floor_corners_m()
    assert corners[:, 2] == pytest.approx(np.zeros(4), abs=1e-12)
    assert view.project(corners) == pytest.approx(np.array([[0, 512], [512, 512], [512, 0], [0, 0]]), abs=1e-6)


def test_what_is_behind_the_camera_has_no_depth() -> None:
    """A point behind or beside the camera has no depth."""
    view = turned(30.0, 0.0)
    assert (view.depths_m(np.array([[0.5, 0.0, 0.5], view.position_m])) <= 1e-12).all()


def test_the_steepest_slope_is_that_to_the_farthest_corner() -> None:
    """Straight down it is half the diagonal's slope; a tilt towards a corner adds to that angle."""
    reach = math.sqrt(2) * 0.5 * 36 / 24
    assert turned(focal_length_mm=24.0).steepest_slope == pytest.approx(reach)
    tilted = turned(15.0, 45.0, focal_length_mm=24.0).steepest_slope
    assert tilted == pytest.approx(math.tan(math.atan(reach) + math.radians(15)))


OBLONG = [PictureSize(width=512, height=170), PictureSize(width=170, height=512), PictureSize(width=512, height=384)]


@given(tilt=tilts, bearing=angles, roll=angles, size=st.sampled_from(OBLONG))
def test_an_oblong_picture_is_the_middle_of_a_square_one(
    tilt: float, bearing: float, roll: float, size: PictureSize
) -> None:
    """With its longer edge as long, it shows things as large, at the same distance from the middle."""
    square = turned(tilt, bearing, roll)
    oblong = replace(square, resolution=size)
    places = np.array([[0.0, 0.0, 0.0], [0.03, -0.02, 0.01], [-0.05, 0.01, 0.0]])
    middle = np.array([size.width, size.height]) / 2
    assert oblong.project(places) - middle == pytest.approx(square.project(places) - 256)
    assert oblong.pixels_per_m == square.pixels_per_m


@given(tilt=tilts, bearing=angles, roll=angles, size=st.sampled_from(OBLONG))
def test_the_floor_that_an_oblong_picture_sees(tilt: float, bearing: float, roll: float, size: PictureSize) -> None:
    """The corners of the seen floor are the picture's, and a square picture sees all of it."""
    square = turned(tilt, bearing, roll)
    corners = replace(square, resolution=size).floor_corners_m()
    width, height = size.width, size.height
    seen = replace(square, resolution=size).project(corners)
    assert seen == pytest.approx(np.array([[0, height], [width, height], [width, 0], [0, 0]]), abs=1e-6)
    inside = square.project(corners)
    assert inside.min() > -1e-6
    assert inside.max() < 512 + 1e-6


@pytest.mark.parametrize("size", OBLONG)
@pytest.mark.parametrize("distortion", [-0.2, 0.2])
def test_distortion_is_told_at_the_corner_of_any_picture(size: PictureSize, distortion: float) -> None:
    """The corner moves by 1 + the distortion against the middle, which stays in the middle."""
    view = replace(turned(distortion=distortion), resolution=size)
    corner = replace(view, distortion=0.0).floor_corners_m()[1:2]
    middle = np.array([size.width, size.height]) / 2
    far, near = (view.project(share * corner)[0] - middle for share in (1.0, 1e-6))
    assert far / near * 1e-6 == pytest.approx(np.full(2, 1.0 + distortion), rel=1e-6)
