import numpy as np
import pytest

from assets.surfaces.kit.grid import Grid
from assets.surfaces.kit.handwriting import printed_page, written_lines
from assets.surfaces.kit.lettering import stamp, text_patch

GRID = Grid(512, 128.0)


@pytest.mark.parametrize("height", [2.0, 5.0])
def test_capitals_have_the_height_asked_for(height: float) -> None:
    """Ink covers the height of a capital, give or take a stroke."""
    patch = text_patch("HE", height, GRID)
    inked = np.flatnonzero((patch > 127).any(axis=1))
    assert (inked[-1] - inked[0] + 1) * GRID.texel_mm == pytest.approx(height, rel=0.3)


def test_longer_texts_are_wider() -> None:
    """Twice the letters take about twice the room."""
    assert 1.7 < text_patch("HHHHHH", 4.0, GRID).shape[1] / text_patch("HHH", 4.0, GRID).shape[1] < 2.1


def test_a_stamp_over_the_corner_goes_on_at_the_other_side() -> None:
    """Stamped on the corner, a patch equals the same patch stamped in the middle and rolled there."""
    patch = text_patch("R12", 4.0, GRID)
    corner, middle = np.zeros((2, 512, 512), np.uint8)
    stamp(corner, patch, 0.0, 0.0, GRID)
    stamp(middle, patch, 64.0, 64.0, GRID)
    assert corner.any()
    assert np.array_equal(corner, np.roll(middle, (-256, -256), (0, 1)))


def test_handwriting_stays_near_its_line() -> None:
    """Letters rise and fall by a few times their height and no farther."""
    image = np.zeros((512, 512), np.uint8)
    written_lines(np.random.default_rng(0), image, GRID, np.array([64.0]), 2.5)
    inked = np.flatnonzero((image > 60).any(axis=1)) * GRID.texel_mm
    assert inked.size > 0
    assert inked.min() > 50
    assert inked.max() < 78


@pytest.mark.parametrize("seed", range(4))
def test_a_printed_page_keeps_its_margins(seed: int) -> None:
    """Ink covers a few percent of the page and none of the outer centimetre."""
    page = printed_page(np.random.default_rng(seed), (210.0, 297.0), GRID)
    edge = round(10 / GRID.texel_mm)
    assert 0.01 < page.mean() < 0.2
    inside = page.copy()
    inside[edge:-edge, edge:-edge] = 0
    assert inside.max() == 0
