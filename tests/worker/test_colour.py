"""Pictures between levels and light."""

import numpy as np
import pytest

from worker.colour import levels_of, light_of, luminance


@pytest.mark.parametrize("shape", [(256, 1), (16, 16, 1), (4, 64)])
def test_levels_come_back_from_their_light(shape: tuple[int, ...]) -> None:
    """All 256, in arrays of any shape."""
    levels = np.arange(256, dtype=np.uint8).reshape(shape)
    assert (levels_of(light_of(levels)) == levels).all()


def test_light_beyond_black_and_white_is_clipped() -> None:
    """To levels 0 and 255."""
    assert levels_of(np.array([[-1.0, 2.0]], np.float32)).tolist() == [[0, 255]]


def test_luminance_weighs_the_channels() -> None:
    """Green counts most, blue least."""
    red, green, blue = luminance(np.eye(3, dtype=np.float32))
    assert blue < red < green
