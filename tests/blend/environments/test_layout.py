"""Placing things in environments."""

import numpy as np
import pytest

from blend.environments.assembly import Assembly, Points
from blend.environments.layout import Piece, clutter, line_up, row_on
from blend.environments.room import Room, Style, Wall

Rng = np.random.Generator
EDGE = 0.3


def block(a: Assembly, _rng: Rng) -> None:
    """A cube."""
    a.box((0.0, 0.5 * EDGE, 0.0), (EDGE, EDGE, EDGE), "paint", (0.5, 0.5, 0.5))


PIECES = (Piece(block, EDGE, EDGE),)


def middles(a: Assembly) -> Points:
    """The middles of the cubes, (N, 3)."""
    return np.array([part.points.mean(axis=0) for part in a.parts.get("paint", [])])


@pytest.mark.parametrize("seed", range(3))
def test_a_line_fills_its_length_without_overlap(seed: int) -> None:
    """Neighbours keep their distance, and none leaves the line."""
    rng = np.random.default_rng(seed)
    a = Assembly(rng)
    line_up(a, rng, PIECES, -2.0, 2.0)
    x = middles(a)[:, 0]
    assert len(x) >= 8
    assert np.diff(x).min() > 0.98 * EDGE
    assert np.abs(x).max() < 2.0 - 0.49 * EDGE


@pytest.mark.parametrize("seed", range(3))
def test_clutter_stays_on_the_table_and_apart(seed: int) -> None:
    """Things stay on the table and apart, whatever is drawn."""
    rng = np.random.default_rng(seed)
    a = Assembly(rng)
    clutter(a, rng, PIECES, (2.0, 1.0), 0.8, density=0.9)
    place = middles(a)
    assert len(place) >= 3
    assert np.abs(place[:, 0]).max() < 1.0
    assert place[:, 1].min() > 0.0
    assert place[:, 1].max() < 1.0
    apart = np.linalg.norm(place[:, None, :2] - place[None, :, :2], axis=2) + np.eye(len(place)) * 9
    assert apart.min() > 0.85 * EDGE


def test_a_full_shelf_has_nothing_over_its_ends() -> None:
    """A thing that no longer fits on the shelf is left out."""
    rng = np.random.default_rng(0)
    a = Assembly(rng)
    row_on(a, rng, PIECES, 1.2, 0.5)
    assert np.abs(middles(a)[:, 0]).max() < 0.6 - 0.4 * EDGE


@pytest.mark.parametrize("wall", list(Wall))
def test_what_stands_along_a_wall_is_in_the_room(wall: Wall) -> None:
    """A thing along a wall stands in the room with its back to the wall."""
    room = Room(-3.0, 5.0, -2.0, 4.0, 3.0, Style("wall", (0.5,) * 3, (0.5,) * 3, "wall"))
    rng = np.random.default_rng(0)
    for u in (-0.4 * room.length(wall), 0.4 * room.length(wall)):
        a = Assembly(rng)
        with room.along(a, wall, u):
            block(a, rng)
        (middle,) = middles(a)
        assert -3.0 < middle[0] < 5.0
        assert -2.0 < middle[1] < 4.0
        gaps = [middle[0] + 3.0, 5.0 - middle[0], middle[1] + 2.0, 4.0 - middle[1]]
        assert min(gaps) == pytest.approx(0.5 * EDGE)
