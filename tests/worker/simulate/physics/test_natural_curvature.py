"""Rods that are bent without stress, as by the coil from which a cable came."""

import numpy as np
import pytest

from tests.worker.simulate.physics.rods import RADIUS_M, WEIGHTLESS, line, rod
from worker.simulate.rod.fall import curvature_at_rest
from worker.simulate.rod.model import Array, Surroundings
from worker.simulate.rod.simulation import RodSimulation
from worker.simulate.shapes import bent_rod

SEGMENTS = 80
LENGTH_M = 0.4


def turns_rad(nodes_m: Array) -> Array:
    """Turns of the rod to the left at its inner nodes, seen from above, (N - 2,)."""
    edges = np.diff(nodes_m[:, :2], axis=0)
    bearings: Array = np.unwrap(np.arctan2(edges[:, 1], edges[:, 0]))
    return np.diff(bearings)


@pytest.mark.parametrize("modulus", [1e6, 3e7])
def test_a_bent_rod_keeps_its_shape_when_it_lands(modulus: float) -> None:
    """A rod that falls level strikes the floor all at once and isn't bent: turns change by a node's creep over l."""
    level = bent_rod(LENGTH_M, (-5, 3, 5, -2, 4), SEGMENTS + 1)
    nodes = np.column_stack([level, np.full(SEGMENTS + 1, 0.02)])
    bent = rod(nodes, modulus_pa=modulus, natural_curvature_per_m=curvature_at_rest(nodes))
    simulation = RodSimulation([bent], Surroundings(), steps_per_s=1000)
    simulation.advance(500)
    landed = simulation.nodes_m(0)
    assert landed[:, 2] == pytest.approx(RADIUS_M, abs=0.01 * RADIUS_M)
    assert turns_rad(landed) == pytest.approx(turns_rad(nodes), abs=0.01 * RADIUS_M / bent.segment_length_m)


@pytest.mark.parametrize("curvature_per_m", [-8.0, 2.0, 8.0])
def test_a_rod_pressed_straight_springs_to_its_natural_curvature(curvature_per_m: float) -> None:
    """At rest the moment EI (tan(theta)/l - k) is zero at every node."""
    curvature = np.full(SEGMENTS + 1, curvature_per_m)
    nodes = line((0, 0, 1), (LENGTH_M, 0, 1), SEGMENTS)
    straight = rod(nodes, natural_curvature_per_m=curvature)
    gravity_free = Surroundings(gravity_m_s2=(0, 0, 0), floor=False, damping_s=0.05)
    simulation = RodSimulation([straight], gravity_free, steps_per_s=1000)
    assert simulation.settle(rms_m_s=1e-4, fastest_m_s=5e-4, quiet_s=0.2, max_time_s=20)
    angles = turns_rad(simulation.nodes_m(0))
    assert np.tan(angles) / straight.segment_length_m == pytest.approx(curvature[1:-1], rel=0.01)


def test_a_rod_pressed_straight_starts_towards_its_natural_curvature() -> None:
    """The turn at the middle grows with the sign of k from the first steps on."""
    nodes = line((0, 0, 1), (LENGTH_M, 0, 1), SEGMENTS)
    straight = rod(nodes, natural_curvature_per_m=np.full(SEGMENTS + 1, 5.0))
    simulation = RodSimulation([straight], WEIGHTLESS, steps_per_s=1000)
    simulation.advance(20)
    assert turns_rad(simulation.nodes_m(0)).sum() > 0
