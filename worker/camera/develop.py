"""From light to the picture that a camera saves, step by step as a camera does it. Pure numpy and OpenCV.

Light is (H, H, 3), linear Rec. 709 in float32; 1 is what fills the sensor's wells. After the tone curve come levels,
which are sRGB between 0 and 1.
"""

import math

import cv2
import numpy as np
from numpy.typing import NDArray

from assets.colour import REC709_LUMINANCE, srgb_of_light
from farm.errors import RenderError
from farm.scene.camera import UNCOMPRESSED_FROM, Development
from worker.camera.distortion import Distortion
from worker.camera.illuminant import NEUTRAL
from worker.colour import luminance

MID_GREY = 0.18
"""Light of the grey that a photographer meters."""

ADAPTED = 0.75
"""How much of the light's colour a camera takes off, as an exponent; what is left tells a warm lamp from daylight."""

SHOULDER = 0.6
"""Light up to which the curve is sRGB's own; above, it bends and reaches white only at several times 1."""

MOST_LIGHT = 4.0
"""Beyond it all is white anyway; a firefly, or a lamp's reflection, brings no more than this to pixels near it."""

OVERLAP = 0.1
"""Share of what is beyond white in one channel that the others get."""

CORRELATION = 0.3
"""Weight of a pixel's neighbours in noise, as interpolating a Bayer mosaic leaves it."""

SHARPENED_PX = 1.0
"""Standard deviation of the Gaussian that the unsharp mask takes off."""

_FINITE = 1e30

_METERED_STEP = 4
"""Of so many pixels along a row and a column, one is metered."""

_METERED_PART = (2.0, 98.0)
"""Percentiles between which luminances count as they are; what is beyond counts as these."""

_METERED_STOPS = 8.0
"""Darker than the brightest that counts by more than this is black, and counts as if it were not."""

_TABLE_STEPS = 2**15

Light = NDArray[np.float32]
Levels = NDArray[np.float32]


def develop(
    light: Light, development: Development, *, distortion: float = 0.0, lit_by: NDArray[np.float64] = NEUTRAL
) -> NDArray[np.uint8]:
    """Develop a picture.

    Args:
        light: as rendered through a lens without distortion; not finite or negative is black.
        development: what the camera does with it.
        distortion: of its lens, see `farm.scene.camera.Camera`.
        lit_by: colour of the scene's light (3,), which its white balance is after.

    Returns:
        (H, H, 3) uint8 sRGB.

    Raises:
        RenderError: if OpenCV can't compress the picture.
    """
    light = expose(clean(light), development.key, development.exposure_ev)
    light = balance(light, development.white_balance, lit_by)
    light = np.minimum(bleed(vignette(light, development.vignetting)), np.float32(MOST_LIGHT))
    larger = development.chromatic_aberration
    light = Distortion(distortion).distort(light, (1.0 + larger, 1.0, 1.0 - larger))
    rng = np.random.default_rng(development.seed)
    light = add_noise(light, development.full_well, development.read_noise, rng)
    levels = saturate(tone(light, development.contrast), development.saturation)
    return compress(quantize(sharpen(levels, development.sharpening)), development.jpeg_quality)


def clean(light: Light) -> Light:
    """Light without negative numbers, infinity or NaN."""
    positive = np.fmax(light, 0.0)  # takes NaN for missing
    return np.minimum(positive, np.float32(_FINITE), out=positive)


