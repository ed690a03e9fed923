"""Tables, chairs, cupboards and shelving."""

import numpy as np

from blend.environments.assembly import Assembly
from blend.environments.goods import STORED, mug, papers
from blend.environments.lamps import desk_lamp
from blend.environments.layout import clutter, row_on
from blend.environments.palette import (
    ALUMINIUM,
    BLACK,
    BLUE,
    DARK_GREY,
    FABRICS,
    LIGHT_GREY,
    PLASTICS,
    STEEL,
    STEEL_FURNITURE,
    WHITE,
    WOODS,
    pick,
    vary,
)
from blend.environments.prints import PrintKind, any_of
from blend.environments.solids import hanging
from blend.environments.tools import BENCH

Rng = np.random.Generator


def legs(a: Assembly, size: tuple[float, float, float], material: str, tint: tuple[float, float, float]) -> None:
    """Four legs under a table top with its back at y = 0; `size` is its width, depth and height of its underside."""
    for x in (-0.5, 0.5):
        for y in (0.04, size[1] - 0.04):
            a.box((x * (size[0] - 0.08), y, 0), (0.05, 0.05, size[2]), material, tint, bevel=0.005)


def workbench(a: Assembly, rng: Rng) -> None:
    """A heavy bench with a drawer block, a shelf below, and tools and parts on it."""
    width, deep, high = 2.0, 0.75, 0.86
    frame = vary(rng, pick(rng, STEEL_FURNITURE))
    legs(a, (width, deep, high), "paint", frame)
    a.box((0, 0.5 * deep, high), (width, deep, 0.05), "surface:birch_veneer", (0.85, 0.75, 0.62), bevel=0.006)
    a.box((0, 0.5 * deep, 0.16), (width - 0.1, deep - 0.1, 0.025), "wood", pick(rng, WOODS))
    drawers(a, rng, 0.62, 0.5, 0.1, deep - 0.06, 4, vary(rng, pick(rng, STEEL_FURNITURE)))
    with a.at(-0.4, 0.08):
        row_on(a, rng, STORED, 1.1, 0.19, empty=0.3)
    clutter(a, rng, BENCH, (width, deep), high + 0.05, density=0.75)


def drawers(
    a: Assembly, rng: Rng, x: float, width: float, low: float, deep: float, count: int, tint: tuple[float, float, float]
) -> None:
    """A block of drawers with pulls, its top at 0.84 m."""
    high = 0.84 - low
    a.box((x, 0.5 * deep, low), (width, deep, high), "paint", tint, bevel=0.006)
    for n in range(count):
        z = low + n * high / count
        a.box(
            (x, deep + 0.006, z + 0.008),
            (width - 0.03, 0.014, high / count - 0.016),
            "paint",
            vary(rng, tint, 0.05),
            bevel=0.004,
        )
        a.box((x, deep + 0.026, z + 0.7 * high / count), (0.6 * width, 0.025, 0.016), "metal", ALUMINIUM, bevel=0.004)


def desk(a: Assembly, rng: Rng) -> None:
    """An office desk with a computer, papers and a chair in front of it."""
    width, deep, wood = 1.5, 0.75, pick(rng, (*WOODS, WHITE, LIGHT_GREY))
    legs(a, (width, deep, 0.7), "metal", pick(rng, (ALUMINIUM, DARK_GREY)))
    a.box((0, 0.5 * deep, 0.7), (width, deep, 0.028), "wood", wood, bevel=0.004)
    a.box((-0.5, 0.36, 0.06), (0.42, 0.6, 0.56), "paint", vary(rng, LIGHT_GREY), bevel=0.006)
    for n in range(3):
        a.box((-0.5, 0.665, 0.08 + 0.18 * n), (0.4, 0.014, 0.17), "paint", vary(rng, LIGHT_GREY, 0.06), bevel=0.004)
        a.box((-0.5, 0.68, 0.2 + 0.18 * n), (0.14, 0.016, 0.012), "metal", ALUMINIUM)
    a.box((0.55, 0.3, 0.0), (0.19, 0.42, 0.42), "plastic", BLACK, bevel=0.008)
    for x in (0.0,) if rng.random() < 0.4 else (-0.28, 0.3):
        with a.at(x, 0.12, 0.728, turn=-25 * x):
            monitor(a, rng)
    keyboard(a, 0.02, 0.5, 0.728)
    for x, thing in ((-0.55, papers), (0.52, papers), (0.42, mug)):
        with a.at(x, 0.28 + rng.uniform(-0.1, 0.1), 0.728, turn=rng.normal(0, 15)):
            thing(a, rng)
    if rng.random() < 0.5:
        with a.at(-0.6, 0.02, 0.728):
            desk_lamp(a, rng)
    if rng.random() < 0.5:
        with a.at(0.62, 0.02, 0.728):
            plant(a, rng, 0.5)
    with a.at(rng.normal(0, 0.1), deep + 0.1, turn=180 + rng.normal(0, 30)):
        office_chair(a, rng)


