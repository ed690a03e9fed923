"""Curved rods without natural curvature that are let go in weightless space: they straighten.

References: the chain of rigid links of `planar_chain`, and the free end of a long rod that was bent to a curvature k.
With c = sqrt(EI / (rho A)) the linear beam's y'''' c^2 = -y'' (in time) has a solution of s / sqrt(c t) alone: the
curvature is 2 k S(s / sqrt(2 pi c t)), S Fresnel's sine integral, so that it overshoots to 1.428 k (Audoly and
Neukirch 2005, "Fragmentation of rods by cascading cracks: why spaghetti does not break in half"). Integrated twice over
s, it says that the end leaves at the constant speed k c.
"""

import numpy as np
import pytest
from scipy.special import fresnel

from benchmarks.physics.gates import energy_rise, observed_orders
from tests.worker.simulate.physics.planar_chain import PlanarChain
from tests.worker.simulate.physics.rods import RADIUS_M, WEIGHTLESS, line, masses_kg, rod
from worker.simulate.checks.measure import Gate
from worker.simulate.rod.fall import INTERNAL_DAMPING_S
from worker.simulate.rod.model import Array, Rod, Surroundings
from worker.simulate.rod.simulation import RodSimulation


def weightless(damping_s: float) -> Surroundings:
    """Weightless space, for rods with internal damping."""
    return Surroundings(gravity_m_s2=(0.0, 0.0, 0.0), floor=False, damping_s=damping_s)


def arc(turn_rad: float, length_m: float, segments: int, damping_s: float = 0.0) -> tuple[Rod, PlanarChain, Array]:
    """A rod bent to an arc that turns by an angle, the chain that it is, and the bearings of its segments."""
    straight = rod(line((0, 0, 0), (length_m, 0, 0), segments))
    chain = PlanarChain(masses_kg(straight), straight.segment_length_m, straight.bending_stiffness_n_m2, damping_s)
    bearings = np.linspace(-turn_rad / 2, turn_rad / 2, segments)
    return rod(np.column_stack([chain.nodes_m(bearings), np.zeros(segments + 1)])), chain, bearings


def bending_speed_m2_s(one: Rod) -> float:
    """The c of sqrt(EI / (rho A)); a bend takes the time w^2 / c to spread over a width w."""
    return float(np.sqrt(one.bending_stiffness_n_m2 / one.mass_per_length_kg_m))


TURNS = pytest.mark.parametrize("turn_rad", [1.0, 5.5])
"""From a bend to nearly a closed ring."""


@TURNS
def test_an_arc_let_go_accelerates_as_the_chain(turn_rad: float) -> None:
    """The first step's velocity over h is the chain's acceleration, up to (w h)^2 for the fastest mode, w = 4 c / l^2.

    Implicit Euler divides a mode's acceleration by 1 + (w h)^2.
    """
    bent, chain, bearings = arc(turn_rad, 0.2, 24)
    ratio = 0.01
    fastest_rad_s = 4 * bending_speed_m2_s(bent) / bent.segment_length_m**2
    simulation = RodSimulation([bent], WEIGHTLESS, steps_per_s=fastest_rad_s / ratio)
    simulation.advance(1)
    found = simulation.velocities_m_s(0) / simulation.time_s
    expected = chain.node_accelerations_m_s2(bearings)
    assert found[:, :2] == pytest.approx(expected, abs=ratio**2 * float(np.abs(expected).max()))
    assert not found[:, 2].any()


