"""Prints and screens of rooms, drawn into one image, the atlas: labels, posters, sheets, signs, screens, dials."""

from collections.abc import Callable
from enum import Enum

import cv2
import numpy as np
from numpy.typing import NDArray

from blend.environments.assembly import Print
from blend.environments.palette import pick

Image = NDArray[np.uint8]

CELL_PX, CELLS = 256, 8
"""Edge of a picture in texels, and number of pictures of each kind: one row of the atlas holds a kind."""

_WORDS = [
    "SAFETY",
    "PUMP",
    "VALVE",
    "FRAGILE",
    "ORDER",
    "MOTOR",
    "LINE",
    "PLAN",
    "CABLE",
    "STOCK",
    "MAIN",
    "CHECK",
    "UNIT",
    "TEST",
    "POWER",
    "AIR",
    "WATER",
    "ZONE",
    "PART",
    "SHIFT",
]
_INKS = ((25, 25, 30), (150, 30, 25), (25, 60, 130), (30, 100, 50), (90, 90, 95), (200, 110, 20))
_FONT = cv2.FONT_HERSHEY_SIMPLEX


class PrintKind(Enum):
    """Kinds of prints; the value is the row of the atlas that holds the kind, counted from the top."""

    SCREEN = 0
    POSTER = 1
    SHEET = 2
    LABEL = 3
    SIGN = 4
    DRAWING = 5
    PANEL = 6
    DIAL = 7


def cell(kind: PrintKind, number: int) -> Print:
    """Compute a picture's rectangle in the atlas, 1.5 texels inside its edges, so that no neighbour shows at them."""
    left, top, margin = (number % CELLS) / CELLS, 1.0 - kind.value / CELLS, 1.5 / (CELL_PX * CELLS)
    return left + margin, top - 1 / CELLS + margin, left + 1 / CELLS - margin, top - margin


def any_of(rng: np.random.Generator, kind: PrintKind) -> Print:
    """Pick a random picture of a kind, and compute its rectangle."""
    return cell(kind, int(rng.integers(CELLS)))


def draw_atlas(rng: np.random.Generator) -> Image:
    """Draw the atlas with all prints, (2048, 2048, 3), sRGB, the top row first."""
    atlas = np.zeros((CELLS * CELL_PX, CELLS * CELL_PX, 3), np.uint8)
    for kind in PrintKind:
        for column in range(CELLS):
            row = kind.value * CELL_PX
            atlas[row : row + CELL_PX, column * CELL_PX : (column + 1) * CELL_PX] = _DRAWN[kind](rng)
    return atlas


def _blank(colour: tuple[int, int, int]) -> Image:
    return np.full((CELL_PX, CELL_PX, 3), colour, np.uint8)


def _rows_of_text(image: Image, rng: np.random.Generator, box: tuple[int, int, int, int], ink: tuple[int, ...]) -> None:
    """Draw lines of text too small to read: strokes as long as words, in a box (left, top, right, bottom)."""
    left, top, right, bottom = box
    step = int(rng.integers(7, 12))
    for y in range(top, bottom - 4, step):
        x, end = left, right if rng.random() < 0.8 else int(rng.integers(left + 10, right))
        while x < end - 6:
            length = int(rng.integers(6, 26))
            for stroke in range(x, min(x + length, end), 3):
                height = int(rng.integers(2, 5))
                cv2.line(image, (stroke, y), (stroke, y + height), ink, 1)
            x += length + 5


def _colour(rng: np.random.Generator) -> tuple[int, int, int]:
    colour = cv2.cvtColor(
        np.array([[[rng.integers(180), rng.integers(90, 220), rng.integers(90, 235)]]], np.uint8), cv2.COLOR_HSV2RGB
    )[0, 0]
    return int(colour[0]), int(colour[1]), int(colour[2])