def monitor(a: Assembly, rng: Rng) -> None:
    """A flat screen on a foot, switched on four times out of five."""
    width, high = rng.choice([0.53, 0.6]), 0.33
    a.box((0, 0.06, 0), (0.22, 0.18, 0.012), "plastic", BLACK, bevel=0.004)
    a.box((0, 0.02, 0), (0.05, 0.02, 0.2), "plastic", BLACK)
    a.box((0, 0.05, 0.14), (width, 0.035, high), "plastic", BLACK, bevel=0.006)
    if rng.random() < 0.8:
        tone = rng.uniform(0.8, 1.6)
        a.picture(
            (0, 0.0685, 0.155), (width - 0.025, high - 0.03), any_of(rng, PrintKind.SCREEN), "screen", (tone,) * 3
        )
    else:
        a.box((0, 0.068, 0.155), (width - 0.025, 0.001, high - 0.03), "dark glass", (0.008, 0.009, 0.01))


def keyboard(a: Assembly, x: float, y: float, z: float) -> None:
    """A keyboard and a mouse."""
    a.box((x, y, z), (0.44, 0.14, 0.016), "plastic", BLACK, bevel=0.004)
    for row in range(5):
        for column in range(14):
            key = (x - 0.2 + 0.0305 * column, y - 0.054 + 0.027 * row, z + 0.016)
            a.box(key, (0.026, 0.022, 0.006), "plastic", DARK_GREY)
    a.lathe((x - 0.32, y, z), [(0.03, 0.0), (0.03, 0.015), (0.015, 0.03), (0.0, 0.032)], "plastic", BLACK, sides=12)


def office_chair(a: Assembly, rng: Rng) -> None:
    """A swivel chair on castors."""
    cover = pick(rng, FABRICS)
    for n in range(5):
        t = 2 * np.pi * n / 5
        a.tube([(0, 0, 0.1), (0.3 * np.cos(t), 0.3 * np.sin(t), 0.07)], 0.02, "plastic", BLACK)
        a.cylinder((0.3 * np.cos(t) - 0.02, 0.3 * np.sin(t), 0.03), 0.03, 0.04, "rubber", BLACK, axis="x", sides=10)
    a.cylinder((0, 0, 0.08), 0.025, 0.36, "chrome", STEEL)
    a.box((0, 0, 0.43), (0.5, 0.48, 0.08), "fabric", cover, bevel=0.03)
    a.box((0, -0.25, 0.5), (0.06, 0.03, 0.3), "plastic", BLACK)
    with a.at(0, -0.26, 0.58, lean=-6):
        a.box((0, 0, 0), (0.46, 0.07, rng.uniform(0.42, 0.62)), "fabric", cover, bevel=0.03)
    for side in (-0.28, 0.28):
        a.box((side, -0.02, 0.64), (0.05, 0.28, 0.03), "rubber", BLACK, bevel=0.012)
        a.box((side, 0.0, 0.44), (0.03, 0.05, 0.2), "plastic", BLACK)


def stool(a: Assembly, rng: Rng) -> None:
    """A round stool."""
    a.cylinder((0, 0.2, 0.6), 0.17, 0.05, "wood" if rng.random() < 0.5 else "rubber", pick(rng, WOODS))
    for n in range(4):
        t = np.pi / 4 + np.pi / 2 * n
        a.tube(
            [(0.1 * np.cos(t), 0.2 + 0.1 * np.sin(t), 0.6), (0.2 * np.cos(t), 0.2 + 0.2 * np.sin(t), 0)],
            0.013,
            "metal",
            STEEL,
        )
    ring = np.linspace(0, 2 * np.pi, 17)
    a.tube(np.column_stack([0.17 * np.cos(ring), 0.2 + 0.17 * np.sin(ring), np.full(17, 0.22)]), 0.009, "metal", STEEL)


