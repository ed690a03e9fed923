"""Rods of very different radius and mass on each other: their statics, and what happens when one drops on the other."""

import numpy as np
import pytest

from benchmarks.physics.gates import energy_rise
from benchmarks.physics.passes import passes_between
from farm.spec.simulation import RodFall
from tests.worker.simulate.physics.rods import GRAVITY_M_S2, line, masses_kg, rod, shapes
from worker.simulate.checks.measure import Gate, measure
from worker.simulate.rod.fall import (
    INTERNAL_DAMPING_S,
    REST_FASTEST_M_S,
    REST_RMS_M_S,
    REST_S,
    STICK_YOUNGS_MODULUS_PA,
)
from worker.simulate.rod.model import Array, Rod, Surroundings
from worker.simulate.rod.simulation import RodSimulation

STEPS_PER_S = RodFall().steps_per_s
SOFT_PA, STIFF_PA = 1e7, STICK_YOUNGS_MODULUS_PA
AVERAGED_S = 0.2
"""Time over which forces are averaged, in seconds."""

Place = tuple[float, float, float]


def bar(start: Place, end: Place, *, radius_m: float, density_kg_m3: float, modulus_pa: float) -> Rod:
    """A straight rod in segments of the default length, at least eight."""
    length_m = float(np.linalg.norm(np.subtract(end, start)))
    segments = max(8, round(length_m / (RodFall().segment_radii * radius_m)))
    return rod(line(start, end, segments), radius_m=radius_m, modulus_pa=modulus_pa, density_kg_m3=density_kg_m3)


def carried(
    *, radii_m: tuple[float, float], densities_kg_m3: tuple[float, float], modulus_pa: float
) -> tuple[RodSimulation, list[Rod]]:
    """A stiff bar just above two free ones on the floor, 35 mm to one side of its middle and 20 mm to the other.

    Args:
        radii_m: radius of the bar, and of those below it.
        densities_kg_m3: density of the bar, and of those below it.
        modulus_pa: Young's modulus of those below it.
    """
    (upper, lower), (above, below) = radii_m, densities_kg_m3
    half, height = max(0.06, 16 * upper), 2 * lower + upper + 0.0002
    rods = [bar((-half, 0, height), (half, 0, height), radius_m=upper, density_kg_m3=above, modulus_pa=STIFF_PA)]
    rods += [
        bar((x, -0.04, lower), (x, 0.04, lower), radius_m=lower, density_kg_m3=below, modulus_pa=modulus_pa)
        for x in (-0.035, 0.02)
    ]
    simulation = RodSimulation(rods, Surroundings(damping_s=INTERNAL_DAMPING_S), steps_per_s=STEPS_PER_S)
    return simulation, rods


def rest(simulation: RodSimulation) -> bool:
    """Whether the rods come to rest within the time that a fall may take."""
    return simulation.settle(
        rms_m_s=REST_RMS_M_S, fastest_m_s=REST_FASTEST_M_S, quiet_s=REST_S, max_time_s=RodFall().max_time_s
    )


def mean_forces_n(simulation: RodSimulation) -> tuple[Array, Array]:
    """Mean upward forces (2,) of the lower rods on the bar, and of the floor on the lower rods."""
    start_s = simulation.time_s
    on_bar, on_lower = np.zeros(2), np.zeros(2)
    while simulation.time_s < start_s + AVERAGED_S:
        before_s = simulation.time_s
        simulation.advance(1)
        step_s = simulation.time_s - before_s
        on_bar += [step_s * simulation.contact_force_n(0, k)[2] for k in (1, 2)]
        on_lower += [step_s * simulation.floor_forces_n(k)[:, 2].sum() for k in (1, 2)]
    elapsed_s = simulation.time_s - start_s
    return on_bar / elapsed_s, on_lower / elapsed_s


LIGHT_ON_HEAVY = [((0.0005, 0.006), (1200, 5000)), ((0.001, 0.004), (1000, 2500)), ((0.001, 0.001), (500, 5000))]
HEAVY_ON_LIGHT = [((0.002, 0.001), (1500, 1500)), ((0.003, 0.001), (1500, 1500))]


