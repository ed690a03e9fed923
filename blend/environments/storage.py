"""Filled cupboards, shelving, racks and pallets."""

from collections.abc import Sequence

import numpy as np

from blend.environments.assembly import Assembly
from blend.environments.furniture import plant
from blend.environments.goods import SHELVED, STORED
from blend.environments.layout import Piece, clutter, row_on
from blend.environments.palette import (
    BLACK,
    BLUE,
    DARK_GREY,
    LIGHT_GREY,
    ORANGE,
    STEEL,
    STEEL_FURNITURE,
    WHITE,
    WOODS,
    pick,
    vary,
)
from blend.environments.prints import PrintKind, any_of

Rng = np.random.Generator


def steel_cupboard(a: Assembly, rng: Rng) -> None:
    """A two-door steel cupboard with things on top."""
    tint, width, high = vary(rng, pick(rng, STEEL_FURNITURE)), 0.95, 1.95
    a.box((0, 0.22, 0.06), (width, 0.42, high - 0.06), "paint", tint, bevel=0.008)
    a.box((0, 0.2, 0), (width - 0.06, 0.36, 0.06), "paint", BLACK)
    for side in (-1, 1):
        a.box(
            (side * 0.25 * width, 0.44, 0.08),
            (0.5 * width - 0.008, 0.018, high - 0.11),
            "paint",
            vary(rng, tint, 0.04),
            bevel=0.005,
        )
        for n in range(4):
            a.box((side * 0.25 * width, 0.45, high - 0.2 - 0.03 * n), (0.2, 0.004, 0.01), "rubber", BLACK)
    a.box((0.03, 0.46, 1.0), (0.02, 0.03, 0.14), "chrome", STEEL, bevel=0.006)
    if rng.random() < 0.8:
        a.picture((-0.25 * width, 0.4505, 1.2), (0.2, 0.28), any_of(rng, PrintKind.SHEET))
    if rng.random() < 0.7:
        with a.at(0, 0.02):
            row_on(a, rng, STORED, width, high, empty=0.4)


def lockers(a: Assembly, rng: Rng) -> None:
    """Three lockers side by side."""
    tint = pick(rng, (BLUE, (0.25, 0.3, 0.32), (0.4, 0.42, 0.4), (0.05, 0.2, 0.12)))
    a.box((0, 0.24, 0.05), (0.92, 0.48, 1.8), "paint", LIGHT_GREY, bevel=0.006)
    for n in range(3):
        x = -0.303 + 0.303 * n
        a.box((x, 0.486, 0.08), (0.292, 0.016, 1.74), "paint", vary(rng, tint, 0.05), bevel=0.005)
        for z in (0.25, 0.28, 0.31, 1.55, 1.58, 1.61):
            a.box((x, 0.496, z), (0.14, 0.003, 0.01), "rubber", BLACK)
        a.box((x + 0.11, 0.505, 0.95), (0.018, 0.025, 0.07), "chrome", STEEL)
        a.picture((x, 0.495, 1.4), (0.09, 0.05), any_of(rng, PrintKind.LABEL))


def steel_shelf(
    a: Assembly, rng: Rng, pieces: Sequence[Piece] = STORED, *, width: float = 1.2, high: float = 2.1, boards: int = 5
) -> None:
    """Filled open shelving of angle steel."""
    post = pick(rng, (STEEL, LIGHT_GREY, BLUE, DARK_GREY))
    for x in (-0.5 * width, 0.5 * width):
        for y in (0.03, 0.47):
            a.box((x, y, 0), (0.035, 0.035, high), "paint", post)
    a.tube([(-0.5 * width, 0.02, 0.1), (0.5 * width, 0.02, high - 0.1)], 0.006, "metal", STEEL)
    a.tube([(0.5 * width, 0.02, 0.1), (-0.5 * width, 0.02, high - 0.1)], 0.006, "metal", STEEL)
    for z in np.linspace(0.12, high - 0.04, boards):
        a.box((0, 0.25, float(z)), (width, 0.48, 0.03), "paint", vary(rng, LIGHT_GREY), bevel=0.004)
        with a.at(0, 0.02):
            row_on(a, rng, pieces, width - 0.06, float(z) + 0.03)


