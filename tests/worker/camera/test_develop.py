"""Developing light to levels, step by step."""

import math

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from assets.colour import srgb_of_light
from farm.scene.camera import NO_JPEG, Development
from worker.camera import develop as steps
from worker.camera.develop import Light, develop
from worker.colour import luminance

PLAIN = Development(
    key=0.18,
    exposure_ev=0.0,
    contrast=1.0,
    saturation=1.0,
    white_balance=(1.0, 1.0),
    vignetting=0.0,
    chromatic_aberration=0.0,
    full_well=0.0,
    read_noise=0.0,
    sharpening=0.0,
    jpeg_quality=NO_JPEG,
    seed=0,
)
"""Development with nothing but the exposure and the sRGB curve."""

NOISY = PLAIN.model_copy(update={"full_well": 2000.0, "read_noise": 3.0})


def even(value: float, size: int = 64) -> Light:
    """The same light in every pixel and channel."""
    return np.full((size, size, 3), value, np.float32)


def varied(size: int = 64, seed: int = 0) -> Light:
    """Light of all levels over four stops and of all colours, the same at any exposure."""
    light: Light = np.exp2(np.random.default_rng(seed).uniform(-3, 1, (size, size, 3))).astype(np.float32)
    return light


def test_settings_that_do_nothing_give_plain_srgb() -> None:
    """Below the shoulder, levels are sRGB's to two levels, once the mean is at mid-grey: 0.18 is level 118."""
    steps_of_light = np.exp2(np.linspace(-1.5, 1.5, 64))
    mean = math.sqrt(math.exp(float(np.log(steps_of_light).mean())) * float(steps_of_light.mean()))
    light = np.repeat(steps_of_light[:, None, None], 64, axis=1).repeat(3, axis=2) * (0.18 / mean)
    expected = np.rint(255 * srgb_of_light(light)).astype(int)
    assert np.abs(develop(light.astype(np.float32), PLAIN).astype(int) - expected).max() <= 2
    assert (develop(even(0.7), PLAIN) == 118).all()


@given(brightness=st.floats(1e-4, 1e4), key=st.floats(0.02, 0.5), stops=st.floats(-2, 2))
def test_the_exposure_reaches_its_key(brightness: float, key: float, stops: float) -> None:
    """The exposure meets its key for any brightness, and an error of stops is added."""
    exposed = luminance(steps.expose(varied(256) * np.float32(brightness), key, stops))
    mean = math.sqrt(math.exp(float(np.log(exposed).mean())) * float(exposed.mean()))
    assert mean == pytest.approx(key * 2**stops, rel=0.05)


def test_a_lamp_in_view_or_a_black_edge_does_not_sway_the_exposure() -> None:
    """A hundredth of the picture at 10,000 times the light, or at none, changes the exposure by a tenth of a stop."""
    plain = steps.expose(varied(), 0.18, 0.0)[32:, 32:]
    for value in (1e4, 0.0):
        changed = varied()
        changed[:6, :6] = value
        assert steps.expose(changed, 0.18, 0.0)[32:, 32:] == pytest.approx(plain, rel=0.07)


def test_black_stays_black() -> None:
    """A black picture, which has nothing to meter, stays black."""
    assert not develop(even(0.0), PLAIN).any()


def test_what_is_no_light_does_no_harm() -> None:
    """NaN, infinity and negative light in single pixels change no other pixel."""
    light = varied()
    broken = light.copy()
    broken[10, 11], broken[20, 5], broken[40, 40] = np.nan, np.inf, -1.0
    change = np.abs(develop(broken, PLAIN).astype(int) - develop(light, PLAIN)).max(axis=2)
    change[[10, 20, 40], [11, 5, 40]] = 0
    assert change.max() <= 2


def test_the_white_balance_keeps_a_greys_luminance() -> None:
    """Red over green and blue over green change by the gains, and luminance doesn't."""
    seen = steps.balance(even(0.5), (1.2, 0.9))
    assert luminance(seen) == pytest.approx(np.full((64, 64), 0.5), rel=1e-6)
    assert seen[0, 0] / seen[0, 0, 1] == pytest.approx([1.2, 1.0, 0.9])


