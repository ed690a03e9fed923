"""The nodes that the floor may touch, and the speed at which they must rise."""

import numpy as np
import pytest

from tests.worker.simulate.physics.rods import RADIUS_M, line, rod
from worker.curves import smooth
from worker.simulate.rod.arrays import flatten
from worker.simulate.rod.contact import SLOP_RADII, UNDOING_S
from worker.simulate.rod.curves import find_bends
from worker.simulate.rod.floor import NEAR_FLOOR_RADII, find_near_floor
from worker.simulate.rod.model import Array

STEP_S = 1e-3


def near_floor(heights_m: Array) -> tuple[list[int], Array]:
    """The near nodes of a rod at rest with nodes at these heights, and the least speed at which all must rise."""
    bodies, motion = flatten([rod(line((0, 0, 0), (0.004 * (len(heights_m) - 1), 0, 0), len(heights_m) - 1))])
    motion.x[2] = heights_m
    touching, rise = np.empty(len(heights_m), np.int64), np.empty(len(heights_m))
    bends = np.empty(motion.x.shape)
    find_bends(bodies, motion.x, bends)
    count = find_near_floor(bodies, motion, bends, STEP_S, 0.4, touching, rise)
    return touching[:count].tolist(), rise


def test_nodes_close_to_the_floor_are_near() -> None:
    """At rest, a node is near if the rod's lowest point there is within a share of the radius of the floor."""
    heights = RADIUS_M * (1 + NEAR_FLOOR_RADII * np.array([0.0, 0.5, 0.9, 1.5, 2.1, 2.7]))
    touching, rise = near_floor(heights)
    assert touching == [0, 1, 2]
    # Moving nodes may close the gap within the step.
    assert rise[:3] == pytest.approx((RADIUS_M - heights[:3]) / STEP_S)


@pytest.mark.parametrize("lift_radii", [0.1, 0.5, 1.0])
def test_a_curve_that_dips_between_nodes_lifts_them(lift_radii: float) -> None:
    """Both ends of the segment before a raised node rise at depth / tau, beyond the slop.

    The depth is looked for at quarters of the segment, which misses less than a tenth of it.
    """
    heights = RADIUS_M * np.array([1.0, 1.0, 1.0, 1.0, 1.0 + lift_radii, 1.0 + 2 * lift_radii])
    _, rise = near_floor(heights)
    dip = RADIUS_M - smooth(np.stack([np.arange(6), np.zeros(6), heights], axis=1), 300)[:, 2].min()
    assert dip > 0.05 * lift_radii * RADIUS_M
    assert rise[2:4] * UNDOING_S + SLOP_RADII * RADIUS_M == pytest.approx(dip, rel=0.1)


def test_a_straight_rod_on_the_floor_is_left_as_it_is() -> None:
    """The curve of a straight rod dips nowhere, so no node is lifted."""
    touching, rise = near_floor(np.full(6, RADIUS_M))
    assert touching == list(range(6))
    assert rise.tolist() == [0.0] * 6