def book_case(a: Assembly, rng: Rng) -> None:
    """A wooden bookcase with binders, books and oddments."""
    wood, width, high = pick(rng, (*WOODS, WHITE, LIGHT_GREY)), 0.9, rng.choice([1.2, 2.0])
    for x in (-0.5 * width, 0.5 * width):
        a.box((x, 0.17, 0), (0.022, 0.34, high), "wood", wood, bevel=0.003)
    a.box((0, 0.005, 0), (width, 0.01, high), "wood", vary(rng, wood))
    for z in np.linspace(0.06, high - 0.022, round(high / 0.4) + 1):
        a.box((0, 0.17, float(z)), (width, 0.33, 0.022), "wood", wood, bevel=0.003)
        if z < high - 0.1:
            row_on(a, rng, SHELVED, width - 0.03, float(z) + 0.022, empty=0.18)
    if high < 1.5:
        clutter(a, rng, (Piece(plant, 0.3, 0.3), *SHELVED), (width, 0.33), high, density=0.6)


def pallet_rack(
    a: Assembly, rng: Rng, pieces: Sequence[Piece] = STORED, *, width: float = 2.7, levels: int = 3, gap: float = 1.25
) -> None:
    """Loaded heavy racking with painted uprights and orange beams."""
    deep, upright = 0.95, pick(rng, (BLUE, (0.02, 0.1, 0.05), (0.3, 0.32, 0.34)))
    high = gap * levels
    for x in (-0.5 * width, 0.5 * width):
        for y in (0.05, deep - 0.05):
            a.box((x, y, 0), (0.09, 0.07, high), "paint", upright, bevel=0.005)
            a.box((x, y + 0.038, 0.4), (0.03, 0.002, high - 0.6), "rubber", BLACK)
        for n in range(int(high / 0.6)):
            ends = [(x, 0.05, 0.2 + 0.6 * n), (x, deep - 0.05, 0.6 + 0.6 * n)]
            a.tube(
                ends if n % 2 else [(x, 0.05, 0.6 + 0.6 * n), (x, deep - 0.05, 0.2 + 0.6 * n)], 0.014, "paint", upright
            )
        a.box((x, deep + 0.06, 0), (0.14, 0.1, 0.4), "paint", (0.75, 0.5, 0.02), bevel=0.02)
    for level in range(levels):
        z = 0.08 + gap * level
        for y in (0.05, deep - 0.05):
            a.box((0, y, z), (width - 0.09, 0.05, 0.11), "paint", vary(rng, ORANGE, 0.06), bevel=0.006)
        a.box((0, 0.5 * deep, z + 0.1), (width - 0.1, deep - 0.1, 0.02), "surface:particle_board", (1, 1, 1))
        a.picture(
            (rng.uniform(-1, 1) * 0.3 * width, deep - 0.023, z + 0.02), (0.14, 0.07), any_of(rng, PrintKind.LABEL)
        )
        with a.at(0, 0.04, z + 0.12):
            _loaded(a, rng, pieces, width - 0.2, gap - 0.3)


def _loaded(a: Assembly, rng: Rng, pieces: Sequence[Piece], width: float, high: float) -> None:
    """The goods on one level: loose things in two rows, or two pallets of cartons."""
    if rng.random() < 0.45:
        for x in (-0.25, 0.25):
            with a.at(x * width, 0.0):
                pallet(a, rng, layers=max(1, int(high / 0.3)) if rng.random() < 0.85 else 0)
        return
    with a.at(0, 0.02):
        row_on(a, rng, pieces, width, 0.0)
    with a.at(0, 0.42):
        row_on(a, rng, pieces, width, 0.0, empty=0.25)


def pallet(a: Assembly, rng: Rng, layers: int = 3) -> None:
    """A pallet with `layers` layers of equal cartons."""
    wood = pick(rng, WOODS)
    for y in (0.06, 0.4, 0.74):
        a.box((0, y, 0), (1.15, 0.09, 0.1), "wood", vary(rng, wood))
    for x in np.linspace(-0.52, 0.52, 7):
        a.box((float(x), 0.4, 0.1), (0.1, 0.8, 0.022), "wood", vary(rng, wood, 0.2), bevel=0.003)
    tint, high = pick(rng, ((0.42, 0.25, 0.1), (0.5, 0.33, 0.16), (0.62, 0.6, 0.55))), rng.uniform(0.2, 0.3)
    for layer in range(layers):
        for x in (-0.37, 0.0, 0.37):
            for y in (0.2, 0.59):
                if layer == layers - 1 and rng.random() < 0.3:
                    continue
                z = 0.122 + layer * high
                with a.at(x + rng.normal(0, 0.006), y + rng.normal(0, 0.006), z, turn=rng.normal(0, 1)):
                    a.box((0, 0, 0), (0.36, 0.38, high - 0.004), "card", vary(rng, tint, 0.08), bevel=0.004)
                    a.box((0, 0.191, 0), (0.36, 0.002, 0.05), "plastic", (0.4, 0.27, 0.13))
                    if y > 0.4:
                        a.picture((rng.uniform(-0.06, 0.06), 0.193, 0.08), (0.14, 0.1), any_of(rng, PrintKind.LABEL))
