"""In still air nothing adds energy."""

from collections.abc import Sequence

import numpy as np
import pytest

from benchmarks.physics.gates import energy_rise
from farm.spec.simulation import RodFall
from tests.worker.scenes import make_scene
from tests.worker.simulate.physics.rods import IN_THE_AIR, line, rod
from worker.simulate.checks.measure import Gate
from worker.simulate.rod.fall import INTERNAL_DAMPING_S, rods_of, surroundings_of
from worker.simulate.rod.model import Rod, Surroundings
from worker.simulate.rod.simulation import RodSimulation


def greatest_rise(rods: Sequence[Rod], surroundings: Surroundings, *, steps: int, steps_per_s: int = 1000) -> float:
    """Gate 7 in a fall of this many steps; heights, and so the start's energy, count from the floor."""
    simulation = RodSimulation(rods, surroundings, steps_per_s=steps_per_s)
    energies = [simulation.energy().total]
    for _ in range(steps):
        simulation.advance(1)
        energies.append(simulation.energy().total)
    return energy_rise(np.array(energies))


@pytest.mark.parametrize("modulus", [1e6, 3e6, 1e7, 3e7])
@pytest.mark.parametrize("damping_s", [0.0, INTERNAL_DAMPING_S])
def test_a_swinging_cantilever_gains_no_energy(damping_s: float, modulus: float) -> None:
    """KE + m g z + bending never rises, within gate 7; its tip may just reach the height that counts as zero."""
    swinging = rod(line((0, 0, 0.3), (0.3, 0, 0.3), 60), modulus_pa=modulus, pinned=(0, 1))
    surroundings = Surroundings(floor=False, damping_s=damping_s)
    assert Gate.ENERGY_RISE.on_target(greatest_rise([swinging], surroundings, steps=1500))


@pytest.mark.parametrize("modulus", [1e6, 3e7])
@pytest.mark.parametrize("rise_m", [0.0, 0.05])
def test_a_rod_that_falls_on_the_floor_gains_no_energy(modulus: float, rise_m: float) -> None:
    """KE + m g z + bending never rises, within gate 7, through fall, impact, bouncing and rest."""
    dropped = rod(line((0, 0, 0.02), (0.3, 0, 0.02 + rise_m), 60), modulus_pa=modulus)
    assert Gate.ENERGY_RISE.on_target(greatest_rise([dropped], Surroundings(damping_s=INTERNAL_DAMPING_S), steps=500))


def test_a_rod_that_flies_and_bends_gains_no_energy() -> None:
    """KE + m g z + bending never rises, within gate 7, with the bending stored at the start."""
    pressed = rod(line((0, 0, 1), (0.3, 0, 1), 60), natural_curvature_per_m=np.full(61, 5.0))
    assert Gate.ENERGY_RISE.on_target(greatest_rise([pressed], IN_THE_AIR, steps=300))


@pytest.mark.parametrize("index", range(4))
def test_a_pile_gains_no_energy(index: int) -> None:
    """KE + m g z + bending of eight cables never rises, within gate 7, with the wind off."""
    scene = make_scene(index=index, ranges={"cable": {"count": [8, 8]}, "wind": {"strength": [0.0, 0.0]}})
    fall = RodFall()
    rise = greatest_rise(rods_of(scene, fall), surroundings_of(scene), steps=400, steps_per_s=fall.steps_per_s)
    assert Gate.ENERGY_RISE.on_target(rise)
