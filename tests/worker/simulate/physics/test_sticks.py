"""Sticks, rods as stiff as those of a scene, against the rigid slender rod.

The reference has the rod's own mass m, and its moment of inertia I = m L^2 / 12 (1 + 2 / n^2) about its middle, as n
segments have it. A stick does not roll: rods carry no twist, so a stick pushed across its axis slides, or stays.
"""

from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from benchmarks.physics.closed_forms import euler_fall_m, incline_acceleration_m_s2
from benchmarks.physics.gates import observed_orders
from tests.worker.simulate.physics.rods import GRAVITY_M_S2, line, masses_kg, rod
from worker.simulate.checks.measure import Gate
from worker.simulate.rod.fall import INTERNAL_DAMPING_S, STICK_YOUNGS_MODULUS_PA
from worker.simulate.rod.lengths import BALANCE_TOLERANCE_M_S
from worker.simulate.rod.model import Array, Rod, Surroundings
from worker.simulate.rod.simulation import RodSimulation

STICK_RADIUS_M = 0.003
STICK_LENGTH_M = 0.144
HALF_M = STICK_LENGTH_M / 2


def stick(middle: tuple[float, float, float], tilt_rad: float = 0.0, segments: int = 12) -> Rod:
    """A stick of 6 mm by 144 mm in the x-z plane whose end of greater x is higher, if tilted."""
    along = np.array([np.cos(tilt_rad), 0, np.sin(tilt_rad)])
    nodes = line(np.array(middle) - along * HALF_M, np.array(middle) + along * HALF_M, segments)
    return rod(nodes, radius_m=STICK_RADIUS_M, modulus_pa=STICK_YOUNGS_MODULUS_PA, density_kg_m3=1000.0)


def inertia(one: Rod) -> tuple[float, float]:
    """Mass of a straight rod, and its moment of inertia about its middle."""
    mass = masses_kg(one)
    away = np.linalg.norm(one.nodes_m - one.nodes_m.mean(axis=0), axis=1)
    return float(mass.sum()), float(mass @ away**2)


def tilt_of(simulation: RodSimulation) -> float:
    """Angle of the first rod's chord to the floor."""
    chord = simulation.nodes_m(0)[-1] - simulation.nodes_m(0)[0]
    return float(np.arctan2(chord[2], chord[0]))


def motion(simulation: RodSimulation, one: Rod) -> tuple[Array, float]:
    """Velocity of the first rod's middle, and its rate of turning about -y, at which its tilt grows."""
    mass, nodes, velocities = masses_kg(one), simulation.nodes_m(0), simulation.velocities_m_s(0)
    centre, velocity = mass @ nodes / mass.sum(), mass @ velocities / mass.sum()
    momentum = (mass[:, None] * np.cross(nodes - centre, velocities - velocity)).sum(axis=0)
    return velocity, -float(momentum[1]) / inertia(one)[1]


def euler_turn_rad(rate_rad_s: float, step_s: float, steps: int) -> float:
    """The angle by which implicit Euler turns a rigid rod about its middle.

    A step turns it by a. Tension acts along the mean of the directions before and after, so it leaves the part of the
    velocity across that mean: sin(a' / 2) = sin(a / 2) cos((a + a') / 2), and tan(a / 2) = w h / 2 in the first step.
    """
    turn = 2 * np.arctan(rate_rad_s * step_s / 2)
    total = turn
    for _ in range(steps - 1):
        last = turn
        turn = brentq(lambda a, b=last: np.sin(a / 2) - np.sin(b / 2) * np.cos((a + b) / 2), 0, 2 * last, xtol=1e-16)
        total += turn
    return float(total)


@pytest.mark.parametrize("steps_per_s", [1000, 4000])
@pytest.mark.parametrize("rate_rad_s", [5.0, 20.0])
def test_a_stick_that_spins_falls_as_a_rigid_rod(rate_rad_s: float, steps_per_s: int) -> None:
    """Its middle falls g t^2 (1 + h/t) / 2, it turns as implicit Euler turns a rigid rod, and it stays straight.

    The turn differs from w t by w^3 t^2 h / 4 in the first place. The solver leaves a node's velocity out of balance by
    up to 2e-6 m/s in each step: over n steps the tips may lag by n times that.
    """
    one = stick((0, 0, 1), 0.3)
    simulation = RodSimulation([one], Surroundings(floor=False, damping_s=INTERNAL_DAMPING_S), steps_per_s=steps_per_s)
    start = one.nodes_m.mean(axis=0)
    velocity = np.array([0.2, 0.1, 0.5])
    spin: Array = rate_rad_s * np.cross(np.array([0.0, -1.0, 0.0]), one.nodes_m - start).astype(np.float64)
    simulation.set_velocities(0, velocity + spin)
    time_s, tilts = 0.15, [0.3]
    for _ in range(round(time_s * steps_per_s)):
        simulation.advance(1)
        tilts.append(tilt_of(simulation))
    turned, steps = float(np.ptp(np.unwrap(tilts))), len(tilts) - 1
    lag_rad = steps * BALANCE_TOLERANCE_M_S * time_s / HALF_M
    assert turned == pytest.approx(euler_turn_rad(rate_rad_s, 1 / steps_per_s, steps), abs=lag_rad)
    assert turned == pytest.approx(rate_rad_s * time_s, abs=rate_rad_s**3 * time_s**2 / steps_per_s / 4 + lag_rad)
    nodes = simulation.nodes_m(0)
    drop = [0, 0, euler_fall_m(time_s, 1 / steps_per_s, GRAVITY_M_S2)]
    # Impulses within a rod sum to zero, so its middle moves exactly, up to rounding.
    assert masses_kg(one) @ nodes / inertia(one)[0] == pytest.approx(start + velocity * time_s - drop, abs=1e-9)
    assert nodes == pytest.approx(np.linspace(nodes[0], nodes[-1], len(nodes)), abs=1e-9)


