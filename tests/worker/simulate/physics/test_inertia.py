"""Rods whose inertia is more than their mass, and rods that are pinned all along."""

import numpy as np
import pytest

from tests.worker.simulate.physics.rods import GRAVITY_M_S2, RADIUS_M, line, rod, shapes
from worker.simulate.checks.measure import Gate, measure
from worker.simulate.rod.arrays import flatten
from worker.simulate.rod.bending import operator_for
from worker.simulate.rod.fall import INTERNAL_DAMPING_S, REST_FASTEST_M_S, REST_RMS_M_S, REST_S
from worker.simulate.rod.model import Rod, Surroundings
from worker.simulate.rod.simulation import RodSimulation

STEPS_PER_S = 1000
HEAVY_RADII = 6.0


def heavier(one: Rod, inertia: float) -> Rod:
    """The same rod with another inertia."""
    return Rod(
        nodes_m=one.nodes_m,
        radius_m=one.radius_m,
        youngs_modulus_pa=one.youngs_modulus_pa,
        density_kg_m3=one.density_kg_m3,
        pinned=one.pinned,
        inertia=inertia,
    )


def settled(rods: list[Rod]) -> RodSimulation:
    """The rods at rest on the floor."""
    simulation = RodSimulation(
        rods, Surroundings(damping_s=INTERNAL_DAMPING_S, resistance=0.01), steps_per_s=STEPS_PER_S
    )
    assert simulation.settle(
        rms_m_s=REST_RMS_M_S, fastest_m_s=REST_FASTEST_M_S, quiet_s=REST_S, max_time_s=4.0, max_steps=20_000
    )
    return simulation


@pytest.mark.parametrize("touches_itself", [False, True])
def test_a_rod_with_more_inertia_falls_as_any_rod_does(touches_itself: bool) -> None:
    """Semi-implicit Euler: g t^2 / 2 (1 + h / t), also for a ring whose ends touch each other on the way."""
    turn = np.linspace(0.0, 1.99 * np.pi if touches_itself else np.pi, 60)
    ring = 0.02 * np.stack([np.cos(turn), np.sin(turn), np.zeros(60)], axis=1)
    simulation = RodSimulation([heavier(rod(ring), 16.0)], Surroundings(floor=False), steps_per_s=STEPS_PER_S)
    before = simulation.nodes_m(0)[:, 2].mean()
    simulation.advance(100)
    time_s = simulation.time_s
    fallen = before - simulation.nodes_m(0)[:, 2].mean()
    assert fallen == pytest.approx(GRAVITY_M_S2 * time_s**2 / 2 * (1 + 1 / STEPS_PER_S / time_s), rel=1e-3)


@pytest.mark.parametrize("inertia", [2.25, 4.0])
def test_inertia_does_not_change_where_a_thin_rod_rests_under_a_thick_one(inertia: float) -> None:
    """The thick rod rests on the thin one, which the floor carries: gate 2 and gate 3 hold, and its force is the same.

    The floor pushes the thin rod with its own weight and the share of the thick one's that it carries, whatever the
    inertia: the sum of all floor forces is the weight of both, up to the dry resistance.
    """
    thin = heavier(rod(line((-0.03, 0, RADIUS_M), (0.03, 0, RADIUS_M), 15)), inertia)
    height = (2 + HEAVY_RADII) * RADIUS_M + 0.001
    thick = rod(line((0, -0.07, height), (0.002, 0.07, height), 6), radius_m=HEAVY_RADII * RADIUS_M, modulus_pa=3e7)
    simulation = settled([thin, thick])
    figures = measure(shapes(simulation, [thin, thick]))
    assert Gate.CABLE_PENETRATION.on_target(figures.cable_penetration)
    simulation.advance(1)
    weight_n = sum(
        one.mass_per_length_kg_m * one.segment_length_m * (len(one.nodes_m) - 1) * GRAVITY_M_S2 for one in (thin, thick)
    )
    lift_n = sum(float(simulation.floor_forces_n(k)[:, 2].sum()) for k in range(2))
    assert lift_n == pytest.approx(weight_n, rel=0.05)


@pytest.mark.parametrize("pinned_first", [True, False])
def test_a_rod_rests_on_a_pinned_one_whichever_is_named_first(pinned_first: bool) -> None:
    """Their axes come to rest two radii apart, within gate 2's target."""
    bar = rod(line((-0.05, 0, 0.01), (0.05, 0, 0.01), 25), pinned=range(26))
    falling = rod(line((0, -0.05, 0.013), (0, 0.05, 0.013), 25), modulus_pa=1e8)
    rods = [bar, falling] if pinned_first else [falling, bar]
    simulation = RodSimulation(
        rods, Surroundings(floor=False, damping_s=INTERNAL_DAMPING_S, resistance=0.01), steps_per_s=STEPS_PER_S
    )
    simulation.advance(100)
    middle = simulation.nodes_m(1 if pinned_first else 0)[12:14, 2].min()
    assert middle - 0.01 == pytest.approx(2 * RADIUS_M, abs=Gate.CABLE_PENETRATION.value.target * RADIUS_M)


def test_a_thrown_rod_does_not_rest() -> None:
    """Setting velocities ends the time for which rods have been at rest, and the drift is that of the throw."""
    one = rod(line((-0.05, 0, RADIUS_M), (0.05, 0, RADIUS_M), 25))
    simulation = settled([one])
    assert np.abs(simulation.drift_m_s(0)).max() <= REST_FASTEST_M_S
    simulation.set_velocities(0, np.tile([1.0, 0.0, 0.0], (26, 1)))
    assert simulation.drift_m_s(0)[:, 0].min() == 1.0


def test_a_push_on_one_end_of_a_stiff_rod_moves_the_other() -> None:
    """A free rigid rod of mass m that is pushed at one end by J moves there at 4 J / m and at the other at -2 J / m."""
    bodies, _ = flatten([rod(line((0, 0, 0), (0.1, 0, 0), 20), modulus_pa=1e13)])
    operator = operator_for(bodies, 1e-3, 0.01)
    centre, mass = (operator.response.shape[1] - 1) // 2, float(bodies.mass.sum())
    assert operator.reach[0] == 20
    # Twenty segments in place of a line: the nodes' moment of inertia is larger by 1 / 200, their ends' weight half.
    assert operator.response[0, centre] * mass == pytest.approx(4.0, rel=0.02)
    assert operator.response[0, centre + 20] * mass == pytest.approx(-2.0, rel=0.03)


def test_a_rod_of_too_few_nodes_is_refused() -> None:
    """A contact acts on four nodes, so that three are too few."""
    with pytest.raises(ValueError, match="a rod has 3 nodes; it needs 4"):
        flatten([rod(line((0, 0, 0), (0.01, 0, 0), 2))])
