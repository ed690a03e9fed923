"""The listed pairs that are near in a step, and the memory of the others."""

import numpy as np
import pytest

from tests.worker.simulate.physics.rods import RADIUS_M, line, rod
from worker.curves import smooth
from worker.simulate.rod.arrays import Bodies, Integers, Motion, flatten
from worker.simulate.rod.broad_phase import Candidates, find_candidates, no_candidates
from worker.simulate.rod.curves import find_bends, find_bulge
from worker.simulate.rod.model import Array
from worker.simulate.rod.narrow_phase import find_near, find_reach

STEP_S = 1e-3


def crossed(height_m: float, speed_m_s: float = 0.0) -> tuple[Bodies, Motion]:
    """Two rods that cross at right angles; the upper one falls."""
    bodies, motion = flatten(
        [
            rod(line((-0.05, 0.0, 0.0), (0.05, 0.0, 0.0), 25)),
            rod(line((0.0, -0.05, height_m), (0.0, 0.05, height_m), 25)),
        ]
    )
    motion.v[2, 26:] = -speed_m_s
    return bodies, motion


def bends_and_bulge_m(bodies: Bodies, motion: Motion) -> tuple[Array, Array]:
    """The second derivatives of the curves and the bulge, at each node."""
    bends, bulge = np.empty(motion.x.shape), np.empty(len(bodies.owner))
    find_bends(bodies, motion.x, bends)
    find_bulge(bends, bulge)
    return bends, bulge


def looked_at(bodies: Bodies, motion: Motion) -> tuple[Candidates, Integers, Array]:
    """The list, the numbers of the near pairs, and their closest places."""
    margin = 2 * STEP_S * float(np.abs(motion.v).max()) + 0.1 * RADIUS_M
    bends, bulge = bends_and_bulge_m(bodies, motion)
    reach = np.empty(len(bodies.owner))
    find_reach(bodies, motion.v, np.zeros(3), STEP_S, margin, bulge, reach)
    before = no_candidates(len(bodies.owner))
    candidates = find_candidates(bodies, motion, np.zeros(3), STEP_S, reach, before)
    candidates.impulse[:] = 1.0
    near, at = np.empty(len(candidates.one), np.int64), np.empty((2, len(candidates.one)))
    way = np.empty((len(candidates.one), 3))
    count = find_near(bodies, motion, candidates, bends, bulge, reach, STEP_S, margin, near, at, way)
    return candidates, near[:count], at[:, :count]


@pytest.mark.parametrize(
    ("height_radii", "speed_m_s", "number"),
    [(2.05, 0.0, 1), (2.4, 0.0, 0), (2.4, 0.5, 1), (4.0, 0.5, 0), (4.0, 1.5, 1)],
)
def test_a_pair_is_near_if_it_may_touch_in_the_step(height_radii: float, speed_m_s: float, number: int) -> None:
    """Whether the middles of two crossed rods are near depends on their distance and on their closing speed."""
    candidates, near, at = looked_at(*crossed(height_radii * RADIUS_M, speed_m_s))
    middle = [k for k in near if (candidates.one[k], candidates.other[k]) == (12, 38)]
    assert len(middle) == number
    if number:
        assert at[:, near.tolist().index(middle[0])] == pytest.approx(0.5)


def test_the_others_forget_their_impulses_and_remember_their_sides() -> None:
    """Each normal points from the lower rod's segment up to the upper one's, by their sides."""
    bodies, motion = crossed(2.4 * RADIUS_M)
    candidates, near, _ = looked_at(bodies, motion)
    assert len(candidates.one) > 0
    assert len(near) == 0
    assert (candidates.impulse == 0.0).all()
    assert (candidates.normal[:, 2] < 0).all()


def test_those_near_keep_what_they_remember() -> None:
    """The impulse of the step before is the start of this step's."""
    candidates, near, _ = looked_at(*crossed(2.05 * RADIUS_M))
    assert len(near) > 0
    assert (candidates.impulse[near] == 1.0).all()
    assert (candidates.normal[near] == 0.0).all()


def arch_over_line(height_m: float) -> tuple[Bodies, Motion]:
    """A rod bent downwards by 0.4 rad per node; its lowest chord is this high over a straight one across."""
    slope = 0.4 * np.arange(-4, 5)
    edges = 0.004 * np.stack([np.cos(slope), np.zeros(9), np.sin(slope)], axis=1)
    nodes = np.concatenate([np.zeros((1, 3)), np.cumsum(edges, axis=0)])
    nodes += [0, 0, height_m] - nodes[4:6].mean(axis=0)
    return flatten([rod(nodes), rod(line((0, -0.05, 0), (0, 0.05, 0), 25))])


def test_a_pair_whose_curves_touch_is_near_though_its_chords_are_apart() -> None:
    """At 2.19 radii straight chords aren't near; at 0.4 rad a node the curve hangs 0.2 radii down."""
    height = 2.19 * RADIUS_M
    bodies, motion = arch_over_line(height)
    assert smooth(np.ascontiguousarray(motion.x[:, :10].T), 8)[:, 2].min() < 2 * RADIUS_M
    candidates, near, at = looked_at(bodies, motion)
    pairs = [(int(candidates.one[k]), int(candidates.other[k])) for k in near]
    assert (4, 22) in pairs
    assert at[:, pairs.index((4, 22))] == pytest.approx(0.5)
    # Straight rods at this distance aren't near.
    assert len(looked_at(*crossed(height))[1]) == 0
