"""Rods that fall freely."""

import numpy as np
import pytest

from benchmarks.physics.closed_forms import euler_fall_m
from tests.worker.simulate.physics.rods import GRAVITY_M_S2, IN_THE_AIR, line, rod
from worker.simulate.rod.fall import curvature_at_rest
from worker.simulate.rod.simulation import RodSimulation
from worker.simulate.shapes import bent_rod


@pytest.mark.parametrize("steps_per_s", [100, 1000, 4000])
@pytest.mark.parametrize("end", [(0.4, 0, 1), (0.2, 0.3, 1.1), (0, 0, 1.4)])
def test_a_rod_falls_as_semi_implicit_euler_says(end: tuple[float, float, float], steps_per_s: int) -> None:
    """A rod falls g t^2 (1 + h/t) / 2 exactly, up to the rounding of its steps, and doesn't deform."""
    nodes = line((0, 0, 1), end, 80)
    simulation = RodSimulation([rod(nodes)], IN_THE_AIR, steps_per_s=steps_per_s)
    steps = round(0.3 * steps_per_s)
    simulation.advance(steps)
    drop = euler_fall_m(steps / steps_per_s, 1 / steps_per_s, GRAVITY_M_S2)
    # Bending forces of stiff rods round to 1e-16 EI / l^3 l, which over a node's mass and the time is below 1e-10 m.
    assert simulation.nodes_m(0) == pytest.approx(nodes - [0, 0, drop], abs=1e-9)


def test_a_naturally_bent_rod_falls_without_deformation() -> None:
    """At its natural curvature a rod has no moment, so all nodes fall alike, up to a strain of 1e-7 in each edge.

    The chords carry a little tension there, and the solver finds it up to that strain.
    """
    level = bent_rod(0.4, (-5, 3, 5, -2, 4), 81)
    nodes = np.column_stack([level, np.full(81, 1.0)])
    bent = rod(nodes, natural_curvature_per_m=curvature_at_rest(nodes))
    simulation = RodSimulation([bent], IN_THE_AIR, steps_per_s=1000)
    simulation.advance(300)
    assert simulation.nodes_m(0) == pytest.approx(nodes - [0, 0, euler_fall_m(0.3, 1e-3, GRAVITY_M_S2)], abs=1e-7 * 0.4)
