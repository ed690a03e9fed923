"""Draws adhesive tape, plain or with hazard stripes. Numpy and OpenCV."""

import cv2
import numpy as np
from numpy.typing import NDArray

from farm.scene.clutter import Sheet
from worker.clutter.print import TEXEL_M, Levels, Print, ink, levels, on_floor, pixels_of, plain, relief
from worker.noise import Field, rough_noise, smooth_noise, smooth_step

HAZARDS = (((236, 186, 24), (24, 24, 26)), ((236, 186, 24), (24, 24, 26)), ((188, 28, 30), (230, 230, 228)))
"""Pairs of colours of hazard tape, sRGB levels: yellow and black twice, as it is commoner, and red and white."""


def draw_tape(sheet: Sheet, rng: np.random.Generator) -> Print:
    """Draw tape of plastic, crêped paper or cloth, in the sheet's colour."""
    rows, columns = pixels_of(sheet.width_m), pixels_of(sheet.length_m)
    canvas = plain(rows, columns, sheet.colour)
    kind = int(rng.choice(3, p=(0.5, 0.3, 0.2)))
    height = _wrinkles(rng, rows, columns)
    gloss = float(rng.uniform(0.25, 0.45))
    if kind == 1:
        crepe = smooth_noise(rng, rows, columns, (12.0, 1.6)) + 0.5 * smooth_noise(rng, rows, columns, (3.0, 1.2))
        height += 0.12 * crepe
        canvas *= 1 + 0.02 * crepe[:, :, None]
        gloss = 0.7
    elif kind == 2:
        weave = np.cos(np.arange(columns) * (2 * np.pi * TEXEL_M / 1.1e-3))[None]
        weft = np.cos(np.arange(rows) * (2 * np.pi * TEXEL_M / 1.4e-3))[:, None]
        height += (0.08 * np.maximum(weave, 0.6) + 0.08 * np.maximum(weft, 0.6)).astype(np.float32)
        gloss = 0.4
    canvas *= 1 + 0.03 * rough_noise(rng, rows, columns, 60.0, 3)[:, :, None]
    return _stuck(canvas, height, gloss, rng)


def draw_hazard_tape(sheet: Sheet, rng: np.random.Generator) -> Print:
    """Draw tape with diagonal stripes of two colours, scuffed."""
    rows, columns = pixels_of(sheet.width_m), pixels_of(sheet.length_m)
    bright, dark = HAZARDS[int(rng.integers(len(HAZARDS)))]
    pitch = rows * float(rng.uniform(0.9, 1.5))
    lean = 1.0 if rng.random() < 0.5 else -1.0
    along = np.arange(columns)[None] + lean * np.arange(rows)[:, None] + float(rng.uniform(0, pitch))
    # The distance from a stripe's middle, in texels, makes its edge one texel soft.
    place = np.abs((along / pitch) % 1.0 - 0.5) * pitch
    stripes = np.clip(place - pitch / 4 + 0.5, 0, 1).astype(np.float32)
    canvas = plain(rows, columns, bright)
    ink(canvas, stripes, dark)
    rubbed = rough_noise(rng, rows, columns, 25.0, 5) + 0.7 * smooth_noise(rng, rows, columns, (1.5, 30.0))
    ink(canvas, 0.45 * smooth_step(rubbed, 1.4, 3.4), (150, 146, 138))
    return _stuck(canvas, _wrinkles(rng, rows, columns), float(rng.uniform(0.28, 0.5)), rng)


def _stuck(canvas: Field, height: Field, gloss: float, rng: np.random.Generator) -> Print:
    rows, columns = canvas.shape[:2]
    roughness = gloss * (1 + 0.25 * rough_noise(rng, rows, columns, 50.0, 3))
    drawn = Print(
        colour=levels(canvas),
        roughness=levels(255 * roughness),
        alpha=_torn(rng, rows, columns),
        normal=relief(height),
    )
    return on_floor(drawn, 0.45e-3, 0.4)


def _torn(rng: np.random.Generator, rows: int, columns: int) -> Levels:
    """Draw the coverage between two ends, each torn off, cut by the teeth of a dispenser, or cut with a knife."""
    first, last = _end(rng, rows), columns - _end(rng, rows)
    place = np.arange(columns)[None]
    covered = np.clip(place - first[:, None], 0, 1) * np.clip(last[:, None] - place, 0, 1)
    return levels(255 * covered.astype(np.float32))


def _end(rng: np.random.Generator, rows: int) -> NDArray[np.float64]:
    """Sample the number of texels that are missing from each row at an end, (rows,)."""
    kind = int(rng.integers(3))
    slant = float(rng.uniform(-0.15, 0.15)) * np.arange(rows)
    if kind == 0:
        rough = (
            rough_noise(rng, 1, rows, 12.0, 5)[0] * 3.0 + smooth_noise(rng, 1, rows, (1.0, rows / 2))[0] * 0.06 * rows
        )
        missing = slant + rough
    elif kind == 1:
        tooth = 1.3e-3 / TEXEL_M
        missing = 0.3 * slant + np.abs((np.arange(rows) / tooth) % 1.0 - 0.5) * tooth
    else:
        missing = slant
    missing = np.asarray(missing, np.float64)
    cut: NDArray[np.float64] = missing - missing.min()
    return cut


def _wrinkles(rng: np.random.Generator, rows: int, columns: int) -> Field:
    """Sample ripples and a few creases from edge to edge: heights (rows, columns) in texels."""
    height = 0.5 * smooth_noise(rng, rows, columns, (rows / 1.5, 60.0))
    creases = np.zeros((rows, columns), np.float32)
    for _ in range(int(rng.poisson(columns * TEXEL_M / 0.06))):
        middle, lean = float(rng.uniform(0, columns)), float(rng.uniform(-0.8, 0.8)) * rows
        ends = np.array([[middle - lean, -2], [middle + 0.2 * lean, rows / 2], [middle + lean, rows + 2]])
        cv2.polylines(creases, [np.rint(ends).astype(np.int32)], False, (float(rng.uniform(0.4, 1.2)),), 2)
    height += cv2.GaussianBlur(creases, (0, 0), 1.6) * 2.0
    return height.astype(np.float32, copy=False)
