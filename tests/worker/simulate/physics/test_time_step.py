"""The order in the time step without contact, over the time of a real fall."""

from collections.abc import Callable

import numpy as np
import pytest

from benchmarks.physics.gates import largest_movement, observed_orders
from farm.spec.simulation import RodFall
from tests.worker.simulate.physics.rods import line, rod, shapes
from worker.simulate.checks.measure import Gate
from worker.simulate.rod.model import Breeze, Rod, Surroundings
from worker.simulate.rod.simulation import RodSimulation
from worker.simulate.shapes import CableShapes

FALL_S = 0.08
"""Seconds of a fall from 32 mm, where the highest of eight cables starts."""


def swinging() -> tuple[Rod, Surroundings]:
    """A rod clamped at one end that bends under its weight."""
    return rod(line((0, 0, 1), (0.2, 0, 1), 40), pinned=(0, 1)), Surroundings(floor=False)


def springing() -> tuple[Rod, Surroundings]:
    """A rod that was pressed straight, and bends while it falls."""
    nodes = line((0, 0, 1), (0.4, 0, 1), 80)
    return rod(nodes, natural_curvature_per_m=np.full(81, 5.0)), Surroundings(floor=False, damping_s=0.003)


def blown() -> tuple[Rod, Surroundings]:
    """A falling rod in the strongest wind of the default ranges, gusts and all, half of it across the rod."""
    breeze = Breeze(
        velocity_m_s=np.array([1.2, 2.0, 0.9]),
        gusts=np.array([(0.3, 2 * np.pi / 0.05, 1.0), (0.2, 2 * np.pi / 0.15, 4.0)]),
        until_s=FALL_S,
    )
    nodes = line((0, 0, 1), (0.4, 0, 1), 80)
    return rod(nodes, modulus_pa=1e6), Surroundings(floor=False, damping_s=0.003, breeze=breeze)


CASES = pytest.mark.parametrize("case", [swinging, springing, blown])


def after_the_fall(case: Callable[[], tuple[Rod, Surroundings]], steps_per_s: int) -> CableShapes:
    """The nodes after the fall."""
    one, surroundings = case()
    simulation = RodSimulation([one], surroundings, steps_per_s=steps_per_s)
    simulation.advance(round(FALL_S * steps_per_s))
    assert simulation.time_s == pytest.approx(FALL_S)
    return shapes(simulation, [one])


@CASES
def test_the_error_is_of_first_order_in_the_time_step(case: Callable[[], tuple[Rod, Surroundings]]) -> None:
    """For implicit Euler the movement when h is halved is c h / 2 + O(h^2), so it halves with h, within gate 8."""
    runs = [after_the_fall(case, 4000 * 2**k) for k in range(4)]
    coarse, middle, fine = (largest_movement(runs[k], runs[k + 1]) for k in range(3))
    assert all(Gate.ORDER.on_target(order) for order in observed_orders((coarse, middle, fine)))


@CASES
def test_halving_the_default_step_moves_no_node_by_half_a_radius(
    case: Callable[[], tuple[Rod, Surroundings]],
) -> None:
    """At the default step |x_h - x_(h/2)| is within gate 8."""
    steps_per_s = RodFall().steps_per_s
    movement = largest_movement(after_the_fall(case, steps_per_s), after_the_fall(case, 2 * steps_per_s))
    assert Gate.STEP_HALVING.on_target(movement)
