"""The curve of sRGB and the luminance of light, against the standards' own numbers."""

import numpy as np
import pytest

from assets.colour import LIGHT_OF_LEVEL, REC709_LUMINANCE, light_of_srgb, srgb_of_light


@pytest.mark.parametrize(("value", "light"), [(0.0, 0.0), (0.04045, 0.0031308), (0.5, 0.2140411), (1.0, 1.0)])
def test_light_of_a_value(value: float, light: float) -> None:
    """The ends, the foot of the straight part, and the middle (IEC 61966-2-1)."""
    assert light_of_srgb(value) == pytest.approx(light, abs=1e-7)


def test_the_two_ways_undo_each_other() -> None:
    """From every 8-bit level to light and back."""
    levels = np.arange(256) / 255.0
    light = np.array([light_of_srgb(level) for level in levels.tolist()])
    np.testing.assert_allclose(srgb_of_light(light), levels, atol=1e-7)


def test_the_table_has_the_light_of_each_level() -> None:
    """In the precision of pictures, and never to be changed by those who share it."""
    assert LIGHT_OF_LEVEL.tolist() == [float(np.float32(light_of_srgb(level / 255.0))) for level in range(256)]
    assert not LIGHT_OF_LEVEL.flags.writeable


def test_white_has_a_luminance_of_one() -> None:
    """The weights add up."""
    assert REC709_LUMINANCE.sum() == pytest.approx(1.0)
