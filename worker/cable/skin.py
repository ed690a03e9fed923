"""Sheaths drawn as images around and along a cable. Numpy, OpenCV and Pillow."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from farm.scene.cable import Sheath, Skin
from worker.cable.canvas import Canvas
from worker.cable.paint import paint_stripe, print_marking
from worker.cable.sheath import draw_braid, draw_plain, draw_translucent
from worker.cable.soiling import soil, wear_down
from worker.noise import Field

_TEXELS_A_PIXEL = 1.2
"""Around a cable's middle, where it faces the camera."""

_FINEST_M = 0.00005
_FEWEST_ROWS, _MOST_ROWS = 16, 256
_MOST_COLUMNS = 4096

_HAZE = 0.45
"""Of clear plastic: one looks through more of it towards the sides."""

_UNEVEN_SHOWS = 0.5
"""Roughness below which the relief of a plain sheath is seen."""


@dataclass(frozen=True, slots=True)
class SkinImages:
    """A sheath's images: rows around the cable, which they close, columns from its start to its end.

    Attributes:
        colour: (H, W, 3) uint8 sRGB.
        roughness: (H, W) uint8, 255 for 1.
        normal: (H, W, 3) uint8, tangent space in OpenGL's convention: red along the cable, green around it as texture
            coordinates count, which is up in the image; None if it is smooth.
        metallic: 0 to 1.
        coat: weight of a clear glossy layer over it, 0 to 1.
        coat_roughness: of that layer.
        haze: weight of a milky film that shows where one looks along the surface, 0 to 1.
    """

    colour: NDArray[np.uint8]
    roughness: NDArray[np.uint8]
    normal: NDArray[np.uint8] | None
    metallic: float
    coat: float
    coat_roughness: float
    haze: float = 0.0


def draw_skin(skin: Skin, length_m: float, diameter_m: float, pixel_m: float) -> SkinImages:
    """Draw a sheath.

    The same skin, size and pixel give the same images.

    Args:
        skin: what it looks like.
        length_m: of the cable.
        diameter_m: of it.
        pixel_m: edge of a picture's pixel on the floor, which decides how fine the images are.
    """
    rng = np.random.default_rng(skin.pattern_seed)
    canvas = _blank(length_m, np.pi * diameter_m, max(pixel_m / _TEXELS_A_PIXEL, _FINEST_M))
    match skin.sheath:
        case Sheath.PLAIN:
            draw_plain(canvas, skin, rng)
        case Sheath.TRANSLUCENT:
            draw_translucent(canvas, skin, rng)
        case Sheath.BRAIDED:
            draw_braid(canvas, skin, rng)
    if skin.stripe is not None and skin.sheath is not Sheath.BRAIDED:
        paint_stripe(canvas, skin.stripe, rng)
    if skin.marking is not None and skin.sheath is not Sheath.BRAIDED:
        print_marking(canvas, skin.marking, rng)
    wear_down(canvas, skin.wear, rng)
    soil(canvas, skin.dirt, rng)
    if skin.sheath is Sheath.PLAIN and skin.roughness > _UNEVEN_SHOWS:
        canvas.height_m = None
    return SkinImages(
        colour=_merged(*(_bytes(plane) for plane in canvas.colour)),
        roughness=_bytes(canvas.roughness),
        normal=None if canvas.height_m is None else _normals(canvas.height_m, canvas.texel_m),
        metallic=canvas.metallic,
        coat=canvas.coat,
        coat_roughness=float(np.clip(skin.roughness, 0.03, 0.5)),
        haze=_HAZE * canvas.coat,
    )


def _blank(length_m: float, around_m: float, texel_m: float) -> Canvas:
    """A canvas whose rows are a multiple of 8, so that fields of many sizes close around it."""
    rows = int(np.clip(8 * np.ceil(around_m / texel_m / 8), _FEWEST_ROWS, _MOST_ROWS))
    columns = int(np.clip(np.ceil(length_m / texel_m), 64, _MOST_COLUMNS))
    return Canvas(
        length_m=length_m,
        around_m=around_m,
        colour=np.empty((3, rows, columns), np.float32),
        roughness=np.empty((rows, columns), np.float32),
    )


def _bytes(values: Field) -> NDArray[np.uint8]:
    # It rounds, and stops at 255.
    return np.asarray(cv2.convertScaleAbs(np.maximum(values, 0.0), alpha=255.0), np.uint8)


def _normals(height_m: Field, texel_m: tuple[float, float]) -> NDArray[np.uint8]:
    """Of a relief that closes around its rows, which run from the top of the image down."""
    along = np.gradient(height_m, axis=1) / np.float32(texel_m[1])
    around = (np.roll(height_m, 1, axis=0) - np.roll(height_m, -1, axis=0)) / np.float32(2 * texel_m[0])
    up = np.float32(0.5) / np.sqrt(1.0 + along * along + around * around)
    return _merged(_bytes(0.5 - along * up), _bytes(0.5 - around * up), _bytes(0.5 + up))


def _merged(*planes: NDArray[np.uint8]) -> NDArray[np.uint8]:
    return cv2.merge(planes).astype(np.uint8, copy=False)
