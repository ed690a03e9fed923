"""The air: drag across and along a rod."""

import numpy as np
import pytest

from tests.worker.simulate.physics.rods import line, rod
from worker.simulate.rod.forces import AIR_DENSITY_KG_M3, DRAG_COEFFICIENT, SKIN_COEFFICIENT
from worker.simulate.rod.model import Breeze, Surroundings
from worker.simulate.rod.simulation import RodSimulation


def in_air(velocity_m_s: tuple[float, float, float]) -> Surroundings:
    """Surroundings with nothing but a steady wind."""
    breeze = Breeze(velocity_m_s=np.array(velocity_m_s), gusts=np.zeros((0, 3)), until_s=1e3)
    return Surroundings(gravity_m_s2=(0.0, 0.0, 0.0), floor=False, breeze=breeze)


@pytest.mark.parametrize("density_kg_m3", [1.0, 100.0])
@pytest.mark.parametrize("modulus", [1e6, 1e9])
def test_the_lightest_rod_is_never_faster_than_the_air(modulus: float, density_kg_m3: float) -> None:
    """|v| <= |u| at 100 steps per second, in a wind of 10 m/s.

    At the start, h rho/2 C d u / (pi r^2 rho_rod) = 42 for the lighter one: an explicit step would give it 42 times
    the speed of the air.
    """
    blown = rod(line((0, 0, 1), (0.2, 0, 1), 40), modulus_pa=modulus, density_kg_m3=density_kg_m3)
    wind = (3.0, 9.0, -3.0)
    simulation = RodSimulation([blown], in_air(wind), steps_per_s=100)
    for _ in range(100):
        simulation.advance(1)
        assert np.linalg.norm(simulation.velocities_m_s(0), axis=1).max() <= np.linalg.norm(wind)
    # Across the wind, the rod is carried along.
    assert simulation.velocities_m_s(0)[:, 1] == pytest.approx(9.0, rel=0.05)


@pytest.mark.parametrize("steps_per_s", [100, 1000])
@pytest.mark.parametrize(("bearing", "coefficient"), [((1, 0, 0), SKIN_COEFFICIENT), ((0, 1, 0), DRAG_COEFFICIENT)])
def test_still_air_slows_a_rod_along_its_axis_and_across_it(
    bearing: tuple[int, int, int], coefficient: float, steps_per_s: int
) -> None:
    """dv/dt = -rho/2 C d L v^2 / m: v = v0 / (1 + v0 k t) with k = rho/2 C d L / m.

    A step of 1/v' = 1/v + k h, drag at its end with |v| of its start, has no error of its own; what is left is the
    strain of 1e-8 that lengths are kept to.
    """
    flying = rod(line((0, 0, 1), (0.2, 0, 1), 40), density_kg_m3=10.0)
    simulation = RodSimulation([flying], in_air((0.0, 0.0, 0.0)), steps_per_s=steps_per_s)
    speed = 5.0
    simulation.set_velocities(0, np.tile(speed * np.array(bearing), (41, 1)))
    simulation.advance(steps_per_s // 2)
    k = 0.5 * AIR_DENSITY_KG_M3 * coefficient * 2 * flying.radius_m / flying.mass_per_length_kg_m
    expected = speed / (1 + speed * k * simulation.time_s)
    assert expected < 0.4 * speed
    assert simulation.velocities_m_s(0) == pytest.approx(np.outer(np.full(41, expected), bearing), abs=1e-8 * speed)
