"""Workshops: benches, tools on the walls, shelves, machines under strip lights."""

import numpy as np

from blend.environments import furniture, lamps, machines, services, storage
from blend.environments.assembly import Assembly
from blend.environments.goods import STORED
from blend.environments.layout import Piece, clutter, line_up, row_on
from blend.environments.palette import (
    DARK_GREY,
    LIGHT_GREY,
    MACHINES,
    ORANGE,
    WHITE,
    WOODS,
    YELLOW,
    palette,
    pick,
    vary,
)
from blend.environments.room import Room, Style, Wall, door, gate, windows
from blend.environments.scene import Light
from blend.environments.tools import BENCH

Rng = np.random.Generator

UPPER = palette("d8d4c4 c8ccc8 dcd8d0 b8c0bc")
"""Colours of painted walls above the dado."""
LOWER = palette("4a6a5a 5a6a78 8a8478 6a7a70 3f5668")
"""Colours of painted walls below the dado."""

FLOOR_PIECES = (
    Piece(furniture.workbench, 2.05, 0.8),
    Piece(storage.steel_cupboard, 1.0, 0.5),
    Piece(storage.steel_shelf, 1.25, 0.5),
    Piece(storage.lockers, 0.95, 0.5),
    Piece(machines.drill_press, 0.7, 0.8),
    Piece(machines.lathe, 2.2, 0.9),
    Piece(machines.milling_machine, 1.5, 1.1),
    Piece(machines.compressor, 1.4, 0.7),
    Piece(machines.gas_bottles, 0.95, 0.4),
    Piece(machines.drum, 0.65, 0.65),
    Piece(furniture.trolley, 0.95, 0.6),
    Piece(furniture.ladder, 0.6, 0.6),
)
"""Things that stand along a workshop's walls."""


def build(a: Assembly, rng: Rng, variant: int) -> Light:
    """Build a workshop; the two variants differ in height, walls and light."""
    old = variant % 2 == 0
    style = Style(
        wall="brick" if old else "blocks",
        upper=(0.36, 0.17, 0.1) if old else pick(rng, UPPER),
        lower=(0.36, 0.17, 0.1) if old else pick(rng, LOWER),
        dado=0.0 if old else 1.3,
        floor="surface:concrete_stained" if old else "surface:concrete_smooth",
        floor_tint=(0.9, 0.87, 0.82) if old else (0.75, 0.8, 0.8),
        ceiling="wood" if old else "wall",
        ceiling_tint=WOODS[1] if old else WHITE,
        frames=DARK_GREY if old else WHITE,
        panes=(4, 3) if old else (2, 2),
    )
    room = Room(
        west=-5.5,
        east=5.0,
        south=-4.0,
        north=4.6,
        height=4.4 if old else 3.4,
        style=style,
        openings={
            Wall.NORTH: windows(3, 10.0, 2.0, 1.35, 1.7 if old else 1.4),
            Wall.EAST: (*windows(1, 3.0, 1.6, 1.3, 1.5), door(3.4)),
            Wall.WEST: (gate(0.6, 3.0, 3.0),),
            Wall.SOUTH: (door(-4.2),),
        },
    )
    room.build(a)
    for wall, left, right in (
        (Wall.NORTH, -5.0, 5.0),
        (Wall.EAST, -4.1, 2.7),
        (Wall.SOUTH, -3.5, 5.0),
        (Wall.WEST, 2.3, 4.2),
        (Wall.WEST, -4.2, -1.1),
    ):
        with room.along(a, wall):
            line_up(a, rng, FLOOR_PIECES, left, right)
    _walls(a, rng, room)
    _middle(a, rng)
    _above(a, rng, room, old=old)
    return Light(
        camera_m=(0.0, 0.0, 1.45),
        sky=7.0,
        overcast=0.25,
        daylight=8.0 if old else 4.0,
        sun=6.0 if old else 0.0,
        sun_bearing_deg=62.0,
        sun_height_deg=32.0,
        ambient=(0.16, 0.15, 0.14) if old else (0.2, 0.2, 0.2),
    )


