"""A rod clamped at one end that bends under its own weight, against the heavy elastica."""

from functools import cache

import numpy as np
import pytest

from benchmarks.physics.elastica import droop_ratio
from benchmarks.physics.gates import CantileverError, cantilever_error, observed_orders
from tests.worker.simulate.physics.rods import GRAVITY_M_S2, line, modulus_pa, rod, weight_per_length_n_m
from worker.simulate.checks.measure import Gate
from worker.simulate.rod.model import Rod, Surroundings
from worker.simulate.rod.simulation import RodSimulation

LENGTH_M = 0.4

SETTINGS = {1.0: (0.1, 200), 10.0: (0.05, 100), 100.0: (0.3, 100), 1000.0: (1.0, 50)}
"""Damping, and steps per second, with which a cantilever comes to rest soon, by slenderness."""


def clamped(slenderness: float, segments: int) -> Rod:
    """A rod that is free over `LENGTH_M` from the middle of its first segment on."""
    segment = LENGTH_M / (segments - 0.5)
    nodes = line((-segment / 2, 0, 1), (LENGTH_M, 0, 1), segments)
    return rod(nodes, modulus_pa=modulus_pa(slenderness, LENGTH_M), pinned=(0, 1))


@cache
def settled(
    slenderness: float, segments: int, damping_s: float, steps_per_s: int
) -> tuple[Rod, RodSimulation, CantileverError]:
    """A cantilever at rest to 1 um/s: its remaining movement, speed times period, is far below the measured errors."""
    cantilever = clamped(slenderness, segments)
    surroundings = Surroundings(floor=False, gravity_m_s2=(0, 0, -GRAVITY_M_S2), damping_s=damping_s)
    simulation = RodSimulation([cantilever], surroundings, steps_per_s=steps_per_s)
    simulation.settle(rms_m_s=1e-6, fastest_m_s=1e-5, quiet_s=0.05, max_time_s=60)
    assert np.linalg.norm(simulation.velocities_m_s(0), axis=1).max() < 1e-5
    error = cantilever_error(
        simulation.nodes_m(0),
        bending_stiffness_n_m2=cantilever.bending_stiffness_n_m2,
        weight_per_length_n_m=weight_per_length_n_m(cantilever),
    )
    return cantilever, simulation, error


@pytest.mark.parametrize("slenderness", SETTINGS)
def test_a_cantilever_droops_as_the_master_curve_says(slenderness: float) -> None:
    """H/W is that of theta'' = -G (1 - s) cos(theta), within gate 5."""
    _, _, error = settled(slenderness, 80, *SETTINGS[slenderness])
    assert error.slenderness == pytest.approx(slenderness, rel=1e-6)
    assert error.gate.on_target(error.error)


@pytest.mark.parametrize("slenderness", SETTINGS)
def test_a_cantilever_keeps_its_length(slenderness: float) -> None:
    """|x[i+1] - x[i]| = l for every segment, within gate 1."""
    cantilever, simulation, _ = settled(slenderness, 80, *SETTINGS[slenderness])
    lengths = np.linalg.norm(np.diff(simulation.nodes_m(0), axis=0), axis=1)
    assert Gate.LENGTH.on_target(float(np.abs(lengths / cantilever.segment_length_m - 1).max()))


@pytest.mark.parametrize(("slenderness", "segments"), [(1.0, (10, 20, 40)), (100.0, (20, 40, 80))])
def test_a_cantilever_converges_at_second_order_in_the_segment_length(
    slenderness: float, segments: tuple[int, int, int]
) -> None:
    """The error is c l^2 (1 + O(l^2)): order 2, off by what the next term, a few percent here, changes a ratio by."""
    coarse, middle, fine = (settled(slenderness, n, *SETTINGS[slenderness])[2].error for n in segments)
    assert observed_orders((coarse, middle, fine)) == pytest.approx((2.0, 2.0), abs=0.15)


@pytest.mark.parametrize(("damping_s", "steps_per_s"), [(0.02, 100), (0.1, 100), (0.05, 500)])
def test_where_a_cantilever_rests_depends_on_neither_damping_nor_time_step(damping_s: float, steps_per_s: int) -> None:
    """Damping and time step multiply velocities, which are zero at rest: H/W differs by a swing's rest at 1e-5 m/s."""
    _, _, reference = settled(10.0, 80, *SETTINGS[10.0])
    _, _, other = settled(10.0, 80, damping_s, steps_per_s)
    # The first swing, at 3.516 sqrt(g / (G L)), in lengths; no sign is lost, as both errors are below 1e-4.
    remainder = 1e-5 / (3.516 * np.sqrt(GRAVITY_M_S2 / 10.0 / LENGTH_M)) / LENGTH_M
    assert other.error == pytest.approx(reference.error, abs=2 * remainder * (1 + droop_ratio(10.0) ** 2) + 1e-6)