def check_shares(simulation: RodSimulation, rods: list[Rod]) -> None:
    """Compare the forces with the lever law, where the rods lie now.

    Speeds within gate 4 change the momentum, and the angular momentum about either support, by what a force of
    2 v / (g T) of the weight does in the averaged time; about a support, its arm counts, of up to the half length.
    """
    weights = [float(masses_kg(one).sum()) * GRAVITY_M_S2 for one in rods]
    on_bar, on_lower = mean_forces_n(simulation)
    middle = float(masses_kg(rods[0]) @ simulation.nodes_m(0)[:, 0]) * GRAVITY_M_S2 / weights[0]
    places = np.array([simulation.nodes_m(k)[:, 0].mean() for k in (1, 2)])
    share = np.array([places[1] - middle, middle - places[0]]) / (places[1] - places[0])
    half_m = float(np.ptp(rods[0].nodes_m[:, 0])) / 2
    change = 2 * Gate.SPEED_MAX.value.target / 1000 / AVERAGED_S / GRAVITY_M_S2
    assert on_bar / weights[0] == pytest.approx(share, abs=change * half_m / (places[1] - places[0]))
    assert on_lower == pytest.approx(on_bar + weights[1:], rel=change)


@pytest.mark.parametrize("modulus", [SOFT_PA, STIFF_PA])
@pytest.mark.parametrize(("radii_m", "densities_kg_m3"), [*LIGHT_ON_HEAVY, *HEAVY_ON_LIGHT])
def test_two_rods_carry_another_by_the_lever_law(
    radii_m: tuple[float, float], densities_kg_m3: tuple[float, float], modulus: float
) -> None:
    """A level bar on two supports at a and b from its middle presses on them by m g b / (a + b) and m g a / (a + b)."""
    simulation, rods = carried(radii_m=radii_m, densities_kg_m3=densities_kg_m3, modulus_pa=modulus)
    assert rest(simulation)
    check_shares(simulation, rods)
    figures = measure(shapes(simulation, rods, (1, 2, 0)))
    assert Gate.CABLE_PENETRATION.on_target(figures.cable_penetration_max)
    assert Gate.FLOOR_PENETRATION.on_target(figures.floor_penetration_max)


DROPS = [((0.0005, 0.006), (1200, 5000)), ((0.001, 0.004), (1000, 2500))]


@pytest.mark.parametrize("angle_deg", [90, 30])
@pytest.mark.parametrize("aside_m", [0.0, 0.02])
@pytest.mark.parametrize(("radii_m", "densities_kg_m3"), DROPS)
def test_a_stiff_light_rod_bounces_off_a_heavy_one(
    radii_m: tuple[float, float], densities_kg_m3: tuple[float, float], aside_m: float, angle_deg: float
) -> None:
    """Dropped from 50 mm it goes through nothing, and the energy rises in no step by more than gate 7 allows."""
    (upper, lower), (above, below) = radii_m, densities_kg_m3
    centre = np.array([0.0, aside_m, 2 * lower + upper + 0.05])
    along = 0.05 * np.array([np.cos(np.radians(angle_deg)), np.sin(np.radians(angle_deg)), 0.0])
    rods = [
        bar((-0.1, 0, lower), (0.1, 0, lower), radius_m=lower, density_kg_m3=below, modulus_pa=SOFT_PA),
        bar(tuple(centre - along), tuple(centre + along), radius_m=upper, density_kg_m3=above, modulus_pa=STIFF_PA),
    ]
    simulation = RodSimulation(rods, Surroundings(damping_s=INTERNAL_DAMPING_S), steps_per_s=STEPS_PER_S)
    radii, met, energies = np.array([lower, upper]), False, [simulation.energy().total]
    while simulation.time_s < 0.3:
        before = (simulation.nodes_m(0), simulation.nodes_m(1))
        simulation.advance(1)
        after = (simulation.nodes_m(0), simulation.nodes_m(1))
        assert all(passage.near_end for passage in passes_between(before, after, radii))
        met = met or bool(simulation.contact_force_n(1, 0)[2] > 0)
        energies.append(simulation.energy().total)
    assert met
    assert Gate.ENERGY_RISE.on_target(energy_rise(np.array(energies)))
