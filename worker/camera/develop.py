"""Develops light to the picture that a camera saves, in the steps of a camera. Pure numpy and OpenCV.

Light is (H, W, 3) float32, linear Rec. 709; 1 fills the sensor's wells. The tone curve turns it into levels, which are
(H, W, 3) float32, sRGB between 0 and 1.
"""

import math

import cv2
import numpy as np
from numpy.typing import NDArray

from assets.colour import REC709_LUMINANCE, srgb_of_light
from farm.errors import RenderError
from farm.scene.camera import UNCOMPRESSED_FROM, Development
from farm.scene.picture_size import PictureSize
from worker.camera.distortion import Distortion
from worker.camera.illuminant import NEUTRAL
from worker.colour import luminance

MID_GREY = 0.18
"""Light of mid-grey, the grey card that a photographer meters."""

ADAPTED = 0.75
"""Exponent by which the white balance removes the light's colour: 0 removes nothing, 1 everything. The rest lets a
picture tell a warm lamp from daylight."""

SHOULDER = 0.6
"""Light up to which the tone curve is that of sRGB; above it, the curve bends and reaches white only at several times
1."""

MOST_LIGHT = 4.0
"""Largest light: the tone curve makes it white, and more would only spread from a firefly or a lamp's reflection to the
pixels near it."""

OVERLAP = 0.1
"""Share of the brightest channel's light above 1 that is added to every channel."""

CORRELATION = 0.3
"""Weight of a pixel's neighbours in its noise, which the interpolation of a Bayer mosaic causes."""

SHARPENED_PX = 1.0
"""Standard deviation of the unsharp mask's Gaussian, in pixels."""

_FINITE = 1e30
"""Light that stands for infinity: float32 holds it, with room for sums."""

_METERED_STEP = 4
"""Distance between metered pixels along rows and columns, in pixels: one in 16 is enough for a mean."""

_METERED_PART = (2.0, 98.0)
"""Percentiles to which luminances are clipped for the exposure, so that a few extreme pixels do not sway it."""

_METERED_STOPS = 8.0
"""Range below the upper percentile to which luminances are clipped, in stops, so that black pixels do not sway the
exposure."""

_TABLE_STEPS = 2**15
"""Number of steps of the tone curve's table, far more than the 256 levels of a picture."""

Light = NDArray[np.float32]
Levels = NDArray[np.float32]


def develop(
    light: Light, development: Development, *, distortion: float = 0.0, lit_by: NDArray[np.float64] = NEUTRAL
) -> NDArray[np.uint8]:
    """Develop a picture.

    Args:
        light: (H, W, 3) linear Rec. 709, rendered through a lens without distortion; NaN and negative values are black.
        development: settings of the camera.
        distortion: radial distortion of the camera's lens; see `farm.scene.camera.Camera`.
        lit_by: (3,) linear Rec. 709, colour of the scene's light, which the white balance mostly removes.

    Returns:
        (H, W, 3) uint8 sRGB.

    Raises:
        RenderError: if OpenCV can't compress the picture.
    """
    light = expose(clean(light), development.key, development.exposure_ev)
    light = balance(light, development.white_balance, lit_by)
    light = np.minimum(bleed(vignette(light, development.vignetting)), np.float32(MOST_LIGHT))
    larger = development.chromatic_aberration
    lens = Distortion(distortion, PictureSize.of_array(light.shape))
    light = lens.distort(light, (1.0 + larger, 1.0, 1.0 - larger))
    rng = np.random.default_rng(development.seed)
    light = add_noise(light, development.full_well, development.read_noise, rng)
    levels = saturate(tone(light, development.contrast), development.saturation)
    return compress(quantize(sharpen(levels, development.sharpening)), development.jpeg_quality)


def clean(light: Light) -> Light:
    """Remove negative values, infinity and NaN from light (..., 3): they become 0, `_FINITE` and 0."""
    positive = np.fmax(light, 0.0)  # fmax ignores NaN
    return np.minimum(positive, np.float32(_FINITE), out=positive)


