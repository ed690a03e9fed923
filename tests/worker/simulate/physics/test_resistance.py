"""Dry resistance: a share R of the weight that opposes the motion of a rod in contact."""

from dataclasses import replace

import numpy as np
import pytest

from benchmarks.physics.closed_forms import euler_fall_m
from tests.worker.simulate.physics.rods import GRAVITY_M_S2, IN_THE_AIR, RADIUS_M, line, masses_kg, rod
from worker.simulate.rod.model import Surroundings
from worker.simulate.rod.simulation import RodSimulation

STEPS_PER_S = 1000
STEP_S = 1 / STEPS_PER_S


def test_it_leaves_a_rod_alone_that_touches_nothing() -> None:
    """A rod that touches nothing falls g t^2 (1 + h/t) / 2 exactly, as without resistance."""
    nodes = line((0, 0, 1), (0.2, 0, 1), 40)
    simulation = RodSimulation([rod(nodes)], Surroundings(floor=False, resistance=0.5), steps_per_s=STEPS_PER_S)
    without = RodSimulation([rod(nodes)], IN_THE_AIR, steps_per_s=STEPS_PER_S)
    simulation.advance(200)
    without.advance(200)
    assert simulation.nodes_m(0).tolist() == without.nodes_m(0).tolist()
    assert simulation.nodes_m(0) == pytest.approx(nodes - [0, 0, euler_fall_m(0.2, STEP_S, GRAVITY_M_S2)], abs=1e-9)


def sliding(speed_m_s: float, bearing: tuple[float, float, float], resistance: float) -> RodSimulation:
    """A rod that slides on a floor without friction."""
    lying = rod(line((0, 0, RADIUS_M), (0.2, 0, RADIUS_M), 40))
    simulation = RodSimulation([lying], Surroundings(friction_floor=0, resistance=resistance), steps_per_s=STEPS_PER_S)
    simulation.set_velocities(0, np.tile(speed_m_s * np.array(bearing), (41, 1)))
    return simulation


@pytest.mark.parametrize("resistance", [0.01, 0.1])
@pytest.mark.parametrize("bearing", [(1.0, 0.0, 0.0), (0.6, 0.8, 0.0)])
def test_it_slows_a_rod_that_slides_without_friction(bearing: tuple[float, float, float], resistance: float) -> None:
    """dv/dt = -R g from the second step on, as contact is known from the step before."""
    simulation = sliding(0.5, bearing, resistance)
    simulation.advance(200)
    expected = 0.5 - resistance * GRAVITY_M_S2 * 199 * STEP_S
    # The tolerance is the strain of 1e-8 to which lengths are kept.
    assert simulation.velocities_m_s(0) == pytest.approx(np.outer(np.full(41, expected), bearing), abs=1e-8)


def test_it_stops_a_rod_and_does_not_push_it_back() -> None:
    """A rod slides for v / (R g) over v^2 / (2 R g), up to a step or two at start and end, and then lies."""
    simulation = sliding(0.2, (1.0, 0.0, 0.0), 0.1)
    duration = 0.2 / (0.1 * GRAVITY_M_S2)
    simulation.advance(round(duration * STEPS_PER_S) + 2)
    assert np.abs(simulation.velocities_m_s(0)).max() < 1e-9
    assert simulation.nodes_m(0)[0, 0] == pytest.approx(0.2 * duration / 2, abs=2 * 0.2 * STEP_S)


@pytest.mark.parametrize(("share", "moves"), [(0.5, False), (2.0, True)])
def test_it_holds_a_rod_that_is_pulled_by_less_than_it(share: float, moves: bool) -> None:
    """A pull of half of R times the weight moves nothing; one of twice as much does, at R g."""
    resistance, steps = 0.05, 200
    lying = rod(line((0, 0, RADIUS_M), (0.2, 0, RADIUS_M), 40))
    pull = np.outer(masses_kg(lying), [0.0, share * resistance * GRAVITY_M_S2, 0.0])
    surroundings = Surroundings(friction_floor=0, resistance=resistance)
    simulation = RodSimulation([replace(lying, pull_n=pull)], surroundings, steps_per_s=STEPS_PER_S)
    simulation.advance(steps)
    speed = simulation.velocities_m_s(0)[:, 1]
    if moves:
        assert speed == pytest.approx(resistance * GRAVITY_M_S2 * steps * STEP_S, rel=2 / steps)
    else:
        # In the first step nothing is known to touch the rod yet.
        assert np.abs(speed).max() == 0.0
        assert simulation.nodes_m(0)[:, 1] == pytest.approx(0.0, abs=resistance * GRAVITY_M_S2 * STEP_S**2)


