"""Houses, cars, trees and other things in streets and yards."""

import numpy as np

from blend.environments.assembly import Assembly, Points
from blend.environments.palette import (
    ALUMINIUM,
    BINS,
    BLACK,
    CAR_PAINT,
    DARK_GREY,
    GREY,
    LIGHT_GREY,
    MACHINES,
    RED,
    STEEL,
    WHITE,
    YELLOW,
    Colour,
    palette,
    pick,
    vary,
)
from blend.environments.prints import PrintKind, any_of
from blend.environments.solids import hanging

Rng = np.random.Generator
FRONTS = palette("c8b49a b8a88c d8d0c0 a86a50 8a8c90 d0b880 b49a90 94a09c e0dcd2")
"""Colours of plastered house fronts."""
PANES = (0.03, 0.04, 0.055)
"""Linear colour of window panes seen from outside in daylight: nearly black, a little blue."""


def house(a: Assembly, rng: Rng, width: float = 9.0, floors: int = 3, deep: float = 6.0) -> None:
    """A house with windows and a door; its front is at y = 0 and faces +y."""
    wall = pick(rng, ("brick", "wall", "wall", "blocks"))
    tint = (0.42, 0.22, 0.15) if wall == "brick" else vary(rng, pick(rng, FRONTS))
    high, frame = 3.1 * floors + 0.4, pick(rng, (WHITE, DARK_GREY, (0.2, 0.1, 0.05)))
    a.box((0, -0.5 * deep, 0), (width, deep, high), wall, tint)
    a.box((0, 0.02, 0), (width, 0.06, 0.6), "wall", vary(rng, (0.25, 0.24, 0.22)))
    a.box((0, -0.5 * deep, high), (width + 0.5, deep + 0.5, 0.18), "paint", vary(rng, LIGHT_GREY))
    if rng.random() < 0.6:
        roof = [(0.4, high + 0.15), (-0.5 * deep, high + 2.4), (-deep - 0.4, high + 0.15)]
        a.prism(
            roof,
            0.0,
            width + 0.4,
            "ribbed" if rng.random() < 0.4 else "ground",
            pick(rng, palette("7a3a28 4a4a4c 5c4438")),
        )
        a.box((0.25 * width, -0.4 * deep, high + 1.0), (0.6, 0.6, 2.0), "brick", (0.4, 0.2, 0.14))
    count = int(width / 1.9)
    for level in range(floors):
        for n in range(count):
            x, z = (n + 0.5) / count * width - 0.5 * width, 0.9 + 3.1 * level
            if level == 0 and n == count // 2:
                _entrance(a, rng, x)
            else:
                _pane(a, rng, x, z, frame)
    a.cylinder((0.48 * width, 0.06, 0), 0.05, high, "metal", GREY)
    a.cylinder((-0.5 * width - 0.25, 0.2, high + 0.08), 0.07, width + 0.5, "metal", GREY, axis="x")


def _pane(a: Assembly, rng: Rng, x: float, z: float, frame: Colour) -> None:
    a.box((x, 0.0, z), (1.1, 0.03, 1.5), "dark glass", vary(rng, PANES, 0.4))
    if rng.random() < 0.5:
        a.box((x + rng.choice([-0.35, 0.35]), 0.018, z), (0.4, 0.006, 1.5), "fabric", vary(rng, WHITE))
    for side in (-0.55, 0.0, 0.55):
        a.box((x + side, 0.02, z), (0.06, 0.05, 1.5), "plastic", frame)
    for level in (0.0, 0.95, 1.45):
        a.box((x, 0.02, z + level), (1.1, 0.05, 0.06), "plastic", frame)
    a.box((x, 0.08, z - 0.08), (1.35, 0.22, 0.07), "wall", LIGHT_GREY)
    a.box((x, 0.03, z + 1.52), (1.4, 0.1, 0.16), "wall", vary(rng, LIGHT_GREY))
    if rng.random() < 0.15:
        a.box((x, 0.25, z - 0.55), (0.8, 0.34, 0.5), "plastic", WHITE, bevel=0.02)
        a.cylinder((x - 0.12, 0.42, z - 0.3), 0.18, 0.02, "plastic", DARK_GREY, axis="y", sides=18)


