"""Tools and other things that lie on benches.

Each function is a `layout.Build`: the thing's back is at y = 0, its foot at z = 0, its middle at x = 0.
"""

import numpy as np

from blend.environments.assembly import Assembly
from blend.environments.goods import bin_open, bottle, coil, mug, papers, reel, small_carton, tin, tool_box
from blend.environments.layout import Piece
from blend.environments.palette import (
    BLACK,
    DARK_GREY,
    LIGHT_GREY,
    ORANGE,
    PLASTICS,
    STEEL,
    WHITE,
    pick,
    vary,
)
from blend.environments.prints import PrintKind, any_of
from blend.environments.solids import hanging

Rng = np.random.Generator


def drill(a: Assembly, rng: Rng) -> None:
    """A cordless drill that lies on its side."""
    tint = pick(rng, PLASTICS)
    a.cylinder((-0.09, 0.12, 0.035), 0.033, 0.15, "plastic", tint, axis="x")
    a.cylinder((0.06, 0.12, 0.035), 0.022, 0.05, "metal", DARK_GREY, axis="x", top=0.012)
    a.box((-0.05, 0.05, 0.01), (0.045, 0.13, 0.045), "rubber", BLACK, bevel=0.01, turn=12)
    a.box((-0.06, 0.0, 0.0), (0.11, 0.07, 0.06), "plastic", BLACK, bevel=0.01)


def pliers(a: Assembly, rng: Rng) -> None:
    """A pair of pliers."""
    tint = pick(rng, PLASTICS)
    a.tube([(0.02, 0.0, 0.01), (0.03, 0.06, 0.012), (0.008, 0.11, 0.012)], 0.009, "plastic", tint)
    a.tube([(-0.02, 0.0, 0.01), (-0.03, 0.06, 0.012), (-0.008, 0.11, 0.012)], 0.009, "plastic", tint)
    a.box((0, 0.15, 0.004), (0.024, 0.08, 0.014), "chrome", STEEL, bevel=0.004)


def spanner(a: Assembly, rng: Rng) -> None:
    """A spanner."""
    length = rng.uniform(0.14, 0.26)
    a.box((0, 0.5 * length, 0.002), (0.018, length, 0.008), "chrome", STEEL, bevel=0.003)
    for y in (0.0, length):
        a.cylinder((0, y, 0.0), 0.02, 0.012, "chrome", STEEL, sides=10)


def meter(a: Assembly, rng: Rng) -> None:
    """A hand-held meter with its leads."""
    tint = pick(rng, PLASTICS)
    a.box((0, 0.12, 0), (0.09, 0.18, 0.04), "plastic", tint, bevel=0.012)
    a.box((0, 0.12, 0.008), (0.078, 0.168, 0.036), "plastic", DARK_GREY, bevel=0.008)
    a.picture((0, 0.19, 0.0455), (0.06, 0.05), any_of(rng, PrintKind.SCREEN), facing="z")
    a.cylinder((0, 0.09, 0.044), 0.022, 0.008, "plastic", BLACK)
    for x, lead in ((-0.02, BLACK), (0.02, (0.5, 0.03, 0.03))):
        end = (x + rng.uniform(-0.2, 0.2), rng.uniform(-0.1, 0.0), 0.01)
        a.tube(hanging((x, 0.05, 0.04), end, 0.0), 0.003, "rubber", lead)


def helmet(a: Assembly, rng: Rng) -> None:
    """A safety helmet."""
    tint = pick(rng, (WHITE, ORANGE, (0.8, 0.6, 0.02), (0.03, 0.15, 0.5)))
    profile = [(0.125, 0.0), (0.12, 0.05), (0.1, 0.1), (0.06, 0.135), (0.0, 0.145)]
    a.lathe((0, 0.14, 0), [(0.155, 0.0), (0.15, 0.012), *profile], "plastic", tint, sides=20)


def parts_tray(a: Assembly, rng: Rng) -> None:
    """A shallow tray with many small parts."""
    a.box((0, 0.12, 0), (0.3, 0.22, 0.03), "plastic", pick(rng, PLASTICS), bevel=0.006)
    for _ in range(18):
        place = (rng.uniform(-0.12, 0.12), rng.uniform(0.03, 0.21), 0.028)
        size = (rng.uniform(0.012, 0.04), rng.uniform(0.012, 0.03), rng.uniform(0.008, 0.03))
        chosen = pick(rng, ("metal", "metal", "plastic", "chrome"))
        a.box(place, size, chosen, STEEL if chosen != "plastic" else pick(rng, PLASTICS), turn=rng.uniform(0, 180))


def rag(a: Assembly, rng: Rng) -> None:
    """A crumpled rag."""
    tint = vary(rng, pick(rng, (WHITE, (0.45, 0.06, 0.05), (0.05, 0.12, 0.35), LIGHT_GREY)))
    profile = [(0.1, 0.0), (0.085, 0.02), (0.05, 0.045), (0.0, 0.05)]
    a.lathe((0, 0.1, 0), profile, "fabric", tint, sides=7)


BENCH = (
    Piece(drill, 0.24, 0.24),
    Piece(pliers, 0.08, 0.2),
    Piece(spanner, 0.06, 0.26),
    Piece(meter, 0.2, 0.26),
    Piece(bottle, 0.1, 0.1),
    Piece(tin, 0.2, 0.2),
    Piece(parts_tray, 0.32, 0.25),
    Piece(bin_open, 0.19, 0.28),
    Piece(papers, 0.26, 0.34),
    Piece(coil, 0.34, 0.34),
    Piece(tool_box, 0.44, 0.25),
    Piece(rag, 0.2, 0.2),
    Piece(mug, 0.1, 0.1),
    Piece(helmet, 0.32, 0.3),
    Piece(small_carton, 0.26, 0.24),
    Piece(reel, 0.3, 0.36),
)
"""Things that lie on workbenches."""
