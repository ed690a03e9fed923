"""The colour of a scene's light, which a camera's white balance removes. Pure numpy."""

import math

import numpy as np
from numpy.typing import NDArray

from farm.scene.light import GreyWorld, Lamp, StudioLamp
from worker.camera.black_body import black_body

NEUTRAL = np.ones(3)
"""Colour of neutral light, (3,) linear Rec. 709."""


def illuminant(lamps: tuple[Lamp, ...], grey: GreyWorld | None) -> NDArray[np.float64]:
    """Compute the colour of the light on the floor.

    Args:
        lamps: lamps of the scene; only studio lamps have a colour.
        grey: light around the lamps, if it has a colour.

    Returns:
        (3,) linear Rec. 709; neutral if neither the lamps nor the light around them have a colour.
    """
    light = np.zeros(3)
    for lamp in lamps:
        if isinstance(lamp, StudioLamp):
            on_floor = lamp.irradiance_w_m2 * math.sin(math.radians(lamp.elevation_deg))
            light += on_floor * black_body(lamp.temperature_k)
    if grey is not None:
        light += math.pi * grey.radiance * black_body(grey.temperature_k)
    return light if light.all() else NEUTRAL