def _entrance(a: Assembly, rng: Rng, x: float) -> None:
    a.box((x, 0.03, 0.0), (1.2, 0.06, 2.3), "wood", pick(rng, palette("4a2a18 22402c 1c2c48 5a1c1c")), bevel=0.01)
    a.box((x, 0.065, 1.3), (0.7, 0.01, 0.8), "dark glass", PANES)
    a.box((x, 0.5, 2.5), (1.8, 1.0, 0.08), "paint", vary(rng, DARK_GREY))
    a.box((x, 0.5, 0.0), (1.6, 1.0, 0.14), "wall", LIGHT_GREY)
    a.box((x + 0.9, 0.04, 1.4), (0.3, 0.06, 0.4), "metal", ALUMINIUM)
    a.picture((x, 0.12, 2.65), (2.2, 0.5), any_of(rng, PrintKind.POSTER))


def shed(a: Assembly, rng: Rng, width: float = 14.0, high: float = 5.5) -> None:
    """An industrial shed with gates, a sign and a pipe."""
    tint = vary(rng, pick(rng, (*MACHINES[:5], LIGHT_GREY)))
    a.box((0, -5, 0), (width, 10, high), "ribbed", tint)
    a.box((0, 0.03, 0), (width, 0.08, 0.9), "wall", vary(rng, GREY))
    a.prism([(0.3, high), (-5, high + 1.6), (-10.3, high)], 0.0, width + 0.4, "ribbed", vary(rng, GREY))
    for x in (-0.27, 0.18):
        shade = vary(rng, pick(rng, MACHINES))
        for n in range(7):
            a.box((x * width, 0.07, 0.55 * n + 0.01), (3.6, 0.06, 0.53), "paint", shade, bevel=0.015)
        for side in (-1.9, 1.9):
            a.box((x * width + side, 0.15, 0), (0.18, 0.18, 1.1), "paint", YELLOW, bevel=0.02)
    a.box((0.4 * width, 0.08, 0), (1.0, 0.06, 2.1), "paint", vary(rng, DARK_GREY))
    a.picture((0.0, 0.1, high - 1.2), (3.0, 0.9), any_of(rng, PrintKind.POSTER))
    for n in range(5):
        a.box((-0.42 * width + 0.21 * width * n, 0.06, high - 1.3), (1.6, 0.05, 0.7), "dark glass", PANES)
    a.cylinder((-0.45 * width, 0.2, 0), 0.1, high, "metal", GREY)
    a.box((0.0, 0.25, 3.2), (0.25, 0.35, 0.15), "paint", DARK_GREY)


def car(a: Assembly, rng: Rng, *, van: bool = False) -> None:
    """A car or van along y, with its middle at the origin."""
    tint, long = pick(rng, CAR_PAINT), 4.3
    half = 0.5 * long
    if van:
        body = [(-half, 0.35), (half, 0.35), (half + 0.1, 0.9), (half - 0.5, 1.15), (half - 1.1, 1.95), (-half, 2.0)]
    else:
        body = [
            (-half, 0.3),
            (half, 0.3),
            (half + 0.06, 0.62),
            (half - 0.15, 0.82),
            (half - 1.1, 0.94),
            (-half + 0.3, 1.0),
            (-half - 0.04, 0.85),
        ]
    a.prism(body, 0.0, 1.74, "plastic", tint)
    cabin = [(half - 1.2, 0.92), (half - 1.85, 1.42), (-half + 1.1, 1.47), (-half + 0.25, 0.98)]
    if not van:
        a.prism(cabin, 0.0, 1.5, "dark glass", PANES)
        a.prism(
            [(half - 1.8, 1.4), (half - 1.9, 1.45), (-half + 1.1, 1.5), (-half + 0.95, 1.42)],
            0.0,
            1.44,
            "plastic",
            tint,
        )
        for x in (-0.74, 0.74):
            a.tube(
                [
                    (x, half - 1.2, 0.93),
                    (x * 0.97, half - 1.85, 1.43),
                    (x * 0.97, -half + 1.1, 1.47),
                    (x, -half + 0.25, 0.98),
                ],
                0.035,
                "plastic",
                tint,
            )
            a.box((x, -0.15, 0.93), (0.05, 0.1, 0.52), "plastic", tint)
    else:
        a.prism(
            [(half - 0.55, 1.16), (half - 1.1, 1.85), (half - 1.9, 1.85), (half - 1.9, 1.16)],
            0.0,
            1.76,
            "dark glass",
            PANES,
        )
    for x in (-1.0, 1.0):
        for y in (-half + 0.8, half - 0.82):
            start = 0.66 if x > 0 else -0.88
            a.cylinder((start, y, 0.31), 0.32, 0.22, "rubber", BLACK, axis="x", sides=22)
            a.cylinder(
                (start - 0.01 if x < 0 else start + 0.03, y, 0.31), 0.2, 0.2, "metal", ALUMINIUM, axis="x", sides=18
            )
        a.box((0.62 * x, half + 0.02, 0.6), (0.36, 0.1, 0.14), "chrome", WHITE, bevel=0.02)
        a.box((0.7 * x, -half - 0.02, 0.7), (0.26, 0.06, 0.16), "plastic", RED, bevel=0.02)
        a.box((0.87 * x, 0.1, 0.78), (0.02, 0.16, 0.025), "chrome", STEEL)
        a.box((0.97 * x, half - 1.45, 0.95), (0.16, 0.1, 0.12), "plastic", tint, bevel=0.03)
    for y in (half + 0.04, -half - 0.05):
        a.box((0, y, 0.34), (1.7, 0.12, 0.2), "plastic", DARK_GREY, bevel=0.03)
    a.box((0, half + 0.1, 0.42), (0.5, 0.02, 0.11), "plastic", WHITE)


