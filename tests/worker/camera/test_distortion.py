"""A lens's distortion of places and of pictures, which must agree."""

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from farm.scene.picture_size import PictureSize
from tests.worker.scenes import tubular
from worker.backdrop.matte import covered_by
from worker.camera.distortion import Distortion
from worker.camera.view import View
from worker.curves import Points
from worker.label.coverage import covered_share
from worker.label.label import label_cables
from worker.label.silhouette import silhouettes

amounts = st.floats(-0.2, 0.2)
EDGE = np.sqrt(0.5)
SQUARE = PictureSize.square(256)


SHAPES = [SQUARE, PictureSize(width=256, height=192), PictureSize(width=96, height=256)]


def half_edges(size: PictureSize) -> NDArray[np.float64]:
    """Half the width and height, (2,), where a corner has radius 1."""
    half: NDArray[np.float64] = np.array([size.width, size.height]) / np.hypot(size.width, size.height)
    return half


def border(count: int, size: PictureSize = SQUARE) -> NDArray[np.float64]:
    """Places along the picture's border."""
    along, edge = np.linspace(-1.0, 1.0, count), np.ones(count)
    sides = [np.stack(pair, axis=1) for pair in ((along, edge), (along, -edge), (edge, along), (-edge, along))]
    places: NDArray[np.float64] = np.concatenate(sides) * half_edges(size)
    return places


def test_none_moves_nothing() -> None:
    """Without distortion, places and pictures stay the same to the last bit."""
    picture = np.random.default_rng(0).random((16, 16, 3), np.float32)
    assert (Distortion(0.0, SQUARE).move(border(9)) == border(9)).all()
    assert Distortion(0.0, SQUARE).distort(picture) is picture


@given(amount=amounts, size=st.sampled_from(SHAPES))
def test_the_picture_is_just_filled(amount: float, size: PictureSize) -> None:
    """The border never moves inside the picture, and somewhere it stays on the border."""
    moved = (np.abs(Distortion(amount, size).move(border(101, size))) / half_edges(size)).max(axis=1)
    assert moved.min() == pytest.approx(1.0)


@given(amount=amounts)
def test_a_corner_moves_against_the_middle_as_told(amount: float) -> None:
    """A corner moves by 1 + the amount, relative to the scale of the picture's middle."""
    lens = Distortion(amount, SQUARE)
    middle, corner = (lens.move(radius * np.array([[EDGE, EDGE]]))[0] / radius for radius in (1e-6, 1.0))
    assert corner / middle == pytest.approx(np.full(2, 1.0 + amount), rel=1e-6)


@given(amount=amounts, radius=st.floats(0, 50), further=st.floats(1e-3, 10))
def test_what_is_farther_out_stays_farther_out(amount: float, radius: float, further: float) -> None:
    """Even far outside, nothing is folded back into the picture."""
    near, far = Distortion(amount, SQUARE).move(np.array([[radius, 0.0], [radius + further, 0.0]]))[:, 0]
    assert far > near


@pytest.mark.parametrize("size", SHAPES)
@pytest.mark.parametrize("amount", [-0.2, -0.05, 0.05, 0.2])
def test_pictures_are_distorted_as_places_are(amount: float, size: PictureSize) -> None:
    """The centroid of each blurred dot is where its place moves, within 0.06 pixels."""
    sigma, middle, lens = 2.0, np.array([size.width, size.height]) / 2, Distortion(amount, size)
    shares = np.array([[0.0, 0.0], [-0.53, -0.29], [0.56, -0.61], [-0.76, 0.72], [0.73, 0.73]])
    places = middle * (1 + shares)
    moved = lens.corner_px * lens.move((places - middle) / lens.corner_px) + middle
    rows, columns = np.indices(size.shape) + 0.5
    for place, expected in zip(places, moved, strict=True):
        dot = np.exp(-((columns - place[0]) ** 2 + (rows - place[1]) ** 2) / (2 * sigma**2))
        seen = lens.distort(np.repeat(dot[..., None], 3, axis=2).astype(np.float32))[..., 0]
        found = np.array([np.average(columns, weights=seen), np.average(rows, weights=seen)])
        # The curvature of the distortion also moves a dot's centroid away from the place of its middle.
        assert found == pytest.approx(expected, abs=0.06)


@pytest.mark.parametrize("amount", [-0.2, 0.2])
@pytest.mark.parametrize(
    ("tilt", "roll", "resolution"), [(0.0, 0.0, SQUARE), (25.0, 40.0, SQUARE), (25.0, 40.0, SHAPES[1])]
)
def test_a_mask_agrees_with_its_distorted_picture(
    amount: float, tilt: float, roll: float, resolution: PictureSize
) -> None:
    """Coverage through an undistorted lens, distorted as a picture, against that of distorted silhouettes.

    In each row a nearly upright cable's edges are apart by what it covers, and in their middle by its centroid.
    """
    view = View(
        height_m=0.12, resolution=resolution, tilt_deg=tilt, tilt_bearing_deg=70.0, roll_deg=roll, distortion=amount
    )
    across = view.rotation[:, :2] @ [[1.0, 0.2], [0.0, 1.0]]
    across[2] = 0.001
    along = np.linspace(-0.06, 0.06, 601)
    curve: Points = np.stack([0.012 * np.ones_like(along), along], axis=1) @ across[:2].T
    curve = np.column_stack([curve, np.full(len(curve), 0.001)])
    tube = [tubular(curve, 0.001)]
    ideal = covered_by(tube, view.undistorted(), 0.0, 64)
    # A renderer's pixels overlap. A step from one pixel to the next leaves nothing between them to look up.
    ideal = cv2.GaussianBlur(ideal, (0, 0), 0.7).astype(np.float32)
    picture = Distortion(amount, resolution).distort(np.repeat(ideal[..., None], 3, axis=2))[..., 0]
    quads = silhouettes(tube, view, 64).quads_px
    mask = covered_share(quads, resolution.height, 256)
    assert mask.sum() > 1000
    columns = np.arange(256) + 0.5
    inner = slice(8, -8)
    width = picture.sum(axis=1)[inner], mask.sum(axis=1)[inner]
    place = (picture @ columns)[inner] / width[0], (mask @ columns)[inner] / width[1]
    assert np.abs(width[0] - width[1]).max() < 0.1
    assert np.abs(place[0] - place[1]).max() < 0.1
    labels = label_cables(tube, view, 64)
    assert np.mean((labels.mask > 0) != (picture > 0.5)) < 0.002


def test_red_is_larger_and_blue_smaller() -> None:
    """A white dot to the right of the middle splits: red outside, blue inside, by the share of its distance."""
    picture = np.zeros((201, 201, 3), np.float32)
    cv2.circle(picture, (180, 100), 3, (1.0, 1.0, 1.0), -1)
    seen = Distortion(0.0, PictureSize.square(201)).distort(picture, (1.01, 1.0, 0.99))
    found = [np.average(np.arange(201), weights=seen[..., k].sum(axis=0)) - 100 for k in range(3)]
    assert found == pytest.approx([80.8, 80.0, 79.2], abs=0.05)
