"""Coulomb friction: on a slope, and around a drum."""

import numpy as np
import pytest

from benchmarks.physics.closed_forms import euler_fall_m, incline_acceleration_m_s2
from tests.worker.simulate.physics.rods import GRAVITY_M_S2, RADIUS_M, line, rod
from worker.simulate.checks.measure import Gate
from worker.simulate.rod.model import Surroundings
from worker.simulate.rod.simulation import RodSimulation

FRICTION = 0.4


def on_slope(slope_rad: float, bearing_rad: float) -> RodSimulation:
    """A rod on a floor that falls away along x."""
    gravity = (GRAVITY_M_S2 * np.sin(slope_rad), 0.0, -GRAVITY_M_S2 * np.cos(slope_rad))
    end = (0.2 * np.cos(bearing_rad), 0.2 * np.sin(bearing_rad), RADIUS_M)
    lying = rod(line((0, 0, RADIUS_M), end, 40))
    surroundings = Surroundings(gravity_m_s2=gravity, friction_floor=FRICTION)
    return RodSimulation([lying], surroundings, steps_per_s=1000)


@pytest.mark.parametrize("bearing_deg", [0, 37, 90])
@pytest.mark.parametrize("excess", [1.1, 1.5, 3.0])
def test_a_rod_slips_on_a_slope_steeper_than_its_friction(excess: float, bearing_deg: float) -> None:
    """With tan a > mu it slides a t^2 (1 + h/t) / 2 with a = g (sin a - mu cos a), within 1 %, and stays on the floor.

    The 1 % is for the first contact: until the floor carries the rod in full, friction is not the whole of mu N.
    """
    slope = float(np.arctan(excess * FRICTION))
    simulation = on_slope(slope, np.radians(bearing_deg))
    before = simulation.nodes_m(0)
    simulation.advance(200)
    moved = simulation.nodes_m(0) - before
    slide = euler_fall_m(0.2, 1e-3, incline_acceleration_m_s2(slope, FRICTION, GRAVITY_M_S2))
    assert moved.mean(axis=0)[:2] == pytest.approx([slide, 0], abs=0.01 * slide)
    assert Gate.FLOOR_PENETRATION.on_target(float(-moved[:, 2].min()) / RADIUS_M)


@pytest.mark.parametrize("bearing_deg", [0, 37, 90])
@pytest.mark.parametrize("share", [0.0, 0.5, 0.9])
def test_a_rod_sticks_on_a_slope_flatter_than_its_friction(share: float, bearing_deg: float) -> None:
    """With tan a < mu the rod creeps no faster than gate 4 allows in a resting scene."""
    simulation = on_slope(float(np.arctan(share * FRICTION)), np.radians(bearing_deg))
    before = simulation.nodes_m(0)
    simulation.advance(500)
    moved = np.linalg.norm(simulation.nodes_m(0) - before, axis=1)
    assert Gate.SPEED_RMS.on_target(float(moved.max()) / 0.5 * 1000)


DRUM_RADIUS_M = 0.02
ROPE_RADIUS_M = 0.0005
SEGMENT_M = 5 * ROPE_RADIUS_M
LIGHT_SEGMENTS = 20


def rope_over_drum(pull_ratio: float, friction: float) -> RodSimulation:
    """A limp rope over half a drum; the two hanging ends are as long as the given ratio of their weights requires."""
    reach = DRUM_RADIUS_M + ROPE_RADIUS_M
    turns = round(np.pi * reach / SEGMENT_M)
    # The corners lie outside the circle, so that the chords just touch it.
    corner = reach / np.cos(np.pi / turns / 2)
    angle = np.pi - np.pi * np.arange(turns + 1) / turns
    over = np.stack([corner * np.cos(angle), np.zeros(turns + 1), 1 + corner * np.sin(angle)], axis=1)
    segment = float(np.linalg.norm(over[1] - over[0]))
    light, heavy = LIGHT_SEGMENTS, round(LIGHT_SEGMENTS * pull_ratio)
    rise, fall = segment * np.arange(light, 0, -1), segment * np.arange(1, heavy + 1)
    left = np.stack([np.full(light, -corner), np.zeros(light), 1 - rise], axis=1)
    right = np.stack([np.full(heavy, corner), np.zeros(heavy), 1 - fall], axis=1)
    rope = rod(np.concatenate([left, over, right]), radius_m=ROPE_RADIUS_M, modulus_pa=1e5)
    drum = rod(line((0, -0.08, 1), (0, 0.08, 1), 4), radius_m=DRUM_RADIUS_M, pinned=range(5))
    surroundings = Surroundings(floor=False, friction_rods=friction, damping_s=0.01)
    return RodSimulation([rope, drum], surroundings, steps_per_s=2000)


def capstan_ratio(friction: float) -> float:
    """Ratio at which the rope on the half drum is about to run: dT/dp = mu (T + w R sin p) + w R cos p.

    The angle p counts from the light side. Without the weight on the drum, w R, this is e^(mu pi).
    """
    weight_over_pull = (DRUM_RADIUS_M + ROPE_RADIUS_M) / (LIGHT_SEGMENTS * SEGMENT_M)
    grip = np.exp(friction * np.pi)
    return float(grip + 2 * friction * weight_over_pull * (grip + 1) / (1 + friction**2))


def speed_on_drum_m_s(pull_ratio: float, friction: float) -> float:
    """Mean speed of the heavy end over the last of three tenths of a second."""
    simulation = rope_over_drum(pull_ratio, friction)
    simulation.advance(400)
    before = simulation.nodes_m(0)[-1, 2]
    simulation.advance(200)
    return float(before - simulation.nodes_m(0)[-1, 2]) / 0.1


@pytest.mark.parametrize("friction", [0.2, 0.4])
def test_a_rope_around_a_drum_sticks_below_the_capstans_ratio(friction: float) -> None:
    """With T2 / T1 < e^(mu p) the rope creeps no faster than gate 4 allows the fastest node of a resting scene."""
    speed = speed_on_drum_m_s(0.7 * capstan_ratio(friction), friction)
    assert Gate.SPEED_MAX.on_target(abs(speed) * 1000)


@pytest.mark.parametrize("friction", [0.2, 0.4])
def test_a_rope_around_a_drum_runs_above_the_capstans_ratio(friction: float) -> None:
    """With T2 / T1 > e^(mu p) the excess, 0.3 T2 over the mass of both ends, accelerates it to 50 mm/s within 0.2 s."""
    speed = speed_on_drum_m_s(1.3 * capstan_ratio(friction), friction)
    assert speed > 10 * Gate.SPEED_MAX.value.target / 1000
