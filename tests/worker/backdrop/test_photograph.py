"""A photograph as the backdrop of the cables."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray
from PIL import Image

from assets.colour import REC709_LUMINANCE
from farm.scene.backdrop import Plate
from farm.scene.picture_size import PictureSize
from worker.backdrop.panorama import disc
from worker.backdrop.photograph import DARKEST, photograph_backdrop

WHOLE = Plate(name="lab", x=0.0, y=0.0, zoom=1.0, mirror=False, blur_px=0.0)


def noise(height: int = 300, width: int = 400, seed: int = 0) -> NDArray[np.uint8]:
    """A photograph of noise."""
    return np.random.default_rng(seed).integers(0, 256, (height, width, 3), np.uint8)


def linear(pixels: NDArray[np.uint8]) -> NDArray[np.float64]:
    """The curve of IEC 61966-2-1, from its text."""
    level = pixels / 255.0
    return np.where(level <= 0.04045, level / 12.92, ((level + 0.055) / 1.055) ** 2.4)


def mean_luminance(light: NDArray[np.float32] | NDArray[np.float64]) -> float:
    """Of all pixels."""
    return float((light.astype(np.float64) @ REC709_LUMINANCE).mean())


def test_pixel_for_pixel_only_the_brightness_changes() -> None:
    """A square as large as the picture keeps its pixels, in linear light."""
    pixels = noise(256, 256)
    seen = photograph_backdrop(pixels, WHOLE, PictureSize.square(256), 0.0, 0.5)
    assert seen.shape == (256, 256, 3)
    assert seen.dtype == np.float32
    expected = linear(pixels)
    np.testing.assert_allclose(seen, expected * 0.5 / mean_luminance(expected), rtol=1e-4, atol=1e-6)


def test_linear_light_is_what_the_standard_says() -> None:
    """Level 188 of sRGB is half of white's light."""
    pixels = np.full((256, 256, 3), 255, np.uint8)
    pixels[:, :128] = 188
    seen = photograph_backdrop(pixels, WHOLE, PictureSize.square(256), 0.0, 1.0)
    assert seen[0, 0, 0] / seen[0, -1, 0] == pytest.approx(0.5028, abs=1e-3)


@settings(max_examples=40)
@given(
    x=st.floats(0, 1),
    y=st.floats(0, 1),
    zoom=st.floats(0.3, 1),
    mirror=st.booleans(),
    blur=st.floats(0, 20),
    size=st.sampled_from([(256, 256), (256, 700), (700, 256), (900, 600)]),
    luminance=st.floats(0.01, 5),
)
def test_the_mean_is_what_was_asked_for(
    x: float, y: float, zoom: float, mirror: bool, blur: float, size: tuple[int, int], luminance: float
) -> None:
    """The mean is met whatever part is seen, and no light is negative."""
    plate = Plate(name="lab", x=x, y=y, zoom=zoom, mirror=mirror, blur_px=blur)
    seen = photograph_backdrop(noise(*size), plate, PictureSize.square(128), blur, luminance)
    assert seen.shape == (128, 128, 3)
    assert mean_luminance(seen) == pytest.approx(luminance, rel=1e-3)
    assert seen.min() >= 0


@pytest.mark.parametrize(("x", "y", "left", "top"), [(0.0, 0.0, 0, 0), (1.0, 1.0, 500, 300), (0.5, 0.25, 250, 75)])
def test_the_square_lies_where_it_was_drawn(x: float, y: float, left: int, top: int) -> None:
    """Within the free range, 0 touches the left or upper edge, and 1 the right or lower."""
    pixels = noise(600, 800)
    plate = WHOLE.model_copy(update={"x": x, "y": y, "zoom": 0.5})
    seen = photograph_backdrop(pixels, plate, PictureSize.square(300), 0.0, 1.0)
    expected = linear(pixels[top : top + 300, left : left + 300])
    np.testing.assert_allclose(seen, expected / mean_luminance(expected), rtol=1e-4, atol=1e-6)


def test_mirrored() -> None:
    """Left and right change places; up and down don't."""
    pixels, size = noise(), PictureSize.square(64)
    mirrored = photograph_backdrop(pixels, WHOLE.model_copy(update={"mirror": True}), size, 3.0, 1.0)
    np.testing.assert_allclose(mirrored, photograph_backdrop(pixels, WHOLE, size, 3.0, 1.0)[:, ::-1], rtol=1e-4)


