import numpy as np
import pytest

from assets.surfaces.kit.grid import Grid
from assets.surfaces.kit.shapes import box, filled, repeated

GRID = Grid(256, 128.0)


def test_repeated_cells_count_from_their_middles() -> None:
    """Each of 8 cells runs from minus to plus half a pitch, and a shift moves the cells to the right."""
    x, _ = GRID.coordinates()
    cell = repeated(x, 16.0)
    assert cell[0, 16] == pytest.approx(0.25)
    assert np.array_equal(cell[:, :32], cell[:, 32:64])
    assert np.array_equal(repeated(x, 16.0, 4.0)[:, 8:], cell[:, :-8])


def test_a_box_is_measured_from_its_border() -> None:
    """Distances are exact in the middle, beside an edge and outside."""
    u = np.array([[0.0, 4.0, 7.0]], np.float32)
    v = np.zeros_like(u)
    assert box(u, v, 10.0, 6.0, 0.0).tolist() == [[-3.0, -1.0, 2.0]]


def test_round_corners_end_where_the_circle_does() -> None:
    """With a radius of half its height a box is a slot: its ends are half circles."""
    diagonal = np.sqrt(0.5).astype(np.float32)
    u, v = np.array([[2.0 + 3 * diagonal]], np.float32), np.array([[3 * diagonal]], np.float32)
    assert box(u, v, 10.0, 6.0, 3.0)[0, 0] == pytest.approx(0.0, abs=1e-5)


def test_a_filled_disc_has_the_disc_s_area() -> None:
    """The smooth border adds as much outside as it takes inside."""
    x, y = GRID.coordinates()
    disc = filled(np.hypot(x - 64, y - 64) - np.float32(20.0), GRID)
    assert disc.sum() * GRID.texel_mm**2 == pytest.approx(np.pi * 400, rel=0.005)
    assert set(np.unique(disc)) >= {0.0, 1.0}
