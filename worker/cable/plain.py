"""Paints surfaces of one colour in the same way as skins: copper, tin, and the plastic of ties and collars."""

import numpy as np

from worker.cable.canvas import pigment
from worker.cable.piece import Plain, Substance
from worker.cable.skin import SkinImages
from worker.noise import rough_wrapped_noise, wrapped_noise

_SHAPE = (32, 256)
"""Rows and columns of the images."""


def draw_plain(surface: Plain) -> SkinImages:
    """Paint a surface; the same substance and colour give the same images."""
    rng = np.random.default_rng(sum(level << 8 * place for place, level in enumerate(surface.colour)))
    mottle = rough_wrapped_noise(rng, _SHAPE, (8, 8), 3)
    if surface.substance is Substance.PLASTIC:
        colour = pigment(surface.colour) * (1.0 + 0.03 * mottle)
        roughness, metallic = 0.42 + 0.04 * mottle, 0.0
    else:
        streaks = wrapped_noise(rng, _SHAPE, (1, 32))
        metal = np.array(surface.colour, np.float32).reshape(3, 1, 1) / 255.0
        colour = metal * (1.0 + 0.07 * mottle + 0.05 * streaks)
        roughness, metallic = 0.30 + 0.05 * mottle + 0.04 * streaks, 1.0
    return SkinImages(
        colour=np.clip(255 * np.moveaxis(colour, 0, 2) + 0.5, 0, 255).astype(np.uint8),
        roughness=np.clip(255 * roughness + 0.5, 0, 255).astype(np.uint8),
        normal=None,
        metallic=metallic,
        coat=0.0,
        coat_roughness=0.1,
    )
