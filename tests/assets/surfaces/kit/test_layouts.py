import numpy as np
import pytest

from assets.surfaces.kit.grid import Grid
from assets.surfaces.kit.layouts import Layout, boards, chevron, herringbone, tiles

GRID = Grid(256, 400.0)
LAYOUTS = [
    boards(np.random.default_rng(0), GRID, 4),
    tiles(GRID, 4, 4),
    tiles(GRID, 2, 4, 0.5),
    herringbone(GRID, 1),
    herringbone(GRID, 2, 3),
    chevron(GRID, 4, 8),
]


@pytest.mark.parametrize("layout", LAYOUTS)
def test_pieces_are_numbered_without_gaps(layout: Layout) -> None:
    """Labels run from 0 and each occurs."""
    present = np.unique(layout.labels)
    assert present.tolist() == list(range(len(present)))


@pytest.mark.parametrize("layout", LAYOUTS)
def test_neighbouring_texels_of_different_pieces_lie_at_an_edge(layout: Layout) -> None:
    """Wherever the label changes, across the tile's edge too, the distance to the edge is under a texel."""
    for axis in (0, 1):
        changed = layout.labels != np.roll(layout.labels, 1, axis)
        assert (layout.edge_mm[changed] <= GRID.texel_mm).all()
    assert layout.edge_mm.min() >= -1e-3


def test_herringbone_blocks_are_all_of_one_size() -> None:
    """Every block covers the same area: ratio times the square of its width."""
    layout = herringbone(GRID, 1, 4)
    counts = np.bincount(layout.labels.ravel())
    assert len(counts) == 16
    assert counts.min() == counts.max() == 256 * 256 // 16


def test_half_bond_shifts_every_other_row() -> None:
    """In a half bond a tile's middle lies over the joint of the row before."""
    layout = tiles(GRID, 2, 4, 0.5)
    assert abs(layout.u_mm[10, 64]) < GRID.texel_mm
    assert layout.edge_mm[32, 128] < GRID.texel_mm
    assert abs(layout.u_mm[96, 128]) < GRID.texel_mm


def test_chevron_boards_are_all_of_one_size() -> None:
    """Every board covers the same area, and there are as many as columns times pieces."""
    counts = np.bincount(chevron(GRID, 4, 8).labels.ravel())
    assert len(counts) == 32
    assert counts.min() == counts.max() == 256 * 256 // 32


def test_chevron_boards_rise_and_fall_in_turn() -> None:
    """Boards run up to the right in even columns and down in odd ones, mirrored where they meet."""
    layout = chevron(GRID, 4, 8)
    left, right = layout.v_mm[:, :64], layout.v_mm[:, 64:128]
    assert np.array_equal(left, right[:, ::-1])
    assert layout.labels[40, 10] == layout.labels[30, 20]
    assert layout.labels[40, 74] == layout.labels[50, 84]
