"""Naturally curved coils: in weightless space, and lying on themselves."""

import numpy as np
import pytest

from farm.spec.ranges.placement import SPACING_DIAMETERS
from farm.spec.simulation import RodFall
from tests.worker.simulate.physics.rods import DENSITY_KG_M3, GRAVITY_M_S2, RADIUS_M, masses_kg, rod, shapes
from worker.simulate.checks.measure import Gate, measure
from worker.simulate.rod.fall import (
    INTERNAL_DAMPING_S,
    RESISTANCE,
    REST_FASTEST_M_S,
    REST_RMS_M_S,
    REST_S,
    curvature_at_rest,
)
from worker.simulate.rod.model import Array, Rod, Surroundings
from worker.simulate.rod.segments import MOST_TURN_RAD
from worker.simulate.rod.simulation import RodSimulation
from worker.simulate.shapes import bent_rod

STEPS_PER_S = RodFall().steps_per_s
TIGHTEST_M = 8 * RADIUS_M
"""Radius of the tightest coil of the style `wide`, four diameters."""

SEGMENT_M = min(RodFall().segment_radii * RADIUS_M, MOST_TURN_RAD * TIGHTEST_M)
"""Length of the segments with which such a coil falls."""

UNEVENNESS = 0.08
"""Standard deviation of a drawn coil's curvature, as a share of its mean."""


def wound(radius_m: float, turns: float, unevenness: float, seed: int = 0) -> Array:
    """Nodes (N, 2) of a level coil whose curvature varies as that of drawn coils does."""
    length_m = turns * 2 * np.pi * radius_m
    uneven = np.random.default_rng(seed).normal(0.0, unevenness, 33)
    return bent_rod(length_m, tuple(((1 + uneven) / radius_m).tolist()), round(length_m / SEGMENT_M) + 1)


def spiral(radius_m: float, gap_m: float, turns: float) -> Array:
    """Nodes (N, 2) of a level spiral that begins at a radius and grows by a gap in each turn, at equal distances."""
    angle = np.linspace(0, turns * 2 * np.pi, 20_001)
    away = radius_m + gap_m * angle / (2 * np.pi)
    points = np.stack([away * np.cos(angle), away * np.sin(angle)], axis=1)
    nodes = [points[0]]
    place = 0
    while place < len(points):
        beyond = np.linalg.norm(points[place:] - nodes[-1], axis=1) >= SEGMENT_M
        if not beyond.any():
            break
        place += int(beyond.argmax())
        nodes.append(nodes[-1] + SEGMENT_M * (points[place] - nodes[-1]) / np.linalg.norm(points[place] - nodes[-1]))
    return np.array(nodes)


@pytest.mark.parametrize("modulus", [1e6, 3e7])
@pytest.mark.parametrize(
    "level",
    [wound(TIGHTEST_M, 0.9, 0.0), wound(TIGHTEST_M, 0.9, UNEVENNESS), spiral(TIGHTEST_M, 3 * RADIUS_M, 3)],
    ids=["even", "uneven", "spiral"],
)
def test_a_level_coil_in_weightless_space_stays_as_it_is(level: Array, modulus: float) -> None:
    """The moment EI (tan(theta) / l - k) is zero at every node, so nothing moves but by rounding.

    A node's bending forces, 8 of up to EI |x| / l^3, round to 2e-16 of that; this over its mass may add up as t^2 / 2.
    """
    nodes = np.column_stack([level, np.zeros(len(level))])
    coil = rod(nodes, modulus_pa=modulus, natural_curvature_per_m=curvature_at_rest(nodes))
    surroundings = Surroundings(gravity_m_s2=(0, 0, 0), floor=False, damping_s=INTERNAL_DAMPING_S)
    simulation = RodSimulation([coil], surroundings, steps_per_s=STEPS_PER_S)
    simulation.advance(1000)
    force_n = 8 * np.finfo(float).eps * coil.bending_stiffness_n_m2 * np.abs(nodes).max() / SEGMENT_M**3
    assert np.abs(simulation.nodes_m(0) - nodes).max() <= force_n / masses_kg(coil)[1] * simulation.time_s**2 / 2