@TURNS
def test_an_arc_let_go_straightens_as_the_chain(turn_rad: float) -> None:
    """The distance to the chain halves with h, within gate 8: all that differs is implicit Euler's first-order error.

    The damping is that of falls: modes that no step resolves die out, in the chain as in the rod. By then the ring
    has moved by more than thirty radii.
    """
    bent, chain, bearings = arc(turn_rad, 0.2, 16, INTERNAL_DAMPING_S)
    time_s = 0.05
    expected = chain.nodes_m(chain.bearings_after(bearings, time_s))
    errors = []
    for steps_per_s in (2000, 4000, 8000):
        simulation = RodSimulation([bent], weightless(INTERNAL_DAMPING_S), steps_per_s=steps_per_s)
        simulation.advance(round(time_s * steps_per_s))
        assert simulation.time_s == pytest.approx(time_s)
        errors.append(float(np.linalg.norm(simulation.nodes_m(0)[:, :2] - expected, axis=1).max()))
    coarse, middle, fine = errors
    assert all(Gate.ORDER.on_target(order) for order in observed_orders((coarse, middle, fine)))
    assert fine < 0.01 * float(np.abs(expected - bent.nodes_m[:, :2]).max())


FREE_LENGTH_M = 0.4
WAVES = 16
"""Length of the rod over sqrt(c t) when its ends are looked at: neither has heard of the other yet."""


def released(segments: int, steps: int) -> tuple[RodSimulation, Rod, float, float]:
    """A slightly curved rod after t = (L / 16)^2 / c, its curvature k at the start, and sqrt(c t)."""
    turn = 0.05
    bent, _, _ = arc(turn, FREE_LENGTH_M, segments)
    spread_m = FREE_LENGTH_M / WAVES
    time_s = spread_m**2 / bending_speed_m2_s(bent)
    simulation = RodSimulation([bent], WEIGHTLESS, steps_per_s=steps / time_s)
    simulation.advance(steps)
    return simulation, bent, turn / (segments - 1) / bent.segment_length_m, spread_m


def test_a_free_end_leaves_at_constant_speed() -> None:
    """The end moves by k c t at k c, off by less than l^2 / (c t) and of second order in the segment length l."""
    errors = []
    for segments in (50, 100, 200):
        simulation, bent, curvature, spread_m = released(segments, 125)
        off = (bent.segment_length_m / spread_m) ** 2
        moved_m = float(np.linalg.norm(simulation.nodes_m(0)[0] - bent.nodes_m[0]))
        speed_m_s = float(np.linalg.norm(simulation.velocities_m_s(0)[0]))
        assert moved_m == pytest.approx(curvature * spread_m**2, rel=off)
        assert speed_m_s == pytest.approx(curvature * bending_speed_m2_s(bent), rel=off)
        errors.append(abs(moved_m / (curvature * spread_m**2) - 1))
    # The next term is of fourth order, so it changes a ratio by the square of the coarsest spacing at most, 10 %.
    assert observed_orders((errors[0], errors[1], errors[2])) == pytest.approx((2.0, 2.0), abs=np.log2(1.1))


@pytest.mark.parametrize(("segments", "steps"), [(50, 250), (100, 125), (100, 250)])
def test_the_curvature_near_a_free_end_is_the_self_similar_one(segments: int, steps: int) -> None:
    """The curvature is 2 k S(s / sqrt(2 pi c t)) up to its peak of 1.428 k at s^2 = 4 pi c t.

    There the wave has turned by a phase of pi, so its frequency is pi / t and its wave number squared q^2 = pi / (c t).
    Implicit Euler takes w^2 h t / 2 = pi^2 h / 2t of it; the nodes delay it by w t (q l)^2 / 12 = pi^2 l^2 / (12 c t).
    """
    simulation, bent, curvature, spread_m = released(segments, steps)
    edges = np.diff(simulation.nodes_m(0)[:, :2], axis=0)
    found = np.diff(np.arctan2(edges[:, 1], edges[:, 0])) / bent.segment_length_m / curvature
    place = bent.segment_length_m * np.arange(1, segments) / spread_m
    reference = 2 * fresnel(place / np.sqrt(2 * np.pi))[0]
    wave = place <= 2 * np.sqrt(np.pi) + bent.segment_length_m / spread_m
    tolerance = np.pi**2 / (2 * steps) + np.pi**2 / 12 * (bent.segment_length_m / spread_m) ** 2
    assert found[wave] == pytest.approx(reference[wave], abs=tolerance)
    assert reference[wave].max() == pytest.approx(1.428, abs=1e-2)


