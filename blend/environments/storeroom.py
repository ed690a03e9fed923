"""Storerooms and warehouses: racks and shelving full of goods, aisles, pallets, a lift truck."""

import numpy as np

from blend.environments import furniture, lamps, machines, services, storage
from blend.environments.assembly import Assembly
from blend.environments.goods import CARTONS, STORED
from blend.environments.layout import Piece, line_up, row_on
from blend.environments.palette import (
    BLACK,
    DARK_GREY,
    LIGHT_GREY,
    ORANGE,
    RED,
    STEEL,
    WHITE,
    YELLOW,
    palette,
    pick,
    vary,
)
from blend.environments.room import Room, Style, Wall, door, gate, windows
from blend.environments.scene import Light

Rng = np.random.Generator
TRUCKS = (ORANGE, YELLOW, RED, *palette("2a6a3a 1c5aa0"))
"""Colours of lift trucks and pallet trucks."""


def lift_truck(a: Assembly, rng: Rng) -> None:
    """A counterbalanced lift truck with its forks towards +y."""
    tint = pick(rng, TRUCKS)
    a.box((0, 0.75, 0.22), (1.05, 1.5, 0.5), "paint", tint, bevel=0.06)
    a.box((0, 0.35, 0.7), (1.0, 0.7, 0.42), "paint", tint, bevel=0.08)
    a.box((0, 0.1, 0.25), (1.02, 0.3, 0.75), "paint", DARK_GREY, bevel=0.08)
    a.box((0, 0.62, 1.0), (0.5, 0.45, 0.12), "rubber", BLACK, bevel=0.03)
    a.box((0, 0.42, 1.05), (0.5, 0.1, 0.45), "rubber", BLACK, bevel=0.03)
    for x in (-0.46, 0.46):
        a.tube([(x, 0.15, 1.0), (x, 0.25, 2.05), (x, 1.15, 2.1), (x, 1.4, 0.75)], 0.04, "paint", DARK_GREY)
        for y in (0.35, 1.25):
            a.cylinder((x - 0.11 if x < 0 else x - 0.05, y, 0.27), 0.27, 0.17, "rubber", BLACK, axis="x", sides=20)
            a.cylinder((x - 0.12 if x < 0 else x - 0.06, y, 0.27), 0.13, 0.19, "paint", LIGHT_GREY, axis="x", sides=16)
        a.box((0.7 * x, 1.62, 0.08), (0.09, 0.12, 2.1), "paint", BLACK)
        a.box((0.5 * x, 2.2, 0.1), (0.11, 1.1, 0.045), "metal", DARK_GREY)
        a.box((0.5 * x, 1.68, 0.1), (0.11, 0.05, 0.6), "metal", DARK_GREY)
    for y in np.linspace(0.3, 1.15, 6):
        a.box((0, float(y), 2.05), (0.9, 0.05, 0.03), "paint", DARK_GREY)
    ring = np.linspace(0, 2 * np.pi, 19)
    points = np.column_stack([0.16 * np.cos(ring), 1.12 + 0.05 * np.sin(ring), 1.15 + 0.15 * np.sin(ring)])
    a.tube(points, 0.014, "rubber", BLACK)
    a.cylinder((0, 0.2, 2.12), 0.05, 0.09, "glow", (5.0, 1.6, 0.1))


def pallet_truck(a: Assembly, rng: Rng) -> None:
    """A hand pallet truck."""
    tint = pick(rng, TRUCKS)
    for x in (-0.2, 0.2):
        a.box((x, 0.75, 0.06), (0.15, 1.15, 0.05), "paint", tint, bevel=0.01)
    a.box((0, 0.12, 0.06), (0.45, 0.16, 0.3), "paint", tint, bevel=0.03)
    a.tube([(0, 0.05, 0.3), (0, -0.25, 1.15)], 0.022, "paint", BLACK)
    a.tube(
        [(-0.12, -0.25, 1.12), (-0.1, -0.31, 1.28), (0.1, -0.31, 1.28), (0.12, -0.25, 1.12), (-0.12, -0.25, 1.12)],
        0.016,
        "rubber",
        BLACK,
    )
    for x in (-0.06, 0.03):
        a.cylinder((x, 0.08, 0.09), 0.09, 0.05, "rubber", BLACK, axis="x")