def _screen(rng: np.random.Generator) -> Image:
    dark = rng.random() < 0.5
    image = _blank((28, 32, 40) if dark else (236, 238, 242))
    ink = (190, 200, 205) if dark else (60, 60, 70)
    cv2.rectangle(image, (0, 0), (255, 16), (45, 90, 150) if rng.random() < 0.6 else (70, 74, 80), -1)
    cv2.rectangle(image, (0, 17), (46, 255), (40, 44, 54) if dark else (214, 218, 224), -1)
    style = rng.random()
    if style < 0.35:
        _rows_of_text(image, rng, (56, 26, 246, 250), ink)
    elif style < 0.7:
        for _ in range(4):
            values = 140 + np.cumsum(rng.normal(0, 7, 25))
            line = np.column_stack([np.linspace(56, 248, 25), np.clip(values, 40, 230)]).astype(np.int32)
            cv2.polylines(image, [line], isClosed=False, color=_colour(rng), thickness=2, lineType=cv2.LINE_AA)
        for y in range(40, 240, 40):
            cv2.line(image, (54, y), (250, y), (90, 96, 104), 1)
    else:
        for _ in range(9):
            x, y = int(rng.integers(54, 190)), int(rng.integers(24, 200))
            cv2.rectangle(
                image, (x, y), (x + int(rng.integers(20, 60)), y + int(rng.integers(12, 50))), _colour(rng), -1
            )
        _rows_of_text(image, rng, (56, 190, 246, 250), ink)
    return image


def _poster(rng: np.random.Generator) -> Image:
    image = _blank(_colour(rng) if rng.random() < 0.7 else (240, 238, 230))
    for _ in range(int(rng.integers(2, 6))):
        centre = (int(rng.integers(20, 236)), int(rng.integers(60, 220)))
        if rng.random() < 0.5:
            cv2.circle(image, centre, int(rng.integers(15, 70)), _colour(rng), -1, cv2.LINE_AA)
        else:
            other = (int(rng.integers(0, 255)), int(rng.integers(60, 255)))
            cv2.rectangle(image, centre, other, _colour(rng), -1)
    cv2.rectangle(image, (0, 0), (255, 48), pick(rng, _INKS), -1)
    cv2.putText(image, pick(rng, _WORDS), (14, 36), _FONT, 1.1, (245, 245, 240), 3, cv2.LINE_AA)
    cv2.rectangle(image, (16, 196), (240, 244), (244, 243, 238), -1)
    _rows_of_text(image, rng, (24, 202, 232, 242), (50, 50, 55))
    return image


