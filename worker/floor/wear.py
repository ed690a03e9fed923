"""Applies a floor's wear to the texels that the camera sees. Numpy and OpenCV."""

import cv2
import numpy as np

from farm.scene.floor import Wear
from worker.colour import LUMINANCE_WEIGHTS, Texels, levels_of, light_of
from worker.floor.marks import Marks
from worker.noise import Field

STAIN_LEAVES = (0.58, 0.50, 0.40)
"""Share of red, green and blue light that the strongest stain leaves, on the rim of a puddle."""

DUST_COLOUR = (0.44, 0.40, 0.34)
"""Colour of house dust, linear Rec. 709."""

DUST_COVERS = 0.42
"""Share of the floor's colour that the densest dust hides."""

DUST_ROUGHNESS = 0.85
"""Roughness of dust, 0 to 1."""

FILL_ROUGHNESS = 0.9
"""Roughness of grout, sand and dirt, 0 to 1."""


def worn_colour(texels: Texels, wear: Wear, marks: Marks) -> Texels:
    """Apply wear and marks to a window's colour.

    Args:
        texels: (H, W, 3) sRGB levels, or (H, W) if they are grey.
        wear: brightness, tint, saturation, and contrast about the window's mean.
        marks: marks on the window, (H, W) each.

    Returns:
        (H, W, 3) sRGB levels.
    """
    coloured = texels if texels.ndim == 3 else np.repeat(texels[:, :, None], 3, axis=2)
    mean = light_of(coloured[::4, ::4]).mean(axis=(0, 1), dtype=np.float64)
    grey = LUMINANCE_WEIGHTS[None, :] * np.ones((3, 1))
    mix = wear.saturation * np.eye(3) + (1 - wear.saturation) * grey
    gain = wear.brightness * np.array(wear.tint)[:, None]
    # colour = gain * (mean + contrast * (mix light - mix mean)), one matrix with an offset.
    matrix = np.hstack([gain * wear.contrast * mix, gain * ((1 - wear.contrast) * mix @ mean)[:, None]])
    light: Field = cv2.transform(light_of(coloured), matrix.astype(np.float32)).astype(np.float32, copy=False)
    if marks.joint is not None and wear.joints is not None:
        for channel, albedo in enumerate(wear.joints.albedo):
            light[:, :, channel] += marks.joint * (np.float32(albedo) - light[:, :, channel])
    if marks.stain is not None:
        for channel, left in enumerate(STAIN_LEAVES):
            light[:, :, channel] *= 1 - np.float32(1 - left) * marks.stain
    if marks.scratch is not None:
        light *= (1 + 0.9 * marks.scratch)[:, :, None]
        light += (0.1 * np.maximum(marks.scratch, 0))[:, :, None]
    if marks.dust is not None:
        cover = np.float32(DUST_COVERS) * marks.dust
        for channel, dust in enumerate(DUST_COLOUR):
            light[:, :, channel] += cover * (np.float32(dust) - light[:, :, channel])
    return levels_of(light)


def worn_roughness(texels: Texels, marks: Marks) -> Texels:
    """Apply marks to a window's roughness: stains make it smoother; scratches, dust and filled joints make it rougher.

    Args:
        texels: (H, W) or (H, W, 3), 255 for a roughness of 1.
        marks: marks on the window, (H, W) each.

    Returns:
        (H, W) uint8, 255 for a roughness of 1.
    """
    rough = (texels if texels.ndim == 2 else texels[:, :, 0]).astype(np.float32)
    if marks.joint is not None:
        rough += marks.joint * (255 * np.float32(FILL_ROUGHNESS) - rough)
    if marks.stain is not None:
        rough *= 1 - 0.15 * marks.stain
    if marks.scratch is not None:
        rough += 60 * np.abs(marks.scratch)
    if marks.dust is not None:
        rough += marks.dust * (255 * np.float32(DUST_ROUGHNESS) - rough)
    return _rounded(rough)


def turned_over(texels: Texels, *, normal: bool) -> Texels:
    """Swap left and right of a tile's texels.

    Args:
        texels: (H, W) or (H, W, 3).
        normal: whether they are a normal map, whose slopes change their sign too.
    """
    turned = texels[:, ::-1]
    if normal and turned.ndim == 3:
        turned = turned.copy()
        turned[:, :, 0] = 255 - turned[:, :, 0]
    return turned


def _rounded(values: Field) -> Texels:
    texels: Texels = np.clip(values + np.float32(0.5), 0, 255).astype(np.uint8)
    return texels
