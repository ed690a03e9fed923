"""The colour of the light that a scene is lit by, as a camera's white balance finds it. Pure numpy."""

import math

import numpy as np
from numpy.typing import NDArray

from farm.scene.light import GreyWorld, Lamp, StudioLamp
from worker.camera.black_body import black_body

NEUTRAL = np.ones(3)


def illuminant(lamps: tuple[Lamp, ...], grey: GreyWorld | None) -> NDArray[np.float64]:
    """The colour of the light on the floor, (3,) linear Rec. 709; of lamps and worlds that have no colour, neutral.

    Args:
        lamps: of the scene.
        grey: what is around them.
    """
    light = np.zeros(3)
    for lamp in lamps:
        if isinstance(lamp, StudioLamp):
            on_floor = lamp.irradiance_w_m2 * math.sin(math.radians(lamp.elevation_deg))
            light += on_floor * black_body(lamp.temperature_k)
    if grey is not None:
        light += math.pi * grey.radiance * black_body(grey.temperature_k)
    return light if light.all() else NEUTRAL