def test_the_white_balance_takes_off_most_of_a_lamps_colour() -> None:
    """White paper under a warm lamp keeps its luminance and the fourth root of its colour."""
    lamp = np.array([1.6, 0.9, 0.3])
    seen = steps.balance(even(0.5) * lamp.astype(np.float32), (1.0, 1.0), lamp)[0, 0]
    assert luminance(seen) == pytest.approx(luminance((0.5 * lamp).astype(np.float32)))
    assert seen / seen[1] == pytest.approx((lamp / lamp[1]) ** 0.25)


@pytest.mark.parametrize("lost", [0.1, 0.35, 1.0])
def test_corners_lose_their_share(lost: float) -> None:
    """Corners lose their share of the middle's light; along a radius it falls as cos^4."""
    seen = steps.vignette(even(1.0, 401), lost)[..., 0]
    assert seen[200, 200] == pytest.approx(1.0, abs=1e-4)
    assert seen[0, 0] == pytest.approx(1.0 - lost, abs=0.01)
    slope = np.sqrt(1 / np.sqrt(max(1 - lost, 1e-4)) - 1) * np.hypot(100, 100) / np.hypot(200.5, 200.5)
    assert seen[100, 100] == pytest.approx(np.cos(np.arctan(slope)) ** 4, rel=1e-3)


def test_a_bright_coloured_light_turns_white() -> None:
    """A deep red light gains green and blue beyond white, so that ten times the light is pale."""
    red = even(1.0) * np.array([1.0, 0.1, 0.02], np.float32)
    assert (steps.bleed(red) == red).all()
    paler = steps.bleed(10 * red)[0, 0]
    assert paler == pytest.approx([10.9, 1.9, 1.1], rel=1e-5)


@pytest.mark.parametrize("level", [0.02, 0.2, 0.8])
def test_noise_has_the_variance_of_shot_and_read_noise(level: float) -> None:
    """The variance is level / full well + (read noise / full well)^2, within 5 %, and the mean stays."""
    noisy = steps.add_noise(even(level, 256), 2000.0, 3.0, np.random.default_rng(0))
    assert noisy.var() == pytest.approx(level / 2000 + (3 / 2000) ** 2, rel=0.05)
    assert noisy.mean() == pytest.approx(level, rel=0.01)


def test_noise_is_shared_with_the_pixels_beside() -> None:
    """The autocorrelation is the kernel's, 2 c / (1 + 2 c^2), in each direction; channels are independent."""
    noise = steps.add_noise(even(0.5, 256), 2000.0, 0.0, np.random.default_rng(0)) - 0.5
    expected = 2 * steps.CORRELATION / (1 + 2 * steps.CORRELATION**2)
    across = np.corrcoef(noise[:, :-1, 0].ravel(), noise[:, 1:, 0].ravel())[0, 1]
    down = np.corrcoef(noise[:-1, :, 0].ravel(), noise[1:, :, 0].ravel())[0, 1]
    assert [across, down] == pytest.approx([expected, expected], abs=0.02)
    assert abs(np.corrcoef(noise[..., 0].ravel(), noise[..., 1].ravel())[0, 1]) < 0.02


def test_the_seed_decides_the_noise() -> None:
    """The same seed, 0 included, gives the same picture, and another seed another one."""
    first, again = (develop(varied(), NOISY) for _ in range(2))
    other = develop(varied(), NOISY.model_copy(update={"seed": 1}))
    assert (first == again).all()
    assert (first != other).any()


def test_the_tone_curve_rises_to_white_and_is_smooth_at_the_shoulder() -> None:
    """The curve never falls, has no kink where the shoulder begins, and is white at the most light."""
    light = np.linspace(0.0, steps.MOST_LIGHT, 20_001)
    for contrast in (0.8, 1.0, 1.6):
        levels = steps.curve(light, contrast)
        assert (np.diff(levels) >= 0).all()
        assert levels[0] == 0.0
        assert levels[-1] == pytest.approx(1.0, abs=1e-3)
        at = int(np.searchsorted(light, steps.SHOULDER))
        assert np.diff(levels)[at + 2] == pytest.approx(np.diff(levels)[at - 3], rel=0.02)


