"""Sheets: the function that draws each kind, and a sheet's corners on the floor. Pure numpy."""

from collections.abc import Callable, Mapping

import numpy as np

from farm.scene.clutter import Sheet, SheetKind
from worker.clutter.ground import draw_painted_line, draw_seam, draw_slot
from worker.clutter.paper import draw_label, draw_paper
from worker.clutter.print import Print
from worker.clutter.ruler import draw_ruler
from worker.clutter.solid import Array
from worker.clutter.tape import draw_hazard_tape, draw_tape

_ARTISTS: Mapping[SheetKind, Callable[[Sheet, np.random.Generator], Print]] = {
    SheetKind.TAPE: draw_tape,
    SheetKind.HAZARD_TAPE: draw_hazard_tape,
    SheetKind.PAPER: draw_paper,
    SheetKind.LABEL: draw_label,
    SheetKind.RULER: draw_ruler,
    SheetKind.PAINTED_LINE: draw_painted_line,
    SheetKind.SLOT: draw_slot,
    SheetKind.SEAM: draw_seam,
}


def print_sheet(sheet: Sheet) -> Print:
    """Draw the images of a sheet; the same sheet gives the same images."""
    return _ARTISTS[sheet.kind](sheet, np.random.default_rng(sheet.pattern_seed))


def sheet_corners(sheet: Sheet, margin_m: float = 0.0) -> Array:
    """Compute the corners of a sheet's image on the floor.

    Args:
        sheet: sampled sheet.
        margin_m: distance by which the image reaches over the sheet's edges, in metres.

    Returns:
        (4, 2) metres, anticlockwise from the corner where its length and its width begin.
    """
    along, across = sheet.length_m / 2 + margin_m, sheet.width_m / 2 + margin_m
    turn = np.radians(sheet.rotation_deg)
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    corners = np.array([(-along, -across), (along, -across), (along, across), (-along, across)])
    placed: Array = corners @ rotation.T + [sheet.x_m, sheet.y_m]
    return placed
