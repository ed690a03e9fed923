"""Starts that no drawn scene has: rods within each other, within the floor, or upright."""

from collections.abc import Callable

import numpy as np
import pytest

from benchmarks.physics.gates import StressFault, stress_fault
from farm.spec.simulation import RodFall
from tests.worker.simulate.physics.rods import RADIUS_M, curve_m, line, rod, shapes
from worker.simulate.checks.measure import Gate, measure
from worker.simulate.rod.contact import UNDOING_S
from worker.simulate.rod.fall import INTERNAL_DAMPING_S
from worker.simulate.rod.model import Rod, Surroundings
from worker.simulate.rod.simulation import RodSimulation


def overlapping() -> list[Rod]:
    """Two rods that cross with their axes half a radius apart."""
    return [
        rod(line((-0.1, 0, 0.01), (0.1, 0, 0.01), 40)),
        rod(line((0, -0.1, 0.0105), (0.01, 0.1, 0.0105), 40)),
    ]


def crossing_at_one_height() -> list[Rod]:
    """Two rods whose axes meet, so that neither side is the right one."""
    return [rod(line((-0.1, 0, 0.01), (0.1, 0, 0.01), 40)), rod(line((0, -0.1, 0.01), (0, 0.1, 0.01), 40))]


def coincident() -> list[Rod]:
    """Two rods in the same place."""
    return [rod(line((-0.1, 0, 0.01), (0.1, 0, 0.01), 40)) for _ in range(2)]


def side_by_side() -> list[Rod]:
    """Two rods that overlap by half a radius all along."""
    return [rod(line((-0.1, y, RADIUS_M), (0.1, y, RADIUS_M), 40)) for y in (0, 1.5 * RADIUS_M)]


def upright() -> list[Rod]:
    """A perfectly vertical rod on one end."""
    return [rod(line((0, 0, 0.005), (0, 0, 0.205), 40))]


def at_the_floor() -> list[Rod]:
    """A rod on the floor, and one on top of it."""
    return [
        rod(line((-0.1, 0, RADIUS_M), (0.1, 0, RADIUS_M), 40)),
        rod(line((0, -0.1, 3 * RADIUS_M), (0, 0.1, 3 * RADIUS_M), 40)),
    ]


def within_the_floor() -> list[Rod]:
    """A rod that is half sunk."""
    return [rod(line((-0.1, 0, 0), (0.1, 0, 0), 40))]


START = pytest.mark.parametrize(
    "start",
    [overlapping, crossing_at_one_height, coincident, side_by_side, upright, at_the_floor, within_the_floor],
)


@START
def test_a_bad_start_comes_to_rest_apart(start: Callable[[], list[Rod]]) -> None:
    """Positions stay finite and within reach, speeds below those of the fall, and gates 1 to 3 hold at rest.

    Whatever comes apart gains no more than m g times the depth, so no speed is above sqrt(2 g z) of the highest node.
    """
    rods = start()
    simulation = RodSimulation(rods, Surroundings(damping_s=INTERNAL_DAMPING_S), steps_per_s=RodFall().steps_per_s)
    highest = max(float(one.nodes_m[:, 2].max()) for one in rods)
    # A limp chain's free end may be faster than free fall; twice its speed bounds that and excludes an explosion.
    bound = 2 * np.sqrt(2 * 9.81 * (highest + 2 * RADIUS_M))
    # An upright rod takes a while to topple.
    for _ in range(80):
        simulation.advance(50)
        assert min(float(simulation.nodes_m(k)[:, 2].min()) for k in range(len(rods))) > 0
        assert max(float(np.abs(simulation.velocities_m_s(k)).max()) for k in range(len(rods))) < bound
    settled = shapes(simulation, rods)
    # Such a start doesn't decide which of the two comes to lie on top.
    assert stress_fault(settled, reach_m=1.0) in {None, StressFault.PASSED_THROUGH}
    figures = measure(settled)
    assert Gate.LENGTH.on_target(figures.length_error)
    assert Gate.CABLE_PENETRATION.on_target(figures.cable_penetration)
    assert Gate.FLOOR_PENETRATION.on_target(figures.floor_penetration)
    assert Gate.FLOOR_PASS_THROUGH.on_target(figures.floor_pass_throughs)


@pytest.mark.parametrize("modulus", [1e7, 1e9])
@pytest.mark.parametrize(("rise_radii", "first_on_top"), [(0.0, False), (-0.5, False), (0.5, True)])
def test_crossed_rods_within_each_other_come_to_rest_one_on_the_other(
    rise_radii: float, first_on_top: bool, modulus: float
) -> None:
    """At rest they are r + r apart, within gate 2: the higher one on top, or the second of two at one height.

    What they are deeper than the slop goes down as exp(-t / tau) with the time constant of undoing it, so half a second
    leaves nothing of it.
    """
    height = 0.01 + rise_radii * RADIUS_M
    rods = [
        rod(line((-0.1, 0, height), (0.1, 0, height), 40), modulus_pa=modulus),
        rod(line((0, -0.1, 0.01), (0, 0.1, 0.01), 40), modulus_pa=modulus),
    ]
    simulation = RodSimulation(rods, Surroundings(damping_s=INTERNAL_DAMPING_S), steps_per_s=RodFall().steps_per_s)
    simulation.advance(round(15 * UNDOING_S * RodFall().steps_per_s))
    one, other = (curve_m(simulation.nodes_m(k), 32) for k in range(2))
    ways = one[:, None] - other[None]
    distances = np.linalg.norm(ways, axis=2)
    closest = np.unravel_index(distances.argmin(), distances.shape)
    assert distances[closest] == pytest.approx(2 * RADIUS_M, abs=Gate.CABLE_PENETRATION.value.target * RADIUS_M)
    assert (ways[closest][2] > 0) is np.bool_(first_on_top)
    assert max(np.abs(simulation.velocities_m_s(k)).max() for k in range(2)) * 1000 < Gate.SPEED_MAX.value.target