def expose(light: Light, key: float, exposure_ev: float) -> Light:
    """Expose light so that its mean luminance is `key`, but for an error.

    The mean lies half-way, in stops, between the geometric mean, which bright parts hardly sway, and the arithmetic
    mean, which holes and shadows hardly sway. A black picture stays black.

    Args:
        light: (H, W, 3) linear Rec. 709.
        key: wanted mean, 0 to 1.
        exposure_ev: error of the exposure, in stops.

    Returns:
        (H, W, 3) exposed light.
    """
    metered = slice(_METERED_STEP // 2, None, _METERED_STEP)
    seen = luminance(np.ascontiguousarray(light[metered, metered]))
    low, high = np.percentile(seen, _METERED_PART)
    if high <= 0.0:
        return light
    metered_light = np.clip(seen, max(low, high * 2.0**-_METERED_STOPS), high).astype(np.float64)
    mean = math.sqrt(math.exp(float(np.log(metered_light).mean())) * float(metered_light.mean()))
    return light * np.float32(key / mean * 2.0**exposure_ev)


_LEAST_LIT = 0.05
"""Least light of a channel for the white balance, as a share of the strongest channel's: a candle has hardly any blue,
and a gain of ten or more would amplify noise alone."""


def balance(light: Light, error: tuple[float, float], lit_by: NDArray[np.float64] = NEUTRAL) -> Light:
    """Remove most of the colour of the scene's light, with an error. A grey object keeps its luminance.

    Args:
        light: (H, W, 3) linear Rec. 709.
        error: gains of red and blue.
        lit_by: (3,) linear Rec. 709, colour of the scene's light.

    Returns:
        (H, W, 3) balanced light.
    """
    lit_by = np.maximum(lit_by, _LEAST_LIT * lit_by.max())
    left = lit_by ** (1.0 - ADAPTED) * [error[0], 1.0, error[1]]
    gains = left / lit_by * (REC709_LUMINANCE @ lit_by) / (REC709_LUMINANCE @ left)
    balanced: Light = light * gains.astype(np.float32)
    return balanced


def vignette(light: Light, lost: float) -> Light:
    """Darken a picture towards its corners by cos^4 of the angle at which light meets the sensor, like a simple lens.

    Args:
        light: (H, W, 3) linear Rec. 709.
        lost: share of the light that the corners lose, 0 to 1, which sets the angle there.

    Returns:
        (H, W, 3) light.
    """
    if lost == 0.0:
        return light
    corner = 1.0 / math.sqrt(max(1.0 - lost, 1e-4)) - 1.0  # tan^2 of the angle at the corners
    rows, columns = light.shape[:2]
    down, right = (
        np.float32(corner * (edge**2 / (rows**2 + columns**2)))
        * ((2 * np.arange(edge, dtype=np.float32) + 1) / edge - 1) ** 2
        for edge in (rows, columns)
    )
    left = 1.0 / (1.0 + down[:, None] + right[None, :]) ** 2
    return light * left[:, :, None]


def bleed(light: Light) -> Light:
    """Add a share of the brightest channel's light above 1 to all channels of (H, W, 3): a sensor's filters overlap.

    A strongly coloured light becomes paler the brighter it is, and finally white.
    """
    over = np.maximum(cv2.max(cv2.max(light[..., 0], light[..., 1]), light[..., 2]) - 1.0, 0.0)
    return light + np.float32(OVERLAP) * over[:, :, None]


def add_noise(light: Light, full_well: float, read_noise: float, rng: np.random.Generator) -> Light:
    """Add shot noise and read noise, whose variance at light x is x / full_well + (read_noise / full_well)^2.

    Args:
        light: (H, W, 3) linear Rec. 709, 0 or more; 1 fills the wells.
        full_well: electrons of a full well; 0 adds no noise.
        read_noise: standard deviation of the read noise, in electrons.
        rng: random generator of the noise.

    Returns:
        (H, W, 3) light, 0 or more; without noise it is the light itself.
    """
    if full_well == 0.0:
        return light
    grains = rng.standard_normal(light.shape, np.float32)
    kernel = np.array([CORRELATION, 1.0, CORRELATION]) / math.sqrt(1.0 + 2 * CORRELATION**2)
    grains = cv2.sepFilter2D(grains, -1, kernel, kernel, borderType=cv2.BORDER_REFLECT_101).astype(
        np.float32, copy=False
    )
    variance = light * np.float32(1 / full_well)
    variance += np.float32((read_noise / full_well) ** 2)
    grains *= np.sqrt(variance, out=variance)
    grains += light
    noisy: Light = np.maximum(grains, 0.0, out=grains)
    return noisy


def tone(light: Light, contrast: float) -> Levels:
    """Turn light (..., 3) into levels by the tone curve, from a table; see `curve`."""
    # The table's steps are even in the square root of light, so they are fine in the dark, as eyes are.
    table = curve(MOST_LIGHT * np.linspace(0.0, 1.0, _TABLE_STEPS + 1) ** 2, contrast).astype(np.float32)
    step = np.sqrt(np.clip(light, 0.0, MOST_LIGHT) * np.float32(1 / MOST_LIGHT)) * np.float32(_TABLE_STEPS)
    levels: Levels = table[np.rint(step, out=step).astype(np.int32)]
    return levels


def curve(light: NDArray[np.float64], contrast: float) -> NDArray[np.float64]:
    """Compute the tone curve: that of sRGB with a soft shoulder, and over it an S about mid-grey.

    Args:
        light: linear light of any shape, 0 or more.
        contrast: slope of the S at mid-grey; 1 leaves the levels as they are.

    Returns:
        sRGB levels, 0 to 1, in the shape of the light.
    """
    above = np.maximum(light - SHOULDER, 0.0) / (1.0 - SHOULDER)
    rolled = np.minimum(light, SHOULDER) + (1.0 - SHOULDER) * (1.0 - np.exp(-above))
    level, middle = srgb_of_light(rolled), float(srgb_of_light(np.array(MID_GREY)))
    dark, bright = np.minimum(level / middle, 1.0), np.minimum((1.0 - level) / (1.0 - middle), 1.0)
    curved: NDArray[np.float64] = np.where(
        level < middle, middle * dark**contrast, 1.0 - (1.0 - middle) * bright**contrast
    )
    return curved


def saturate(levels: Levels, saturation: float) -> Levels:
    """Multiply the distance of levels (H, W, 3) from the grey of the same luminance by `saturation`."""
    if saturation == 1.0:
        return levels
    grey = luminance(levels)[:, :, None]
    return grey + np.float32(saturation) * (levels - grey)


def sharpen(levels: Levels, amount: float) -> Levels:
    """Sharpen levels (H, W, 3) by an unsharp mask on their luminance, with the strength `amount`; 0 changes nothing."""
    if amount == 0.0:
        return levels
    grey = luminance(levels)
    detail = grey - cv2.GaussianBlur(grey, (0, 0), SHARPENED_PX)
    return levels + np.float32(amount) * detail[:, :, None]


def quantize(levels: Levels) -> NDArray[np.uint8]:
    """Round levels from 0 to 1, of any shape, to 8 bits, clipped."""
    scaled = np.clip(levels, 0.0, 1.0)
    scaled *= np.float32(255.0)
    eight: NDArray[np.uint8] = np.rint(scaled, out=scaled).astype(np.uint8)
    return eight


def compress(picture: NDArray[np.uint8], quality: int) -> NDArray[np.uint8]:
    """Compress a picture by JPEG, with colours at half the resolution, and decode it.

    Args:
        picture: (H, W, 3) uint8 sRGB.
        quality: JPEG quality, 1 to 100; from `UNCOMPRESSED_FROM` on the picture stays as it is.

    Returns:
        (H, W, 3) uint8 sRGB.

    Raises:
        RenderError: if OpenCV can't compress the picture.
    """
    if quality >= UNCOMPRESSED_FROM:
        return picture
    options = [
        cv2.IMWRITE_JPEG_QUALITY,
        quality,
        cv2.IMWRITE_JPEG_SAMPLING_FACTOR,
        cv2.IMWRITE_JPEG_SAMPLING_FACTOR_420,
    ]
    done, packed = cv2.imencode(".jpg", cv2.cvtColor(picture, cv2.COLOR_RGB2BGR), options)
    if not done:
        raise RenderError("OpenCV failed to compress a picture")
    unpacked = cv2.imdecode(packed, cv2.IMREAD_COLOR)
    return cv2.cvtColor(unpacked, cv2.COLOR_BGR2RGB).astype(np.uint8, copy=False)
