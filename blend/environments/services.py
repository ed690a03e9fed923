"""Things on walls and ceilings: pipes, trays, ducts, boards, signs, sockets, beams."""

import numpy as np

from blend.environments.assembly import Assembly
from blend.environments.palette import (
    ALUMINIUM,
    BLACK,
    CABLES,
    DARK_GREY,
    GREY,
    LIGHT_GREY,
    RED,
    STEEL,
    WHITE,
    WOODS,
    Colour,
    palette,
    pick,
    vary,
)
from blend.environments.prints import PrintKind, any_of
from blend.environments.solids import hanging

Rng = np.random.Generator
PIPES = palette("b8b8b4 8a3a2c 2c6a4a 3a5f8a c8a82c 9a9c9a d8d8d4")
"""Colours of painted pipes."""


def pipe_run(a: Assembly, rng: Rng, length: float, z: float, count: int = 3) -> None:
    """Pipes along a wall, on brackets, with flanges, valves and a branch downwards."""
    y = 0.1
    for n in range(count):
        radius, tint = rng.uniform(0.02, 0.07), pick(rng, PIPES)
        level = z + 0.2 * n
        a.cylinder((-0.5 * length, y + radius, level), radius, length, "paint", tint, axis="x")
        for x in np.arange(-0.5 * length + 0.4, 0.5 * length, rng.uniform(1.4, 2.4)):
            a.cylinder((float(x), y + radius, level), radius * 1.5, 0.05, "paint", vary(rng, tint), axis="x")
            a.box((float(x) + 0.1, 0.05, level - radius - 0.03), (0.05, 0.2, 0.03), "metal", STEEL)
        x = rng.uniform(-0.45, 0.45) * length
        a.cylinder((x, y + radius, 0.5), radius * 0.8, level - 0.5, "paint", tint)
        if rng.random() < 0.7:
            _valve(a, rng, x, y + radius, rng.uniform(1.1, 1.7), radius)
        if rng.random() < 0.6:
            dial = (x + 0.3, y + 2.2 * radius + 0.03, level - 0.02)
            a.cylinder((dial[0], y + radius, level), 0.07, radius + 0.04, "metal", STEEL, axis="y")
            a.picture((dial[0], y + 2 * radius + 0.045, level - 0.06), (0.12, 0.12), any_of(rng, PrintKind.DIAL))


def _valve(a: Assembly, rng: Rng, x: float, y: float, z: float, radius: float) -> None:
    a.cylinder((x, y, z - 0.06), radius * 1.3, 0.12, "paint", DARK_GREY)
    a.cylinder((x, y, z), 0.012, 0.17, "metal", STEEL, axis="y")
    ring = np.linspace(0, 2 * np.pi, 19)
    points = np.column_stack([x + 0.09 * np.cos(ring), np.full(19, y + 0.17), z + 0.09 * np.sin(ring)])
    tint = pick(rng, (RED, (0.02, 0.15, 0.5), (0.7, 0.5, 0.02)))
    a.tube(points, 0.011, "paint", tint)
    for t in (0.0, 2.1, 4.2):
        a.tube([(x, y + 0.17, z), (x + 0.09 * np.cos(t), y + 0.17, z + 0.09 * np.sin(t))], 0.007, "paint", tint)


def cable_tray(a: Assembly, rng: Rng, length: float, z: float, width: float = 0.35) -> None:
    """A ladder tray along x on hangers, with cables in it; its middle is at y = 0."""
    for side in (-0.5, 0.5):
        a.box((0, side * width, z), (length, 0.012, 0.07), "metal", LIGHT_GREY)
    for x in np.arange(-0.5 * length + 0.1, 0.5 * length, 0.3):
        a.box((float(x), 0, z + 0.006), (0.03, width, 0.014), "metal", LIGHT_GREY)
    for _ in range(9):
        y, tint = rng.uniform(-0.42, 0.42) * width, pick(rng, CABLES)
        xs = np.linspace(-0.5 * length, 0.5 * length, max(6, int(length / 0.4)))
        wave = y + 0.02 * np.sin(xs * rng.uniform(1, 3) + rng.uniform(0, 6))
        points = np.column_stack([xs, wave, np.full(len(xs), z + rng.uniform(0.03, 0.06))])
        a.tube(points, rng.uniform(0.006, 0.016), "rubber", tint)
    for x in np.arange(-0.5 * length + 0.3, 0.5 * length, 1.8):
        a.cylinder((float(x), 0.5 * width + 0.01, z), 0.006, 0.9, "metal", STEEL, sides=6)
        a.cylinder((float(x), -0.5 * width - 0.01, z), 0.006, 0.9, "metal", STEEL, sides=6)


