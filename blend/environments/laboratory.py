"""Laboratories: white benches with instruments and glassware, fume hoods, shelves of bottles."""

import numpy as np

from blend.environments import furniture, lamps, services, storage
from blend.environments.assembly import Assembly
from blend.environments.goods import bottle, canister
from blend.environments.instruments import BENCH_TOP, SHELF, flask
from blend.environments.layout import Piece, clutter, line_up, row_on
from blend.environments.palette import (
    ALUMINIUM,
    DARK_GREY,
    GREY,
    LIGHT_GREY,
    PLASTICS,
    STEEL,
    WHITE,
    WOODS,
    pick,
    vary,
)
from blend.environments.prints import PrintKind, any_of
from blend.environments.room import Room, Style, Wall, door, windows
from blend.environments.scene import Light

Rng = np.random.Generator


def lab_bench(a: Assembly, rng: Rng) -> None:
    """A bench with cupboards below, instruments on it, and shelves above."""
    width, deep = 1.8, 0.75
    front = vary(rng, pick(rng, (WHITE, LIGHT_GREY, WOODS[2], (0.25, 0.4, 0.55))), 0.05)
    a.box((0, 0.34, 0.1), (width, 0.62, 0.76), "plastic", vary(rng, LIGHT_GREY), bevel=0.005)
    for n in range(4):
        x = -0.675 + 0.45 * n
        if n % 2:
            a.box((x, 0.66, 0.12), (0.44, 0.018, 0.72), "wood", front, bevel=0.004)
            a.box((x - 0.17, 0.68, 0.55), (0.014, 0.03, 0.16), "metal", STEEL)
        else:
            for z in (0.12, 0.36, 0.6):
                a.box((x, 0.66, z), (0.44, 0.018, 0.23), "wood", vary(rng, front, 0.04), bevel=0.004)
                a.box((x, 0.68, z + 0.16), (0.16, 0.03, 0.014), "metal", STEEL)
    a.box(
        (0, 0.5 * deep, 0.86), (width, deep, 0.035), "plastic", pick(rng, (WHITE, DARK_GREY, LIGHT_GREY)), bevel=0.008
    )
    for x in (-0.86, 0.0, 0.86):
        a.box((x, 0.06, 0.895), (0.04, 0.05, 0.95), "metal", ALUMINIUM)
    for z in (1.4, 1.75):
        a.box((0, 0.16, z), (width, 0.28, 0.018), "plastic", WHITE)
        with a.at(0, 0.02):
            row_on(a, rng, SHELF, width - 0.1, z + 0.018, empty=0.15)
    for x in (-0.5, 0.1, 0.6):
        a.box((x, 0.05, 1.05), (0.1, 0.05, 0.08), "plastic", WHITE, bevel=0.006)
    clutter(a, rng, BENCH_TOP, (width, deep - 0.1), 0.895, density=0.95)


def sink_bench(a: Assembly, rng: Rng) -> None:
    """A bench with a basin, a tap and a drying board."""
    a.box((0, 0.34, 0.1), (1.2, 0.62, 0.76), "wood", vary(rng, WHITE, 0.04), bevel=0.005)
    a.box((0, 0.38, 0.86), (1.2, 0.76, 0.035), "metal", STEEL, bevel=0.008)
    a.box((0.2, 0.4, 0.897), (0.5, 0.4, 0.002), "rubber", DARK_GREY)
    a.tube([(0.2, 0.1, 0.89), (0.2, 0.1, 1.2), (0.2, 0.2, 1.26), (0.2, 0.3, 1.22)], 0.014, "chrome", STEEL)
    a.box((-0.2, 0.02, 1.15), (0.6, 0.03, 0.6), "plastic", WHITE)
    for x in (-0.4, -0.25, -0.1, 0.0):
        for z in (1.25, 1.45, 1.6):
            a.tube([(x, 0.03, z), (x, 0.12, z + 0.04)], 0.006, "plastic", WHITE)
            if rng.random() < 0.6:
                with a.at(x, 0.04, z):
                    flask(a, rng)
    with a.at(-0.4, 0.3, 0.895):
        bottle(a, rng)


def fume_hood(a: Assembly, rng: Rng) -> None:
    """A fume hood with its sash half up and glassware inside."""
    width, tint = 1.5, vary(rng, WHITE, 0.05)
    a.box((0, 0.4, 0), (width, 0.8, 0.88), "paint", tint, bevel=0.01)
    for side in (-0.37, 0.37):
        a.box((side, 0.806, 0.08), (0.7, 0.014, 0.74), "paint", vary(rng, (0.3, 0.45, 0.6), 0.05), bevel=0.005)
    for side in (-1, 1):
        a.box((side * (0.5 * width - 0.06), 0.4, 0.88), (0.12, 0.8, 1.5), "paint", tint, bevel=0.01)
        for n in range(3):
            a.cylinder(
                (side * (0.5 * width - 0.06), 0.8, 1.0 + 0.12 * n),
                0.022,
                0.05,
                "plastic",
                pick(rng, PLASTICS),
                axis="y",
            )
    a.box((0, 0.02, 0.88), (width, 0.04, 1.5), "plastic", LIGHT_GREY)
    a.box((0, 0.4, 2.1), (width, 0.8, 0.5), "paint", tint, bevel=0.01)
    a.box((0, 0.4, 2.09), (1.0, 0.2, 0.008), "glow", (9.0, 9.5, 10.0))
    a.box((0, 0.74, 1.45), (width - 0.24, 0.01, 0.66), "glass", (0.85, 0.9, 0.9))
    a.box((0, 0.76, 1.42), (width - 0.24, 0.03, 0.04), "metal", ALUMINIUM)
    a.picture((0.5 * width - 0.06, 0.805, 1.5), (0.1, 0.16), any_of(rng, PrintKind.PANEL))
    clutter(a, rng, (*BENCH_TOP[:5], Piece(canister, 0.27, 0.25)), (width - 0.3, 0.65), 0.88, density=0.9)
    a.cylinder((0.3, 0.4, 2.6), 0.13, 1.0, "plastic", GREY)


