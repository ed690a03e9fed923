"""Rods that meet at speeds far above those of any fall."""

from dataclasses import replace

import numpy as np
import pytest

from farm.scene.physics import GRAVITY_M_S2
from tests.worker.simulate.physics.rods import RADIUS_M, WEIGHTLESS, line, rod, shapes
from worker.simulate.checks.measure import Gate, measure
from worker.simulate.rod.model import Surroundings
from worker.simulate.rod.simulation import RodSimulation

STEPS_PER_S = 500

FAST = pytest.mark.parametrize("speed_m_s", [5.0, 10.0])


@FAST
@pytest.mark.parametrize("modulus", [1e6, 1e8])
@pytest.mark.parametrize("angle_deg", [90, 30])
@pytest.mark.parametrize("shift_m", [0.0, 0.0023])
def test_rods_fired_at_each_other_do_not_pass_through(
    shift_m: float, angle_deg: float, modulus: float, speed_m_s: float
) -> None:
    """The order of a crossing never changes while both rods are there, however u h compares with the radius."""
    along = 0.1 * np.array([np.cos(np.radians(angle_deg)), np.sin(np.radians(angle_deg)), 0])
    low = rod(line((-0.1, 0, 1), (0.1, 0, 1), 40), modulus_pa=modulus)
    centre = np.array([shift_m, 0, 1.05])
    high = rod(line(centre - along, centre + along, 40), modulus_pa=modulus)
    simulation = RodSimulation([low, high], WEIGHTLESS, steps_per_s=STEPS_PER_S)
    simulation.set_velocities(0, np.tile([0, 0, speed_m_s], (41, 1)))
    simulation.set_velocities(1, np.tile([0, 0, -speed_m_s], (41, 1)))
    met = False
    # They meet after 24 mm; until twice that their middles overlap in plan, and no end has come round.
    while simulation.time_s < 0.048 / speed_m_s:
        simulation.advance(1)
        met = met or bool(simulation.contact_force_n(1, 0)[2] > 0)
        assert Gate.CABLE_PASS_THROUGH.on_target(measure(shapes(simulation, [low, high])).pass_throughs)
    assert met


@pytest.mark.parametrize("weights", [10, 100])
def test_no_force_takes_a_rod_from_rest_through_another(weights: int) -> None:
    """It hangs over a fixed rod six radii below; its weight alone moves it by g h^2 = 4 radii in a step."""
    low = rod(line((0, -0.1, 1), (0, 0.1, 1), 40), pinned=range(41))
    high = rod(line((-0.1, 0, 1 + 6 * RADIUS_M), (0.1, 0, 1 + 6 * RADIUS_M), 40))
    pull = np.tile([0, 0, -weights * GRAVITY_M_S2 * high.mass_per_length_kg_m * high.segment_length_m], (41, 1))
    simulation = RodSimulation([low, replace(high, pull_n=pull)], WEIGHTLESS, steps_per_s=50)
    simulation.advance(20)
    assert simulation.nodes_m(1)[20, 2] > 1 + RADIUS_M


@FAST
@pytest.mark.parametrize("modulus", [1e6, 1e8])
@pytest.mark.parametrize("slope_deg", [0, 30, 90])
def test_a_rod_fired_at_the_floor_does_not_pass_through(slope_deg: float, modulus: float, speed_m_s: float) -> None:
    """No node's z, that of the axis, is ever below 0: level, slanting or with an end first."""
    rise, run = 0.1 * np.sin(np.radians(slope_deg)), 0.1 * np.cos(np.radians(slope_deg))
    # The least lean makes an upright rod fall to a side, as any real one does.
    fired = rod(line((0, 0, 0.03), (run + 1e-4, 0, 0.03 + rise), 20), modulus_pa=modulus)
    surroundings = Surroundings(damping_s=0.003)
    simulation = RodSimulation([fired], surroundings, steps_per_s=STEPS_PER_S)
    simulation.set_velocities(0, np.tile([0, 0, -speed_m_s], (21, 1)))
    while simulation.time_s < 0.1:
        simulation.advance(1)
        assert simulation.nodes_m(0)[:, 2].min() > 0
