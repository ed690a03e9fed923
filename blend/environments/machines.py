"""Machines of workshops and halls."""

import numpy as np

from blend.environments.assembly import Assembly
from blend.environments.palette import (
    ALUMINIUM,
    BLACK,
    DARK_GREY,
    GREEN,
    GREY,
    LIGHT_GREY,
    MACHINES,
    ORANGE,
    RED,
    STEEL,
    WHITE,
    YELLOW,
    pick,
    vary,
)
from blend.environments.prints import PrintKind, any_of
from blend.environments.solids import hanging

Rng = np.random.Generator


def wheel(a: Assembly, place: tuple[float, float, float], radius: float) -> None:
    """A hand wheel that faces +y."""
    x, y, z = place
    ring = np.linspace(0, 2 * np.pi, 21)
    a.tube(
        np.column_stack([x + radius * np.cos(ring), np.full(21, y), z + radius * np.sin(ring)]), 0.011, "chrome", STEEL
    )
    for t in (0.3, 2.4, 4.5):
        a.tube([(x, y, z), (x + radius * np.cos(t), y, z + radius * np.sin(t))], 0.009, "chrome", STEEL)
    a.cylinder((x + 0.8 * radius, y, z), 0.012, 0.07, "plastic", BLACK, axis="y")
    a.cylinder((x, y - 0.08, z), 0.02, 0.09, "metal", STEEL, axis="y")


def control_box(a: Assembly, rng: Rng, width: float = 0.36, high: float = 0.36) -> None:
    """A panel of buttons that faces +y."""
    a.box((0, 0.06, 0), (width, 0.12, high), "paint", vary(rng, pick(rng, (LIGHT_GREY, GREY, DARK_GREY))), bevel=0.01)
    a.picture((0, 0.1215, 0.02), (width - 0.04, high - 0.04), any_of(rng, PrintKind.PANEL))


def lathe(a: Assembly, rng: Rng) -> None:
    """A centre lathe, 2.1 m long."""
    tint = vary(rng, pick(rng, MACHINES))
    for x in (-0.75, 0.7):
        a.box((x, 0.35, 0), (0.5, 0.55, 0.62), "paint", tint, bevel=0.03)
    a.box((0, 0.35, 0.52), (1.1, 0.5, 0.08), "paint", DARK_GREY)
    a.box((0, 0.35, 0.62), (2.0, 0.36, 0.17), "paint", tint, bevel=0.02)
    for y in (0.24, 0.46):
        a.box((0.1, y, 0.79), (1.75, 0.05, 0.03), "metal", STEEL)
    a.box((-0.78, 0.35, 0.79), (0.5, 0.46, 0.48), "paint", tint, bevel=0.04)
    a.picture((-0.78, 0.582, 0.98), (0.3, 0.22), any_of(rng, PrintKind.PANEL))
    for n in range(3):
        a.tube([(-0.9 + 0.12 * n, 0.58, 0.9), (-0.9 + 0.12 * n, 0.66, 0.86)], 0.009, "chrome", STEEL)
    a.cylinder((-0.53, 0.35, 1.03), 0.13, 0.1, "metal", STEEL, axis="x", sides=20)
    for t in (0, 2.1, 4.2):
        a.box((-0.4, 0.35 + 0.07 * np.cos(t), 1.01 + 0.07 * np.sin(t)), (0.06, 0.04, 0.04), "metal", DARK_GREY)
    a.cylinder((-0.42, 0.35, 1.03), 0.03, 0.5, "metal", STEEL, axis="x")
    a.box((0.05, 0.4, 0.8), (0.3, 0.5, 0.1), "paint", vary(rng, tint), bevel=0.015)
    a.box((0.05, 0.4, 0.9), (0.14, 0.2, 0.1), "metal", STEEL, bevel=0.01)
    a.box((0.05, 0.66, 0.66), (0.34, 0.06, 0.22), "paint", vary(rng, tint), bevel=0.015)
    wheel(a, (0.0, 0.73, 0.8), 0.09)
    a.box((0.72, 0.35, 0.8), (0.24, 0.22, 0.26), "paint", tint, bevel=0.03)
    a.cylinder((0.46, 0.35, 1.03), 0.03, 0.16, "chrome", STEEL, axis="x", top=0.045)
    a.box((0, 0.1, 0.62), (2.0, 0.03, 0.85), "paint", vary(rng, tint, 0.06), bevel=0.01)
    _work_lamp(a, 0.2, 0.12, 1.47)


