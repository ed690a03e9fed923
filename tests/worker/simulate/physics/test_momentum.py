"""Rods that collide with nothing else around."""

import numpy as np
import pytest

from tests.worker.simulate.physics.rods import WEIGHTLESS, line, masses_kg, rod
from worker.simulate.rod.model import Array, Rod
from worker.simulate.rod.simulation import RodSimulation


def momentum_kg_m_s(simulation: RodSimulation, rods: list[Rod]) -> Array:
    """The momentum of all rods, (3,)."""
    return sum((masses_kg(one) @ simulation.velocities_m_s(k) for k, one in enumerate(rods)), np.zeros(3))


@pytest.mark.parametrize("speed_m_s", [0.5, 2.0])
@pytest.mark.parametrize("offset_m", [0.0, 0.04])
def test_rods_that_collide_keep_their_momentum(offset_m: float, speed_m_s: float) -> None:
    """The sum of m v is constant: impulses are equal and opposite and bending and tension act between nodes.

    Newton's method takes a node for balanced when it lacks no more than 2e-6 m/s times its mass. But the columns of A
    sum to the masses, and what else couples nodes sums to 0, so that after an iteration all nodes of a rod together
    lack nothing, whatever each of them does. What is left is rounding: 3e4 additions over steps, nodes and iterations,
    of 1e-16 each and of terms A_ii / m = 1 + 6 EI h^2 / (l^3 m) = 640 times the momentum's, 1e-11 if they are random.
    Only a rod that is within the tolerance at once, without an iteration, could lose more: up to 2e-6 m/s times its
    mass a step.
    """
    one = rod(line((-0.1, 0, 0.0), (0.1, 0, 0.0), 40))
    other = rod(line((offset_m, -0.1, 0.01), (offset_m, 0.1, 0.012), 40), radius_m=0.002, modulus_pa=1e8)
    simulation = RodSimulation([one, other], WEIGHTLESS, steps_per_s=1000)
    simulation.set_velocities(0, np.tile([0.0, 0.1, speed_m_s], (41, 1)))
    before = momentum_kg_m_s(simulation, [one, other])
    simulation.advance(100)
    after = momentum_kg_m_s(simulation, [one, other])
    assert np.abs(simulation.velocities_m_s(1)).max() > 0.01 * speed_m_s
    assert after == pytest.approx(before, abs=1e-9 * float(np.linalg.norm(before)))
