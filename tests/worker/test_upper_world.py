"""What is left of an HDRI that only lights a floor."""

import numpy as np
import pytest

from worker.upper_world import BELOW, directions, upper_world

UPRIGHT = np.eye(3)
QUARTER_TURN = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""About the x axis, as the published tilt of 90 degrees."""


def test_below_the_horizon_it_is_black_and_above_unchanged() -> None:
    """An even panorama keeps its upper half, and 2 degrees more."""
    lit = upper_world(np.ones((90, 180, 3), np.float32), UPRIGHT)
    height = directions(90, 180)[..., 2]
    assert (lit[height > -BELOW] == 1.0).all()
    assert (lit[height < -BELOW] == 0.0).all()


def test_it_turns_with_the_panorama() -> None:
    """Tilted by 90 degrees, what the world's zenith shows is the panorama's direction that the turn takes it to."""
    lit = upper_world(np.ones((90, 180, 3), np.float32), QUARTER_TURN)
    toward = directions(90, 180) @ (QUARTER_TURN @ [0.0, 0.0, 1.0])
    assert (lit[toward > 0.1] == 1.0).all()
    assert (lit[toward < -0.1] == 0.0).all()


def test_a_large_panorama_is_reduced_and_keeps_its_light() -> None:
    """From 2048 to 512 texels, the mean light above the horizon stays."""
    panorama = np.random.default_rng(0).exponential(1.0, (1024, 2048, 3)).astype(np.float32)
    panorama[512:] = 0.0
    lit = upper_world(panorama, UPRIGHT)
    assert lit.shape == (256, 512, 3)
    assert lit.mean() == pytest.approx(panorama.mean(), rel=1e-4)


def test_directions_are_unit_vectors_with_the_zenith_first() -> None:
    """The first row looks up, the middle column along x, and what is right of it towards -y."""
    towards = directions(64, 128)
    assert np.linalg.norm(towards, axis=-1) == pytest.approx(np.ones((64, 128)))
    assert towards[0, :, 2].min() > 0.99
    assert towards[32, 64, 0] > 0.99
    assert towards[32, 70, 1] < 0.0