FREE_ROOTS = (4.7300, 7.8532, 10.9956, 14.1372)
"""First roots b of cos(b) cosh(b) = 1; a free beam's frequencies are b^2 sqrt(EI / (rho A)) / L^2."""


def give_of_bending(one: Rod, damping_s: float, step_s: float) -> float:
    """Velocity that bending adds to that of a rigid rod's end when a step pushes it, as a share of the latter.

    A mode moves an end by 2 / sqrt(m) of its amplitude, and a step of implicit Euler divides its answer by
    1 + h (h + tau) w^2; the rigid rod's two motions across add up to 4 / m.
    """
    speed = np.sqrt(one.bending_stiffness_n_m2 / one.mass_per_length_kg_m)
    frequencies = np.array(FREE_ROOTS) ** 2 * speed / STICK_LENGTH_M**2
    return float(np.sum(1 / (1 + step_s * (step_s + damping_s) * frequencies**2)))


@pytest.mark.parametrize("damping_s", [INTERNAL_DAMPING_S, 1.0])
@pytest.mark.parametrize("tilt_rad", [0.2, 0.6, 1.0, 1.4])
@pytest.mark.parametrize(("speed_m_s", "steps_per_s"), [(0.3, 1000), (0.3, 8000), (1.0, 8000)])
def test_a_stick_that_lands_on_one_end_turns(
    speed_m_s: float, steps_per_s: int, tilt_rad: float, damping_s: float
) -> None:
    """A plastic impact J = m v / (1 + m a^2 cos^2(q) / I), a = L/2, leaves the speeds v - J/m and w = J a cos(q) / I.

    That is J = m v / (1 + 3 cos^2 q) and w = 6 v cos(q) / (L (1 + 3 cos^2 q)) for a slender rod. Nothing rubs, and
    there is no weight, so the end leaves the floor at once, and what is measured does not change any more. The impact
    takes up to two steps, in which the stick turns by w h each; and bending gives way by a share that is known.
    """
    gap_m = 0.0005
    one = stick((0, 0, STICK_RADIUS_M + HALF_M * np.sin(tilt_rad) + gap_m), tilt_rad)
    surroundings = Surroundings(gravity_m_s2=(0, 0, 0), friction_floor=0, damping_s=damping_s)
    simulation = RodSimulation([one], surroundings, steps_per_s=steps_per_s)
    simulation.set_velocities(0, np.tile([0, 0, -speed_m_s], (len(one.nodes_m), 1)))
    mass, moment = inertia(one)

    def impact(tilt: float) -> Array:
        arm = HALF_M * np.cos(tilt)
        impulse = mass * speed_m_s / (1 + mass * arm**2 / moment)
        return np.array([impulse / mass, impulse * arm / moment])

    lift, rate = impact(tilt_rad)
    while simulation.time_s < gap_m / speed_m_s + 0.005:
        simulation.advance(1)
    velocity, turning = motion(simulation, one)
    turn = 2 * rate / steps_per_s
    late = np.abs(impact(tilt_rad + turn) - impact(tilt_rad))
    give = give_of_bending(one, damping_s, 1 / steps_per_s)
    tolerance = late + give * np.array([lift, rate])
    assert velocity[2] == pytest.approx(lift - speed_m_s, abs=tolerance[0])
    assert turning == pytest.approx(-rate, abs=tolerance[1])
    assert np.abs(velocity[:2]).max() < 1e-9
    assert simulation.nodes_m(0)[0, 2] > STICK_RADIUS_M


def tilt_after(rates: Callable[[float, Array], list[float]], tilt_rad: float, time_s: float) -> float:
    """Integrate a tilt that starts at rest, from the rates of it and of its speed."""
    found = solve_ivp(rates, (0.0, time_s), [tilt_rad, 0.0], rtol=1e-10, atol=1e-12)
    return float(found.y[0, -1])


