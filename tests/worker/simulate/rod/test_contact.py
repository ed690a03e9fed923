"""The contacts of a step: the directions in which rods that start within each other are parted."""

import numpy as np
import pytest

from tests.worker.simulate.physics.rods import RADIUS_M, line, rod
from worker.simulate.rod.arrays import flatten
from worker.simulate.rod.bending import operator_for
from worker.simulate.rod.broad_phase import find_candidates, no_candidates
from worker.simulate.rod.contact import gather_contacts, room_for_contacts
from worker.simulate.rod.curves import find_bends, find_bulge
from worker.simulate.rod.march import room_for_step
from worker.simulate.rod.model import Array, Rod
from worker.simulate.rod.narrow_phase import find_reach

STEP_S = 1e-3
MARGIN_M = 0.1 * RADIUS_M


def normals_and_approaches(rods: list[Rod], known: Array | None = None) -> tuple[Array, Array]:
    """Normals (n, 3) and approaches (n,) of all contacts at rest; `known` is the last direction to the first rod."""
    bodies, motion = flatten(rods)
    scratch = room_for_step(len(bodies.owner))
    find_bends(bodies, motion.x, scratch.bends)
    find_bulge(scratch.bends, scratch.bulge)
    find_reach(bodies, motion.v, np.zeros(3), STEP_S, MARGIN_M, scratch.bulge, scratch.reach)
    before = no_candidates(len(bodies.owner))
    candidates = find_candidates(bodies, motion, np.zeros(3), STEP_S, scratch.reach, before)
    if known is not None:
        candidates.normal[:] = known
    operator = operator_for(bodies, STEP_S, 0.0)
    contacts = room_for_contacts(len(candidates.one), operator)
    count = gather_contacts(bodies, operator, motion, candidates, scratch, MARGIN_M, contacts)
    return contacts.normal[:count], contacts.approach[:count]


def crossed(height_m: float) -> list[Rod]:
    """Two rods at right angles, with the second one's axis higher by this much."""
    return [rod(line((-0.05, 0, 0), (0.05, 0, 0), 25)), rod(line((0, -0.05, height_m), (0, 0.05, height_m), 25))]


@pytest.mark.parametrize(("height_radii", "up"), [(0.0, -1.0), (1.0, -1.0), (-1.0, 1.0)])
def test_rods_that_start_within_each_other_are_parted_upright(height_radii: float, up: float) -> None:
    """The higher rod goes up; of two at one height, the first goes down, as if it had always been below."""
    normals, approaches = normals_and_approaches(crossed(height_radii * RADIUS_M))
    parted = normals[approaches > 0]
    assert len(parted) > 0
    assert parted == pytest.approx(np.tile([0.0, 0.0, up], (len(parted), 1)))


def test_the_same_rod_twice_is_parted_one_way_all_along() -> None:
    """With no side of its own at any place, the first rod goes down everywhere, pushed at least once a segment."""
    one = rod(line((-0.05, 0, 0), (0.05, 0, 0), 25))
    normals, approaches = normals_and_approaches([one, one])
    assert normals == pytest.approx(np.tile([0.0, 0.0, -1.0], (len(normals), 1)))
    assert (approaches > 0).sum() >= 25
    assert (approaches[np.isfinite(approaches)] > 0).all()


def test_rods_that_have_cut_into_each_other_go_back_to_their_sides() -> None:
    """The first rod was above before: it is pushed up, although its axis is now a radius below the other's."""
    normals, approaches = normals_and_approaches(crossed(RADIUS_M), np.array([0.0, 0.0, 1.0]))
    assert normals == pytest.approx(np.tile([0.0, 0.0, 1.0], (len(normals), 1)))
    assert (approaches > 0).all()


def test_rods_that_touch_are_pushed_along_the_way_between_their_axes() -> None:
    """For two rods that cross the direction is upright, and neither needs to part."""
    normals, approaches = normals_and_approaches(crossed(2 * RADIUS_M))
    assert normals == pytest.approx(np.tile([0.0, 0.0, -1.0], (len(normals), 1)))
    assert (approaches <= 0).all()
