"""Wrong impulses do no harm: a step that gains energy, or presses rods into each other, is made again."""

from itertools import product

import numpy as np
import pytest

from tests.worker.simulate.physics.rods import GRAVITY_M_S2, IN_THE_AIR, RADIUS_M, WEIGHTLESS, line, masses_kg, rod
from worker.simulate.checks.measure import Gate
from worker.simulate.rod.contact import DEPENETRATION_SHARE, UNDOING_S
from worker.simulate.rod.model import Rod, Surroundings
from worker.simulate.rod.simulation import RodSimulation
from worker.simulate.rod.step import SPEED_SPARE_M_S


def fastest_m_s(simulation: RodSimulation, rods: list[Rod]) -> float:
    """The fastest speed of all nodes."""
    return max(float(np.linalg.norm(simulation.velocities_m_s(k), axis=1).max()) for k in range(len(rods)))


def mass_kg(rods: list[Rod]) -> float:
    """The mass of all rods."""
    return float(sum(masses_kg(one).sum() for one in rods))


@pytest.mark.parametrize("steps_per_s", [100, 1000])
@pytest.mark.parametrize("shift_m", [0.0, 0.04, 0.095])
@pytest.mark.parametrize("apart_radii", [0.0, 0.5, 1.9])
def test_light_stiff_rods_within_each_other_are_parted_gently(
    apart_radii: float, shift_m: float, steps_per_s: int
) -> None:
    """No node is faster than 3 u / 2, and the energy is below m u^2 / 2: u is the speed at which the contact parts.

    It is the depth over the time constant of undoing it, or a share of the depth a step, or sqrt(g r). Push a rigid
    rod by u at a fraction p of its half length, and its ends move at u (1 +- 3 p) / (1 + 3 p^2), 3 u / 2 at most. Two
    free rods, pushed apart by u, have m_one u^2 / 4 at most, half of what is asked for here.
    """
    height = apart_radii * RADIUS_M
    rods = [
        rod(line((-0.1, 0, height), (0.1, 0, height), 40), modulus_pa=1e10, density_kg_m3=100),
        rod(line((shift_m, -0.1, 0), (shift_m, 0.1, 0), 40), modulus_pa=1e10, density_kg_m3=100),
    ]
    simulation = RodSimulation(rods, WEIGHTLESS, steps_per_s=steps_per_s)
    depth = (2 - apart_radii) * RADIUS_M
    speed = min(depth / UNDOING_S, DEPENETRATION_SHARE * depth * steps_per_s, np.sqrt(GRAVITY_M_S2 * RADIUS_M))
    fastest = 0.0
    for _ in range(steps_per_s // 4):
        simulation.advance(1)
        fastest = max(fastest, fastest_m_s(simulation, rods))
        assert simulation.energy().total < 0.5 * mass_kg(rods) * speed**2
    assert 0.25 * speed < fastest < 1.5 * speed


def pile(seed: int, modulus: float) -> list[Rod]:
    """Four rods across each other, close above the floor."""
    draw = np.random.default_rng(seed)
    rods = []
    for k in range(4):
        bearing, centre = draw.uniform(0, np.pi), np.array([*draw.uniform(-0.02, 0.02, 2), RADIUS_M * (1.2 + 2.2 * k)])
        half = 0.05 * np.array([np.cos(bearing), np.sin(bearing), 0])
        rods.append(rod(line(centre - half, centre + half, 25), modulus_pa=modulus))
    return rods


@pytest.mark.parametrize("modulus", [1e6, 1e8, 1e10])
def test_rods_that_land_on_each_other_gain_no_energy_but_by_being_parted(modulus: float) -> None:
    """KE + m g z + bending rises in no step by more than u J and the step's allowance.

    J is the sum of all impulses of the step, and u the speed at which rods are parted that are within each other, or
    within the floor, by 0.02 r: gate 2, and twice as deep as these ever are.
    """
    for seed in range(4):
        rods = pile(seed, modulus)
        simulation = RodSimulation(rods, Surroundings(damping_s=0.01), steps_per_s=1000)
        speed = Gate.CABLE_PENETRATION.value.target * RADIUS_M / UNDOING_S
        before = simulation.energy().total
        for _ in range(100):
            simulation.advance(1)
            after = simulation.energy().total
            impulses = np.linalg.norm(simulation._candidates.impulse, axis=1).sum()
            impulses += np.linalg.norm(simulation._motion.floor_impulse, axis=0).sum()
            assert after - before < speed * impulses + 0.5 * mass_kg(rods) * SPEED_SPARE_M_S**2
            before = after


@pytest.mark.parametrize("size_n_s", [1e-4, 1e-2, 1.0])
def test_wrong_impulses_to_start_from_do_not_throw_rods(size_n_s: float) -> None:
    """KE + m g z + bending stays below its start's, plus that of all rods at the speed of the step's allowance.

    The weight of a rod gives it 5e-6 N s in a step.
    """
    gains = []
    for seed, modulus in product(range(4), (1e6, 1e8, 1e10)):
        rods = pile(seed, modulus)
        for between, below in ((True, False), (False, True), (True, True)):
            simulation = RodSimulation(rods, Surroundings(damping_s=0.01), steps_per_s=1000)
            simulation.advance(60)
            before, draw = simulation.energy().total, np.random.default_rng(seed)
            if between:
                impulse = simulation._candidates.impulse
                impulse[:] = draw.normal(0, size_n_s, impulse.shape)
            if below:
                impulse = simulation._motion.floor_impulse
                impulse[:] = draw.normal(0, size_n_s, impulse.shape)
            simulation.advance(1)
            gains.append((simulation.energy().total - before) / mass_kg(rods))
    assert max(gains) <= 0.5 * SPEED_SPARE_M_S**2


def test_a_step_that_is_made_again_is_counted() -> None:
    """The step is tried again, at last as two halves, which finds a sound end, so no rod is stopped."""
    simulation = RodSimulation(pile(1, 1e8), Surroundings(damping_s=0.01), steps_per_s=1000)
    simulation.advance(60)
    before, impulse = simulation.counts, simulation._candidates.impulse
    impulse[:] = np.random.default_rng(0).normal(0, 1.0, impulse.shape)
    simulation.advance(1)
    after = simulation.counts
    assert after["retries"] == before["retries"] + 1
    assert after["stops"] == before["stops"] == 0
    assert after["steps"] == before["steps"] + 1


def test_rods_that_fall_freely_need_no_step_again() -> None:
    """Rods that touch nothing gain no energy."""
    simulation = RodSimulation(pile(0, 1e8), IN_THE_AIR, steps_per_s=1000)
    simulation.advance(100)
    assert simulation.counts["retries"] == simulation.counts["stops"] == 0


@pytest.mark.parametrize("modulus", [1e6, 1e8, 1e10])
def test_a_pile_is_never_stopped_for_want_of_a_sound_end(modulus: float) -> None:
    """A step that is halved often enough has a sound end."""
    simulation = RodSimulation(pile(1, modulus), Surroundings(damping_s=0.01), steps_per_s=1000)
    simulation.advance(500)
    assert simulation.counts["stops"] == 0
