"""Paints the dirt and wear of cables over their sheaths. Numpy and OpenCV."""

import cv2
import numpy as np

from worker.cable.canvas import Canvas, tone
from worker.noise import Field, highest_share, rough_wrapped_noise, wrapped_noise

_GRIME = tone(0.15, 0.125, 0.10)
"""Colour of grime, sRGB."""

_DUST = tone(0.60, 0.56, 0.50)
"""Colour of dust, sRGB."""

_SCUFFS_PER_M = 700.0
"""Scuffs on a metre of cable, before `_scuffs` reduces them by the cable's girth and its rubbed share."""


def soil(canvas: Canvas, share: float, rng: np.random.Generator) -> None:
    """Soil a share of a canvas, 0 to 1, in place: spots and smears of some millimetres, and a film of dust between."""
    if share <= 0.0:
        return
    shape = canvas.shape
    spots = rough_wrapped_noise(rng, shape, canvas.cells(0.0025, 0.0045), 4)
    smears = rough_wrapped_noise(rng, shape, canvas.cells(0.0015, 0.014), 3)
    # Dirt gathers: some parts of a cable have much of it, others hardly any.
    crowd = wrapped_noise(rng, shape, canvas.cells(canvas.around_m, 0.035))
    where = np.maximum(spots, smears) + 0.6 * crowd
    grime = highest_share(where, share, rng.uniform(0.4, 1.2))
    density = np.clip(0.70 + 0.20 * wrapped_noise(rng, shape, canvas.cells(0.0012, 0.0020)), 0.25, 0.95)
    tint = _GRIME * np.float32(rng.uniform(0.5, 1.5))
    dust = np.clip(0.5 + 0.5 * rough_wrapped_noise(rng, shape, canvas.cells(0.004, 0.012), 3), 0.0, 1.5)
    film = dust * np.float32(0.22 * min(1.0, 3.0 * share))
    canvas.blend(film, _DUST)
    canvas.blend_roughness(np.minimum(2.0 * film, 1.0), 0.85)
    canvas.blend(grime * density, tint)
    canvas.blend_roughness(grime * 0.9, 0.78)


def wear_down(canvas: Canvas, share: float, rng: np.random.Generator) -> None:
    """Rub a share of a canvas, 0 to 1, paler and duller, and scuff it, in place."""
    if share <= 0.0:
        return
    shape = canvas.shape
    where = rough_wrapped_noise(rng, shape, canvas.cells(0.0018, 0.018), 4)
    where += 0.8 * wrapped_noise(rng, shape, canvas.cells(canvas.around_m / 3, 0.06))
    rubbed = highest_share(where, share, 0.7) * np.clip(
        0.6 + 0.3 * wrapped_noise(rng, shape, canvas.cells(0.0004, 0.003)), 0, 1
    )
    paler = 0.5 * canvas.colour + 0.5 * np.float32(0.74)
    canvas.blend(0.85 * rubbed, paler)
    canvas.blend_roughness(rubbed, 0.7)
    scuffs = _scuffs(canvas, share, rng)
    canvas.blend(0.6 * scuffs, 0.4 * canvas.colour + 0.6 * np.float32(0.80))
    canvas.blend_roughness(0.8 * scuffs, 0.65)


def _scuffs(canvas: Canvas, share: float, rng: np.random.Generator) -> Field:
    """Draw short, thin scratches, mostly along the cable: (rows, columns), 0 to 1; they continue around the cable."""
    rows, columns = canvas.shape
    count = rng.poisson(_SCUFFS_PER_M * canvas.length_m * np.sqrt(share) * min(1.0, canvas.around_m / 0.006) * 0.3)
    drawn = np.zeros((3 * rows, columns), np.uint8)
    lengths = rng.gamma(2.0, 0.0012, count)
    slopes = rng.normal(0.0, 0.35, count)
    starts = rng.uniform(0.0, 1.0, (count, 2)) * [columns, rows] + [0, rows]
    runs = lengths[:, None] * np.stack([np.cos(slopes), np.sin(slopes)], axis=1) / canvas.texel_m[::-1]
    runs[:, 1] = np.clip(runs[:, 1], -0.9 * rows, 0.9 * rows)
    levels = rng.integers(70, 220, count)
    for start, run, level in zip(starts, runs, levels, strict=True):
        a, b = (16 * start).astype(int), (16 * (start + run)).astype(int)
        ends = (int(a[0]), int(a[1])), (int(b[0]), int(b[1]))
        cv2.line(drawn, *ends, (int(level),), 1, lineType=cv2.LINE_AA, shift=4)
    around: Field = drawn.reshape(3, rows, columns).max(axis=0) / np.float32(255)
    return around
