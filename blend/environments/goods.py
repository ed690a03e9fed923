"""Small things: boxes, bins, bottles, books, cases, tools, cups.

Each function is a `layout.Build`: the thing's back is at y = 0, its foot at z = 0, its middle at x = 0.
"""

import numpy as np

from blend.environments.assembly import Assembly
from blend.environments.layout import Piece
from blend.environments.palette import (
    ALUMINIUM,
    BINS,
    BLACK,
    BOOKS,
    CABLES,
    CARDBOARD,
    CASES,
    MACHINES,
    PLASTICS,
    STEEL,
    WHITE,
    WOODS,
    pick,
    vary,
)
from blend.environments.prints import PrintKind, any_of

Rng = np.random.Generator


def carton(a: Assembly, rng: Rng, width: float = 0.36, depth: float = 0.32) -> None:
    """A cardboard box with tape and a label."""
    high, tint = rng.uniform(0.16, 0.4), vary(rng, pick(rng, CARDBOARD))
    a.box((0, 0.5 * depth, 0), (width, depth, high), "card", tint, bevel=0.004)
    tape = (0.42, 0.3, 0.15) if rng.random() < 0.7 else (0.5, 0.5, 0.48)
    a.box((0, 0.5 * depth, high), (0.05, depth, 0.002), "plastic", tape)
    a.box((0, depth, high - 0.07), (0.05, 0.002, 0.07), "plastic", tape)
    if rng.random() < 0.7:
        size = rng.uniform(0.07, 0.13)
        place = (rng.uniform(-0.25, 0.25) * width, depth + 0.002, 0.2 * high)
        a.picture(place, (size, min(size * 0.7, 0.7 * high)), any_of(rng, PrintKind.LABEL))


def small_carton(a: Assembly, rng: Rng) -> None:
    """A small cardboard box."""
    carton(a, rng, 0.24, 0.22)


def large_carton(a: Assembly, rng: Rng) -> None:
    """A large cardboard box."""
    carton(a, rng, 0.56, 0.45)


def stacked_cartons(a: Assembly, rng: Rng) -> None:
    """Two or three cardboard boxes, one on another."""
    z = 0.0
    for _ in range(int(rng.integers(2, 4))):
        high, tint = rng.uniform(0.15, 0.3), vary(rng, pick(rng, CARDBOARD))
        with a.at(rng.normal(0, 0.015), rng.uniform(0, 0.03), z, turn=rng.normal(0, 3)):
            a.box((0, 0.2, 0), (0.4, 0.36, high), "card", tint, bevel=0.004)
            a.box((0, 0.2, high), (0.05, 0.36, 0.002), "plastic", (0.42, 0.3, 0.15))
            a.picture((rng.uniform(-0.1, 0.1), 0.382, 0.03), (0.12, 0.08), any_of(rng, PrintKind.LABEL))
        z += high


def bin_open(a: Assembly, rng: Rng) -> None:
    """An open-fronted storage bin with parts in it."""
    tint = pick(rng, BINS)
    for side in (-0.085, 0.085):
        a.box((side, 0.14, 0), (0.008, 0.26, 0.12), "plastic", tint)
    a.box((0, 0.14, 0), (0.17, 0.26, 0.01), "plastic", tint)
    a.box((0, 0.015, 0), (0.17, 0.01, 0.13), "plastic", tint)
    a.box((0, 0.265, 0), (0.17, 0.008, 0.06), "plastic", tint)
    a.picture((0, 0.271, 0.015), (0.09, 0.04), any_of(rng, PrintKind.LABEL))
    for _ in range(7):
        place = (rng.uniform(-0.06, 0.06), rng.uniform(0.05, 0.22), 0.012)
        metal = rng.random() < 0.5
        a.box(
            place,
            (0.05, 0.05, rng.uniform(0.03, 0.08)),
            "metal" if metal else "plastic",
            STEEL if metal else pick(rng, PLASTICS),
            bevel=0.006,
            turn=rng.uniform(0, 90),
        )


def crate(a: Assembly, rng: Rng) -> None:
    """A plastic crate with ribs and grips."""
    tint, high = vary(rng, pick(rng, BINS)), rng.uniform(0.2, 0.32)
    a.box((0, 0.2, 0), (0.56, 0.38, high), "plastic", tint, bevel=0.012)
    a.box((0, 0.2, high - 0.035), (0.6, 0.4, 0.03), "plastic", tint, bevel=0.008)
    for x in np.linspace(-0.24, 0.24, 7):
        a.box((float(x), 0.392, 0.01), (0.012, 0.012, high - 0.05), "plastic", tint)
    a.box((0, 0.396, high - 0.11), (0.15, 0.008, 0.04), "plastic", BLACK)
    a.picture((0.15, 0.4, 0.04), (0.1, 0.07), any_of(rng, PrintKind.LABEL))