def _work_lamp(a: Assembly, x: float, y: float, z: float) -> None:
    a.tube([(x, y, z), (x + 0.05, y, z + 0.3), (x - 0.1, y + 0.25, z + 0.2)], 0.012, "paint", DARK_GREY)
    a.lathe((x - 0.1, y + 0.27, z + 0.1), [(0.08, 0), (0.03, 0.11)], "paint", LIGHT_GREY)
    a.cylinder((x - 0.1, y + 0.27, z + 0.105), 0.06, 0.01, "glow", (26.0, 23.0, 17.0))


def drill_press(a: Assembly, rng: Rng) -> None:
    """A pillar drill."""
    tint = vary(rng, pick(rng, MACHINES))
    a.box((0, 0.32, 0), (0.46, 0.6, 0.1), "paint", tint, bevel=0.02)
    a.cylinder((0, 0.16, 0.1), 0.055, 1.5, "metal", STEEL)
    a.box((0, 0.42, 0.92), (0.42, 0.4, 0.06), "metal", STEEL, bevel=0.01)
    a.box((0, 0.22, 0.86), (0.14, 0.2, 0.14), "paint", tint, bevel=0.02)
    a.box((0, 0.36, 1.42), (0.27, 0.66, 0.36), "paint", tint, bevel=0.05)
    a.box((0, 0.34, 1.78), (0.25, 0.62, 0.1), "paint", vary(rng, tint), bevel=0.03)
    a.cylinder((0, 0.1, 1.5), 0.1, 0.34, "paint", DARK_GREY)
    a.cylinder((0, 0.5, 1.24), 0.04, 0.2, "metal", STEEL)
    a.cylinder((0, 0.5, 1.12), 0.012, 0.14, "chrome", STEEL)
    a.cylinder((0, 0.5, 1.1), 0.01, 0.1, "chrome", STEEL, top=0.03)
    for t in (0.4, 2.5, 4.6):
        end = (0.24, 0.5 + 0.2 * np.cos(t), 1.52 + 0.2 * np.sin(t))
        a.tube([(0.14, 0.5, 1.52), end], 0.008, "chrome", STEEL)
        a.lathe((end[0] - 0.02, end[1], end[2] - 0.02), [(0.0, 0.0), (0.022, 0.02), (0.0, 0.04)], "plastic", BLACK)
    a.picture((0, 0.692, 1.5), (0.2, 0.2), any_of(rng, PrintKind.PANEL))
    a.box((0, 0.46, 0.98), (0.18, 0.14, 0.07), "paint", (0.02, 0.1, 0.35), bevel=0.008)


def milling_machine(a: Assembly, rng: Rng) -> None:
    """A knee-type milling machine."""
    tint = vary(rng, pick(rng, MACHINES))
    a.box((0, 0.5, 0), (0.8, 1.0, 0.14), "paint", tint, bevel=0.02)
    a.box((0, 0.25, 0.14), (0.55, 0.5, 1.5), "paint", tint, bevel=0.05)
    a.box((0, 0.6, 0.4), (0.4, 0.5, 0.45), "paint", vary(rng, tint), bevel=0.03)
    a.cylinder((0, 0.7, 0.14), 0.05, 0.3, "metal", STEEL)
    a.box((0, 0.7, 0.87), (1.3, 0.3, 0.1), "metal", STEEL, bevel=0.01)
    a.box((0.1, 0.7, 0.97), (0.3, 0.16, 0.12), "paint", DARK_GREY, bevel=0.01)
    a.box((0, 0.55, 1.62), (0.34, 1.0, 0.3), "paint", tint, bevel=0.05)
    a.cylinder((0, 0.82, 1.2), 0.1, 0.5, "paint", vary(rng, tint))
    a.cylinder((0, 0.82, 1.06), 0.04, 0.16, "metal", STEEL)
    a.cylinder((0, 0.82, 1.92), 0.12, 0.34, "paint", DARK_GREY)
    wheel(a, (0.0, 0.95, 0.62), 0.12)
    for side in (-1, 1):
        a.cylinder((side * 0.66, 0.7, 0.92), 0.08, 0.02, "chrome", STEEL, axis="x")
    a.tube([(0.25, 0.5, 1.7), (0.6, 0.8, 1.75), (0.62, 0.9, 1.5)], 0.02, "paint", LIGHT_GREY)
    with a.at(0.62, 0.88, 1.2, turn=-20):
        control_box(a, rng, 0.34, 0.42)