def _walls(a: Assembly, rng: Rng, room: Room) -> None:
    for wall, u, z, thing in (
        (Wall.SOUTH, -1.6, 1.25, furniture.tool_wall),
        (Wall.SOUTH, 1.4, 1.3, furniture.tool_wall),
        (Wall.SOUTH, 3.9, 1.3, services.pin_board),
        (Wall.EAST, -2.6, 1.25, furniture.tool_wall),
        (Wall.EAST, 1.6, 1.6, services.poster),
        (Wall.WEST, -2.2, 1.6, services.pin_board),
        (Wall.WEST, 2.9, 0.0, services.fuse_board),
        (Wall.EAST, 2.35, 0.0, services.extinguisher),
        (Wall.EAST, 2.3, 2.3, services.clock),
        (Wall.WEST, -3.6, 1.7, services.poster),
    ):
        with room.along(a, wall, u, z=z):
            thing(a, rng)
    with room.along(a, Wall.NORTH):
        services.trunking(a, rng, 9.5, 1.1)
        services.pipe_run(a, rng, 9.0, room.height - 0.8, 2)
    with room.along(a, Wall.SOUTH):
        services.trunking(a, rng, 8.0, 1.1)
    with room.along(a, Wall.SOUTH, z=2.35):
        a.box((0.6, 0.2, 0.0), (6.0, 0.36, 0.03), "wood", WOODS[1])
        with a.at(0.6, 0.02):
            from_left = (*STORED,)
            row_on(a, rng, from_left, 5.9, 0.03, empty=0.2)


def _middle(a: Assembly, rng: Rng) -> None:
    """Add the things that stand free: an assembly table, stools, trolleys, a pallet, a drum, a machine."""
    with a.at(2.0, -1.9, turn=rng.normal(90, 6)):
        a.box((0, 0.45, 0.82), (1.9, 0.9, 0.06), "surface:birch_veneer", (0.8, 0.7, 0.6), bevel=0.01)
        furniture.legs(a, (1.9, 0.9, 0.82), "paint", vary(rng, pick(rng, MACHINES)))
        clutter(a, rng, (*BENCH, Piece(machines.vice, 0.25, 0.4)), (1.8, 0.85), 0.88, density=0.9)
    for x, y, thing in (
        (1.0, -2.6, furniture.stool),
        (-2.3, -1.6, furniture.trolley),
        (-2.9, 1.9, storage.pallet),
        (2.7, 1.7, furniture.stool),
        (-1.6, 2.6, machines.drum),
        (2.6, 2.4, furniture.trolley),
        (-3.6, -2.2, machines.milling_machine),
    ):
        with a.at(x, y, turn=rng.uniform(0, 360)):
            thing(a, rng)
    for y in (-3.2, 3.6):
        services.floor_line(a, (-4.6, y * 0.95), (4.2, y * 0.95), vary(rng, YELLOW), 0.08)


def _above(a: Assembly, rng: Rng, room: Room, *, old: bool) -> None:
    for x in np.arange(-4.5, 5.0, 2.2):
        with a.at(float(x), 0.3, turn=90):
            if old:
                a.box((0, 0, room.height - 0.3), (8.6, 0.2, 0.3), "wood", vary(rng, WOODS[3]))
            else:
                services.girder(a, 8.6, room.height - 0.26, vary(rng, LIGHT_GREY), 0.24)
    for x, y in lamps.rows((-3.6, 3.4, 3), (-2.2, 2.6, 3)):
        with a.at(x, y):
            if old and abs(y) < 1.0:
                lamps.bell(a, room.height, drop=0.9)
            else:
                lamps.tube(a, room.height - 0.3, drop=0.25)
    with a.at(0, -3.3):
        services.cable_tray(a, rng, 9.5, room.height - 0.75)
    with a.at(0, 3.5):
        services.duct(a, rng, 9.5, room.height - 0.65, 0.2)
    with a.at(-1.0, 1.2):
        a.tube([(0, 0, room.height), (0.02, 0, 2.2)], 0.008, "rubber", ORANGE)
        a.box((0.02, 0, 2.05), (0.08, 0.08, 0.16), "plastic", ORANGE, bevel=0.01)