def duct(a: Assembly, rng: Rng, length: float, z: float, radius: float = 0.22) -> None:
    """A round air duct along x with seams and outlets."""
    a.cylinder((-0.5 * length, 0, z), radius, length, "metal", ALUMINIUM, axis="x", sides=24)
    for x in np.arange(-0.5 * length, 0.5 * length, 1.2):
        a.cylinder((float(x), 0, z), radius * 1.03, 0.03, "metal", STEEL, axis="x", sides=24)
    for x in np.arange(-0.5 * length + 0.9, 0.5 * length, 2.4):
        a.box((float(x), 0, z - radius - 0.02), (0.4, 0.14, 0.06), "metal", vary(rng, LIGHT_GREY))


def pin_board(a: Assembly, rng: Rng, width: float = 1.4, high: float = 0.95) -> None:
    """A cork board with sheets and posters, on a wall."""
    wood = pick(rng, WOODS)
    a.box((0, 0.01, 0), (width, 0.02, high), "surface:cork", (1, 1, 1))
    for z in (0.0, high - 0.03):
        a.box((0, 0.015, z), (width, 0.03, 0.03), "wood", wood)
    for x in (-0.5, 0.5):
        a.box((x * width, 0.015, 0), (0.03, 0.03, high), "wood", wood)
    for x in np.arange(-0.5 * width + 0.18, 0.5 * width - 0.12, 0.27):
        for z in (0.08, 0.52):
            if rng.random() < 0.8:
                kind = pick(rng, (PrintKind.SHEET, PrintKind.SHEET, PrintKind.POSTER, PrintKind.DRAWING))
                place = (float(x) + rng.normal(0, 0.02), 0.022 + rng.uniform(0, 0.002), z + rng.normal(0, 0.03))
                a.picture(place, (0.21, 0.297), any_of(rng, kind))


def white_board(a: Assembly, rng: Rng, width: float = 1.8, high: float = 1.1) -> None:
    """A whiteboard with drawings on it."""
    a.box((0, 0.012, 0), (width, 0.02, high), "plastic", WHITE)
    for n in range(2):
        a.picture((-0.4 + 0.8 * n, 0.0225, 0.1), (0.75, 0.9), any_of(rng, PrintKind.DRAWING))
    for z in (0.0, high):
        a.box((0, 0.018, z - 0.015), (width + 0.03, 0.03, 0.03), "metal", ALUMINIUM)
    for x in (-0.5, 0.5):
        a.box((x * width, 0.018, 0), (0.03, 0.03, high), "metal", ALUMINIUM)
    a.box((0, 0.06, -0.03), (0.9, 0.09, 0.015), "metal", ALUMINIUM)
    for x in (-0.2, -0.05, 0.1):
        a.cylinder((x, 0.07, -0.006), 0.01, 0.12, "plastic", pick(rng, (RED, BLACK, (0.02, 0.1, 0.5))), axis="x")


def poster(a: Assembly, rng: Rng, size: tuple[float, float] = (0.6, 0.84)) -> None:
    """A poster or plan on a wall."""
    kind = pick(rng, (PrintKind.POSTER, PrintKind.POSTER, PrintKind.DRAWING))
    a.box((0, 0.004, 0), (size[0] + 0.02, 0.008, size[1] + 0.02), "plastic", pick(rng, (BLACK, WHITE, GREY)))
    a.picture((0, 0.0095, 0.01), size, any_of(rng, kind))


def sign(a: Assembly, rng: Rng, size: float = 0.3) -> None:
    """A sign on a wall."""
    a.box((0, 0.003, 0), (size, 0.006, size), "plastic", WHITE)
    a.picture((0, 0.0075, 0), (size, size), any_of(rng, PrintKind.SIGN))


def clock(a: Assembly, rng: Rng) -> None:
    """A wall clock."""
    a.cylinder((0, 0, 0.17), 0.18, 0.04, "plastic", BLACK, axis="y", sides=24)
    a.picture((0, 0.042, 0.03), (0.28, 0.28), any_of(rng, PrintKind.DIAL))


def extinguisher(a: Assembly, rng: Rng) -> None:
    """A fire extinguisher on a wall, with its sign above."""
    a.lathe((0, 0.1, 0.75), [(0.075, 0), (0.08, 0.02), (0.08, 0.4), (0.03, 0.48)], "paint", RED)
    a.box((0, 0.1, 1.22), (0.05, 0.1, 0.05), "plastic", BLACK)
    a.tube([(0.02, 0.12, 1.24), (0.12, 0.14, 1.2), (0.12, 0.14, 0.95)], 0.012, "rubber", BLACK)
    a.picture((0, 0.005, 1.6), (0.22, 0.22), any_of(rng, PrintKind.SIGN))
    a.picture((0, 0.182, 0.9), (0.1, 0.14), any_of(rng, PrintKind.LABEL))


