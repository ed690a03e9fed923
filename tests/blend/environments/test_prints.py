"""The prints of environments."""

import numpy as np

from blend.environments.prints import CELL_PX, CELLS, PrintKind, cell, draw_atlas


def test_the_atlas_is_full_and_repeats() -> None:
    """Every cell shows something, and one seed draws one atlas."""
    atlas = draw_atlas(np.random.default_rng(5))
    assert np.array_equal(atlas, draw_atlas(np.random.default_rng(5)))
    cells = atlas.reshape(CELLS, CELL_PX, CELLS, CELL_PX, 3).swapaxes(1, 2)
    assert cells.std(axis=(2, 3, 4)).min() > 5


def test_cells_lie_apart_from_the_top_down() -> None:
    """The first kind is at the atlas's top, where v is 1."""
    left, bottom, right, top = cell(PrintKind.SCREEN, 0)
    assert 0 < left < right < 1 / CELLS
    assert 1 - 1 / CELLS < bottom < top < 1
    assert cell(PrintKind.POSTER, 1)[0] > right
    assert cell(PrintKind.POSTER, 1)[3] < bottom
