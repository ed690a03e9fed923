"""The camera's aperture."""

import pytest

from farm.scene.camera import Camera
from worker.camera.lens import lens_radius_m


def test_the_aperture_is_the_focal_length_over_the_f_number_wide() -> None:
    """50 mm at f/4 opens 12.5 mm."""
    assert 2 * lens_radius_m(Camera(height_m=0.2, focal_length_mm=50.0, f_number=4.0)) == pytest.approx(0.0125)
