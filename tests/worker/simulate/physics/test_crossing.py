"""A rod that lies across a rigid ridge on the floor, against the beam that lifts off.

The reference holds for a lift much smaller than the lift-off length. It is the ridge's diameter here, 2 mm, and the
moduli are chosen so that the cable lifts off over 23 and 62 times that. Nothing rubs, as the reference knows no pull
along the cable; so a rod may slide at leisure, and what is measured is its shape and what carries it.
"""

from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from benchmarks.physics.gates import crossing_error
from benchmarks.physics.ridge import RidgeCrossing, fit_lifted
from tests.worker.simulate.physics.rods import GRAVITY_M_S2, RADIUS_M, curve_m, line, rod, weight_per_length_n_m
from worker.simulate.checks.measure import Gate
from worker.simulate.rod.contact import SLOP_RADII
from worker.simulate.rod.floor import SUNK_RADII
from worker.simulate.rod.model import Array, Rod, Surroundings
from worker.simulate.rod.simulation import RodSimulation

SOFT_PA, STIFF_PA = 2e6, 1e8
TIME_S = 3.0
AVERAGED_STEPS = 200
"""Steps over which contact forces are averaged, since they tremble by what the solver's sweeps leave open."""


def cable_over_ridge(modulus_pa: float, segment_radii: float) -> tuple[Rod, Rod, RidgeCrossing]:
    """A cable of 4.4 lift-off lengths just above a ridge that stands between two of its nodes."""
    unit = rod(line((0, 0, 0), (1, 0, 0), 4), modulus_pa=modulus_pa)
    reference = RidgeCrossing(unit.bending_stiffness_n_m2, weight_per_length_n_m(unit), 2 * RADIUS_M)
    segment = segment_radii * RADIUS_M
    half = 2.2 * reference.lift_off_m
    cable = rod(
        line((-half, 0, 3.05 * RADIUS_M), (half, 0, 3.05 * RADIUS_M), round(2 * half / segment)), modulus_pa=modulus_pa
    )
    place = 0.3 * segment
    ridge = rod(line((place, -4 * segment, RADIUS_M), (place, 4 * segment, RADIUS_M), 8), pinned=range(9))
    return cable, ridge, reference


@cache
def settled(modulus_pa: float, segment_radii: float) -> tuple[Array, NDArray[np.float64], RidgeCrossing]:
    """The resting shape, the mean upward force on each node, and the reference."""
    cable, ridge, reference = cable_over_ridge(modulus_pa, segment_radii)
    surroundings = Surroundings(friction_floor=0, friction_rods=0, damping_s=0.05)
    simulation = RodSimulation([cable, ridge], surroundings, steps_per_s=1000)
    simulation.advance(round(TIME_S * 1000) - AVERAGED_STEPS)
    reactions = np.zeros(len(cable.nodes_m))
    for _ in range(AVERAGED_STEPS):
        simulation.advance(1)
        reactions += simulation.floor_forces_n(0)[:, 2] / AVERAGED_STEPS
        on_ridge = int(np.abs(simulation.nodes_m(0)[:, 0] - ridge.nodes_m[0, 0]).argmin())
        reactions[on_ridge] += simulation.contact_force_n(0, 1)[2] / AVERAGED_STEPS
    return simulation.nodes_m(0), reactions, reference


@pytest.mark.parametrize("segment_radii", [4, 5])
@pytest.mark.parametrize("modulus", [SOFT_PA, STIFF_PA])
def test_a_rod_lifts_off_and_is_carried_as_the_beam(modulus: float, segment_radii: float) -> None:
    """Lift-off at a = (72 EI d / w)^(1/4), ridge reaction 4 w a / 3, within gate 6."""
    nodes, reactions, reference = settled(modulus, segment_radii)
    assert reference.lift_off_m > 20 * reference.lift_m
    error = crossing_error(nodes, reactions, radius_m=RADIUS_M, reference=reference)
    assert Gate.LIFT_OFF.on_target(error.lift_off_error)
    assert Gate.RIDGE_REACTION.on_target(error.reaction_error)


def test_floor_and_ridge_together_carry_the_rod() -> None:
    """The vertical forces sum to the weight, up to a change of speed within gate 4's bound over the averaged time."""
    nodes, reactions, reference = settled(STIFF_PA, 4)
    weight = reference.weight_per_length_n_m * float(np.linalg.norm(np.diff(nodes, axis=0), axis=1).sum())
    change = 2 * Gate.SPEED_MAX.value.target / 1000 / (AVERAGED_STEPS / 1000) / GRAVITY_M_S2
    assert float(reactions.sum()) == pytest.approx(weight, rel=change)


def test_a_stiff_rod_bridges_where_a_soft_one_drapes() -> None:
    """The lift-off length grows with E^(1/4), within gate 6 for both moduli."""
    lengths = []
    for modulus in (SOFT_PA, STIFF_PA):
        nodes, _, _ = settled(modulus, 4)
        lengths.append(fit_lifted(nodes[:, 0], nodes[:, 2] - RADIUS_M).lift_off_m)
    assert lengths[1] / lengths[0] == pytest.approx((STIFF_PA / SOFT_PA) ** 0.25, rel=2 * Gate.LIFT_OFF.value.target)


@pytest.mark.parametrize("friction_floor", [0.0, 0.4])
@pytest.mark.parametrize("modulus", [1e5, 1e6])
def test_a_soft_rod_at_the_foot_of_its_rise_does_not_dip_below_the_floor(modulus: float, friction_floor: float) -> None:
    """The smooth curve between nodes on the floor and in the air is no deeper than the floor lets any node be.

    That is its slop and what keeping the lengths may press in, 0.006 r together, and a tenth more that is hidden from
    the floor, which looks at quarters of each segment. With these nodes on the floor itself it would be deeper.
    """
    cable = rod(line((-0.06, 0, 3.05 * RADIUS_M), (0.06, 0, 3.05 * RADIUS_M), 30), modulus_pa=modulus)
    ridge = rod(line((0.001, -0.02, RADIUS_M), (0.001, 0.02, RADIUS_M), 10), pinned=range(11))
    surroundings = Surroundings(friction_floor=friction_floor, friction_rods=0, damping_s=0.02)
    simulation = RodSimulation([cable, ridge], surroundings, steps_per_s=1000)
    simulation.advance(1000)
    nodes = simulation.nodes_m(0)
    lowest = (1 - 1.1 * (SLOP_RADII + SUNK_RADII)) * RADIUS_M
    assert curve_m(nodes, 16)[:, 2].min() > lowest
    nodes[:, 2] = np.where(nodes[:, 2] < 1.05 * RADIUS_M, RADIUS_M, nodes[:, 2])
    assert curve_m(nodes, 16)[:, 2].min() < lowest