@pytest.mark.parametrize("contrast", [0.8, 1.0, 1.5])
def test_contrast_is_the_slope_about_mid_grey(contrast: float) -> None:
    """Contrast multiplies sRGB's slope at mid-grey, which stays where it is."""
    light = steps.MID_GREY * np.array([0.99, 1.0, 1.01])
    levels, plain = steps.curve(light, contrast), srgb_of_light(light)
    assert levels[1] == pytest.approx(plain[1])
    assert (levels[2] - levels[0]) / (plain[2] - plain[0]) == pytest.approx(contrast, rel=0.01)


def test_the_table_is_the_curve() -> None:
    """The table equals the curve to a fifth of a level, also in the dark."""
    light = (np.linspace(0, 1, 4096) ** 4 * steps.MOST_LIGHT).astype(np.float32)
    assert steps.tone(light, 1.3) == pytest.approx(steps.curve(light.astype(np.float64), 1.3), abs=0.2 / 255)


def test_saturation_keeps_brightness() -> None:
    """A saturation of 0 leaves grey, 1 changes nothing, and 2 doubles the distance from grey."""
    levels = varied() / 4
    grey = luminance(levels)
    assert steps.saturate(levels, 1.0) is levels
    assert steps.saturate(levels, 0.0) == pytest.approx(np.repeat(grey[..., None], 3, axis=2), abs=1e-6)
    assert luminance(steps.saturate(levels, 2.0)) == pytest.approx(grey, abs=1e-6)


def test_sharpening_steepens_an_edge_and_leaves_flats() -> None:
    """Sharpening adds back the amount of what a blur takes off."""
    step = np.repeat(np.where(np.arange(64) < 32, 0.3, 0.6)[None, :, None], 64, axis=0).repeat(3, axis=2)
    sharp = steps.sharpen(step.astype(np.float32), 0.5)
    assert sharp[:, :20] == pytest.approx(np.full((64, 20, 3), 0.3), abs=1e-5)
    assert sharp[32, 32, 0] - sharp[32, 31, 0] > 0.3 * 1.3


def peak_snr_db(picture: NDArray[np.uint8], other: NDArray[np.uint8]) -> float:
    """Peak signal-to-noise ratio of two pictures, dB."""
    return float(cv2.PSNR(picture, other))


def test_compression_does_what_its_quality_says() -> None:
    """From 100 on there is no loss; below, a lower quality loses more."""
    picture = cv2.GaussianBlur(np.rint(varied() * 100).astype(np.uint8), (0, 0), 2).astype(np.uint8)
    assert (steps.compress(picture, NO_JPEG) == picture).all()
    assert (steps.compress(picture, 100) == picture).all()
    found = [peak_snr_db(steps.compress(picture, quality), picture) for quality in (30, 60, 95)]
    assert found == sorted(found)
    assert found[0] < found[2]


def test_a_distorted_picture_is_filled() -> None:
    """No border is black or stretched, even with colour fringes."""
    fringed = PLAIN.model_copy(update={"chromatic_aberration": 0.002})
    for distortion in (-0.2, 0.2):
        assert (develop(even(0.7), fringed, distortion=distortion) == 118).all()


@pytest.mark.parametrize("shape", [(301, 401), (401, 133)])
def test_the_corners_of_any_picture_lose_their_share(shape: tuple[int, int]) -> None:
    """The corners lose the share that was asked for, and the loss depends on the distance from the middle alone."""
    seen = steps.vignette(np.ones((*shape, 3), np.float32), 0.35)[..., 0]
    corner, (row, column) = 0.65, (shape[0] // 2, shape[1] // 2)
    assert seen[[0, 0, -1, -1], [0, -1, 0, -1]] == pytest.approx(np.full(4, corner), abs=0.01)
    assert seen[row, column + 60] == pytest.approx(seen[row + 60, column], rel=1e-6)


@pytest.mark.parametrize("shape", [(48, 64), (64, 48)])
def test_every_step_keeps_the_shape(shape: tuple[int, int]) -> None:
    """A picture of any shape goes through the whole camera."""
    changes = {"vignetting": 0.3, "chromatic_aberration": 0.002, "sharpening": 0.5, "jpeg_quality": 80}
    light = np.full((*shape, 3), 0.5, np.float32)
    seen = steps.develop(light, NOISY.model_copy(update=changes), distortion=-0.05)
    assert seen.shape == (*shape, 3)