def plant(a: Assembly, rng: Rng, size: float = 1.0) -> None:
    """A pot with leaves."""
    a.lathe((0, 0.15 * size, 0), [(0.1 * size, 0), (0.14 * size, 0.24 * size)], "plastic", pick(rng, PLASTICS))
    count = 60
    angle, lift = rng.uniform(0, 2 * np.pi, count), rng.uniform(0.15, 1.0, count)
    out = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(count)])
    side = np.column_stack([-np.sin(angle), np.cos(angle), np.zeros(count)])
    root = np.array([0, 0.15 * size, 0.24 * size]) + [0, 0, 0.5 * size] * lift[:, None]
    tip = root + size * (
        out * rng.uniform(0.15, 0.34, (count, 1)) + np.array([0, 0, 1]) * rng.uniform(-0.1, 0.2, (count, 1))
    )
    middle, half = 0.5 * (root + tip) + [0, 0, 0.04 * size], side * 0.035 * size
    tints = np.array([0.05, 0.16, 0.04]) * rng.uniform(0.5, 1.6, (count, 1))
    a.quads(np.stack([root, middle + half, tip, middle - half], axis=1), "leaf", tints)


def trolley(a: Assembly, rng: Rng) -> None:
    """A trolley with two loaded decks."""
    tint = vary(rng, pick(rng, STEEL_FURNITURE))
    for z in (0.18, 0.78):
        a.box((0, 0.3, z), (0.85, 0.5, 0.03), "paint", tint, bevel=0.008)
        clutter(a, rng, BENCH, (0.8, 0.5), z + 0.03, density=0.7)
    for x in (-0.4, 0.4):
        for y in (0.07, 0.53):
            a.cylinder((x, y, 0.1), 0.014, 0.8, "metal", STEEL, sides=8)
            a.cylinder((x - 0.02, y, 0.06), 0.06, 0.04, "rubber", BLACK, axis="x")
    a.tube([(-0.4, 0.07, 0.9), (-0.46, 0.07, 0.95), (-0.46, 0.53, 0.95), (-0.4, 0.53, 0.9)], 0.014, "metal", STEEL)


def ladder(a: Assembly, rng: Rng) -> None:
    """A ladder that leans against a wall."""
    high = rng.uniform(2.2, 3.0)
    with a.at(0, 0.55, 0, lean=13):
        for x in (-0.2, 0.2):
            a.box((x, 0, 0), (0.025, 0.07, high), "metal", ALUMINIUM)
        for z in np.arange(0.25, high - 0.1, 0.28):
            a.box((0, 0, float(z)), (0.4, 0.035, 0.03), "metal", ALUMINIUM)


def tool_wall(a: Assembly, rng: Rng) -> None:
    """A perforated board with tools hung on it, to be placed on a wall."""
    width, high = 1.9, 0.95
    a.box((0, 0.012, 0), (width, 0.02, high), "pegboard", vary(rng, pick(rng, (*STEEL_FURNITURE, BLUE))))
    x = -0.5 * width + 0.06
    while x < 0.5 * width - 0.06:
        z, style = rng.uniform(0.5, 0.6), int(rng.integers(5))
        tint = pick(rng, PLASTICS)
        if style == 0:
            a.box((x, 0.035, z - 0.2), (0.022, 0.012, 0.3), "chrome", STEEL, bevel=0.004)
            a.cylinder((x, 0.03, z + 0.1), 0.024, 0.014, "chrome", STEEL, axis="y", sides=10)
        elif style == 1:
            a.cylinder((x, 0.04, z), 0.016, 0.11, "plastic", tint, sides=8)
            a.cylinder((x, 0.04, z - 0.16), 0.005, 0.16, "chrome", STEEL, sides=6)
        elif style == 2:
            a.box((x, 0.04, z - 0.2), (0.03, 0.025, 0.3), "wood", pick(rng, WOODS), bevel=0.008)
            a.box((x, 0.04, z + 0.08), (0.12, 0.03, 0.035), "metal", DARK_GREY, bevel=0.005)
            x += 0.05
        elif style == 3:
            a.prism([(0.025, z), (0.03, z), (0.03, z + 0.1), (0.025, z + 0.1)], x, 0.36, "chrome", STEEL)
            a.box((x + 0.2, 0.03, z - 0.02), (0.1, 0.025, 0.13), "plastic", tint, bevel=0.01)
            x += 0.28
        else:
            turns = np.linspace(0, 6 * np.pi, 40)
            points = np.column_stack([x + 0.09 * np.cos(turns), 0.03 + 0.004 * turns, z + 0.11 * np.sin(turns) - 0.1])
            a.tube(points, 0.007, "rubber", tint)
            x += 0.1
        x += rng.uniform(0.06, 0.13)
    for n in range(5):
        with a.at(-0.75 + 0.37 * n, 0.03, 0.02):
            a.box((0, 0.07, 0), (0.3, 0.12, 0.09), "plastic", pick(rng, PLASTICS), bevel=0.006)
            a.picture((0, 0.131, 0.025), (0.1, 0.04), any_of(rng, PrintKind.LABEL))
    a.tube(hanging((-0.6, 0.05, 0.4), (0.3, 0.06, 0.45), 0.3), 0.006, "rubber", tint)
