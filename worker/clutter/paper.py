"""Draws paper, blank or written on, and stickers with a barcode. Numpy, OpenCV and Pillow."""

from collections.abc import Callable

import cv2
import numpy as np

from farm.scene.clutter import Sheet
from worker.clutter.print import TEXEL_M, Print, bars, ink, levels, lines, on_floor, pixels_of, plain, relief, write
from worker.noise import Field, rough_noise, smooth_noise

MM = 1e-3 / TEXEL_M
"""Number of texels in a millimetre."""

WORDS = (
    *("the", "of", "to", "and", "in", "is", "for", "with", "at", "by", "from", "on", "not", "see", "after", "before"),
    *("length", "current", "supply", "module", "panel", "wire", "cable", "connector", "screw", "torque", "note"),
    *("figure", "table", "check", "install", "remove", "replace", "signal", "ground", "shield", "plug", "socket"),
    *("terminal", "voltage", "rated", "test", "step", "insert", "tighten", "loosen", "cover", "label", "number"),
)

INKS = ((26, 26, 30), (26, 26, 30), (24, 36, 96), (70, 70, 74))
"""Colours of ink and pencil, sRGB levels: black twice, as it is the commonest, blue and grey. Print is black."""


def draw_paper(sheet: Sheet, rng: np.random.Generator) -> Print:
    """Draw a piece of paper: blank, ruled, squared, or with text, a drawing or a chart; some are folded once."""
    rows, columns = pixels_of(sheet.width_m), pixels_of(sheet.length_m)
    canvas = plain(rows, columns, sheet.colour)
    kind: tuple[Callable[[Field, np.random.Generator], None], ...] = (_ruled, _squared, _text, _drawing, _chart)
    upright = rng.random() < 0.5
    page = np.ascontiguousarray(np.rot90(canvas)) if upright else canvas
    if rng.random() > 0.15:
        kind[int(rng.integers(len(kind)))](page, rng)
    canvas = np.ascontiguousarray(np.rot90(page, -1)) if upright else page
    canvas *= 1 + 0.008 * rough_noise(rng, rows, columns, 6.0, 2)[:, :, None]
    curl = smooth_noise(rng, rows, columns, (rows / 1.3, columns / 1.3))
    canvas *= 1 + 0.025 * curl[:, :, None]
    height = 2.0 * curl + 0.05 * rough_noise(rng, rows, columns, 5.0, 2)
    if rng.random() < 0.5:
        _fold(canvas, height, rng)
    drawn = Print(
        colour=levels(canvas),
        roughness=np.full((rows, columns), round(255 * float(rng.uniform(0.6, 0.8))), np.uint8),
        normal=relief(height),
    )
    return on_floor(drawn, 0.6e-3, 0.4)


def _fold(canvas: Field, height: Field, rng: np.random.Generator) -> None:
    """Add a crease to a colour (H, W, 3) and a height (H, W), in place: its sides lean, so one is in shade."""
    rows, columns = height.shape
    across = rng.random() < 0.7
    size = columns if across else rows
    place = size * float(rng.uniform(0.3, 0.7))
    away = np.arange(size, dtype=np.float32) - np.float32(place)
    reach = 12 * MM
    side = float(rng.choice((-1.0, 1.0)))
    shade = 1 - side * 0.09 * np.sign(away) * np.exp(-np.abs(away) / reach)
    shade *= 1 - 0.12 * np.exp(-((away / (0.35 * MM)) ** 2))
    lean = 0.1 * reach * np.exp(-np.abs(away) / reach)
    canvas *= shade[None, :, None] if across else shade[:, None, None]
    height += lean[None, :] if across else lean[:, None]


def _ruled(page: Field, rng: np.random.Generator) -> None:
    rows, columns = page.shape[:2]
    pitch, first = float(rng.choice((7.0, 8.0))) * MM, float(rng.uniform(4, 14)) * MM
    place = np.arange(first, rows, pitch)
    cover = np.broadcast_to(bars(rows, place, np.full(len(place), 0.25 * MM))[:, None], (rows, columns))
    ink(page, 0.7 * cover, (120, 150, 200))
    if rng.random() < 0.5:
        margin = bars(columns, np.array([float(rng.uniform(12, 25)) * MM]), np.array([0.3 * MM]))
        ink(page, 0.7 * np.broadcast_to(margin, (rows, columns)), (210, 110, 110))
    if rng.random() < 0.6:
        _handwriting(page, place, rng)