LENGTH_M = 0.1
DRUM_RADIUS_M = 0.005
PIVOT_M = DRUM_RADIUS_M + RADIUS_M
"""Sum of the radii, on which a rod that rocks on a drum without slipping rolls, as contacts act on axes."""

TILT = 0.05


def rocking(resistance: float) -> RodSimulation:
    """A stiff rod across the top of a drum, tilted as if it had rolled there from its balance."""
    along, out = np.array([np.cos(TILT), 0, np.sin(TILT)]), np.array([-np.sin(TILT), 0, np.cos(TILT)])
    middle = np.array([0, 0, 1]) + PIVOT_M * out + PIVOT_M * TILT * along
    nodes = line(middle - along * LENGTH_M / 2, middle + along * LENGTH_M / 2, 25)
    drum = rod(line((0, -0.01, 1), (0, 0.01, 1), 4), radius_m=DRUM_RADIUS_M, pinned=range(5))
    surroundings = Surroundings(floor=False, friction_rods=0.5, resistance=resistance)
    return RodSimulation([rod(nodes, modulus_pa=1e9), drum], surroundings, steps_per_s=STEPS_PER_S)


def tilts(simulation: RodSimulation, steps: int) -> list[float]:
    """The tilt after each of this many steps."""
    found = []
    for _ in range(steps):
        simulation.advance(1)
        ends = simulation.nodes_m(0)[[0, -1]]
        found.append(float(ends[1, 2] - ends[0, 2]) / LENGTH_M)
    return found


SWING_S = np.pi / np.sqrt(12 * GRAVITY_M_S2 * PIVOT_M) * LENGTH_M
"""Half the period of m L^2 / 12 a'' = -m g s a, with s the sum of the radii."""


def test_a_rod_that_rocks_on_another_comes_to_rest_with_it() -> None:
    """Each swing is 2 a0 smaller than the one before, with a0 = R L / (4 s), until one is below that.

    So says L^2 / 12 a'' = -g s a -+ R g L / 4, with s the sum of the radii. With R = 0.002 that is after three of 0.05,
    0.033 and 0.017. What then drives it within a0 is stopped only by the step after, so that it creeps at up to the
    tips' acceleration at a0, 12 g s a0 / L^2 L / 2 = 3/2 R g, times h.
    """
    resistance = 0.002
    stop = resistance * LENGTH_M / (4 * PIVOT_M)
    assert pytest.approx(6 * stop) == TILT
    simulation = rocking(resistance)
    steps = round(SWING_S * STEPS_PER_S)
    found = [tilts(simulation, steps)[-1] for _ in range(3)]
    assert found == pytest.approx([-(TILT - 2 * stop), TILT - 4 * stop, 0.0], abs=0.3 * stop)
    simulation.advance(100)
    assert np.abs(simulation.velocities_m_s(0)).max() < 1.1 * 1.5 * resistance * GRAVITY_M_S2 * STEP_S


def test_a_rod_that_rocks_on_another_goes_on_without_it() -> None:
    """After six swings the rod has lost exp(-w h / 2) per radian to implicit Euler, and at most 10 % to contact."""
    simulation = rocking(0.0)
    swing = round(SWING_S * STEPS_PER_S)
    simulation.advance(4 * swing)
    expected = TILT * np.exp(-np.pi / SWING_S * STEP_S / 2 * 6 * np.pi)
    assert max(tilts(simulation, round(2.2 * swing))) == pytest.approx(expected, rel=0.1)