def machining_centre(a: Assembly, rng: Rng) -> None:
    """An enclosed machine tool with a window and a panel on an arm."""
    tint, accent = vary(rng, pick(rng, (WHITE, LIGHT_GREY))), pick(rng, MACHINES)
    width, deep, high = 2.4, 1.6, 2.1
    a.box((0, 0.5 * deep, 0), (width, deep, 0.3), "paint", DARK_GREY, bevel=0.02)
    a.box((0, 0.5 * deep, 0.3), (width, deep, high - 0.3), "paint", tint, bevel=0.04)
    a.box((-0.2, deep + 0.012, 0.75), (1.3, 0.03, 1.1), "paint", accent, bevel=0.02)
    a.box((-0.2, deep + 0.03, 1.0), (1.0, 0.012, 0.7), "dark glass", (0.02, 0.025, 0.03))
    a.box((0.3, deep + 0.06, 1.1), (0.03, 0.04, 0.45), "chrome", STEEL, bevel=0.01)
    a.box((0, 0.5 * deep, high), (0.9, 0.9, 0.4), "paint", vary(rng, tint), bevel=0.03)
    for n in range(6):
        a.box((0.8, deep + 0.004, 0.36 + 0.045 * n), (0.45, 0.008, 0.016), "rubber", BLACK)
    with a.at(0.82, deep, 1.05):
        control_box(a, rng, 0.5, 0.68)
    a.cylinder((-0.95, deep - 0.2, high), 0.02, 0.3, "metal", STEEL)
    for n, light in enumerate(((0.3, 3.5, 0.6), (0.5, 0.35, 0.02), (0.5, 0.02, 0.02))):
        a.cylinder((-0.95, deep - 0.2, high + 0.3 + 0.07 * n), 0.035, 0.065, "glow", light)
    a.picture((-0.8, deep + 0.004, 1.93), (0.5, 0.12), any_of(rng, PrintKind.LABEL))


def robot(a: Assembly, rng: Rng) -> None:
    """A six-axis arm on a plinth."""
    tint = pick(rng, (ORANGE, YELLOW, (0.7, 0.5, 0.02), WHITE))
    a.cylinder((0, 0.8, 0), 0.35, 0.45, "paint", DARK_GREY, sides=20)
    a.lathe((0, 0.8, 0.45), [(0.3, 0.0), (0.28, 0.25), (0.2, 0.38)], "paint", tint, sides=20)
    swing, reach = rng.uniform(-30, 30), rng.uniform(15, 40)
    with a.at(0, 0.8, 0.8, turn=swing):
        a.cylinder((-0.22, 0, 0), 0.2, 0.44, "paint", tint, axis="x", sides=20)
        with a.at(0, 0, 0, lean=reach - 40):
            a.box((0, 0, 0.05), (0.22, 0.26, 1.05), "paint", tint, bevel=0.05)
            with a.at(0, 0, 1.1, lean=-70 + reach):
                a.cylinder((-0.19, 0, 0), 0.17, 0.38, "paint", DARK_GREY, axis="x", sides=20)
                a.cylinder((0, 0, 0.1), 0.12, 0.95, "paint", tint, top=0.08)
                a.cylinder((0, 0, 1.05), 0.06, 0.14, "metal", STEEL)
                for x in (-0.06, 0.06):
                    a.box((x, 0, 1.19), (0.03, 0.06, 0.16), "metal", DARK_GREY, bevel=0.006)
                a.tube(hanging((0.14, 0.05, 0.0), (0.08, 0.06, 1.0), -0.2), 0.022, "rubber", BLACK)
    a.tube(hanging((0.3, 0.8, 0.3), (0.2, 0.7, 1.4), 0.1), 0.025, "rubber", BLACK)