@pytest.mark.parametrize("factor", [2, 3, 8])
def test_shrinking_takes_the_mean_of_areas(factor: int) -> None:
    """Shrinking averages linear light: thin bright lines keep theirs, and nothing glitters."""
    pixels = noise(64 * factor, 64 * factor)
    seen = photograph_backdrop(pixels, WHOLE, PictureSize.square(64), 0.0, 1.0)
    expected = linear(pixels).reshape(64, factor, 64, factor, 3).mean(axis=(1, 3))
    np.testing.assert_allclose(seen, expected / mean_luminance(expected), rtol=1e-3)


@pytest.mark.parametrize("edge", [257, 390, 1000, 1999])
def test_odd_sizes_are_shrunk_alike(edge: int) -> None:
    """A ramp of light stays a ramp, within a pixel, even if the sizes don't divide."""
    ramp = np.linspace(0.0, 1.0, edge)
    level = np.where(ramp <= 0.0031308, ramp * 12.92, 1.055 * ramp ** (1 / 2.4) - 0.055)
    pixels = np.repeat(np.round(255 * level).astype(np.uint8)[None, :, None], edge, axis=0).repeat(3, axis=2)
    seen = photograph_backdrop(pixels, WHOLE, PictureSize.square(100), 0.0, 0.5)
    middles = (np.arange(100) + 0.5) / 100
    assert np.abs(seen[:, :, 1] - middles).max() < 0.015


def test_enlarging_is_smooth() -> None:
    """A picture of 256 pixels enlarged to 512 resembles Pillow's, in linear light."""
    across, down = np.meshgrid(np.linspace(0, 9, 256), np.linspace(0, 7, 256))
    pixels = np.repeat((120 + 100 * np.sin(across) * np.cos(down)).astype(np.uint8)[..., None], 3, axis=2)
    seen = photograph_backdrop(pixels, WHOLE, PictureSize.square(512), 0.0, 1.0)[..., 0]
    light = Image.fromarray(linear(pixels)[..., 0].astype(np.float32))
    expected = np.asarray(light.resize((512, 512), Image.Resampling.BICUBIC))
    assert np.abs(seen - expected / expected.mean()).max() < 0.02


def test_a_point_is_blurred_to_the_lenss_disc() -> None:
    """A single point of light becomes the disc itself, in linear light."""
    pixels = np.zeros((256, 256, 3), np.uint8)
    pixels[128, 128] = 255
    seen = photograph_backdrop(pixels, WHOLE, PictureSize.square(256), 9.0, 1.0)[..., 0]
    reach = len(disc(9.0)) // 2
    patch = seen[128 - reach : 129 + reach, 128 - reach : 129 + reach]
    np.testing.assert_allclose(patch / patch.sum(), disc(9.0), atol=1e-6)
    assert patch.sum() == pytest.approx(seen.sum(), rel=1e-5)


@pytest.mark.parametrize("blur", [0.0, 0.3, 1.0, 40.0, 200.0])
def test_an_even_wall_stays_even(blur: float) -> None:
    """To the very edges, which see no black beyond them."""
    seen = photograph_backdrop(np.full((256, 300, 3), 90, np.uint8), WHOLE, PictureSize.square(128), blur, 0.7)
    np.testing.assert_allclose(seen, 0.7, rtol=1e-4)


def test_a_black_crop_stays_dark() -> None:
    """It is not brightened until its few levels show."""
    size = PictureSize.square(64)
    assert not photograph_backdrop(np.zeros((256, 256, 3), np.uint8), WHOLE, size, 2.0, 1.0).any()
    nearly = photograph_backdrop(np.full((256, 256, 3), 1, np.uint8), WHOLE, size, 2.0, 1.0)
    assert nearly.mean() == pytest.approx(1 / 255 / 12.92 / DARKEST, rel=1e-3)


@pytest.mark.parametrize(
    ("width", "height", "zoom", "rows", "columns"),
    [
        (40, 30, 1.0, slice(0, 300), slice(0, 400)),
        (30, 40, 1.0, slice(0, 300), slice(175, 400)),
        (40, 10, 1.0, slice(200, 300), slice(0, 400)),
        (40, 30, 0.5, slice(150, 300), slice(200, 400)),
    ],
)
def test_a_part_has_the_shape_of_the_picture(width: int, height: int, zoom: float, rows: slice, columns: slice) -> None:
    """Zoom 1 takes the largest part of the picture's shape; nothing is stretched."""
    pixels = noise(300, 400)
    plate = WHOLE.model_copy(update={"x": 1.0, "y": 1.0, "zoom": zoom})
    part = np.ascontiguousarray(pixels[rows, columns])
    size = PictureSize(width=width, height=height)
    seen = photograph_backdrop(pixels, plate, size, 0.0, 1.0)
    assert seen.shape == (height, width, 3)
    np.testing.assert_array_equal(seen, photograph_backdrop(part, WHOLE, size, 0.0, 1.0))