def _handwriting(page: Field, baselines: Field, rng: np.random.Generator) -> None:
    """Draw loops of a pen along some lines, in place; nobody could read handwriting from the camera's height."""
    rows, columns = page.shape[:2]
    cover = np.zeros((rows, columns), np.float32)
    for line in baselines[:: int(rng.integers(1, 3))]:
        if rng.random() < 0.3:
            continue
        start, end = 8 * MM, columns * float(rng.uniform(0.3, 0.95))
        while start < end:
            word = float(rng.uniform(4, 16)) * MM
            t = np.linspace(0, word / (1.6 * MM) * 2 * np.pi, max(12, int(word)))
            tall = 1 + 0.8 * (smooth_noise(rng, 1, len(t), (1.0, 9.0))[0] > 0.9)
            x = start + np.linspace(0, word, len(t)) + 0.5 * MM * np.sin(t)
            y = line - 1.2 * MM + 0.9 * MM * tall * np.cos(t) * (1 + 0.3 * smooth_noise(rng, 1, len(t), (1.0, 7.0))[0])
            lines(cover, np.stack([x + 0.35 * (line - y), y], axis=1), 0.28 * MM)
            start += word + 2.5 * MM
    ink(page, 0.75 * cover, INKS[int(rng.integers(len(INKS)))])


def _squared(page: Field, rng: np.random.Generator) -> None:
    rows, columns = page.shape[:2]
    pitch = 5 * MM
    grid = [np.arange(float(rng.uniform(0, pitch)), edge, pitch) for edge in (rows, columns)]
    down, across = (
        bars(edge, place, np.full(len(place), 0.2 * MM)) for edge, place in zip((rows, columns), grid, strict=True)
    )
    ink(page, 0.6 * np.maximum(down[:, None], across[None]), (140, 160, 196))
    if rng.random() < 0.5:
        _sketch(page, rng)


def _sketch(page: Field, rng: np.random.Generator) -> None:
    """Draw lines and boxes with a pen, in place."""
    rows, columns = page.shape[:2]
    cover = np.zeros((rows, columns), np.float32)
    for _ in range(int(rng.integers(3, 9))):
        x, y = float(rng.uniform(0, columns)), float(rng.uniform(0, rows))
        wide, tall = (float(each) * MM for each in rng.uniform(6, 40, 2))
        corners = np.array([[x, y], [x + wide, y], [x + wide, y + tall], [x, y + tall]])
        lines(cover, corners + rng.normal(0, 0.4 * MM, (4, 2)), 0.45 * MM, closed=rng.random() < 0.6)
    ink(page, 0.9 * cover, INKS[int(rng.integers(len(INKS)))])


def _text(page: Field, rng: np.random.Generator) -> None:
    """Print a heading and paragraphs, in place."""
    rows, columns = page.shape[:2]
    cover = np.zeros((rows, columns), np.float32)
    size = float(rng.uniform(2.6, 4.0)) * MM
    margin = min(float(rng.uniform(5, 14)) * MM, columns / 8)
    y = margin + 1.6 * size
    write(cover, " ".join(rng.choice(WORDS, int(rng.integers(2, 5)))).capitalize(), (margin, y), 1.6 * size)
    y += 2.2 * size
    while y < rows - margin:
        words = " ".join(rng.choice(WORDS, max(2, int((columns - 2 * margin) / (3.2 * size)))))
        write(cover, words[: int((columns - 2 * margin) / (0.5 * size))], (margin, y), size)
        y += (1.35 if rng.random() < 0.85 else 2.3) * size
    ink(page, 0.92 * cover, INKS[int(rng.integers(2))])


def _drawing(page: Field, rng: np.random.Generator) -> None:
    """Draw a wiring diagram, in place: boxes with names, and lines between them that turn at right angles."""
    rows, columns = page.shape[:2]
    cover = np.zeros((rows, columns), np.float32)
    boxes = []
    for _ in range(int(rng.integers(3, 7))):
        wide, tall = float(rng.uniform(12, 28)) * MM, float(rng.uniform(8, 20)) * MM
        x, y = float(rng.uniform(0, max(1, columns - wide))), float(rng.uniform(0, max(1, rows - tall)))
        boxes.append((x, y, wide, tall))
        lines(cover, np.array([[x, y], [x + wide, y], [x + wide, y + tall], [x, y + tall]]), 0.35 * MM, closed=True)
        write(cover, f"{rng.choice(('K', 'X', 'Q', 'U', 'F'))}{int(rng.integers(1, 40))}", (x + MM, y - MM), 3 * MM)
    for _ in range(2 * len(boxes)):
        (x0, y0, w0, t0), (x1, y1, _, t1) = (boxes[int(k)] for k in rng.integers(len(boxes), size=2))
        start = (x0 + w0, y0 + t0 * float(rng.uniform(0.1, 0.9)))
        end = (x1, y1 + t1 * float(rng.uniform(0.1, 0.9)))
        bend = (start[0] + end[0]) / 2 + float(rng.uniform(-8, 8)) * MM
        lines(cover, np.array([start, (bend, start[1]), (bend, end[1]), end]), 0.3 * MM)
    ink(page, 0.92 * cover, INKS[int(rng.integers(2))])


