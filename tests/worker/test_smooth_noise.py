"""Noise has the deviation and the grain that was asked for."""

import numpy as np
import pytest

from worker.noise import rough_noise, smooth_noise, smooth_step


def test_smooth_noise_has_mean_zero_and_deviation_one() -> None:
    """A finite field has about mean 0 and deviation 1."""
    field = smooth_noise(np.random.default_rng(0), 400, 600, (8.0, 8.0))
    assert field.mean() == pytest.approx(0.0, abs=0.1)
    assert field.std() == pytest.approx(1.0, abs=0.15)


def test_grain_is_how_far_noise_stays_alike() -> None:
    """With ten times the grain across as down, noise is alike half a grain away, and not two grains away."""
    field = smooth_noise(np.random.default_rng(0), 600, 3000, (10.0, 100.0))
    alike = [float(np.corrcoef(field[:, :-step].ravel(), field[:, step:].ravel())[0, 1]) for step in (50, 200)]
    assert alike[0] > 0.5
    assert abs(alike[1]) < 0.2
    assert abs(np.corrcoef(field[:-50].ravel(), field[50:].ravel())[0, 1]) < 0.2


def test_rough_noise_is_finer_than_its_coarsest_grain() -> None:
    """Neighbours differ more in rough noise than in smooth noise."""
    fine, coarse = (rough_noise(np.random.default_rng(0), 256, 256, 32.0, octaves) for octaves in (5, 1))
    assert np.abs(np.diff(fine)).mean() > 2 * np.abs(np.diff(coarse)).mean()


def test_a_smooth_step_goes_from_nothing_to_all() -> None:
    """Half way the step is a half."""
    steps = smooth_step(np.array([[0.0, 1.0, 2.0, 3.0, 4.0]], np.float32), 1.0, 3.0)
    assert steps[0].tolist() == [0.0, 0.0, 0.5, 1.0, 1.0]
