"""Offices: desks with screens, book cases, pictures, plants, blinds."""

import numpy as np

from blend.environments import furniture, lamps, services, storage
from blend.environments.assembly import Assembly
from blend.environments.goods import CARTONS
from blend.environments.layout import Piece, line_up
from blend.environments.palette import (
    ALUMINIUM,
    BLACK,
    DARK_GREY,
    FABRICS,
    LIGHT_GREY,
    STEEL,
    WHITE,
    WOODS,
    palette,
    pick,
    vary,
)
from blend.environments.prints import PrintKind, any_of
from blend.environments.room import Room, Style, Wall, door, windows
from blend.environments.scene import Light

Rng = np.random.Generator
WALLS = palette("e2dfd6 d4d8d8 c8d0c4 ddd2c0")
"""Colours of an office's walls."""
ACCENTS = palette("2c5a8c 8a4a3a 3a6a5a c08a30")
"""Strong colours of single walls and of cushions."""


def printer(a: Assembly, rng: Rng) -> None:
    """A printer and copier that stands on the floor."""
    tint = vary(rng, LIGHT_GREY)
    a.box((0, 0.35, 0.05), (0.62, 0.62, 0.75), "plastic", tint, bevel=0.015)
    for z in (0.08, 0.26, 0.44):
        a.box(
            (0, 0.668, z), (0.58, 0.016, 0.165), "plastic", vary(rng, DARK_GREY if z > 0.4 else tint, 0.05), bevel=0.006
        )
        a.box((0, 0.68, z + 0.11), (0.16, 0.012, 0.025), "plastic", DARK_GREY)
    a.box((0, 0.33, 0.86), (0.64, 0.6, 0.14), "plastic", tint, bevel=0.02)
    a.box((-0.1, 0.33, 0.8), (0.4, 0.5, 0.06), "rubber", BLACK)
    with a.at(0.2, 0.66, 0.92, lean=-35):
        a.box((0, 0, 0), (0.22, 0.03, 0.15), "plastic", BLACK, bevel=0.006)
        a.picture((0, 0.017, 0.015), (0.19, 0.12), any_of(rng, PrintKind.SCREEN), "screen", (1.3, 1.3, 1.3))
    for n in range(3):
        a.box((-0.15, 0.5, 1.0 + 0.03 * n), (0.21, 0.297, 0.028), "card", WHITE, turn=rng.normal(0, 8))


def sofa(a: Assembly, rng: Rng) -> None:
    """A small sofa with cushions."""
    tint = vary(rng, pick(rng, FABRICS))
    a.box((0, 0.42, 0.12), (1.7, 0.8, 0.28), "fabric", tint, bevel=0.05)
    a.box((0, 0.12, 0.2), (1.7, 0.2, 0.6), "fabric", tint, bevel=0.06)
    for side in (-0.8, 0.8):
        a.box((side, 0.42, 0.12), (0.18, 0.8, 0.48), "fabric", tint, bevel=0.06)
    for x in (-0.36, 0.36):
        a.box((x, 0.47, 0.38), (0.68, 0.62, 0.12), "fabric", vary(rng, tint), bevel=0.05)
    with a.at(-0.5, 0.3, 0.52, turn=15, lean=-18):
        a.box((0, 0, 0), (0.42, 0.12, 0.4), "fabric", pick(rng, ACCENTS), bevel=0.05)


def filing_cabinet(a: Assembly, rng: Rng) -> None:
    """A filing cabinet of four drawers, with a plant or a carton on top."""
    tint = vary(rng, pick(rng, (LIGHT_GREY, DARK_GREY, WHITE, (0.3, 0.33, 0.36))))
    a.box((0, 0.31, 0), (0.47, 0.62, 1.32), "paint", tint, bevel=0.006)
    for n in range(4):
        a.box((0, 0.626, 0.03 + 0.325 * n), (0.44, 0.014, 0.31), "paint", vary(rng, tint, 0.05), bevel=0.005)
        a.box((0, 0.645, 0.25 + 0.325 * n), (0.15, 0.025, 0.02), "metal", ALUMINIUM)
        a.picture((0, 0.634, 0.16 + 0.325 * n), (0.08, 0.045), any_of(rng, PrintKind.LABEL))
    with a.at(0, 0.1, 1.32):
        (furniture.plant if rng.random() < 0.5 else CARTONS[0].build)(a, rng)


def blind(a: Assembly, rng: Rng, width: float, high: float) -> None:
    """A slatted blind let down by `high` metres; its top edge is at z = 0."""
    a.box((0, 0.03, -0.05), (width, 0.05, 0.05), "metal", ALUMINIUM)
    for n in range(int(high / 0.045)):
        with a.at(0, 0.03, -0.09 - 0.045 * n, lean=rng.normal(28, 1.0)):
            a.box((0, 0, 0), (width, 0.04, 0.002), "plastic", (0.7, 0.68, 0.62))
    a.tube([(0.45 * width, 0.06, 0), (0.45 * width, 0.06, -high - 0.2)], 0.003, "plastic", WHITE)


def curtain(a: Assembly, rng: Rng, width: float, high: float) -> None:
    """A pleated curtain that hangs from z = 0."""
    xs = np.linspace(-0.5, 0.5, 41) * width
    depth = 0.06 + 0.035 * np.sin(np.linspace(0, 2 * np.pi * width / 0.14, 41)) + rng.normal(0, 0.004, 41)
    tint = np.tile(np.array([vary(rng, pick(rng, (WHITE, (0.5, 0.45, 0.38), (0.3, 0.36, 0.42))))]), (40, 1))
    top = np.column_stack([xs, depth, np.zeros(41)])
    low = np.column_stack([xs, depth * 1.2, np.full(41, -high)])
    a.quads(np.stack([top[:-1], top[1:], low[1:], low[:-1]], axis=1), "fabric", tint)


