"""Rods that are bent without stress, as by the coil from which a cable came."""

import numpy as np
import pytest

from tests.worker.simulate.physics.rods import RADIUS_M, WEIGHTLESS, line, rod
from worker.simulate.rod.fall import curvature_at_rest
from worker.simulate.rod.forces import UPRIGHT
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


@pytest.mark.parametrize("tilt_deg", [30.0, 90.0, 150.0])
def test_a_turned_coil_stays_at_rest(tilt_deg: float) -> None:
    """Natural curvature has no direction of its own: in weightless space a coil may lie in any plane.

    What pulls it upright is `UPRIGHT` of EI k^2 L, the energy of its curvature; on the inertia of a ring, m r^2 / 2,
    that gives the acceleration from which the largest speed follows.
    """
    radius_m, turns, modulus, time_s = 0.03, 1.5, 1e7, 0.05
    length_m = turns * 2 * np.pi * radius_m
    level = bent_rod(length_m, (1 / radius_m, 1 / radius_m), SEGMENTS + 1)
    coil = np.column_stack([level, np.linspace(0.0, 3 * RADIUS_M, SEGMENTS + 1)])
    tilt = np.radians(tilt_deg)
    turned = coil @ np.array([[1, 0, 0], [0, np.cos(tilt), np.sin(tilt)], [0, -np.sin(tilt), np.cos(tilt)]])
    lying = rod(turned, modulus_pa=modulus, natural_curvature_per_m=curvature_at_rest(coil))
    simulation = RodSimulation([lying], WEIGHTLESS, steps_per_s=1000)
    simulation.advance(round(time_s * 1000))
    torque = UPRIGHT * lying.bending_stiffness_n_m2 * length_m / radius_m**2
    spin = torque / (lying.mass_per_length_kg_m * length_m * radius_m**2 / 2) * time_s
    assert np.linalg.norm(simulation.velocities_m_s(0), axis=1).max() < 2 * spin * radius_m


def test_a_stiff_arc_that_hangs_over_tips_to_the_floor() -> None:
    """A half circle on a rail under one end does not stay level: its centre of mass is beside the rail."""
    radius_m = 0.04
    level = bent_rod(np.pi * radius_m, (1 / radius_m, 1 / radius_m), SEGMENTS // 2 + 1)
    level -= level.mean(axis=0)
    arc = np.column_stack([level, np.full(len(level), 3.05 * RADIUS_M)])
    along = arc[2] - arc[0]
    across = 0.02 * np.array([-along[1], along[0], 0.0]) / np.linalg.norm(along)
    place = np.array([*arc[3, :2], RADIUS_M])
    rail = rod(line(tuple(place - across), tuple(place + across), 10), pinned=tuple(range(11)))
    bent = rod(arc, modulus_pa=3e7, natural_curvature_per_m=curvature_at_rest(arc))
    simulation = RodSimulation([bent, rail], Surroundings(damping_s=0.01), steps_per_s=1000)
    simulation.advance(400)
    assert simulation.nodes_m(0)[:, 2].min() == pytest.approx(RADIUS_M, abs=0.02 * RADIUS_M)