def lying_on_itself(
    radius_m: float, turns: float, modulus_pa: float, *, resistance: float, unevenness: float = 0.0, seed: int = 0
) -> tuple[RodSimulation, Rod]:
    """A coil that was dropped as drawn ones are and has come to rest on itself."""
    level = wound(radius_m, turns, unevenness, seed)
    height = np.linspace(0.0, SPACING_DIAMETERS * 2 * RADIUS_M * turns, len(level))
    nodes = np.column_stack([level, RADIUS_M + 0.004 + height])
    coil = rod(
        nodes,
        modulus_pa=modulus_pa,
        density_kg_m3=DENSITY_KG_M3,
        natural_curvature_per_m=curvature_at_rest(nodes),
    )
    surroundings = Surroundings(damping_s=INTERNAL_DAMPING_S, resistance=resistance)
    simulation = RodSimulation([coil], surroundings, steps_per_s=STEPS_PER_S)
    assert simulation.settle(
        rms_m_s=REST_RMS_M_S, fastest_m_s=REST_FASTEST_M_S, quiet_s=REST_S, max_time_s=RodFall().max_time_s
    )
    return simulation, coil


COILS = pytest.mark.parametrize(("radii", "turns", "modulus"), [(8, 3, 1e7), (8, 5, 3e7), (12, 3, 1e6), (20, 3, 1e6)])


def mean_lift_n(simulation: RodSimulation, coil: Rod, duration_s: float) -> tuple[float, float]:
    """Mean upward force of the floor over a time, and the mean of what changes the coil's momentum then."""
    mass = masses_kg(coil)
    start_s, before = simulation.time_s, float(mass @ simulation.velocities_m_s(0)[:, 2])
    impulse = 0.0
    while simulation.time_s < start_s + duration_s:
        step_from_s = simulation.time_s
        simulation.advance(1)
        impulse += float(simulation.floor_forces_n(0)[:, 2].sum()) * (simulation.time_s - step_from_s)
    elapsed_s = simulation.time_s - start_s
    return impulse / elapsed_s, (float(mass @ simulation.velocities_m_s(0)[:, 2]) - before) / elapsed_s


@COILS
def test_the_floor_carries_the_weight_of_a_coil_that_lies_on_itself(radii: float, turns: float, modulus: float) -> None:
    """The floor's force is m g + dp/dt: turns that press on each other add nothing to it.

    It holds to a tenth of the dry resistance that falls have, and which is switched off here.
    """
    simulation, coil = lying_on_itself(radii * RADIUS_M, turns, modulus, resistance=0.0)
    weight_n = float(masses_kg(coil).sum()) * GRAVITY_M_S2
    lift_n, change_n = mean_lift_n(simulation, coil, 0.1)
    assert lift_n == pytest.approx(weight_n + change_n, abs=0.1 * RESISTANCE * weight_n)


@COILS
def test_dry_resistance_holds_no_more_of_a_coil_than_its_share(radii: float, turns: float, modulus: float) -> None:
    """With the resistance of falls, R of the weight, the floor's force is m g + dp/dt up to R m g."""
    simulation, coil = lying_on_itself(radii * RADIUS_M, turns, modulus, resistance=RESISTANCE)
    weight_n = float(masses_kg(coil).sum()) * GRAVITY_M_S2
    lift_n, change_n = mean_lift_n(simulation, coil, 0.1)
    assert lift_n == pytest.approx(weight_n + change_n, abs=RESISTANCE * weight_n)


@COILS
def test_the_turns_of_a_coil_rest_on_each_other(radii: float, turns: float, modulus: float) -> None:
    """At rest, turns cut each other and the floor nowhere by more than gate 2 allows, and lie above each other."""
    simulation, coil = lying_on_itself(radii * RADIUS_M, turns, modulus, resistance=RESISTANCE)
    figures = measure(shapes(simulation, [coil]))
    assert Gate.CABLE_PENETRATION.on_target(figures.cable_penetration_max)
    assert Gate.FLOOR_PENETRATION.on_target(figures.floor_penetration_max)
    assert Gate.SPEED_MAX.on_target(figures.speed_max_mm_s)
    # A coil that had gone through itself would lie flat.
    assert simulation.nodes_m(0)[:, 2].max() > 2 * RADIUS_M