def tank(a: Assembly, rng: Rng) -> None:
    """An upright tank with pipes, a ladder and a gauge."""
    radius, high, tint = 0.62, rng.uniform(1.9, 2.8), pick(rng, (ALUMINIUM, LIGHT_GREY, *MACHINES))
    material = "metal" if tint is ALUMINIUM else "paint"
    for t in (0.8, 2.4, 4.0, 5.5):
        a.cylinder((0.45 * np.cos(t), 0.7 + 0.45 * np.sin(t), 0), 0.05, 0.4, "paint", DARK_GREY)
    profile = [(0.08, 0.25), (0.5, 0.34), (radius, 0.5), (radius, high), (0.5, high + 0.16), (0.1, high + 0.24)]
    a.lathe((0, 0.7, 0), profile, material, tint, sides=28)
    for z in (0.9, 0.6 * high):
        a.cylinder((0, 0.7, z), radius * 1.012, 0.05, "metal", STEEL, sides=28)
    a.tube(
        [(0, 0.7, high + 0.2), (0, 0.7, high + 0.5), (0.5, 0.5, high + 0.5), (0.5, 0.1, high + 0.5), (0.5, 0.1, 0)],
        0.05,
        "metal",
        STEEL,
    )
    a.cylinder((-0.2, 1.25, 1.4), 0.11, 0.1, "metal", STEEL, axis="y", sides=20)
    a.picture((-0.2, 1.352, 1.31), (0.18, 0.18), any_of(rng, PrintKind.DIAL))
    a.picture((0.2, 1.345, 1.2), (0.3, 0.22), any_of(rng, PrintKind.LABEL))


def compressor(a: Assembly, rng: Rng) -> None:
    """A compressor on a lying vessel."""
    tint = pick(rng, (RED, GREEN, (0.02, 0.12, 0.4), *MACHINES))
    profile = [(0.05, 0), (0.2, 0.06), (0.24, 0.16), (0.24, 1.1), (0.2, 1.2), (0.05, 1.26)]
    a.lathe((-0.63, 0.35, 0.42), profile, "paint", tint, axis="x", sides=22)
    for x in (-0.4, 0.4):
        a.box((x, 0.35, 0.0), (0.06, 0.36, 0.22), "paint", DARK_GREY)
    a.box((0, 0.35, 0.66), (0.9, 0.3, 0.03), "paint", DARK_GREY)
    a.cylinder((-0.1, 0.35, 0.82), 0.13, 0.36, "paint", GREY, axis="x", sides=18)
    for n in range(7):
        a.cylinder((-0.36, 0.35, 0.72 + 0.04 * n), 0.12, 0.02, "metal", DARK_GREY, sides=16)
    a.cylinder((-0.36, 0.56, 0.85), 0.2, 0.04, "metal", STEEL, axis="y", sides=20)
    a.cylinder((0.42, 0.56, 0.8), 0.05, 0.03, "metal", STEEL, axis="y")
    a.picture((0.42, 0.592, 0.755), (0.09, 0.09), any_of(rng, PrintKind.DIAL))
    a.tube([(0.45, 0.35, 0.7), (0.62, 0.2, 0.7), (0.62, 0.05, 1.6), (0.62, 0.05, 3.0)], 0.015, "metal", STEEL)


def conveyor(a: Assembly, rng: Rng) -> None:
    """Three metres of conveyor with goods on it."""
    tint = vary(rng, pick(rng, MACHINES))
    a.box((0, 0.4, 0.74), (3.0, 0.5, 0.05), "rubber", BLACK)
    for y in (0.13, 0.67):
        a.box((0, y, 0.68), (3.0, 0.04, 0.16), "metal", ALUMINIUM, bevel=0.01)
        for x in (-1.3, -0.4, 0.5, 1.3):
            a.box((x, y, 0), (0.06, 0.05, 0.7), "paint", tint)
    for x in np.arange(-1.4, 1.4, 0.62):
        if rng.random() < 0.8:
            place = (float(x), 0.4, 0.79)
            card = rng.random() < 0.6
            a.box(
                place,
                (0.34, 0.3, rng.uniform(0.12, 0.3)),
                "card" if card else "plastic",
                (0.42, 0.27, 0.12) if card else pick(rng, MACHINES),
                bevel=0.008,
                turn=rng.normal(0, 6),
            )
    a.cylinder((1.0, 0.7, 0.55), 0.09, 0.25, "paint", (0.02, 0.12, 0.4), axis="y")
    with a.at(-1.1, 0.68, 0.95):
        control_box(a, rng, 0.26, 0.34)