@pytest.mark.parametrize(("tilt_rad", "time_s"), [(0.3, 0.068), (0.8, 0.120), (1.3, 0.170)])
def test_a_stick_that_stands_on_one_end_falls_over(tilt_rad: float, time_s: float) -> None:
    """The tilt obeys (I + m a^2 cos^2 q) q'' = m a^2 sin q cos q q'^2 - m g a cos q, and the middle falls straight.

    The floor is without friction, and the time ends just before the stick lies. Implicit Euler's error halves with h,
    within gate 8.
    """
    one = stick((0, 0, STICK_RADIUS_M + HALF_M * np.sin(tilt_rad)), tilt_rad)
    mass, moment = inertia(one)

    def rates(_: float, state: Array) -> list[float]:
        tilt, speed = float(state[0]), float(state[1])
        arm = HALF_M * np.cos(tilt)
        push = mass * arm * (HALF_M * np.sin(tilt) * speed**2 - GRAVITY_M_S2)
        return [speed, push / (moment + mass * arm**2)]

    expected, errors = tilt_after(rates, tilt_rad, time_s), []
    for steps_per_s in (1000, 2000, 4000):
        surroundings = Surroundings(friction_floor=0, damping_s=INTERNAL_DAMPING_S)
        simulation = RodSimulation([one], surroundings, steps_per_s=steps_per_s)
        simulation.advance(round(time_s * steps_per_s))
        assert simulation.time_s == pytest.approx(time_s)
        errors.append(abs(tilt_of(simulation) - expected))
        assert masses_kg(one) @ simulation.nodes_m(0)[:, :2] == pytest.approx([0, 0], abs=1e-9 * mass)
        assert simulation.nodes_m(0)[0, 2] == pytest.approx(STICK_RADIUS_M, rel=Gate.FLOOR_PENETRATION.value.target)
    assert all(Gate.ORDER.on_target(order) for order in observed_orders((errors[0], errors[1], errors[2])))
    assert errors[-1] < 0.01 * tilt_rad


DRUM_RADIUS_M = 0.004


@pytest.mark.parametrize("beyond_m", [0.003, 0.01, 0.02])
def test_a_stick_across_another_tips_to_its_longer_side(beyond_m: float) -> None:
    """With its middle d beyond the drum a stick rolls on it by (I + m b^2) q'' = m b (s q'^2 + g cos q), b = d - s q.

    s is the sum of the radii, on which contacts act. Implicit Euler's error halves with h, within gate 8.
    """
    pivot_m = STICK_RADIUS_M + DRUM_RADIUS_M
    one = stick((beyond_m, 0, 1 + pivot_m), segments=24)
    drum = rod(line((0, -0.02, 1), (0, 0.02, 1), 4), radius_m=DRUM_RADIUS_M, pinned=range(5))
    mass, moment = inertia(one)

    def rates(_: float, state: Array) -> list[float]:
        tilt, speed = float(state[0]), float(state[1])
        arm = beyond_m - pivot_m * tilt
        push = mass * arm * (pivot_m * speed**2 + GRAVITY_M_S2 * np.cos(tilt))
        return [speed, push / (moment + mass * arm**2)]

    expected, errors = tilt_after(rates, 0.0, 0.1), []
    for steps_per_s in (1000, 2000, 4000):
        surroundings = Surroundings(floor=False, friction_rods=1.0, damping_s=INTERNAL_DAMPING_S)
        simulation = RodSimulation([one, drum], surroundings, steps_per_s=steps_per_s)
        simulation.advance(round(0.1 * steps_per_s))
        errors.append(abs(-tilt_of(simulation) - expected))
    assert all(Gate.ORDER.on_target(order) for order in observed_orders((errors[0], errors[1], errors[2])))
    assert errors[-1] < 0.01 * expected


@pytest.mark.parametrize("excess", [0.5, 2.0])
def test_a_stick_across_a_slope_does_not_roll(excess: float) -> None:
    """It lies if tan a < mu and else slides by g (sin a - mu cos a); a solid stick would roll down by 2/3 g sin a.

    The 1 % is for the first contact: until the floor carries the stick in full, friction is not the whole of mu N.
    """
    friction = 0.4
    slope = float(np.arctan(excess * friction))
    gravity = (0.0, GRAVITY_M_S2 * np.sin(slope), -GRAVITY_M_S2 * np.cos(slope))
    surroundings = Surroundings(gravity_m_s2=gravity, friction_floor=friction, damping_s=INTERNAL_DAMPING_S)
    simulation = RodSimulation([stick((0, 0, STICK_RADIUS_M))], surroundings, steps_per_s=1000)
    simulation.advance(200)
    slide = euler_fall_m(0.2, 1e-3, incline_acceleration_m_s2(slope, friction, GRAVITY_M_S2))
    rolled = euler_fall_m(0.2, 1e-3, 2 / 3 * GRAVITY_M_S2 * np.sin(slope))
    assert simulation.nodes_m(0)[:, 1] == pytest.approx(slide, abs=0.01 * rolled)
