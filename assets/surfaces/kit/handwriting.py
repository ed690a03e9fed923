"""Writing and print: lines of handwriting, and pages with text, a table and a diagram."""

from itertools import pairwise

import cv2
import numpy as np
import numpy.typing as npt

from assets.surfaces.kit.grid import Field, Grid
from assets.surfaces.kit.lettering import text_patch
from assets.surfaces.kit.strokes import Image, as_field, polylines

SYLLABLES = (
    *("ca", "ble", "ter", "mi", "nal", "con", "nec", "tor", "sig"),
    *("vol", "ta", "ge", "pin", "re", "lay", "un", "it"),
)
"""Syllables from which the made-up words of printed pages are put together."""


def written_lines(
    rng: np.random.Generator,
    image: Image,
    grid: Grid,
    rows_mm: npt.NDArray[np.float64],
    height_mm: float,
    stroke_mm: float = 0.4,
) -> None:
    """Write lines by hand on an image of the tile, in place.

    Args:
        rng: Source of the randomness.
        image: Image of the tile, shape (H, W), 0 to 255.
        grid: The tile.
        rows_mm: Base line of each line of writing, millimetres from the top, shape (n,).
        height_mm: Height of the small letters.
        stroke_mm: Width of the pen's stroke.
    """
    for y in rows_mm:
        x = rng.uniform(0, grid.size_mm)
        slope = rng.normal(0, 0.02)
        end = x + min(rng.uniform(17, 50) * height_mm, 0.8 * grid.size_mm)
        value = (float(rng.uniform(150, 255)),)
        while x < end:
            word = _word(rng, height_mm)
            word[:, 1] += y + slope * (x - end)
            word[:, 0] += x
            polylines(image, word, stroke_mm, value, grid)
            x = float(word[-1, 0]) + 1.1 * height_mm


def printed_page(rng: np.random.Generator, size_mm: tuple[float, float], grid: Grid) -> Field:
    """Print a page: paragraphs of grey lines, and a table or a wiring diagram.

    Args:
        rng: Source of the randomness.
        size_mm: Width and height of the page.
        grid: Grid that sets the size of a texel.

    Returns:
        Ink, 0 to 1, shape (h, w).
    """
    page = np.zeros((round(size_mm[1] / grid.texel_mm), round(size_mm[0] / grid.texel_mm)), np.uint8)
    y = 22.0
    while y < size_mm[1] - 30:
        block = rng.random()
        if block < 0.55:
            for _ in range(int(rng.integers(4, 9))):
                _text_line(rng, page, 20.0, size_mm[0] - 20.0 - float(rng.exponential(6)), y, grid)
                y += 4.9
        elif block < 0.78:
            y += _table(rng, page, size_mm[0] - 40, y, grid)
        else:
            y += _diagram(rng, page, size_mm[0] - 40, y, grid)
        y += 7.0
    return as_field(page)


def _word(rng: np.random.Generator, height_mm: float) -> npt.NDArray[np.float64]:
    """Draw a scribbled word: a running loop with ascenders and descenders; corners in millimetres from its start."""
    letters = int(rng.integers(3, 10))
    t = np.linspace(0, letters, 9 * letters)
    tall = np.repeat(rng.choice([1.0, 1.0, 1.0, 1.9, 0.7], letters), 9)
    deep = np.repeat(rng.choice([0.0, 0.0, 0.0, 0.8], letters), 9)
    phase = 2 * np.pi * t + np.cumsum(rng.normal(0, 0.12, t.size))
    x = height_mm * (0.62 * t + 0.26 * np.cos(phase) * np.repeat(rng.uniform(0.3, 1.4, letters), 9))
    up = 0.5 * (1 + np.sin(phase))
    y = -height_mm * (up * tall - (1 - up) * deep)
    return np.stack([x - x[0] - 0.2 * y, y], axis=1)


def _text_line(rng: np.random.Generator, page: Image, left_mm: float, right_mm: float, y_mm: float, grid: Grid) -> None:
    """Print one line of made-up words, 2.1 mm high."""
    words: list[str] = []
    while sum(len(word) + 1 for word in words) < (right_mm - left_mm) / 1.75:
        words.append("".join(rng.choice(SYLLABLES, int(rng.integers(1, 4)))))
    patch = text_patch(" ".join(words), 2.1, grid, 0.12)
    _paste(page, patch, left_mm, y_mm, right_mm, grid)


def _paste(page: Image, patch: Image, left_mm: float, y_mm: float, right_mm: float, grid: Grid) -> None:
    """Put a patch on the page, clipped at the right margin and at the page's foot."""
    top, left = round(y_mm / grid.texel_mm), round(left_mm / grid.texel_mm)
    room = page[top : top + patch.shape[0], left : round(right_mm / grid.texel_mm)]
    high, wide = min(room.shape[0], patch.shape[0]), min(room.shape[1], patch.shape[1])
    room[:high, :wide] = np.maximum(room[:high, :wide], patch[:high, :wide])


def _table(rng: np.random.Generator, page: Image, width_mm: float, y_mm: float, grid: Grid) -> float:
    """Draw a ruled table with numbers in its cells; returns its height in millimetres."""
    rows, columns = int(rng.integers(4, 8)), int(rng.integers(3, 6))
    high, wide = 7.0, width_mm / columns
    for row in range(rows + 1):
        _line(page, (20, y_mm + high * row), (20 + width_mm, y_mm + high * row), 0.3, grid)
    for column in range(columns + 1):
        _line(page, (20 + wide * column, y_mm), (20 + wide * column, y_mm + high * rows), 0.3, grid)
    for row in range(rows):
        for column in range(columns):
            text = "".join(str(digit) for digit in rng.integers(0, 10, int(rng.integers(2, 6))))
            x = 20 + wide * column + 2
            _paste(page, text_patch(text, 2.1, grid, 0.12), x, y_mm + high * row + 2, x + wide - 4, grid)
    return high * rows


def _diagram(rng: np.random.Generator, page: Image, width_mm: float, y_mm: float, grid: Grid) -> float:
    """Draw boxes joined by wires along the page's axes; returns the height in millimetres."""
    high = 46.0
    boxes = [(22 + (width_mm - 30) * (i + 0.2) / 4, y_mm + float(rng.uniform(0, high - 22))) for i in range(4)]
    for x, top in boxes:
        corners = [(x, top), (x + 20, top), (x + 20, top + 20), (x, top + 20), (x, top)]
        for start, end in pairwise(corners):
            _line(page, start, end, 0.4, grid)
        _paste(page, text_patch(f"K{int(rng.integers(1, 90))}", 2.6, grid), x + 5, top + 8, x + 20, grid)
    for (x0, y0), (x1, y1) in pairwise(boxes):
        for wire in range(3):
            middle = x0 + 20 + (x1 - x0 - 20) * (0.25 + 0.22 * wire)
            leaves, arrives = y0 + 4 + 5 * wire, y1 + 4 + 5 * wire
            _line(page, (x0 + 20, leaves), (middle, leaves), 0.35, grid)
            _line(page, (middle, leaves), (middle, arrives), 0.35, grid)
            _line(page, (middle, arrives), (x1, arrives), 0.35, grid)
    return high


def _line(page: Image, start: tuple[float, float], end: tuple[float, float], width_mm: float, grid: Grid) -> None:
    """Draw a straight line on a page that doesn't wrap round."""
    points = [(round(x / grid.texel_mm), round(y / grid.texel_mm)) for x, y in (start, end)]
    cv2.line(page, points[0], points[1], (230,), max(1, round(width_mm / grid.texel_mm)), cv2.LINE_AA)