def press(a: Assembly, rng: Rng) -> None:
    """A two-column press with a guard."""
    tint = vary(rng, pick(rng, MACHINES))
    a.box((0, 0.6, 0), (1.5, 1.1, 0.75), "paint", tint, bevel=0.03)
    for x in (-0.58, 0.58):
        a.box((x, 0.5, 0.75), (0.3, 0.7, 1.5), "paint", tint, bevel=0.03)
    a.box((0, 0.55, 2.2), (1.5, 0.95, 0.8), "paint", vary(rng, tint, 0.06), bevel=0.04)
    a.cylinder((0, 0.6, 1.7), 0.16, 0.55, "chrome", STEEL, sides=20)
    a.box((0, 0.6, 1.5), (0.7, 0.6, 0.2), "metal", STEEL, bevel=0.02)
    a.box((0, 0.6, 0.75), (0.8, 0.7, 0.15), "metal", DARK_GREY, bevel=0.02)
    for n in range(5):
        a.box((-0.6 + 0.3 * n, 1.11, 2.25), (0.3, 0.006, 0.16), "paint", BLACK if n % 2 else YELLOW)
    a.picture((0, 1.155, 0.3), (0.4, 0.3), any_of(rng, PrintKind.SIGN))
    with a.at(0.88, 0.9, 1.1):
        control_box(a, rng, 0.3, 0.5)
    a.tube([(-0.6, 0.2, 3.0), (-0.8, 0.1, 2.4), (-0.85, 0.1, 0.6)], 0.03, "rubber", BLACK)


def vice(a: Assembly, rng: Rng) -> None:
    """A bench vice."""
    tint = vary(rng, pick(rng, ((0.02, 0.1, 0.35), RED, (0.03, 0.2, 0.1), DARK_GREY)))
    a.cylinder((0, 0.16, 0), 0.09, 0.05, "paint", tint)
    a.box((0, 0.12, 0.05), (0.14, 0.16, 0.12), "paint", tint, bevel=0.02)
    a.box((0, 0.26, 0.06), (0.14, 0.08, 0.11), "paint", tint, bevel=0.015)
    a.box((0, 0.21, 0.15), (0.16, 0.015, 0.03), "metal", STEEL)
    a.cylinder((0, 0.26, 0.1), 0.016, 0.12, "chrome", STEEL, axis="y")
    a.cylinder((-0.1, 0.36, 0.1), 0.007, 0.2, "chrome", STEEL, axis="x", sides=8)


def drum(a: Assembly, rng: Rng) -> None:
    """An oil drum."""
    tint = vary(rng, pick(rng, MACHINES))
    a.lathe((0, 0.32, 0), [(0.29, 0), (0.29, 0.88)], "rust" if rng.random() < 0.3 else "paint", tint, sides=22)
    for z in (0.0, 0.29, 0.58, 0.86):
        a.cylinder((0, 0.32, z), 0.3, 0.025, "paint", tint, sides=22)
    a.picture((0, 0.615, 0.36), (0.22, 0.2), any_of(rng, PrintKind.LABEL))


def gas_bottles(a: Assembly, rng: Rng) -> None:
    """Gas bottles chained to the wall."""
    for x in (-0.27, 0.0, 0.27):
        tint, shoulder = vary(rng, pick(rng, MACHINES)), pick(rng, (WHITE, (0.6, 0.4, 0.02), DARK_GREY, GREEN))
        a.cylinder((x, 0.18, 0), 0.115, 1.15, "paint", tint, sides=18)
        a.lathe((x, 0.18, 1.15), [(0.115, 0), (0.1, 0.1), (0.045, 0.2), (0.04, 0.32)], "paint", shoulder, sides=18)
        a.cylinder((x, 0.18, 1.42), 0.02, 0.12, "metal", STEEL)
    a.tube(hanging((-0.45, 0.02, 1.0), (0.45, 0.02, 1.0), -0.0), 0.012, "metal", STEEL)
    a.tube([(-0.42, 0.02, 1.0), (-0.4, 0.31, 0.98), (0.4, 0.31, 0.98), (0.42, 0.02, 1.0)], 0.01, "chrome", STEEL)
