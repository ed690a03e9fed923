"""Paints sheaths as images around and along a cable. Numpy, OpenCV and Pillow."""

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
"""Texels for each pixel of the picture along an edge, where the cable faces the camera."""

_FINEST_M = 0.00005
"""Smallest edge of a texel, in metres."""

_FEWEST_ROWS, _MOST_ROWS = 16, 256
"""Smallest and largest number of an image's rows."""

_MOST_COLUMNS = 4096
"""Largest number of an image's columns."""

_HAZE = 0.45
"""Haze of clear plastic, 0 to 1: a line of sight crosses more plastic towards the cable's sides."""

_UNEVEN_SHOWS = 0.5
"""Roughness above which a plain sheath has no relief, as it would not show."""


@dataclass(frozen=True, slots=True)
class SkinImages:
    """The images of a sheath: rows around the cable, the last of which meets the first, and columns along it.

    Attributes:
        colour: (H, W, 3) uint8 sRGB.
        roughness: (H, W) uint8, 255 for a roughness of 1.
        normal: (H, W, 3) uint8, tangent space in OpenGL's convention: red along the cable, green around it in the
            direction of the texture coordinate, which is up in the image; None if the sheath is smooth.
        metallic: metalness, 0 to 1.
        coat: weight of a clear glossy layer over the sheath, 0 to 1.
        coat_roughness: roughness of that layer, 0 to 1.
        haze: weight of a milky film that shows where the line of sight grazes the surface, 0 to 1.
    """

    colour: NDArray[np.uint8]
    roughness: NDArray[np.uint8]
    normal: NDArray[np.uint8] | None
    metallic: float
    coat: float
    coat_roughness: float
    haze: float = 0.0


def draw_skin(skin: Skin, length_m: float, diameter_m: float, pixel_m: float) -> SkinImages:
    """Paint a sheath.

    The same skin and sizes give the same images.

    Args:
        skin: look of the sheath.
        length_m: length of the cable, in metres.
        diameter_m: diameter of the cable, in metres.
        pixel_m: edge of a picture's pixel on the floor, in metres, which decides how fine the images are.
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
    """Make a canvas whose number of rows is a multiple of 8, so that fields of many sizes close around it."""
    rows = int(np.clip(8 * np.ceil(around_m / texel_m / 8), _FEWEST_ROWS, _MOST_ROWS))
    columns = int(np.clip(np.ceil(length_m / texel_m), 64, _MOST_COLUMNS))
    return Canvas(
        length_m=length_m,
        around_m=around_m,
        colour=np.empty((3, rows, columns), np.float32),
        roughness=np.empty((rows, columns), np.float32),
    )


def _bytes(values: Field) -> NDArray[np.uint8]:
    # OpenCV rounds, and clips at 255.
    return np.asarray(cv2.convertScaleAbs(np.maximum(values, 0.0), alpha=255.0), np.uint8)


def _normals(height_m: Field, texel_m: tuple[float, float]) -> NDArray[np.uint8]:
    """Make the normal map of a relief (rows, columns) in metres, whose last row meets the first."""
    along = np.gradient(height_m, axis=1) / np.float32(texel_m[1])
    around = (np.roll(height_m, 1, axis=0) - np.roll(height_m, -1, axis=0)) / np.float32(2 * texel_m[0])
    up = np.float32(0.5) / np.sqrt(1.0 + along * along + around * around)
    return _merged(_bytes(0.5 - along * up), _bytes(0.5 - around * up), _bytes(0.5 + up))


def _merged(*planes: NDArray[np.uint8]) -> NDArray[np.uint8]:
    return cv2.merge(planes).astype(np.uint8, copy=False)