def _chart(page: Field, rng: np.random.Generator) -> None:
    """Draw axes, a grid and a few coloured curves, in place: curves on paper resemble cables most."""
    rows, columns = page.shape[:2]
    low, high = np.array([0.12 * columns, 0.1 * rows]), np.array([0.94 * columns, 0.86 * rows])
    grid, axes = np.zeros((rows, columns), np.float32), np.zeros((rows, columns), np.float32)
    for share in np.linspace(0, 1, 7):
        x, y = low + share * (high - low)
        lines(grid, np.array([[x, low[1]], [x, high[1]]]), 0.15 * MM)
        lines(grid, np.array([[low[0], y], [high[0], y]]), 0.15 * MM)
        write(axes, f"{round(10 * share)}", (x, high[1] + 1.5 * MM), 2.6 * MM, "mt")
    lines(axes, np.array([[low[0], low[1]], [low[0], high[1]], [high[0], high[1]]]), 0.35 * MM)
    ink(page, 0.8 * grid, (190, 190, 190))
    ink(page, axes, (30, 30, 32))
    x = np.linspace(low[0], high[0], 200)
    for _ in range(int(rng.integers(2, 6))):
        curve = smooth_noise(rng, 1, 200, (1.0, float(rng.uniform(40, 120))))[0]
        y = 0.5 * (low[1] + high[1]) + 0.2 * (high[1] - low[1]) * np.clip(curve, -2.4, 2.4)
        cover = np.zeros((rows, columns), np.float32)
        lines(cover, np.stack([x, y], axis=1), float(rng.uniform(0.4, 0.9)) * MM)
        red, green, blue = (int(level) for level in rng.integers(20, 210, 3))
        ink(page, cover, (red, green, blue))


def draw_label(sheet: Sheet, rng: np.random.Generator) -> Print:
    """Draw a sticker with rounded corners: lines of print, the first the largest, and on most a barcode."""
    rows, columns = pixels_of(sheet.width_m), pixels_of(sheet.length_m)
    canvas = plain(rows, columns, sheet.colour)
    cover = np.zeros((rows, columns), np.float32)
    edge = 0.07 * rows
    if rng.random() < 0.4:
        frame = np.array([[edge, edge], [columns - edge, edge], [columns - edge, rows - edge], [edge, rows - edge]])
        lines(cover, frame, 0.3 * MM, closed=True)
    code = rng.random() < 0.75
    lower = 0.52 * rows if code else 0.95 * rows
    size = min(float(rng.uniform(2.0, 3.2)) * MM, 0.28 * lower)
    y = 1.8 * edge + size
    while y < lower:
        letters = "".join(rng.choice(list("ABCDEFHKLMNPRSTX"), 3))
        text = f"{letters}-{int(rng.integers(1000, 99999))}  {' '.join(rng.choice(WORDS, 3)).upper()}"
        write(cover, text[: max(4, int((columns - 4 * edge) / (0.62 * size)))], (2 * edge, y), size)
        y += 1.3 * size
        size = min(size, 2.2 * MM)
    if code:
        _barcode(cover, (2 * edge, 0.56 * rows), (columns - 2 * edge, 0.93 * rows), rng)
    ink(canvas, 0.95 * cover, (22, 22, 24))
    canvas *= 1 + 0.015 * rough_noise(rng, rows, columns, 30.0, 3)[:, :, None]
    drawn = Print(
        colour=levels(canvas),
        roughness=np.full((rows, columns), round(255 * float(rng.uniform(0.3, 0.6))), np.uint8),
        alpha=_rounded(rows, columns, 0.08 * rows),
    )
    return on_floor(drawn, 0.4e-3, 0.3)


def _barcode(cover: Field, low: tuple[float, float], high: tuple[float, float], rng: np.random.Generator) -> None:
    """Draw bars and gaps of one to four modules between two corners (column, row), in place."""
    module = max(1.0, 0.33 * MM)
    widths = rng.integers(1, 5, size=max(4, int((high[0] - low[0]) / (2.5 * module)))) * module
    edges = low[0] + np.cumsum(widths)
    dark = slice(1, None, 2)
    inside = edges[dark] < high[0]
    code = bars(cover.shape[1], (edges[dark] - widths[dark] / 2)[inside], widths[dark][inside])
    part = cover[int(low[1]) : int(high[1])]
    np.maximum(part, code[None], out=part)


def _rounded(rows: int, columns: int, radius: float) -> np.typing.NDArray[np.uint8]:
    mask = np.zeros((rows, columns), np.uint8)
    r = max(1, round(radius))
    cv2.rectangle(mask, (r, 0), (columns - 1 - r, rows - 1), 255, -1)
    cv2.rectangle(mask, (0, r), (columns - 1, rows - 1 - r), 255, -1)
    for x in (r, columns - 1 - r):
        for y in (r, rows - 1 - r):
            cv2.circle(mask, (x, y), r, (255,), -1, cv2.LINE_AA)
    return mask
