"""A rod clamped at one end that vibrates."""

import numpy as np
import pytest
from numpy.typing import NDArray

from benchmarks.physics.closed_forms import cantilever_frequency_rad_s
from tests.worker.simulate.physics.rods import WEIGHTLESS, angular_frequency_rad_s, line, rod
from worker.simulate.rod.simulation import RodSimulation

LENGTH_M = 0.2
FIRST_ROOT = 1.8751040687
"""First root b of cos(b) cosh(b) = -1."""


@pytest.mark.parametrize("segments", [20, 40])
def test_a_cantilever_vibrates_at_its_first_frequency(segments: int) -> None:
    """The frequency is 3.516 sqrt(EI / (rho A L^4)), less (wh)^2 / 3 for implicit Euler; n segments err by 1/n^2."""
    segment = LENGTH_M / (segments - 0.5)
    beam = rod(line((-segment / 2, 0, 1), (LENGTH_M, 0, 1), segments), modulus_pa=1e9, pinned=(0, 1))
    frequency = cantilever_frequency_rad_s(beam.bending_stiffness_n_m2, beam.mass_per_length_kg_m, LENGTH_M)
    steps_per_s = 4000
    simulation = RodSimulation([beam], WEIGHTLESS, steps_per_s=steps_per_s)
    simulation.set_velocities(0, np.outer(first_mode(beam.nodes_m[:, 0]), [0, 0, 0.01]))
    period_steps = 2 * np.pi / frequency * steps_per_s
    found = angular_frequency_rad_s(simulation, lambda nodes: float(nodes[-1, 2]) - 1, steps=round(2.3 * period_steps))
    assert found == pytest.approx(frequency, rel=(frequency / steps_per_s) ** 2 / 3 + 1 / segments**2)


def first_mode(distance_m: NDArray[np.float64]) -> NDArray[np.float64]:
    """The beam's shape as it vibrates, 2 at the tip."""
    b = FIRST_ROOT
    x = b * np.maximum(distance_m, 0) / LENGTH_M
    ratio = (np.cosh(b) + np.cos(b)) / (np.sinh(b) + np.sin(b))
    mode: NDArray[np.float64] = np.cosh(x) - np.cos(x) - ratio * (np.sinh(x) - np.sin(x))
    return mode
