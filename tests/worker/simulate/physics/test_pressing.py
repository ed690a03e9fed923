"""A heavy rod that lies on thin ones is carried by the floor at once."""

import numpy as np
import pytest

from tests.worker.simulate.physics.rods import GRAVITY_M_S2, RADIUS_M, line, masses_kg, rod
from worker.simulate.rod.model import Surroundings
from worker.simulate.rod.simulation import RodSimulation

STEPS = 20


@pytest.mark.parametrize("times", [4, 8])
@pytest.mark.parametrize("soft", [1e6, 1e7])
def test_a_heavy_rod_that_is_laid_on_two_thin_ones_is_carried_within_a_few_steps(times: int, soft: float) -> None:
    """The floor bears all weights to 2 %, and the heavy rod moves by less than a tenth of what it would fall."""
    lower = [rod(line((x, -0.05, RADIUS_M), (x, 0.05, RADIUS_M), 25), modulus_pa=soft) for x in (-0.03, 0.03)]
    height = (2 + times) * RADIUS_M
    heavy = rod(line((-0.06, 0, height), (0.06, 0, height), 12), radius_m=times * RADIUS_M, modulus_pa=1e9)
    simulation = RodSimulation([*lower, heavy], Surroundings(damping_s=0.01), steps_per_s=1000)
    simulation.advance(STEPS)
    weight = GRAVITY_M_S2 * sum(float(masses_kg(each).sum()) for each in (*lower, heavy))
    carried = sum(float(simulation.floor_forces_n(k)[:, 2].sum()) for k in range(3))
    assert carried == pytest.approx(weight, rel=0.02)
    fallen = 0.5 * GRAVITY_M_S2 * (STEPS * 1e-3) ** 2
    assert np.abs(simulation.nodes_m(2)[:, 2] - height).max() < 0.1 * fallen
