"""Draws lines that belong to the floor: painted lines, slots and seams. Numpy."""

import numpy as np

from farm.scene.clutter import Sheet
from worker.clutter.print import Print, ink, levels, pixels_of, plain, relief
from worker.noise import Field, rough_noise, smooth_noise, smooth_step


def draw_painted_line(sheet: Sheet, rng: np.random.Generator) -> Print:
    """Draw a line of paint, worn down to the floor in places."""
    rows, columns = pixels_of(sheet.width_m), pixels_of(sheet.length_m)
    canvas = plain(rows, columns, sheet.colour)
    grime = rough_noise(rng, rows, columns, 70.0, 4)
    canvas *= 1 + 0.05 * grime[:, :, None]
    ink(canvas, 0.3 * smooth_step(grime, 0.6, 2.2), (70, 64, 56))
    away = _from_edge(rows, columns) - 1.5 - 0.8 * rough_noise(rng, rows, columns, 16.0, 4)
    worn = rough_noise(rng, rows, columns, 45.0, 6)
    left = 1 - smooth_step(worn, float(rng.uniform(0.8, 2.2)), 2.6)
    alpha = np.clip(away, 0, 1) * left
    return Print(
        colour=levels(canvas),
        roughness=levels(255 * np.clip(0.45 + 0.08 * grime, 0.1, 1)),
        alpha=levels(255 * alpha),
        normal=relief(0.25 * worn),
    )


def draw_slot(sheet: Sheet, rng: np.random.Generator) -> Print:
    """Draw a groove, as in an extruded profile or a bench: black inside, one lip bright and the other in shade."""
    rows, columns = pixels_of(sheet.width_m), pixels_of(sheet.length_m)
    across = (np.arange(rows, dtype=np.float32) + 0.5)[:, None] / rows
    canvas = plain(rows, columns, (11, 11, 12))
    # Light reaches a little way down the wall that faces it.
    ink(canvas, np.broadcast_to(0.16 * np.exp(-across / 0.18), (rows, columns)).astype(np.float32), (120, 118, 114))
    lint = smooth_step(rough_noise(rng, rows, columns, 30.0, 5), 1.2, 2.6)
    ink(canvas, 0.22 * lint, (120, 112, 100))
    lip = np.float32(0.45e-3 * rows / sheet.width_m)
    place = np.arange(rows, dtype=np.float32)[:, None] + 0.5
    chips = np.clip(1 + 0.3 * smooth_noise(rng, 1, columns, (1.0, 14.0)), 0.4, 1.8)
    lit = np.clip(1 - np.abs(rows - place - lip) / (lip * chips), 0, 1)
    dark = np.clip(1 - np.abs(place - lip) / (lip * chips), 0, 1)
    # A lip is worn bare, so it is paler than the sheet's colour.
    grey = sum(sheet.colour) / 3
    red, green, blue = (min(255, round(0.3 * level + 0.8 * grey) + 25) for level in sheet.colour)
    ink(canvas, 0.8 * np.broadcast_to(lit, (rows, columns)), (red, green, blue))
    ink(canvas, 0.5 * np.broadcast_to(dark, (rows, columns)), (60, 59, 58))
    alpha = np.clip(1.2 * (_from_edge(rows, columns) + 0.5) / lip, 0, 1)
    return Print(
        colour=levels(canvas),
        roughness=levels(255 * np.broadcast_to(0.75 - 0.4 * np.maximum(lit, 0), (rows, columns))),
        alpha=levels(255 * alpha),
        specular=0.05,
    )


def draw_seam(sheet: Sheet, rng: np.random.Generator) -> Print:
    """Draw a joint between two boards: dark, of uneven width, filled with dirt in places."""
    rows, columns = pixels_of(sheet.width_m), pixels_of(sheet.length_m)
    half = 0.5 * rows * (0.72 + 0.16 * rough_noise(rng, 1, columns, 60.0, 4))
    middle = rows / 2 + 0.06 * rows * smooth_noise(rng, 1, columns, (1.0, 120.0))
    away = half - np.abs(np.arange(rows, dtype=np.float32)[:, None] + 0.5 - middle)
    soft = np.float32(max(1.0, 0.18 * rows))
    filled = smooth_step(rough_noise(rng, rows, columns, 40.0, 4), 0.4, 2.0)
    canvas = plain(rows, columns, (26, 24, 22))
    ink(canvas, 0.5 * filled, (96, 88, 76))
    ends = np.minimum(np.arange(columns), np.arange(columns)[::-1]).astype(np.float32)[None]
    alpha = np.clip(away / soft, 0, 1) * np.clip(ends / 4, 0, 1) * (0.9 - 0.3 * filled)
    return Print(
        colour=levels(canvas),
        roughness=np.full((rows, columns), 200, np.uint8),
        alpha=levels(255 * alpha),
        specular=0.1,
    )


def _from_edge(rows: int, columns: int) -> Field:
    """Compute each texel's distance from the nearest edge, (rows, columns), in texels."""
    down, across = (np.minimum(np.arange(size), np.arange(size)[::-1]).astype(np.float32) for size in (rows, columns))
    away: Field = np.minimum(down[:, None], across[None])
    return away