def expose(light: Light, key: float, exposure_ev: float) -> Light:
    """Bring the mean of the luminance to `key`, but for an error in stops.

    The mean is half-way, in stops, between the geometric one, which what is bright hardly sways, and the arithmetic
    one, which holes and shadows hardly do. What is all black stays so.
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
"""Of the strongest channel: a candle has hardly any blue, and a gain of tens would be noise alone."""


def balance(light: Light, error: tuple[float, float], lit_by: NDArray[np.float64] = NEUTRAL) -> Light:
    """Take off most of the colour of the scene's light, and multiply red and blue by the error's gains.

    What is as grey as white paper in that light keeps its luminance.
    """
    lit_by = np.maximum(lit_by, _LEAST_LIT * lit_by.max())
    left = lit_by ** (1.0 - ADAPTED) * [error[0], 1.0, error[1]]
    gains = left / lit_by * (REC709_LUMINANCE @ lit_by) / (REC709_LUMINANCE @ left)
    balanced: Light = light * gains.astype(np.float32)
    return balanced


def vignette(light: Light, lost: float) -> Light:
    """Darken towards the corners by cos^4 of the angle at which light falls on the sensor, as in any simple lens.

    Args:
        light: of the picture.
        lost: share of it that the corners lose; it sets the angle.
    """
    if lost == 0.0:
        return light
    corner = 1.0 / math.sqrt(max(1.0 - lost, 1e-4)) - 1.0  # tan^2 of the angle there
    place = (2 * np.arange(len(light), dtype=np.float32) + 1) / len(light) - 1
    squared = np.float32(corner / 2) * place**2
    left = 1.0 / (1.0 + squared[:, None] + squared[None, :]) ** 2
    return light * left[:, :, None]


def bleed(light: Light) -> Light:
    """Let the colours of what is brighter than white run into each other, as dyes of a sensor's filters overlap.

    A strongly coloured light then comes out paler the brighter it is, and white at last.
    """
    over = np.maximum(cv2.max(cv2.max(light[..., 0], light[..., 1]), light[..., 2]) - 1.0, 0.0)
    return light + np.float32(OVERLAP) * over[:, :, None]


def add_noise(light: Light, full_well: float, read_noise: float, rng: np.random.Generator) -> Light:
    """Add shot and read noise: of light x the variance is x / full_well + (read_noise / full_well)^2.

    Args:
        light: 1 fills the wells; negative comes out as none.
        full_well: electrons of light 1; 0 is no noise.
        read_noise: electrons.
        rng: draws it.
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
    """Levels of light: sRGB's curve with a soft shoulder, and an S of slope `contrast` about mid-grey over it."""
    # Steps of the root: as fine in the dark as eyes are.
    table = curve(MOST_LIGHT * np.linspace(0.0, 1.0, _TABLE_STEPS + 1) ** 2, contrast).astype(np.float32)
    step = np.sqrt(np.clip(light, 0.0, MOST_LIGHT) * np.float32(1 / MOST_LIGHT)) * np.float32(_TABLE_STEPS)
    levels: Levels = table[np.rint(step, out=step).astype(np.int32)]
    return levels


def curve(light: NDArray[np.float64], contrast: float) -> NDArray[np.float64]:
    """The tone curve itself, of light of any shape."""
    above = np.maximum(light - SHOULDER, 0.0) / (1.0 - SHOULDER)
    rolled = np.minimum(light, SHOULDER) + (1.0 - SHOULDER) * (1.0 - np.exp(-above))
    level, middle = srgb_of_light(rolled), float(srgb_of_light(np.array(MID_GREY)))
    dark, bright = np.minimum(level / middle, 1.0), np.minimum((1.0 - level) / (1.0 - middle), 1.0)
    curved: NDArray[np.float64] = np.where(
        level < middle, middle * dark**contrast, 1.0 - (1.0 - middle) * bright**contrast
    )
    return curved


def saturate(levels: Levels, saturation: float) -> Levels:
    """Bring colours nearer to or farther from the grey that is as bright."""
    if saturation == 1.0:
        return levels
    grey = luminance(levels)[:, :, None]
    return grey + np.float32(saturation) * (levels - grey)


def sharpen(levels: Levels, amount: float) -> Levels:
    """Add `amount` of what a blur takes off the brightness."""
    if amount == 0.0:
        return levels
    grey = luminance(levels)
    detail = grey - cv2.GaussianBlur(grey, (0, 0), SHARPENED_PX)
    return levels + np.float32(amount) * detail[:, :, None]


def quantize(levels: Levels) -> NDArray[np.uint8]:
    """Levels of 0 to 1 in 8 bits, clipped."""
    scaled = np.clip(levels, 0.0, 1.0)
    scaled *= np.float32(255.0)
    eight: NDArray[np.uint8] = np.rint(scaled, out=scaled).astype(np.uint8)
    return eight


def compress(picture: NDArray[np.uint8], quality: int) -> NDArray[np.uint8]:
    """The picture (H, W, 3) after JPEG with colours at half the resolution; as it is from `UNCOMPRESSED_FROM` on.

    Raises:
        RenderError: if OpenCV can't compress it.
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
