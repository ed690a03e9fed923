"""Sheets have their true size, are the same every time, and lie at their drawn place."""

import numpy as np
import pytest

from farm.scene.clutter import SheetKind
from tests.worker.clutter.things import make_sheet
from worker.clutter.print import TEXEL_M
from worker.clutter.sheet import print_sheet, sheet_corners


@pytest.mark.parametrize("kind", SheetKind)
def test_a_sheet_has_maps_of_one_size(kind: SheetKind) -> None:
    """The maps of any sheet have one size; texels are 0.15 mm square, margin included."""
    drawn = print_sheet(make_sheet(kind))
    rows, columns = drawn.roughness.shape
    assert drawn.colour.shape == (rows, columns, 3)
    assert drawn.alpha is None or drawn.alpha.shape == (rows, columns)
    assert drawn.normal is None or drawn.normal.shape == (rows, columns, 3)
    assert columns * TEXEL_M == pytest.approx(0.08 + 2 * drawn.margin_m, abs=TEXEL_M)
    assert rows * TEXEL_M == pytest.approx(0.02 + 2 * drawn.margin_m, abs=TEXEL_M)


@pytest.mark.parametrize("kind", SheetKind)
def test_a_sheet_is_drawn_from_its_seed_alone(kind: SheetKind) -> None:
    """The same seed gives the same sheet, and another seed another one."""
    one, again, other = (print_sheet(make_sheet(kind, seed=seed)) for seed in (3, 3, 4))
    assert one.colour.tobytes() == again.colour.tobytes()
    assert one.roughness.tobytes() == again.roughness.tobytes()
    assert one.colour.tobytes() != other.colour.tobytes()


@pytest.mark.parametrize("kind", [SheetKind.TAPE, SheetKind.PAPER, SheetKind.PAINTED_LINE, SheetKind.LABEL])
def test_a_sheet_has_its_colour(kind: SheetKind) -> None:
    """Most of a sheet is within a few levels of its colour, as prints, dirt and creases cover less."""
    drawn = print_sheet(make_sheet(kind))
    assert drawn.alpha is not None
    seen = drawn.colour[drawn.alpha == 255]
    assert np.median(seen, axis=0) == pytest.approx(np.array([200, 180, 60]), abs=16)


def test_a_slot_is_darker_than_anything_that_is_not_a_hole() -> None:
    """A slot is darker along its middle than anything else but holes."""
    drawn = print_sheet(make_sheet(SheetKind.SLOT, width_m=0.006))
    assert np.median(drawn.colour[len(drawn.colour) // 2]) < 40


def test_hazard_stripes_run_at_45_degrees() -> None:
    """Each row is the one above moved by a texel, except for scuffs."""
    colour = print_sheet(make_sheet(SheetKind.HAZARD_TAPE)).colour.astype(int)
    inner = colour[20:60, 60:-60]
    change = [float(np.abs(inner[1:, 2:-2] - np.roll(inner[:-1], shift, axis=1)[:, 2:-2]).mean()) for shift in (-1, 1)]
    assert min(change) < 0.5 * max(change)


def test_corners_lie_about_the_place_along_the_bearing() -> None:
    """A sheet at (1, 2) mm turned by 90 degrees has its length along y and its width along -x."""
    sheet = make_sheet(SheetKind.PAPER, x_m=0.001, y_m=0.002, rotation_deg=90.0)
    expected = [(0.011, -0.038), (0.011, 0.042), (-0.009, 0.042), (-0.009, -0.038)]
    assert sheet_corners(sheet) == pytest.approx(np.array(expected))