def tree(a: Assembly, rng: Rng, high: float = 6.5) -> None:
    """A broad-leaved tree."""
    bark = vary(rng, (0.1, 0.075, 0.055))
    a.cylinder((0, 0, 0), 0.16, 0.45 * high, "ground", bark, top=0.1)
    centres = []
    for n in range(9):
        t, out = 2.4 * n + rng.uniform(0, 0.6), rng.uniform(0.5, 1.5)
        end = (out * np.cos(t), out * np.sin(t), rng.uniform(0.5, 0.95) * high)
        a.tube([(0, 0, 0.32 * high + 0.02 * n), (0.4 * end[0], 0.4 * end[1], 0.5 * high), end], 0.04, "ground", bark)
        centres.append(end)
    leaves = 420
    for centre in centres:
        spread = rng.normal(0, 1, (leaves, 3))
        spread /= np.linalg.norm(spread, axis=1, keepdims=True)
        place = np.array(centre) + spread * rng.uniform(0.3, 1.0, (leaves, 1)) * np.array([1.1, 1.1, 0.85])
        _leaves(a, rng, place, 0.11, (0.07, 0.15, 0.03))


def bush(a: Assembly, rng: Rng, width: float = 1.6, high: float = 1.0) -> None:
    """A bush or a piece of hedge."""
    place = rng.uniform(-1, 1, (900, 3))
    place = place[np.linalg.norm(place, axis=1) < 1] * np.array([0.5 * width, 0.5, 0.5 * high]) + [0, 0, 0.5 * high]
    _leaves(a, rng, place, 0.075, (0.05, 0.12, 0.03))


def _leaves(a: Assembly, rng: Rng, place: Points, size: float, tint: Colour) -> None:
    count = len(place)
    one, two = rng.normal(0, 1, (2, count, 3))
    one *= size / np.linalg.norm(one, axis=1, keepdims=True)
    two *= size / np.linalg.norm(two, axis=1, keepdims=True)
    tints = np.array(tint) * rng.uniform(0.45, 1.7, (count, 1)) * rng.uniform(0.85, 1.15, (count, 3))
    a.quads(np.stack([place - one, place + two, place + one, place - two], axis=1), "leaf", tints)


def lamp_post(a: Assembly, rng: Rng) -> None:
    """A street lamp, unlit."""
    tint = vary(rng, pick(rng, (DARK_GREY, LIGHT_GREY, (0.03, 0.1, 0.07))))
    a.cylinder((0, 0, 0), 0.09, 6.0, "paint", tint, top=0.05)
    a.cylinder((0, 0, 0), 0.13, 1.0, "paint", tint)
    a.tube([(0, 0, 5.9), (0, 0.5, 6.25), (0, 1.4, 6.35)], 0.04, "paint", tint)
    a.box((0, 1.6, 6.28), (0.3, 0.7, 0.12), "paint", GREY, bevel=0.04)