def case(a: Assembly, rng: Rng) -> None:
    """A hard case with latches, corners and a grip."""
    tint, high, width = vary(rng, pick(rng, CASES)), rng.uniform(0.22, 0.36), rng.uniform(0.38, 0.48)
    a.box((0, 0.18, 0), (width, 0.34, high), "plastic", tint, bevel=0.02)
    a.box((0, 0.18, 0.62 * high), (width + 0.006, 0.346, 0.014), "metal", ALUMINIUM)
    for x in (-0.3, 0.3):
        a.box((x * width, 0.355, 0.5 * high), (0.05, 0.014, 0.07), "metal", STEEL, bevel=0.004)
    for x in (-0.5, 0.5):
        for z in (0.0, high - 0.04):
            a.box((x * (width - 0.03), 0.335, z), (0.045, 0.04, 0.045), "metal", ALUMINIUM, bevel=0.01)
    a.tube(
        [(-0.07, 0.35, 0.4 * high), (-0.05, 0.39, 0.4 * high), (0.05, 0.39, 0.4 * high), (0.07, 0.35, 0.4 * high)],
        0.01,
        "rubber",
        BLACK,
    )
    a.picture((0.0, 0.352, 0.68 * high), (0.1, 0.06), any_of(rng, PrintKind.LABEL))


def tool_box(a: Assembly, rng: Rng) -> None:
    """A steel tool box with a lid and a bow handle."""
    tint = vary(rng, pick(rng, MACHINES))
    a.box((0, 0.12, 0), (0.42, 0.2, 0.15), "paint", tint, bevel=0.008)
    a.prism([(0.02, 0.15), (0.22, 0.15), (0.17, 0.21), (0.07, 0.21)], 0.0, 0.42, "paint", tint)
    a.tube([(-0.15, 0.12, 0.2), (-0.13, 0.12, 0.26), (0.13, 0.12, 0.26), (0.15, 0.12, 0.2)], 0.009, "chrome", STEEL)
    for x in (-0.12, 0.12):
        a.box((x, 0.222, 0.12), (0.035, 0.012, 0.05), "chrome", STEEL)


def books(a: Assembly, rng: Rng) -> None:
    """A short row of books, sometimes with a leaning one at its end."""
    x, lean = -0.17, rng.random() < 0.4
    while x < 0.14:
        thick, high, deep = rng.uniform(0.012, 0.045), rng.uniform(0.19, 0.3), rng.uniform(0.14, 0.21)
        tint = vary(rng, pick(rng, BOOKS))
        a.box((x + 0.5 * thick, 0.5 * deep + 0.02, 0), (thick, deep, high), "card", tint, bevel=0.002)
        a.box((x + 0.5 * thick, deep + 0.021, 0.7 * high), (0.8 * thick, 0.002, 0.02), "card", vary(rng, WHITE))
        x += thick + 0.001
    if lean:
        with a.at(x + 0.03, 0.1, 0.0):
            a.box((0, 0, 0), (0.02, 0.16, 0.24), "card", pick(rng, BOOKS))


def binders(a: Assembly, rng: Rng) -> None:
    """A row of ring binders."""
    tint = pick(rng, BOOKS)
    for n in range(5):
        own = vary(rng, tint if rng.random() < 0.75 else pick(rng, BOOKS))
        x = -0.155 + 0.078 * n
        a.box((x, 0.15, 0), (0.074, 0.28, 0.315), "plastic", own, bevel=0.004)
        a.picture((x, 0.291, 0.14), (0.05, 0.13), any_of(rng, PrintKind.LABEL))
        a.cylinder((x, 0.289, 0.07), 0.012, 0.003, "chrome", STEEL, axis="y")


def papers(a: Assembly, rng: Rng) -> None:
    """A few sheets of paper, askew."""
    for n in range(int(rng.integers(1, 5))):
        with a.at(rng.normal(0, 0.02), 0.15 + rng.normal(0, 0.02), 0.003 * n, turn=rng.normal(0, 12)):
            a.box((0, 0, 0), (0.21, 0.297, 0.002), "card", WHITE)
            a.picture((0, 0.148, 0.0035), (0.21, 0.297), any_of(rng, PrintKind.SHEET), facing="z")


