"""Random fields: with the variation asked for, closed around the cable, and repeatable."""

import numpy as np
import pytest

from worker.noise import field, fractal, patches

SHAPE = (64, 1500)


@pytest.mark.parametrize("cell", [(1.0, 1.0), (4.0, 10.0), (16.0, 60.0)])
def test_a_field_varies_by_about_one(cell: tuple[float, float]) -> None:
    """The mean is about 0, and the standard deviation about 1."""
    values = field(np.random.default_rng(0), SHAPE, cell)
    assert values.shape == SHAPE
    assert abs(values.mean()) < 0.25
    assert 0.6 < values.std() < 1.4


@pytest.mark.parametrize("cell", [(8.0, 30.0), (32.0, 100.0)])
def test_a_field_closes_around_the_cable(cell: tuple[float, float]) -> None:
    """The step over the seam is as small as any other."""
    values = field(np.random.default_rng(1), SHAPE, cell)
    steps = np.abs(np.roll(values, -1, axis=0) - values).max(axis=1)
    assert steps[-1] <= 1.05 * steps[:-1].max()
    assert steps.max() < 1.2


def test_one_cell_around_is_the_same_all_around() -> None:
    """A field with one cell around varies along the cable alone."""
    values = field(np.random.default_rng(2), SHAPE, (64.0, 50.0))
    assert np.ptp(values, axis=0).max() < 1e-5


def test_fields_come_from_their_generator() -> None:
    """The same seed gives the same field, and another seed another one."""
    one, again, other = (fractal(np.random.default_rng(seed), SHAPE, (8.0, 20.0)) for seed in (3, 3, 4))
    assert (one == again).all()
    assert (one != other).any()


@pytest.mark.parametrize("share", [0.0, 0.1, 0.5, 1.0])
def test_patches_have_their_share(share: float) -> None:
    """The share of places with half a patch or more is the one asked for, within 3 %."""
    values = fractal(np.random.default_rng(5), SHAPE, (8.0, 20.0))
    assert np.mean(patches(values, share, 0.2) > 0.5) == pytest.approx(share, abs=0.03)