def road_sign(a: Assembly, rng: Rng) -> None:
    """A sign on a post."""
    a.cylinder((0, 0, 0), 0.03, 2.9, "metal", GREY, sides=10)
    a.box((0, 0.03, 2.1), (0.62, 0.02, 0.62), "metal", LIGHT_GREY)
    a.picture((0, 0.042, 2.11), (0.6, 0.6), any_of(rng, PrintKind.SIGN))


def wheeled_bin(a: Assembly, rng: Rng) -> None:
    """A rubbish bin on wheels."""
    tint = vary(rng, pick(rng, (*BINS, (0.02, 0.1, 0.04))))
    a.prism([(0.05, 0.08), (0.55, 0.08), (0.68, 1.0), (0.0, 1.0)], 0.0, 0.55, "plastic", tint)
    a.prism([(-0.03, 1.0), (0.72, 1.0), (0.6, 1.1), (0.05, 1.12)], 0.0, 0.58, "plastic", vary(rng, tint))
    for x in (-0.29, 0.24):
        a.cylinder((x, 0.1, 0.1), 0.1, 0.05, "rubber", BLACK, axis="x")


def container(a: Assembly, rng: Rng) -> None:
    """A shipping container with a long side facing +y."""
    tint = vary(rng, pick(rng, palette("a83c28 1c4a7a 2a6a4a d88c20 7a7c7c b8b8b0")))
    a.box((0, 1.22, 0.15), (6.0, 2.44, 2.45), "ribbed", tint)
    for x in (-3.0, 3.0):
        for y in (0.03, 2.41):
            a.box((x, y, 0.1), (0.16, 0.1, 2.55), "paint", tint)
    for y in (0.02, 2.42):
        for z in (0.1, 2.53):
            a.box((0, y, z), (6.1, 0.1, 0.13), "paint", tint)
    for x in np.linspace(-2.9, 2.9, 22):
        a.box((float(x), 2.455, 0.25), (0.12, 0.035, 2.25), "paint", vary(rng, tint, 0.05), bevel=0.01)
    a.picture((1.6, 2.48, 1.6), (1.1, 0.6), any_of(rng, PrintKind.LABEL))


def fence(a: Assembly, rng: Rng, length: float) -> None:
    """A fence of bars along x."""
    tint = pick(rng, (DARK_GREY, (0.03, 0.12, 0.06), GREY))
    for x in np.arange(-0.5 * length, 0.5 * length, 2.4):
        a.box((float(x), 0, 0), (0.06, 0.06, 1.9), "paint", tint)
    for z in (0.2, 1.0, 1.75):
        a.box((0, 0, z), (length, 0.03, 0.04), "paint", tint)
    for x in np.arange(-0.5 * length, 0.5 * length, 0.12):
        a.box((float(x), 0, 0.1), (0.012, 0.012, 1.75), "paint", tint)


def bench(a: Assembly, rng: Rng) -> None:
    """A park bench."""
    wood = vary(rng, (0.3, 0.17, 0.08))
    for n in range(4):
        a.box((0, 0.1 + 0.11 * n, 0.43), (1.7, 0.09, 0.04), "wood", vary(rng, wood), bevel=0.008)
    for n in range(3):
        a.box((0, 0.02 - 0.03 * n, 0.55 + 0.13 * n), (1.7, 0.035, 0.1), "wood", vary(rng, wood), bevel=0.008)
    for x in (-0.7, 0.7):
        a.tube([(x, 0.5, 0), (x, 0.45, 0.42), (x, 0.05, 0.42), (x, -0.06, 0.95)], 0.025, "paint", DARK_GREY)
        a.tube([(x, 0.05, 0.42), (x, 0.0, 0)], 0.025, "paint", DARK_GREY)


def wires(a: Assembly, rng: Rng, start: tuple[float, float, float], end: tuple[float, float, float]) -> None:
    """Three overhead lines between two points."""
    for n in range(3):
        shift = 0.25 * n
        a.tube(
            hanging(
                (start[0], start[1] + shift, start[2]), (end[0], end[1] + shift, end[2]), rng.uniform(0.3, 0.6), 15
            ),
            0.012,
            "rubber",
            BLACK,
        )
