"""The drawing of sheets."""

import numpy as np
import pytest

from worker.clutter.print import TEXEL_M, Print, bars, ink, on_floor, plain, relief, write


def test_bars_cover_what_is_theirs() -> None:
    """A bar from 1.25 to 2.75 covers three quarters of either texel."""
    assert bars(4, np.array([2.0]), np.array([1.5])) == pytest.approx(np.array([0.0, 0.75, 0.75, 0.0]))


def test_ink_mixes_by_its_cover() -> None:
    """Ink that covers half of white is grey."""
    canvas = plain(1, 2, (200, 200, 200))
    ink(canvas, np.array([[0.0, 0.5]], np.float32), (0, 0, 0))
    assert canvas[0].tolist() == [[200.0] * 3, [100.0] * 3]


def test_relief_leans_away_from_a_rise() -> None:
    """Heights that rise to the right face left; those that rise to the picture's top face its bottom."""
    across, up = np.meshgrid(np.arange(8, dtype=np.float32), -np.arange(8, dtype=np.float32))
    assert relief(across)[4, 4, 0] < 60
    assert relief(up)[4, 4, 1] < 60
    assert relief(np.zeros((4, 4), np.float32))[2, 2].tolist() == [128, 128, 255]


def test_text_is_written_on_its_baseline() -> None:
    """An L reaches up from the baseline by its height, and no farther down."""
    cover = np.zeros((60, 60), np.float32)
    write(cover, "L", (10, 50), 40)
    rows = np.flatnonzero(cover.max(axis=1) > 0.5)
    assert rows.max() == pytest.approx(49, abs=1)
    assert 22 < len(rows) < 36


def test_text_beyond_the_edge_is_cut_off() -> None:
    """Text that begins anywhere is cut off at the edge."""
    cover = np.zeros((20, 20), np.float32)
    for place in ((-50.0, 10.0), (15.0, 18.0), (5.0, 60.0)):
        write(cover, "MMMM", place, 30)
    assert cover.max() <= 1


def test_a_sheet_on_the_floor_throws_shade_round_its_edge() -> None:
    """The shade is black and fades within its reach; the sheet itself stays as it was."""
    sheet = Print(colour=np.full((10, 20, 3), 180, np.uint8), roughness=np.full((10, 20), 90, np.uint8))
    lying = on_floor(sheet, 4 * TEXEL_M, 0.5)
    assert lying.margin_m == pytest.approx(4 * TEXEL_M)
    assert lying.colour.shape == (18, 28, 3)
    assert lying.alpha is not None
    assert (lying.alpha[4:-4, 4:-4] == 255).all()
    assert (lying.colour[4:-4, 4:-4] == 180).all()
    assert (lying.colour[3, 4:-4] == 0).all()
    fading = lying.alpha[:4, 10].astype(int)
    assert (np.diff(fading) > 0).all()
    assert fading[-1] < 0.5 * 255