def packing_table(a: Assembly, rng: Rng) -> None:
    """A table with a roll of paper, a scale, a computer and cartons."""
    furniture.legs(a, (1.9, 0.8, 0.84), "paint", vary(rng, LIGHT_GREY))
    a.box((0, 0.4, 0.84), (1.9, 0.8, 0.04), "wood", (0.55, 0.45, 0.32), bevel=0.006)
    for x in (-0.9, 0.9):
        a.box((x, 0.05, 0.88), (0.05, 0.05, 1.0), "paint", LIGHT_GREY)
    a.box((0, 0.15, 1.55), (1.85, 0.3, 0.025), "paint", LIGHT_GREY)
    with a.at(0, 0.02):
        row_on(a, rng, CARTONS, 1.8, 1.575, empty=0.2)
    a.cylinder((-0.85, 0.25, 1.15), 0.12, 0.6, "card", (0.6, 0.45, 0.28), axis="x", sides=20)
    with a.at(0.5, 0.12, 0.88):
        furniture.monitor(a, rng)
    furniture.keyboard(a, 0.45, 0.55, 0.88)
    with a.at(-0.4, 0.3, 0.88):
        CARTONS[0].build(a, rng)
    with a.at(0.0, 0.2, 0.1):
        row_on(a, rng, CARTONS, 1.7, 0.0)


def build(a: Assembly, rng: Rng, variant: int) -> Light:
    """Build a storeroom: a tall warehouse, or a small room with shelving close to the camera."""
    return _warehouse(a, rng) if variant % 2 else _storeroom(a, rng)


def _warehouse(a: Assembly, rng: Rng) -> Light:
    style = Style(
        wall="ribbed",
        upper=(0.55, 0.58, 0.6),
        lower=(0.3, 0.36, 0.45),
        dado=1.5,
        floor="surface:concrete_smooth",
        floor_tint=(0.85, 0.83, 0.78),
        ceiling="ribbed",
        ceiling_tint=(0.6, 0.62, 0.62),
    )
    room = Room(
        west=-11.0,
        east=12.0,
        south=-7.0,
        north=7.0,
        height=6.4,
        style=style,
        openings={
            Wall.EAST: (gate(1.5, 3.6, 3.8), gate(-3.5, 3.6, 3.8)),
            Wall.WEST: (gate(-2.0, 3.4, 3.6), door(3.8)),
            Wall.NORTH: windows(6, 22.0, 2.4, 4.9, 0.9),
            Wall.SOUTH: windows(6, 22.0, 2.4, 4.9, 0.9),
        },
    )
    room.build(a)
    for y, turn in ((6.7, 180), (3.9, 180), (-2.9, 180), (-5.9, 0)):
        for x in np.arange(-8.0, 9.0, 2.85):
            if (y in {3.9, -2.9} and abs(x + 1.5) < 1.7) or rng.random() < 0.06:
                continue
            with a.at(float(x), y, turn=turn):
                storage.pallet_rack(a, rng, levels=3 if rng.random() < 0.8 else 4, gap=1.35)
    with a.at(4.6, 0.5, turn=70):
        lift_truck(a, rng)
    with a.at(-4.3, -0.5, turn=-50):
        pallet_truck(a, rng)
    for x, y in ((-3.1, 1.9), (2.8, -1.6), (7.6, -1.2), (-6.5, 1.7), (-2.0, 5.0), (1.4, 2.4)):
        with a.at(x, y, turn=rng.uniform(-12, 12) + 90 * float(rng.integers(2))):
            storage.pallet(a, rng, int(rng.integers(1, 5)))
    with room.along(a, Wall.WEST, 1.2):
        packing_table(a, rng)
    for wall, u in ((Wall.WEST, 5.2), (Wall.EAST, 5.3), (Wall.EAST, -6.1)):
        with room.along(a, wall, u):
            services.extinguisher(a, rng)
    for y in (2.6, -2.0):
        services.floor_line(a, (-10.0, y), (11.0, y), YELLOW)
    for x in np.arange(-9.0, 12.0, 4.2):
        with a.at(float(x), 0.0, turn=90):
            services.truss(a, 14.0, room.height - 0.95, vary(rng, LIGHT_GREY), 0.75)
    for x, y in lamps.rows((-8.0, 9.0, 5), (-4.4, 5.3, 3)):
        with a.at(x, y):
            lamps.bell(a, room.height, lamps.NEUTRAL, 0.3, 1.0)
    with a.at(0, 0.2):
        services.duct(a, rng, 21.0, room.height - 1.5, 0.3)
    with a.at(0, 1.4):
        services.cable_tray(a, rng, 21.0, room.height - 1.3)
    return Light(camera_m=(0.0, 0.3, 1.6), sky=7.0, overcast=0.8, daylight=7.0, ambient=(0.28, 0.28, 0.28), reach_m=4.0)