def trunking(a: Assembly, rng: Rng, length: float, z: float = 1.02) -> None:
    """A wall duct with sockets, plugs and cords along x."""
    a.box((0, 0.03, z), (length, 0.06, 0.12), "plastic", vary(rng, WHITE), bevel=0.006)
    for x in np.arange(-0.5 * length + 0.3, 0.5 * length - 0.2, 0.45):
        a.box((float(x), 0.063, z + 0.02), (0.08, 0.01, 0.08), "plastic", WHITE, bevel=0.003)
        a.cylinder((float(x), 0.066, z + 0.06), 0.022, 0.004, "plastic", GREY, axis="y")
        if rng.random() < 0.4:
            a.cylinder((float(x), 0.066, z + 0.06), 0.02, 0.04, "plastic", BLACK, axis="y")
            end = (float(x) + rng.uniform(-0.4, 0.4), 0.12, rng.uniform(0.0, z - 0.1))
            a.tube(hanging((float(x), 0.11, z + 0.05), end, 0.1), 0.005, "rubber", pick(rng, CABLES))


def fuse_board(a: Assembly, rng: Rng) -> None:
    """A grey distribution board with conduits that run upwards."""
    width, high = rng.uniform(0.45, 0.8), rng.uniform(0.6, 1.1)
    a.box((0, 0.11, 0.9), (width, 0.22, high), "paint", vary(rng, LIGHT_GREY), bevel=0.01)
    a.box((0, 0.226, 0.92), (width - 0.04, 0.014, high - 0.04), "paint", vary(rng, LIGHT_GREY, 0.05), bevel=0.006)
    a.box((0.38 * width, 0.24, 0.9 + 0.5 * high), (0.025, 0.02, 0.09), "plastic", BLACK)
    a.picture((-0.1, 0.235, 0.95 + 0.55 * high), (0.17, 0.17), any_of(rng, PrintKind.SIGN))
    for x in np.linspace(-0.35, 0.35, 4):
        a.cylinder((float(x) * width, 0.08, 0.9 + high), 0.016, 2.0, "plastic", GREY, sides=8)


def radiator(a: Assembly, rng: Rng, width: float = 1.2) -> None:
    """A column radiator below a window."""
    tint = vary(rng, WHITE)
    for x in np.arange(-0.5 * width, 0.5 * width, 0.055):
        a.box((float(x), 0.1, 0.14), (0.042, 0.11, 0.6), "paint", tint, bevel=0.012)
    for z in (0.18, 0.66):
        a.cylinder((-0.5 * width, 0.1, z), 0.022, width + 0.1, "paint", tint, axis="x")
    a.cylinder((0.5 * width + 0.08, 0.1, 0.0), 0.014, 0.2, "paint", tint)


def truss(a: Assembly, length: float, z: float, tint: Colour, high: float = 0.7) -> None:
    """A lattice girder along x with its lower chord at z."""
    for level in (z, z + high):
        a.box((0, 0, level), (length, 0.12, 0.1), "paint", tint)
    step = high
    for n, x in enumerate(np.arange(-0.5 * length, 0.5 * length - 0.5 * step, step)):
        low, top = (float(x), 0.0, z + 0.05), (float(x) + step, 0.0, z + high)
        if n % 2:
            low, top = (float(x) + step, 0.0, z + 0.05), (float(x), 0.0, z + high)
        a.tube([low, top], 0.03, "paint", tint)


def girder(a: Assembly, length: float, z: float, tint: Colour, high: float = 0.3) -> None:
    """An I-beam along x with its underside at z."""
    for level in (z, z + high - 0.02):
        a.box((0, 0, level), (length, 0.5 * high, 0.02), "paint", tint)
    a.box((0, 0, z), (length, 0.015, high), "paint", tint)


def column(a: Assembly, high: float, tint: Colour, width: float = 0.3) -> None:
    """An I-column with a striped foot guard."""
    for y in (-0.5 * width, 0.5 * width):
        a.box((0, y, 0), (width, 0.02, high), "paint", tint)
    a.box((0, 0, 0), (0.015, width, high), "paint", tint)
    for n in range(6):
        tone = BLACK if n % 2 else (0.75, 0.5, 0.02)
        a.box((0, 0, 0.2 * n), (width + 0.06, width + 0.06, 0.2), "paint", tone)


def floor_line(
    a: Assembly, start: tuple[float, float], end: tuple[float, float], tint: Colour, width: float = 0.1
) -> None:
    """A painted line on the floor along x or y."""
    middle = (0.5 * (start[0] + end[0]), 0.5 * (start[1] + end[1]), 0.0)
    size = (abs(end[0] - start[0]) + width, abs(end[1] - start[1]) + width, 0.003)
    a.box(middle, size, "paint", tint)