def coat_stand(a: Assembly, rng: Rng) -> None:
    """A stand with coats."""
    a.cylinder((0, 0.25, 0), 0.22, 0.03, "metal", DARK_GREY)
    a.cylinder((0, 0.25, 0), 0.018, 1.8, "metal", DARK_GREY)
    for n in range(3):
        t = 2.1 * n + 0.4
        a.tube([(0, 0.25, 1.6), (0.14 * np.cos(t), 0.25 + 0.14 * np.sin(t), 1.72)], 0.012, "metal", STEEL)
        if n < 2:
            profile = [(0.12, 0.0), (0.16, 0.15), (0.13, 0.6), (0.1, 0.8), (0.03, 0.95)]
            a.lathe((0.15 * np.cos(t), 0.25 + 0.15 * np.sin(t), 0.75), profile, "fabric", pick(rng, FABRICS), sides=9)


PIECES = (
    Piece(storage.book_case, 0.95, 0.4),
    Piece(storage.book_case, 0.95, 0.4),
    Piece(filing_cabinet, 0.5, 0.65),
    Piece(printer, 0.7, 0.7),
    Piece(sofa, 1.8, 0.85),
    Piece(furniture.plant, 0.6, 0.5),
    Piece(coat_stand, 0.55, 0.5),
    Piece(storage.steel_cupboard, 1.0, 0.5),
)


def build(a: Assembly, rng: Rng, variant: int) -> Light:
    """Build an office; the two variants differ in floor, windows and light."""
    warm = variant % 2 == 0
    tint = vary(rng, pick(rng, WALLS), 0.04)
    style = Style(
        wall="wall",
        upper=tint,
        lower=tint,
        floor="surface:oak_planks" if warm else "surface:carpet_loop",
        floor_tint=(1.0, 0.95, 0.9) if warm else (0.8, 0.85, 0.95),
        ceiling="wall" if warm else "tiles",
        frames=WOODS[3] if warm else WHITE,
        panes=(2, 1) if warm else (3, 1),
    )
    room = Room(
        west=-4.2,
        east=4.4,
        south=-3.3,
        north=3.3,
        height=2.85,
        style=style,
        openings={
            Wall.NORTH: windows(3, 8.0, 1.7 if warm else 2.3, 0.85, 1.55),
            Wall.SOUTH: (door(-2.9),),
            Wall.WEST: windows(1, 3.0, 1.6, 0.85, 1.5) if warm else (),
        },
    )
    room.build(a)
    for wall in (Wall.EAST, Wall.WEST):
        with room.along(a, wall):
            a.box(
                (0, 0.004, 0.09),
                (room.length(wall) if wall is Wall.EAST else 0.01, 0.006, room.height - 0.09),
                "wall",
                pick(rng, ACCENTS) if not warm else vary(rng, tint, 0.05),
            )
            line_up(a, rng, PIECES, -3.0, 3.0 if wall is Wall.EAST else -0.9)
    with room.along(a, Wall.SOUTH):
        line_up(a, rng, PIECES, -2.1, 4.2, 0.15)
    with room.along(a, Wall.NORTH):
        for x in (-2.75, 0.0, 2.75):
            with a.at(x, 0.0):
                services.radiator(a, rng, 1.3)
            with a.at(x, 0.0, 2.45):
                if warm:
                    for side in (-1.0, 1.0):
                        with a.at(side, 0.0):
                            curtain(a, rng, 0.5, 2.3)
                else:
                    blind(a, rng, 2.3, rng.uniform(0.4, 1.2))
    for x, y, turn in ((2.0, 1.4, 90), (2.0, -1.2, -90), (-1.9, 1.8, 0), (-2.1, -1.4, 160), (0.3, 2.9, 180)):
        with a.at(x, y, turn=turn + rng.normal(0, 4)):
            furniture.desk(a, rng)
    for wall, u, z, thing in (
        (Wall.EAST, -1.3, 1.5, services.poster),
        (Wall.EAST, 1.0, 1.4, services.white_board),
        (Wall.SOUTH, 0.3, 1.5, services.pin_board),
        (Wall.SOUTH, 2.4, 1.55, services.poster),
        (Wall.SOUTH, -1.4, 2.2, services.clock),
        (Wall.WEST, -2.4, 1.55, services.poster),
        (Wall.WEST, 2.4, 1.3, services.pin_board),
    ):
        with room.along(a, wall, u, z=z):
            thing(a, rng)
    for x, y in lamps.rows((-2.7, 2.7, 3), (-1.7, 1.7, 2)):
        with a.at(x, y):
            if warm:
                lamps.globe(a, room.height, lamps.WARM)
            else:
                lamps.panel(a, room.height)
    for x, y in ((0.9, -2.0), (-0.7, 0.9)):
        with a.at(x, y, turn=rng.uniform(0, 360)):
            (CARTONS[3].build if rng.random() < 0.5 else furniture.office_chair)(a, rng)
    return Light(
        camera_m=(0.0, 0.0, 1.35),
        sky=5.0,
        overcast=0.2 if warm else 0.7,
        daylight=6.0,
        sun=7.0 if warm else 0.0,
        sun_bearing_deg=125.0,
        sun_height_deg=28.0,
        ambient=(0.22, 0.22, 0.22),
        reach_m=1.6,
    )
