"""Draws rulers of steel or plastic, with true millimetres. Numpy, OpenCV and Pillow."""

import numpy as np

from farm.scene.clutter import Sheet
from worker.clutter.print import Print, bars, ink, levels, on_floor, pixels_of, plain, relief, write
from worker.noise import rough_noise, smooth_noise

TICK_M = 0.16e-3
"""Width of a mark, in metres."""

ZERO_M = 5e-3
"""Largest distance from a ruler's end to its first mark, in metres; a short ruler has a twentieth of its length."""

LENGTHS_M = {10: 5.2e-3, 5: 4.0e-3, 1: 2.8e-3}
"""Length of the marks, in metres, by their spacing in millimetres."""

STEEL = (186, 187, 188)
"""Colour of steel, sRGB levels."""

BLACK = (24, 24, 26)
"""Colour of dark marks, sRGB levels."""


def draw_ruler(sheet: Sheet, rng: np.random.Generator) -> Print:
    """Draw a ruler of brushed steel, or of plastic in the sheet's colour, with a mark a millimetre along one edge."""
    rows, columns = pixels_of(sheet.width_m), pixels_of(sheet.length_m)
    steel = rng.random() < 0.6
    canvas = plain(rows, columns, STEEL if steel else sheet.colour)
    brushed = smooth_noise(rng, rows, columns, (1.0, 90.0))
    wear = rough_noise(rng, rows, columns, 80.0, 5)
    roughness = (0.3 + 0.06 * brushed if steel else np.full((rows, columns), 0.35, np.float32)) + 0.03 * wear
    canvas *= 1 + (0.05 * brushed + 0.02 * wear if steel else 0.02 * wear)[:, :, None]
    pale = not steel and sum(sheet.colour) < 300
    ink(canvas, 0.93 * ruler_marks(sheet.length_m, rows, columns), (230, 230, 226) if pale else BLACK)
    edge = np.minimum(np.arange(rows), np.arange(rows)[::-1]).astype(np.float32)
    height = np.broadcast_to(3.0 * np.minimum(edge / 4, 1)[:, None], (rows, columns)).astype(np.float32)
    drawn = Print(
        colour=levels(canvas),
        roughness=levels(255 * np.clip(roughness, 0.08, 1)),
        normal=relief(height),
        metallic=0.9 if steel else 0.0,
    )
    return on_floor(drawn, 1.2e-3, 0.55)


def ruler_marks(length_m: float, rows: int, columns: int) -> np.typing.NDArray[np.float32]:
    """Draw a ruler's marks, one a millimetre, and its digits, one number a centimetre.

    Args:
        length_m: length of the ruler, in metres.
        rows: number of texels across the ruler.
        columns: number of texels along it.

    Returns:
        (rows, columns), share of each texel that ink covers, 0 to 1.
    """
    per_m = columns / length_m
    zero = min(ZERO_M, 0.05 * length_m)
    count = int((length_m - zero) / 1e-3)
    cover = np.zeros((rows, columns), np.float32)
    down = rows / max(rows, 1)
    for step, reach_m in sorted(LENGTHS_M.items()):
        places = (zero + 1e-3 * np.arange(0, count + 1, step)) * per_m
        high = min(round(reach_m * per_m), round(0.45 * rows * down))
        np.maximum(cover[:high], bars(columns, places, np.full(len(places), TICK_M * per_m)), out=cover[:high])
    size = min(3.6e-3 * per_m, 0.4 * rows)
    baseline = min(LENGTHS_M[10] * per_m, 0.45 * rows) + 0.95 * size
    for centimetre in range(count // 10 + 1):
        write(cover, str(centimetre), ((zero + 0.01 * centimetre) * per_m, baseline), size, "ms")
    return cover
