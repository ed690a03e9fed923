"""Paints stripes of a second colour along a cable, and text on it. Numpy, OpenCV and Pillow."""

from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from farm.scene.cable import Marking, Stripe, StripeKind
from worker.cable.canvas import Canvas, pigment
from worker.noise import Field, highest_share, wrapped_noise

_OVERSAMPLED = 4
"""Pixels along an edge, for each texel, at which text is drawn before it is averaged."""

_TOP = 0.25
"""Texture coordinate around a cable, 0 to 1, of its upper side; see `worker.cable.tube.sweep`."""

_TRACKING = 0.06
"""Extra space between two letters, as a share of their height: ink-jet printing is spaced wide."""


def paint_stripe(canvas: Canvas, stripe: Stripe, rng: np.random.Generator) -> None:
    """Paint stripes side by side around the cable, which all turn in step; their edges are a little uneven.

    Args:
        canvas: canvas of the cable, changed in place.
        stripe: colour and course of the stripes.
        rng: random generator of the skin.
    """
    rows_m, columns_m = canvas.texel_m
    turned = rng.choice([-1.0, 1.0]) * canvas.along_m / stripe.pitch_m
    if stripe.kind is StripeKind.STRAIGHT:
        turned = turned + 0.03 * wrapped_noise(rng, (1, canvas.shape[1]), canvas.cells(1.0, 0.06))
    place = stripe.count * (canvas.around - turned.astype(np.float32) + np.float32(rng.random()))
    off = np.abs(place - np.floor(place) - 0.5) / stripe.count
    half = 0.5 * stripe.share / stripe.count
    least_gap = min(half, 0.5 / stripe.count - half)
    uneven = min(0.007, 0.12 * least_gap) * wrapped_noise(rng, canvas.shape, canvas.cells(canvas.around_m / 2, 0.0022))
    blur = np.hypot(rows_m / canvas.around_m, columns_m / stripe.pitch_m)
    inside = np.clip((half + uneven - off) / np.float32(blur) + 0.5, 0.0, 1.0).astype(np.float32)
    if stripe.share >= 1.0:
        inside[:] = 1.0
    mottle = 1.0 + 0.02 * wrapped_noise(rng, canvas.shape, canvas.cells(0.002, 0.006))
    canvas.blend(inside, pigment(stripe.colour) * mottle)
    canvas.roughness += 0.04 * inside


def print_marking(canvas: Canvas, marking: Marking, rng: np.random.Generator) -> None:
    """Print a text along the cable again and again, each time a little to one side, and slightly worn.

    Args:
        canvas: canvas of the cable, changed in place.
        marking: text, its colour and its size.
        rng: random generator of the skin.
    """
    rows, columns = canvas.shape
    rows_m, columns_m = canvas.texel_m
    letters_m = marking.height_share * canvas.around_m / np.pi
    high, wide = letters_m / rows_m, letters_m / columns_m
    text = _fitted(marking.text, high, wide)
    if rng.random() < 0.5:
        text = text[::-1, ::-1]
    step = max(marking.repeat_m / columns_m, 1.15 * text.shape[1])
    ink = np.zeros((3 * rows, columns), np.float32)
    # The cable's own twist turns the line of text slowly around it. Texts start near the top, where most are seen.
    around, twist = rng.normal(_TOP, 0.1), rng.normal(0.0, 0.6) * columns_m
    start = -rng.random() * step
    while start < columns:
        middle = (1.0 - around - twist * (start + 0.5 * text.shape[1] - 0.5 * columns)) % 1.0
        top = round(rows + middle * rows - 0.5 * text.shape[0] + rng.normal(0.0, 0.03) * high)
        _stamp(ink, text, max(0, min(top, 3 * rows - text.shape[0])), round(start))
        start += step
    closed = ink.reshape(3, rows, columns).max(axis=0)
    rubbed = highest_share(wrapped_noise(rng, canvas.shape, canvas.cells(0.0009, 0.0022)), 0.12, 1.0)
    printed = closed * (0.93 - 0.55 * rubbed)
    canvas.blend(printed, pigment(marking.colour))
    canvas.blend_roughness(0.6 * printed, 0.5)


def _stamp(ink: Field, text: Field, top: int, left: int) -> None:
    """Put the part of a text that lies within the ink's columns into the ink, in place."""
    begin, end = max(0, left), min(ink.shape[1], left + text.shape[1])
    if begin < end:
        ink[top : top + text.shape[0], begin:end] = text[:, begin - left : end - left]


def _fitted(text: str, high: float, wide: float) -> Field:
    """Draw a text, 0 to 1, whose capitals are `high` rows high; the same length along the cable is `wide` columns."""
    drawn = _drawn(text, max(8, round(_OVERSAMPLED * high)))
    capitals = max(8, round(_OVERSAMPLED * high))
    size = max(1, round(drawn.shape[1] * wide / capitals)), max(1, round(drawn.shape[0] * high / capitals))
    return (cv2.resize(drawn, size, interpolation=cv2.INTER_AREA) / 255.0).astype(np.float32)


@lru_cache(maxsize=64)
def _drawn(text: str, capitals_px: int) -> NDArray[np.uint8]:
    """Draw a text in Pillow's own font, with capitals of the given height, without margins above and below the ink."""
    font = ImageFont.load_default(size=capitals_px / 0.71)
    spread = _TRACKING * capitals_px
    lefts = np.cumsum([0.0, *(font.getlength(letter) + spread for letter in text)])
    image = Image.new("L", (max(1, round(lefts[-1])), 2 * capitals_px), 0)
    pen = ImageDraw.Draw(image)
    for letter, left in zip(text, lefts, strict=False):
        pen.text((left, 1.5 * capitals_px), letter, fill=255, font=font, anchor="ls")
    pixels = np.array(image, np.uint8)
    inked = np.flatnonzero(pixels.any(axis=1))
    cut = pixels[inked[0] : inked[-1] + 1] if len(inked) else pixels[:1]
    cut.setflags(write=False)  # calls share it
    return cut
