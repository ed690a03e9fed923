"""Segments that pass through each other in a step."""

import numpy as np
import pytest

from tests.worker.simulate.physics.rods import RADIUS_M, line, rod
from worker.simulate.rod.arrays import flatten
from worker.simulate.rod.bending import operator_for
from worker.simulate.rod.contact import room_for_contacts
from worker.simulate.rod.model import Array
from worker.simulate.rod.passing import count_passes


def passes(shift_m: Array, along_m: float = 0.0, *, belongs_below: bool = False) -> int:
    """Passages of two crossed rods, the second half a radius above the first, where it belongs, and then shifted."""
    over_m = 0.5 * RADIUS_M
    bodies, motion = flatten(
        [
            rod(line((-0.01, 0.0, 0.0), (0.01, 0.0, 0.0), 5)),
            rod(line((along_m, -0.01, over_m), (along_m, 0.01, over_m), 5)),
        ]
    )
    contacts = room_for_contacts(25, operator_for(bodies, 1e-3, 0.0))
    pairs = [(i, j) for i in range(5) for j in range(6, 11)]
    contacts.segment[:] = np.array(pairs).T
    contacts.normal[:] = (0.0, 0.0, 1.0 if belongs_below else -1.0)
    end = motion.x.copy()
    end[:, 6:] += shift_m[:, None]
    return count_passes(contacts, len(pairs), motion.x, end)


@pytest.mark.parametrize(
    ("shift_radii", "number"),
    [((0.0, 0.0, -0.4), 0), ((0.0, 0.0, -0.6), 1), ((0.3, 0.2, -1.2), 1), ((0.0, 0.0, 1.0), 0), ((1.0, 0.0, 0.0), 0)],
)
def test_rods_pass_if_their_axes_change_sides(shift_radii: tuple[float, float, float], number: int) -> None:
    """A rod half a radius above another passes through it where it comes down by more, at one pair of segments."""
    assert passes(RADIUS_M * np.array(shift_radii)) == number


def test_a_rod_that_comes_down_beside_another_passes_nothing() -> None:
    """Beyond the other's end no segments cross, although their lines change sides."""
    assert passes(RADIUS_M * np.array([0.0, 0.0, -1.2]), along_m=0.0101) == 0


def test_a_rod_may_pass_to_the_side_where_it_belongs() -> None:
    """Rods that start within each other get to their sides through each other, which is no passage."""
    assert passes(RADIUS_M * np.array([0.0, 0.0, -1.2]), belongs_below=True) == 0
