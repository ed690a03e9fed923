import numpy as np

from assets.surfaces.kit.grid import Grid
from assets.surfaces.kit.pile import Pile, Sprite, pebble
from tests.assets.built import steps

GRID = Grid(128, 128.0)


def slab(high: int, wide: int, code: float) -> Sprite:
    """A flat rectangle, 1 mm thick."""
    shape = (high, wide)
    return Sprite(np.full((*shape, 3), code, np.float32), np.ones(shape, np.float32), np.ones(shape, np.float32))


def bare() -> Pile:
    """A level black floor."""
    return Pile(GRID, np.zeros((128, 128, 3), np.float32), GRID.zeros())


def test_what_is_laid_later_lies_on_top() -> None:
    """A second slab rests on the first and hides it."""
    pile = bare()
    tint = np.ones(3, np.float32)
    pile.lay(slab(20, 20, 0.5), 64, 64, tint, 1.0)
    pile.lay(slab(10, 10, 0.9), 64, 64, tint, 1.0)
    assert pile.height_mm[64, 64] == 2.0
    assert pile.colour[64, 64, 0] == np.float32(0.9)
    assert pile.colour[56, 56, 0] == np.float32(0.5)
    assert pile.thing[64, 64] == 1


def test_a_sprite_over_the_corner_shows_in_all_four() -> None:
    """Laid on the corner, a slab covers a quarter of itself in each corner of the tile."""
    pile = bare()
    pile.lay(slab(20, 20, 0.5), 0, 0, np.ones(3, np.float32))
    assert (pile.thing >= 0).sum() == 400
    assert min(pile.thing[0, 0], pile.thing[0, -1], pile.thing[-1, 0], pile.thing[-1, -1]) == 0


def test_a_heap_of_pebbles_tiles() -> None:
    """Strewn stones leave no seam in colour or relief."""
    rng = np.random.default_rng(0)
    pile = bare()
    pile.strew(rng, [pebble(rng, GRID, 5.0, "a0a0a0", 0.5) for _ in range(8)], 400)
    for axis in (0, 1):
        for image in (pile.colour, pile.height_mm):
            seam, *inside = steps(image, axis)
            assert seam <= 1.05 * max(inside)