def _storeroom(a: Assembly, rng: Rng) -> Light:
    style = Style(
        wall="blocks",
        upper=(0.66, 0.63, 0.55),
        lower=(0.5, 0.47, 0.4),
        dado=1.1,
        floor="surface:concrete_rough",
        floor_tint=(0.75, 0.7, 0.65),
        ceiling="wall",
        ceiling_tint=(0.6, 0.58, 0.55),
    )
    room = Room(
        west=-4.6,
        east=4.4,
        south=-2.9,
        north=3.1,
        height=3.2,
        style=style,
        openings={Wall.EAST: (*windows(1, 2.0, 1.2, 1.7, 0.9),), Wall.WEST: (door(-0.2, 1.3),)},
    )
    room.build(a)
    shelves = (
        Piece(storage.steel_shelf, 1.25, 0.5),
        Piece(storage.steel_shelf, 1.25, 0.5),
        Piece(lambda b, r: storage.steel_shelf(b, r, STORED, width=1.6, high=2.5, boards=5), 1.66, 0.5),
        Piece(lambda b, r: storage.pallet_rack(b, r, width=2.4, levels=2, gap=1.2), 2.55, 1.0),
    )
    with room.along(a, Wall.NORTH):
        line_up(a, rng, shelves, -4.4, 4.4)
    with room.along(a, Wall.SOUTH):
        line_up(a, rng, (*shelves, Piece(machines.drum, 0.65)), -4.2, 4.5)
    with room.along(a, Wall.EAST):
        line_up(a, rng, (*shelves[:2], Piece(storage.steel_cupboard, 1.0), Piece(furniture.ladder, 0.6)), -2.2, 2.2)
    with room.along(a, Wall.WEST):
        line_up(a, rng, shelves[:2], 0.7, 2.9)
        line_up(a, rng, (Piece(furniture.ladder, 0.6), Piece(machines.gas_bottles, 0.95)), -2.6, -1.1)
    for x, y, thing in (
        (2.3, -0.8, furniture.trolley),
        (-2.1, 0.7, storage.pallet),
        (2.2, 1.3, storage.pallet),
        (-1.9, -1.3, pallet_truck),
        (0.9, 1.6, furniture.stool),
    ):
        with a.at(x, y, turn=rng.uniform(0, 360)):
            thing(a, rng)
    for x in (-2.8, 0.2, 3.0):
        with a.at(x, 0.2, turn=90):
            lamps.tube(a, room.height, lamps.NEUTRAL, 1.5, 0.1)
    with room.along(a, Wall.WEST, 1.9, z=2.2):
        services.pin_board(a, rng, 1.2, 0.8)
    with room.along(a, Wall.SOUTH):
        services.pipe_run(a, rng, 8.6, 2.75, 2)
    with a.at(0, 2.0):
        services.cable_tray(a, rng, 8.6, 2.85)
    with room.along(a, Wall.WEST, 0.62, z=1.5):
        services.sign(a, rng)
    a.box((4.39, -1.5, 1.2), (0.02, 0.3, 0.4), "plastic", WHITE)
    a.box((4.37, 1.6, 1.3), (0.05, 0.2, 0.3), "paint", STEEL)
    return Light(camera_m=(0.0, 0.1, 1.45), sky=5.0, overcast=0.6, daylight=7.0, ambient=(0.2, 0.19, 0.18), reach_m=2.0)
