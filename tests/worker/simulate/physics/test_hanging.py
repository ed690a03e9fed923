"""Flexible rods that hang: the catenary, and the hanging chain's first swing."""

import numpy as np
import pytest
from scipy.special import j0

from benchmarks.physics.closed_forms import catenary, hanging_chain_frequency_rad_s
from tests.worker.simulate.physics.rods import GRAVITY_M_S2, IN_THE_AIR, angular_frequency_rad_s, line, modulus_pa, rod
from worker.simulate.rod.model import Surroundings
from worker.simulate.rod.simulation import RodSimulation

LENGTH_M = 0.4
CATENARY_SLENDERNESS = 1e5


@pytest.mark.parametrize("segments", [40, 80])
@pytest.mark.parametrize("span_m", [0.3, 0.35])
def test_a_rod_between_two_points_hangs_as_a_catenary(span_m: float, segments: int) -> None:
    """The sag is c (cosh(D / 2c) - 1), L = 2c sinh(D / 2c), off by 1/n^2 for n links and (L/c)^3 / G for bending."""
    depth = np.sqrt(LENGTH_M**2 - span_m**2) / 2
    left = line((-span_m / 2, 0, 1), (0, 0, 1 - depth), segments // 2)
    right = line((0, 0, 1 - depth), (span_m / 2, 0, 1), segments // 2)
    hung = rod(np.concatenate([left, right[1:]]), modulus_pa=modulus_pa(CATENARY_SLENDERNESS, LENGTH_M), pinned=(0, -1))
    # Internal damping this strong ends the swinging, and doesn't change the resting shape.
    simulation = RodSimulation([hung], Surroundings(floor=False, damping_s=1.0), steps_per_s=500)
    assert simulation.settle(rms_m_s=5e-5, fastest_m_s=1e-4, quiet_s=0.05, max_time_s=20)
    sag = 1 - float(simulation.nodes_m(0)[:, 2].min())
    reference = catenary(span_m, LENGTH_M)
    bending = (LENGTH_M / reference.parameter_m) ** 3 / CATENARY_SLENDERNESS
    assert sag == pytest.approx(reference.sag_m, rel=1 / segments**2 + bending)


@pytest.mark.parametrize("steps_per_s", [500, 1000])
def test_a_hanging_chain_swings_at_its_first_frequency(steps_per_s: int) -> None:
    """The frequency is 1.2024 sqrt(g / L), less (wh)^2 / 3 for implicit Euler; n links are off by less than 1/n^2."""
    segments = 40
    chain = rod(line((0, 0, 1), (0, 0, 1 - LENGTH_M), segments), modulus_pa=modulus_pa(1e6, LENGTH_M), pinned=(0,))
    simulation = RodSimulation([chain], IN_THE_AIR, steps_per_s=steps_per_s)
    frequency = hanging_chain_frequency_rad_s(LENGTH_M, GRAVITY_M_S2)
    height = np.linspace(LENGTH_M, 0, segments + 1)
    velocity = np.zeros((segments + 1, 3))
    # The start is the first mode, so that no other one swings; the tip moves 2 mm.
    velocity[:, 0] = 0.01 * j0(2 * frequency * np.sqrt(height / GRAVITY_M_S2))
    simulation.set_velocities(0, velocity)
    found = angular_frequency_rad_s(simulation, lambda nodes: float(nodes[-1, 0]), steps=round(2.3 * steps_per_s))
    assert found == pytest.approx(frequency, rel=(frequency / steps_per_s) ** 2 / 3 + 1 / segments**2)
