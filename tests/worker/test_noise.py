"""Random fields: of the deviation and the grain asked for, closed around a cable, the same from the same generator."""

import numpy as np
import pytest

from worker.noise import (
    highest_share,
    rough_noise,
    rough_wrapped_noise,
    smooth_noise,
    smooth_step,
    wrapped_noise,
)

SHAPE = (64, 1500)


def test_smooth_noise_has_mean_zero_and_deviation_one() -> None:
    """About: it is a finite field."""
    field = smooth_noise(np.random.default_rng(0), 400, 600, (8.0, 8.0))
    assert field.mean() == pytest.approx(0.0, abs=0.1)
    assert field.std() == pytest.approx(1.0, abs=0.15)


def test_grain_is_how_far_noise_stays_alike() -> None:
    """Ten times as long across as down: half a grain away it is alike, two grains away it is not."""
    field = smooth_noise(np.random.default_rng(0), 600, 3000, (10.0, 100.0))
    alike = [float(np.corrcoef(field[:, :-step].ravel(), field[:, step:].ravel())[0, 1]) for step in (50, 200)]
    assert alike[0] > 0.5
    assert abs(alike[1]) < 0.2
    assert abs(np.corrcoef(field[:-50].ravel(), field[50:].ravel())[0, 1]) < 0.2


def test_rough_noise_is_finer_than_its_coarsest_grain() -> None:
    """Neighbours differ more than in the smooth one."""
    fine, coarse = (rough_noise(np.random.default_rng(0), 256, 256, 32.0, octaves) for octaves in (5, 1))
    assert np.abs(np.diff(fine)).mean() > 2 * np.abs(np.diff(coarse)).mean()


def test_a_smooth_step_goes_from_nothing_to_all() -> None:
    """Half way it is a half."""
    steps = smooth_step(np.array([[0.0, 1.0, 2.0, 3.0, 4.0]], np.float32), 1.0, 3.0)
    assert steps[0].tolist() == [0.0, 0.0, 0.5, 1.0, 1.0]


@pytest.mark.parametrize("cell", [(1.0, 1.0), (4.0, 10.0), (16.0, 60.0)])
def test_a_field_varies_by_about_one(cell: tuple[float, float]) -> None:
    """Mean about 0, standard deviation about 1."""
    values = wrapped_noise(np.random.default_rng(0), SHAPE, cell)
    assert values.shape == SHAPE
    assert abs(values.mean()) < 0.25
    assert 0.6 < values.std() < 1.4


@pytest.mark.parametrize("cell", [(8.0, 30.0), (32.0, 100.0)])
def test_a_field_closes_around_the_cable(cell: tuple[float, float]) -> None:
    """The step over the seam is as small as any other."""
    values = wrapped_noise(np.random.default_rng(1), SHAPE, cell)
    steps = np.abs(np.roll(values, -1, axis=0) - values).max(axis=1)
    assert steps[-1] <= 1.05 * steps[:-1].max()
    assert steps.max() < 1.2


def test_one_cell_around_is_the_same_all_around() -> None:
    """As what varies along the cable alone."""
    values = wrapped_noise(np.random.default_rng(2), SHAPE, (64.0, 50.0))
    assert np.ptp(values, axis=0).max() < 1e-5


def test_fields_come_from_their_generator() -> None:
    """The same seed gives the same, another gives another."""
    one, again, other = (rough_wrapped_noise(np.random.default_rng(seed), SHAPE, (8.0, 20.0)) for seed in (3, 3, 4))
    assert (one == again).all()
    assert (one != other).any()


@pytest.mark.parametrize("share", [0.0, 0.1, 0.5, 1.0])
def test_patches_have_their_share(share: float) -> None:
    """Of the places, half a patch or more is the share, within 3 %."""
    values = rough_wrapped_noise(np.random.default_rng(5), SHAPE, (8.0, 20.0))
    assert np.mean(highest_share(values, share, 0.2) > 0.5) == pytest.approx(share, abs=0.03)
