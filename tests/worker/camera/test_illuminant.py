"""The colour of a scene's light."""

import numpy as np
import pytest

from farm.scene.light import GreyWorld, PointLamp, StudioLamp
from worker.camera.black_body import black_body
from worker.camera.illuminant import illuminant

LAMP = StudioLamp(bearing_deg=0, elevation_deg=30, distance_m=1, irradiance_w_m2=2.0, size_m=0.1, temperature_k=3000)


def test_a_lamp_counts_by_what_it_gives_the_floor() -> None:
    """Half of a lamp's irradiance counts at 30 degrees, and pi times the radiance of a grey world."""
    found = illuminant((LAMP, LAMP), GreyWorld(radiance=0.5, temperature_k=8000))
    assert found == pytest.approx(2 * 1.0 * black_body(3000) + np.pi * 0.5 * black_body(8000))


def test_lamps_without_a_colour_are_neutral() -> None:
    """The published lamps and an HDRI have no colour and count as neutral."""
    point = PointLamp(bearing_deg=0, radius_m=5, height_m=5, power_w=1000, size_m=0.5)
    assert (illuminant((point,), None) == 1.0).all()
    assert (illuminant((), None) == 1.0).all()