def bottle(a: Assembly, rng: Rng) -> None:
    """A bottle or spray can."""
    tint, r, h = vary(rng, pick(rng, PLASTICS)), rng.uniform(0.025, 0.045), rng.uniform(0.14, 0.28)
    profile = [(r, 0), (r, 0.68 * h), (0.9 * r, 0.75 * h), (0.35 * r, 0.86 * h), (0.35 * r, h)]
    a.lathe((0, 0.05, 0), profile, "plastic", tint, sides=12)
    a.cylinder((0, 0.05, 0.94 * h), 0.42 * r, 0.09 * h, "plastic", pick(rng, PLASTICS), sides=10)
    a.cylinder((0, 0.05, 0.2 * h), r * 1.01, 0.3 * h, "card", vary(rng, pick(rng, PLASTICS)), sides=12)


def canister(a: Assembly, rng: Rng) -> None:
    """A canister with a grip."""
    tint = vary(rng, pick(rng, PLASTICS))
    a.box((0, 0.12, 0), (0.24, 0.2, 0.3), "plastic", tint, bevel=0.03)
    a.tube([(-0.07, 0.12, 0.29), (-0.05, 0.12, 0.35), (0.05, 0.12, 0.35), (0.07, 0.12, 0.29)], 0.015, "plastic", tint)
    a.cylinder((0.08, 0.16, 0.29), 0.025, 0.04, "plastic", BLACK)
    a.picture((0, 0.221, 0.06), (0.13, 0.15), any_of(rng, PrintKind.LABEL))


def tin(a: Assembly, rng: Rng) -> None:
    """A paint tin."""
    r, h = rng.uniform(0.05, 0.09), rng.uniform(0.1, 0.2)
    a.cylinder((0, 0.1, 0), r, h, "metal", STEEL)
    a.cylinder((0, 0.1, 0.1 * h), r * 1.01, 0.75 * h, "card", vary(rng, pick(rng, PLASTICS)))
    a.cylinder((0, 0.1, h - 0.006), r * 1.04, 0.01, "metal", STEEL)


def mug(a: Assembly, rng: Rng) -> None:
    """A mug."""
    tint = vary(rng, pick(rng, PLASTICS))
    a.lathe((0, 0.05, 0), [(0.036, 0), (0.04, 0.095), (0.034, 0.095), (0.03, 0.02)], "plastic", tint, sides=14)
    a.tube(
        [(0.036, 0.05, 0.075), (0.06, 0.05, 0.065), (0.06, 0.05, 0.035), (0.036, 0.05, 0.025)], 0.005, "plastic", tint
    )


def reel(a: Assembly, rng: Rng) -> None:
    """A standing reel of wire."""
    r, w, tint = rng.uniform(0.09, 0.17), rng.uniform(0.07, 0.14), pick(rng, CABLES)
    side = pick(rng, WOODS) if rng.random() < 0.5 else pick(rng, PLASTICS)
    a.cylinder((-0.5 * w, 0.18, r), 0.78 * r, w, "rubber", tint, axis="x", sides=20)
    for x in (-0.5 * w - 0.01, 0.5 * w):
        a.cylinder((x, 0.18, r), r, 0.01, "wood", side, axis="x", sides=20)


def coil(a: Assembly, rng: Rng) -> None:
    """A lying coil of cable."""
    tint, r = pick(rng, CABLES), rng.uniform(0.1, 0.15)
    turns = np.linspace(0, 2 * np.pi * 5, 70)
    wobble = r * (1 + 0.06 * np.sin(turns * 0.77))
    points = np.column_stack([wobble * np.cos(turns), 0.17 + wobble * np.sin(turns), 0.012 + 0.007 * turns / np.pi])
    a.tube(points, 0.008, "rubber", tint)


CARTONS = (
    Piece(carton, 0.38, 0.34),
    Piece(small_carton, 0.26, 0.24),
    Piece(large_carton, 0.58, 0.47),
    Piece(stacked_cartons, 0.42, 0.4),
)
"""Cardboard boxes."""

STORED = (
    *CARTONS,
    Piece(crate, 0.62, 0.42),
    Piece(case, 0.5, 0.4),
    Piece(tool_box, 0.44, 0.25),
    Piece(canister, 0.27, 0.25),
    Piece(reel, 0.3, 0.36),
    Piece(bin_open, 0.19, 0.28),
)
"""Things that are kept on the shelves of workshops and storerooms."""

SHELVED = (
    Piece(binders, 0.4, 0.32),
    Piece(books, 0.38, 0.25),
    Piece(small_carton, 0.26, 0.24),
    Piece(bottle, 0.1, 0.1),
)
"""Things that are kept on the shelves of offices."""
