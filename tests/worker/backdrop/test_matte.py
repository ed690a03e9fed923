"""The coverage of pixels by cables, and the backdrop behind them."""

import numpy as np
import pytest
from numpy.typing import NDArray

from farm.scene.picture_size import PictureSize
from tests.worker.scenes import tubular
from worker.backdrop.matte import Matte, covered_by, lay_over
from worker.camera.view import View
from worker.curves import Points

RADIUS = 0.001
SIDES = 64
VIEW = View(height_m=0.12, resolution=PictureSize.square(128))


def bar(z: float = RADIUS, shift: float = 0.0) -> Points:
    """A straight cable from top to bottom, `shift` to the right of the middle."""
    along = np.linspace(-0.2, 0.2, 401)
    return np.stack([np.full_like(along, shift), along, np.full_like(along, z)], axis=1)


def covered(curve: Points, lens_radius_m: float) -> NDArray[np.float32]:
    """The coverage by one cable."""
    return covered_by([tubular(curve, RADIUS)], VIEW, lens_radius_m, SIDES)


def profile(curve: Points, lens_radius_m: float) -> NDArray[np.float32]:
    """The coverage across a cable that runs down the picture."""
    across: NDArray[np.float32] = covered(curve, lens_radius_m)[VIEW.resolution.height // 2]
    return across


def test_a_pinhole_sees_the_width_of_a_cylinder() -> None:
    """A cylinder of radius r at distance d is f 2 r / sqrt(d^2 - r^2) pixels wide; edge pixels hold their share."""
    distance = VIEW.height_m - RADIUS
    width = VIEW.resolution.width * 50 / 36 * 2 * RADIUS / np.sqrt(distance**2 - RADIUS**2)
    assert profile(bar(shift=0.0003), 0.0).sum() == pytest.approx(width, rel=2e-3)


def test_without_cables_nothing_is_covered() -> None:
    """A backdrop without cables is seen whole."""
    assert not covered_by([], VIEW, 0.002, SIDES).any()


@pytest.mark.parametrize("height", [0.006, 0.012, 0.03])
def test_a_lens_blurs_by_its_disc(height: float) -> None:
    """At height z a lens of radius a blurs by a disc of radius a z / (d - z).

    Across a straight cable that is the disc's width, 2 sqrt(1 - s^2) at s of its radius.
    """
    lens, radius, view = 0.002, 0.004, View(height_m=0.12, resolution=PictureSize.square(512))
    sharp, blurred = (covered_by([tubular(bar(height), radius)], view, a, SIDES)[256] for a in (0.0, lens))
    disc_px = lens * height / (view.height_m - height) * view.pixels_per_m
    reach = int(np.ceil(disc_px))
    # The share of the disc in each pixel, from twenty places in it.
    s = (np.arange(20 * (2 * reach + 1)) + 0.5) / 20 - (reach + 0.5)
    kernel = np.sqrt(np.maximum(1.0 - (s / disc_px) ** 2, 0.0)).reshape(-1, 20).sum(axis=1)
    expected = np.convolve(sharp, kernel / kernel.sum(), mode="same")
    assert np.abs(blurred - expected).max() < 0.06


def test_blur_takes_and_gives_alike() -> None:
    """The sum of a row's coverage doesn't depend on the lens, within 1 %."""
    sharp, blurred = (profile(bar(z=0.01), lens).sum() for lens in (0.0, 0.003))
    assert blurred == pytest.approx(sharp, rel=0.01)


def test_what_lies_in_focus_stays_sharp() -> None:
    """A cable on the floor covers the same through any place of the lens, to within its own height."""
    change = np.abs(profile(bar(), 0.0003) - profile(bar(), 0.0))
    assert change.max() < 0.05


@pytest.fixture
def matte() -> Matte:
    """A cable before a bright wall."""
    share = covered(bar(shift=0.0003), 0.0)
    return Matte(share, np.full((*share.shape, 3), 4.0, np.float32))


def test_cables_hide_what_is_behind(matte: Matte) -> None:
    """Where a cable covers all it is seen as rendered, where none is, the backdrop is."""
    cables = matte.covered[:, :, None] * np.array([0.2, 0.1, 0.4], np.float32)
    laid = lay_over(cables, matte)
    assert (laid[matte.covered == 1.0] == cables[matte.covered == 1.0]).all()
    assert (laid[matte.covered == 0.0] == 4.0).all()


def test_an_edge_is_mixed_by_its_share(matte: Matte) -> None:
    """A pixel that is covered in part is a mix of a cable's colour and the backdrop."""
    colour = np.array([0.2, 0.1, 0.4], np.float32)
    share = matte.covered[:, :, None]
    laid = lay_over(share * colour, matte)
    assert np.allclose(laid, share * colour + (1 - share) * 4.0, atol=1e-4)


def test_ragged_samples_leave_the_edge_straight(matte: Matte) -> None:
    """Edge pixels of which all samples or none met the cable, row by row, come out between, and nearer each other."""
    colour = np.array([0.2, 0.1, 0.4], np.float32)
    edge = (matte.covered > 0.0) & (matte.covered < 1.0)
    found = np.where(edge, np.arange(VIEW.resolution.height)[:, None] % 2, matte.covered)
    laid = lay_over((found[:, :, None] * colour).astype(np.float32), matte)
    column = np.flatnonzero(edge[64])[0]
    share = matte.covered[64, column]
    rows = laid[20:100, column, 2]
    assert np.ptp(rows) < 0.25 * colour[2] * share
    assert rows.mean() == pytest.approx(share * colour[2] + (1 - share) * 4.0, rel=0.05)


def test_a_wide_open_lens_close_by_is_bounded() -> None:
    """A pile halfway up to a lens as wide as a hand is blurred in the same number of looks as any other."""
    share = covered(bar(z=0.06), 0.05)
    assert 0.0 <= share.min() <= share.max() < 0.2