def _sheet(rng: np.random.Generator) -> Image:
    tone = int(rng.integers(228, 250))
    image = _blank((tone, tone, tone - int(rng.integers(0, 14))))
    cv2.putText(image, pick(rng, _WORDS), (22, 34), _FONT, 0.7, pick(rng, _INKS), 2, cv2.LINE_AA)
    if rng.random() < 0.5:
        rows = int(rng.integers(6, 14))
        for row in range(rows + 1):
            cv2.line(image, (20, 50 + row * 190 // rows), (236, 50 + row * 190 // rows), (90, 90, 95), 1)
        for x in (20, 80, 150, 236):
            cv2.line(image, (x, 50), (x, 240), (90, 90, 95), 1)
    _rows_of_text(image, rng, (24, 52, 234, 240), (70, 70, 75))
    return image


def _label(rng: np.random.Generator) -> Image:
    image = _blank((238, 236, 228) if rng.random() < 0.75 else (235, 200, 40))
    cv2.rectangle(image, (4, 4), (251, 251), (30, 30, 30), 4)
    cv2.putText(image, pick(rng, _WORDS), (16, 62), _FONT, 1.3, pick(rng, _INKS), 4, cv2.LINE_AA)
    x = 18
    while x < 230:
        width = int(rng.integers(2, 7))
        cv2.rectangle(image, (x, 90), (x + width, 160), (20, 20, 20), -1)
        x += width + int(rng.integers(2, 7))
    _rows_of_text(image, rng, (18, 176, 238, 240), (40, 40, 40))
    return image


def _sign(rng: np.random.Generator) -> Image:
    style = int(rng.integers(4))
    image = _blank(((240, 200, 20), (240, 240, 236), (25, 130, 70), (30, 85, 165))[style])
    if style == 0:
        corners = np.array([(128, 30), (226, 190), (30, 190)], np.int32)
        cv2.polylines(image, [corners], isClosed=True, color=(20, 20, 20), thickness=14, lineType=cv2.LINE_AA)
        cv2.line(image, (128, 86), (128, 140), (20, 20, 20), 14)
        cv2.circle(image, (128, 166), 8, (20, 20, 20), -1)
    elif style == 1:
        cv2.circle(image, (128, 112), 84, (190, 25, 25), 18, cv2.LINE_AA)
        cv2.line(image, (70, 54), (186, 170), (190, 25, 25), 18)
        cv2.rectangle(image, (92, 104), (164, 124), (20, 20, 20), -1)
    else:
        cv2.rectangle(image, (24, 60), (110, 180), (240, 240, 240), -1)
        cv2.arrowedLine(image, (124, 120), (228, 120), (240, 240, 240), 16, cv2.LINE_AA, 0, 0.4)
    cv2.putText(image, pick(rng, _WORDS), (40, 238), _FONT, 1.1, (20, 20, 20) if style < 2 else (240, 240, 240), 3)
    return image


def _drawing(rng: np.random.Generator) -> Image:
    blue = rng.random() < 0.3
    image = _blank((40, 80, 140) if blue else (242, 243, 240))
    for _ in range(14):
        ink = (215, 225, 235) if blue else pick(rng, _INKS)
        one, two = rng.integers(20, 236, 2), rng.integers(20, 236, 2)
        a, b = (int(one[0]), int(one[1])), (int(two[0]), int(two[1]))
        shape = rng.random()
        if shape < 0.4:
            cv2.rectangle(image, a, (b[0], a[1] + 30), ink, 2)
        elif shape < 0.6:
            cv2.circle(image, a, int(rng.integers(8, 40)), ink, 2, cv2.LINE_AA)
        else:
            cv2.line(image, a, b if shape < 0.8 else (b[0], a[1]), ink, 2, cv2.LINE_AA)
    _rows_of_text(image, rng, (150, 200, 244, 246), (215, 225, 235) if blue else (70, 70, 75))
    return image


def _panel(rng: np.random.Generator) -> Image:
    tone = int(rng.integers(60, 205))
    image = _blank((tone, tone, tone + 4))
    cv2.rectangle(image, (24, 20), (150, 90), (24, 40, 44), -1)
    _rows_of_text(image, rng, (32, 28, 144, 84), (90, 210, 160))
    for row in range(4):
        for column in range(6):
            centre = (36 + column * 38, 118 + row * 36)
            if rng.random() < 0.75:
                cv2.circle(image, centre, 11, (20, 20, 20), -1, cv2.LINE_AA)
                cv2.circle(image, centre, 8, _colour(rng), -1, cv2.LINE_AA)
            else:
                cv2.rectangle(
                    image, (centre[0] - 10, centre[1] - 10), (centre[0] + 10, centre[1] + 10), (30, 30, 32), -1
                )
    cv2.circle(image, (204, 56), 30, (228, 190, 20), -1, cv2.LINE_AA)
    cv2.circle(image, (204, 56), 20, (190, 20, 20), -1, cv2.LINE_AA)
    return image


def _dial(rng: np.random.Generator) -> Image:
    image = _blank((40, 42, 44))
    cv2.circle(image, (128, 128), 122, (170, 172, 172), -1, cv2.LINE_AA)
    cv2.circle(image, (128, 128), 108, (240, 240, 236), -1, cv2.LINE_AA)
    for tick in np.arange(0, 2 * np.pi, np.pi / 12):
        end = (int(128 + 104 * np.cos(tick)), int(128 + 104 * np.sin(tick)))
        cv2.line(image, (int(128 + 84 * np.cos(tick)), int(128 + 84 * np.sin(tick))), end, (20, 20, 20), 5)
    for length, width in ((84, 5), (58, 8)):
        angle = rng.uniform(0, 2 * np.pi)
        end = (int(128 + length * np.cos(angle)), int(128 + length * np.sin(angle)))
        cv2.line(image, (128, 128), end, (20, 20, 20), width, cv2.LINE_AA)
    return image


_DRAWN: dict[PrintKind, Callable[[np.random.Generator], Image]] = {
    PrintKind.SCREEN: _screen,
    PrintKind.POSTER: _poster,
    PrintKind.SHEET: _sheet,
    PrintKind.LABEL: _label,
    PrintKind.SIGN: _sign,
    PrintKind.DRAWING: _drawing,
    PrintKind.PANEL: _panel,
    PrintKind.DIAL: _dial,
}
