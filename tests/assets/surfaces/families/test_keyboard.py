import pytest

from assets.surfaces.families.keyboard import LEGENDS, ROWS, UNITS


@pytest.mark.parametrize(("widths", "legends"), list(zip(ROWS, LEGENDS, strict=True)))
def test_a_row_fills_the_tile_and_every_key_is_named(widths: tuple[float, ...], legends: str) -> None:
    """Widths and gaps add up to the tile, and each key has a legend."""
    assert sum(abs(width) for width in widths) == UNITS
    assert len(legends.split()) == sum(width > 0 for width in widths)