def helix(radius_m: float, pitch_m: float, turns: float, segment_m: float) -> Array:
    """Nodes of a coil that rises along z."""
    segments = round(turns * float(np.hypot(2 * np.pi * radius_m, pitch_m)) / segment_m)
    angle = np.linspace(0, turns * 2 * np.pi, segments + 1)
    nodes: Array = np.column_stack([radius_m * np.cos(angle), radius_m * np.sin(angle), pitch_m * angle / (2 * np.pi)])
    return nodes


@pytest.mark.parametrize("damping_s", [0.0, INTERNAL_DAMPING_S, 0.05])
@pytest.mark.parametrize(("radii", "pitch_radii"), [(8, 6), (8, 16), (12, 12)])
def test_a_coil_let_go_loses_the_energy_that_damping_takes(radii: float, pitch_radii: float, damping_s: float) -> None:
    """KE + bending changes in each step by -(h tau + h^2 / 2) w K w - (w - v) M (w - v) / 2, within gate 7.

    v and w are the velocities before and after the step. The first term is internal damping; the rest is what implicit
    Euler takes of a quadratic energy. Tension takes nothing, and no strand touches another.
    """
    coil = rod(helix(radii * RADIUS_M, pitch_radii * RADIUS_M, 2, 4 * RADIUS_M))
    simulation = RodSimulation([coil], weightless(damping_s), steps_per_s=1000)
    mass, stiffness = masses_kg(coil)[:, None], coil.bending_stiffness_n_m2 / coil.segment_length_m**3
    energies, faults = [simulation.energy().total], []
    before = simulation.velocities_m_s(0)
    for _ in range(800):
        start_s = simulation.time_s
        simulation.advance(1)
        step_s, after = simulation.time_s - start_s, simulation.velocities_m_s(0)
        damped = step_s * (damping_s + step_s / 2) * stiffness * float(np.sum(np.diff(after, n=2, axis=0) ** 2))
        damped += float(np.sum(mass * (after - before) ** 2)) / 2
        energies.append(simulation.energy().total)
        faults.append(abs(energies[-1] - energies[-2] + damped) / energies[0])
        before = after
    assert simulation.counts["contacts"] == 0
    assert Gate.ENERGY_RISE.on_target(max(faults))
    assert Gate.ENERGY_RISE.on_target(energy_rise(np.array(energies)))


@pytest.mark.parametrize(("radii", "pitch_radii"), [(8, 6), (8, 16), (12, 12)])
def test_a_coil_let_go_ends_straight(radii: float, pitch_radii: float) -> None:
    """Less than exp(-t / tau) of the energy of bending is left, and the ends are the length apart.

    A mode of a nearly straight rod decays as exp(-w^2 tau t / 2), or creeps back as exp(-t / tau) or faster if w tau is
    above 2. The slowest one, w = 22.37 c / L^2, has w tau above sqrt(2), so all do it as fast as exp(-t / tau), and
    their energy as its square. Half of the time is left for the coil to unwind.
    """
    damping_s, time_s = 0.05, 1.2
    coil = rod(helix(radii * RADIUS_M, pitch_radii * RADIUS_M, 2, 4 * RADIUS_M))
    length_m = coil.segment_length_m * (len(coil.nodes_m) - 1)
    assert 22.37 * bending_speed_m2_s(coil) / length_m**2 * damping_s > np.sqrt(2)
    simulation = RodSimulation([coil], weightless(damping_s), steps_per_s=1000)
    start = simulation.energy().bending
    while simulation.time_s < time_s:
        simulation.advance(1)
    assert simulation.energy().bending < np.exp(-time_s / damping_s) * start
    span_m = float(np.linalg.norm(simulation.nodes_m(0)[-1] - simulation.nodes_m(0)[0]))
    assert span_m == pytest.approx(length_m, rel=1e-6)