def cold_store(a: Assembly, rng: Rng) -> None:
    """A laboratory refrigerator with notes on it."""
    a.box((0, 0.34, 0.05), (0.75, 0.66, 1.95), "paint", vary(rng, WHITE, 0.05), bevel=0.015)
    glass = rng.random() < 0.5
    a.box((0, 0.685, 0.1), (0.73, 0.04, 1.86), "paint", vary(rng, LIGHT_GREY, 0.05), bevel=0.012)
    if glass:
        a.box((0, 0.707, 0.3), (0.55, 0.006, 1.5), "dark glass", (0.03, 0.05, 0.06))
    a.box((0.3, 0.73, 0.9), (0.025, 0.05, 0.5), "chrome", STEEL, bevel=0.008)
    for _ in range(4):
        place = (rng.uniform(-0.25, 0.15), 0.711, rng.uniform(0.9, 1.6))
        a.picture(place, (0.15, 0.2), any_of(rng, pick(rng, (PrintKind.SHEET, PrintKind.LABEL, PrintKind.SIGN))))


PIECES = (
    Piece(lab_bench, 1.85, 0.8),
    Piece(lab_bench, 1.85, 0.8),
    Piece(fume_hood, 1.55, 0.85),
    Piece(sink_bench, 1.25, 0.8),
    Piece(cold_store, 0.8, 0.72),
    Piece(storage.steel_cupboard, 1.0, 0.5),
    Piece(storage.book_case, 0.95, 0.4),
)


def build(a: Assembly, rng: Rng, variant: int) -> Light:
    """Build a laboratory; the two variants differ in floor, colours and light."""
    bright = variant % 2 == 1
    style = Style(
        wall="wall",
        upper=vary(rng, WHITE, 0.05) if bright else (0.62, 0.68, 0.66),
        lower=vary(rng, WHITE, 0.05) if bright else (0.42, 0.52, 0.52),
        dado=1.2,
        floor="surface:linoleum" if bright else "surface:terrazzo_light",
        floor_tint=(0.9, 0.95, 1.0) if bright else (0.8, 0.78, 0.72),
        ceiling="tiles",
        panes=(2, 1),
    )
    room = Room(
        west=-4.6,
        east=4.6,
        south=-3.1,
        north=3.4,
        height=2.9,
        style=style,
        openings={
            Wall.NORTH: windows(3, 8.4, 1.9, 1.0, 1.5),
            Wall.WEST: (door(2.2),),
            Wall.EAST: (door(-2.3, 1.3),),
        },
    )
    room.build(a)
    for wall, left, right in (
        (Wall.NORTH, -4.0, 3.9),
        (Wall.SOUTH, -4.5, 4.5),
        (Wall.EAST, -1.5, 2.4),
        (Wall.WEST, -2.4, 1.5),
    ):
        with room.along(a, wall):
            line_up(a, rng, PIECES if wall is not Wall.NORTH else PIECES[:1], left, right, 0.03)
    for x, y in ((2.1, 0.9), (-2.2, -0.4)):
        with a.at(x, y, turn=90):
            a.box((0, 0.0, 0.0), (1.7, 0.9, 0.86), "plastic", vary(rng, LIGHT_GREY), bevel=0.01)
            a.box((0, 0.0, 0.86), (1.9, 1.1, 0.035), "plastic", pick(rng, (WHITE, DARK_GREY)), bevel=0.008)
            with a.at(0, -0.5):
                clutter(a, rng, BENCH_TOP, (1.8, 1.0), 0.895, density=0.9)
    for x, y in ((1.0, -1.2), (-0.8, 1.7), (3.0, -1.4), (-1.1, -1.6), (1.0, 1.9)):
        with a.at(x, y, turn=rng.uniform(0, 360)):
            (furniture.stool if rng.random() < 0.5 else furniture.office_chair)(a, rng)
    with a.at(-3.2, -1.8, turn=rng.uniform(0, 360)):
        furniture.trolley(a, rng)
    for wall, u, z, thing in (
        (Wall.EAST, 1.9, 1.4, services.pin_board),
        (Wall.WEST, 0.0, 1.95, services.poster),
        (Wall.SOUTH, 0.4, 2.05, services.clock),
        (Wall.WEST, 1.45, 0.0, services.extinguisher),
        (Wall.EAST, -1.3, 1.5, services.sign),
        (Wall.SOUTH, -2.6, 2.1, services.poster),
    ):
        with room.along(a, wall, u, z=z):
            thing(a, rng)
    for x, y in lamps.rows((-3.3, 3.3, 4), (-1.8, 2.1, 3)):
        with a.at(x, y):
            lamps.panel(a, room.height, lamps.NEUTRAL if bright else lamps.COOL, (1.15, 0.28))
    with a.at(0, -2.2):
        services.duct(a, rng, 9.0, 2.62, 0.13)
    return Light(
        camera_m=(0.0, 0.2, 1.5),
        sky=5.0,
        overcast=0.7 if bright else 0.15,
        daylight=5.0,
        sun=0.0 if bright else 9.0,
        sun_bearing_deg=110.0,
        ambient=(0.3, 0.31, 0.32),
        reach_m=1.5,
    )
