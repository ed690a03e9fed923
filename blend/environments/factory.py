"""Factory halls: machines in rows, columns, trusses, a crane, pipes and high windows."""

import itertools

import numpy as np

from blend.environments import furniture, lamps, machines, services, storage
from blend.environments.assembly import Assembly
from blend.environments.layout import Piece, line_up
from blend.environments.palette import DARK_GREY, LIGHT_GREY, MACHINES, ORANGE, STEEL, WHITE, YELLOW, pick, vary
from blend.environments.room import Room, Style, Wall, door, gate, windows
from blend.environments.scene import Light
from blend.environments.solids import hanging
from blend.environments.storeroom import lift_truck

Rng = np.random.Generator


def crane(a: Assembly, rng: Rng, span: float, z: float) -> None:
    """A bridge crane along y, with its hook near the middle."""
    tint = pick(rng, (YELLOW, ORANGE, (0.7, 0.5, 0.02)))
    with a.at(0, 0, turn=90):
        for y in (-0.5, 0.5):
            a.box((0, y, z), (span, 0.3, 0.6), "paint", tint, bevel=0.02)
        a.box((1.0, 0, z + 0.6), (1.0, 1.5, 0.4), "paint", DARK_GREY, bevel=0.03)
        a.cylinder((1.0, 0, z - 1.6), 0.015, 2.2, "metal", STEEL)
        a.box((1.0, 0, z - 1.95), (0.3, 0.2, 0.4), "paint", tint, bevel=0.05)
        a.tube(
            [(1.0, 0, z - 1.95), (1.0, 0, z - 2.1), (1.1, 0, z - 2.2), (1.0, 0, z - 2.3), (0.92, 0, z - 2.2)],
            0.03,
            "metal",
            DARK_GREY,
        )
        a.tube(hanging((-3.0, 0.7, z), (1.0, 0.7, z), 0.5, 15), 0.02, "rubber", DARK_GREY)
        a.tube([(-1.5, 0.6, z), (-1.5, 0.6, 1.5)], 0.012, "rubber", DARK_GREY)
        a.box((-1.5, 0.6, 1.2), (0.08, 0.08, 0.3), "plastic", YELLOW, bevel=0.01)


def platform(a: Assembly, rng: Rng) -> None:
    """A steel platform with stairs, railings and a tank on it."""
    tint = pick(rng, (YELLOW, LIGHT_GREY, *MACHINES))
    for x in (-1.6, 1.6):
        for y in (0.2, 2.0):
            a.box((x, y, 0), (0.14, 0.14, 2.2), "paint", DARK_GREY)
    a.box((0, 1.1, 2.2), (3.5, 2.1, 0.12), "metal", STEEL)
    for z in (2.8, 3.3):
        points = [(1.7, 0.1, z), (-1.7, 0.1, z), (-1.7, 2.1, z), (1.7, 2.1, z)]
        for start, end in itertools.pairwise(points):
            a.tube([start, end], 0.022, "paint", tint)
    for x in np.linspace(-1.7, 1.7, 5):
        for y in (0.1, 2.1):
            a.cylinder((float(x), y, 2.3), 0.02, 1.0, "paint", tint, sides=8)
    for n in range(10):
        a.box((1.9 + 0.24 * n, 1.1, 2.1 - 0.22 * n), (0.26, 0.8, 0.04), "metal", STEEL)
    for y in (0.7, 1.5):
        a.tube([(1.75, y, 2.2), (4.2, y, 0.0)], 0.04, "paint", DARK_GREY)
        a.tube([(1.75, y, 3.2), (4.2, y, 1.0), (4.2, y, 0.0)], 0.022, "paint", tint)
    with a.at(-0.6, 0.3, 2.3):
        machines.tank(a, rng)
    with a.at(0.7, 0.2, 0.0):
        machines.compressor(a, rng)
    a.tube(
        [(0.5, 0.4, 0.7), (0.5, 0.4, 2.0), (-0.6, 0.4, 2.0), (-0.6, 1.0, 2.0), (-0.6, 1.0, 2.6)],
        0.06,
        "paint",
        pick(rng, services.PIPES),
    )


def fenced_robot(a: Assembly, rng: Rng) -> None:
    """A robot behind a guard fence of posts and rails."""
    machines.robot(a, rng)
    for x in np.linspace(-1.8, 1.8, 5):
        a.box((float(x), 2.1, 0), (0.06, 0.06, 2.0), "paint", YELLOW)
        if x < 1.7:
            for step in np.arange(0.1, 0.9, 0.1):
                a.cylinder((float(x) + float(step), 2.1, 0.15), 0.004, 1.8, "paint", DARK_GREY, sides=4)
            for z in (0.15, 1.05, 1.95):
                a.box((float(x) + 0.45, 2.1, z), (0.9, 0.03, 0.03), "paint", DARK_GREY)
    a.box((1.4, 2.16, 1.2), (0.35, 0.06, 0.35), "plastic", WHITE)
    with a.at(1.4, 2.15, 1.15):
        machines.control_box(a, rng)
    with a.at(-1.2, 0.6):
        storage.pallet(a, rng, 2)


PIECES = (
    Piece(machines.machining_centre, 2.6, 1.7),
    Piece(machines.press, 2.0, 1.2),
    Piece(machines.milling_machine, 1.6, 1.1),
    Piece(machines.lathe, 2.3, 0.9),
    Piece(machines.tank, 1.5, 1.4),
    Piece(machines.conveyor, 3.1, 0.9),
    Piece(furniture.workbench, 2.1, 0.8),
    Piece(storage.steel_shelf, 1.3, 0.5),
    Piece(machines.compressor, 1.5, 0.7),
    Piece(storage.pallet, 1.4, 0.9),
)


def build(a: Assembly, rng: Rng, variant: int) -> Light:
    """Build a factory hall: an old one of brick with sun in it, or a new one with even light."""
    old = variant % 2 == 0
    style = Style(
        wall="brick" if old else "ribbed",
        upper=(0.42, 0.24, 0.16) if old else (0.62, 0.66, 0.68),
        lower=(0.42, 0.24, 0.16) if old else (0.2, 0.3, 0.42),
        dado=0.0 if old else 2.0,
        floor="surface:concrete_stained" if old else "surface:concrete_smooth",
        floor_tint=(0.8, 0.76, 0.7) if old else (0.55, 0.68, 0.62),
        ceiling="wood" if old else "ribbed",
        ceiling_tint=(0.3, 0.22, 0.14) if old else (0.6, 0.62, 0.63),
        frames=DARK_GREY,
        panes=(6, 7) if old else (4, 1),
    )
    room = Room(
        west=-13.0,
        east=14.0,
        south=-8.0,
        north=8.5,
        height=8.0,
        style=style,
        openings={
            Wall.NORTH: windows(6, 26.0, 3.0, 2.0 if old else 5.4, 4.2 if old else 1.3),
            Wall.SOUTH: windows(6, 26.0, 3.0, 2.4 if old else 5.4, 3.8 if old else 1.3),
            Wall.EAST: (gate(1.0, 4.0, 4.2), door(-4.2, 1.1)),
            Wall.WEST: (gate(-1.5, 4.0, 4.2), door(5.5, 1.1)),
        },
    )
    room.build(a)
    for wall, left, right in (
        (Wall.NORTH, -12.0, 12.5),
        (Wall.SOUTH, -12.5, 12.0),
        (Wall.EAST, -7.5, -5.0),
        (Wall.EAST, 3.5, 7.8),
        (Wall.WEST, 1.2, 4.6),
    ):
        with room.along(a, wall):
            line_up(a, rng, PIECES, left, right, 0.4)
    for y, left, right, turn in ((3.4, -9.0, 9.5, 180), (-2.9, -9.5, 9.0, 0)):
        with a.at(0.0, y, turn=turn):
            line_up(a, rng, PIECES, left, right, 0.9)
    with a.at(6.2, 0.3, turn=100):
        fenced_robot(a, rng)
    with a.at(-8.2, 0.0, turn=-70):
        platform(a, rng)
    with a.at(-3.6, -1.2, turn=-140):
        lift_truck(a, rng)
    for x, y, thing in (
        (2.9, -1.5, furniture.trolley),
        (-2.6, 1.6, storage.pallet),
        (3.4, 1.6, machines.drum),
        (4.1, 1.9, machines.drum),
        (-5.3, 2.1, furniture.trolley),
        (1.3, 2.4, storage.pallet),
        (-1.2, -2.1, furniture.stool),
    ):
        with a.at(x, y, turn=rng.uniform(0, 360)):
            thing(a, rng)
    _structure(a, rng, room, old=old)
    for y in (-1.9, 2.2):
        services.floor_line(a, (-12.0, y), (13.0, y), YELLOW, 0.12)
    return Light(
        camera_m=(0.0, 0.2, 1.6),
        sky=6.0,
        overcast=0.3 if old else 0.7,
        daylight=9.0 if old else 7.0,
        sun=6.0 if old else 0.0,
        sun_bearing_deg=-70.0,
        sun_height_deg=36.0,
        ambient=(0.3, 0.3, 0.3),
        reach_m=4.0,
    )


def _structure(a: Assembly, rng: Rng, room: Room, *, old: bool) -> None:
    steel = vary(rng, pick(rng, (LIGHT_GREY, (0.12, 0.25, 0.2), (0.1, 0.18, 0.3), (0.4, 0.15, 0.1))))
    for x in np.arange(-11.0, 13.0, 4.6):
        for y in (-5.0, 5.2):
            with a.at(float(x), y):
                services.column(a, room.height, steel)
        with a.at(float(x), 0.2, turn=90):
            services.truss(a, 16.0, room.height - 1.2, steel, 1.0)
    for y in (-5.0, 5.2):
        with a.at(0, y):
            services.girder(a, 26.5, 5.6, steel, 0.5)
    with a.at(-2.4, 0.1):
        crane(a, rng, 10.2, 6.0)
    for x, y in lamps.rows((-10.0, 11.0, 6), (-6.5, 6.8, 4)):
        with a.at(x, y):
            lamps.bell(a, room.height - 0.9, lamps.WARM if old else lamps.COOL, 0.32, 0.5)
    for y, z in ((-4.2, 4.4), (4.4, 4.7)):
        with a.at(0, y):
            services.cable_tray(a, rng, 25.0, z, 0.45)
    with a.at(0, 6.3):
        services.duct(a, rng, 25.0, 5.0, 0.38)
    for wall in (Wall.NORTH, Wall.SOUTH):
        with room.along(a, wall):
            services.pipe_run(a, rng, 25.0, 1.75 if old else 3.2, 3 if not old else 1)
    for wall, u, thing in (
        (Wall.EAST, -3.2, services.extinguisher),
        (Wall.EAST, -2.4, services.fuse_board),
        (Wall.WEST, 4.6, services.fuse_board),
        (Wall.WEST, -4.2, services.extinguisher),
        (Wall.EAST, -5.2, services.fuse_board),
    ):
        with room.along(a, wall, u):
            thing(a, rng)
    for wall, u in ((Wall.EAST, 3.8), (Wall.WEST, 1.8), (Wall.WEST, -5.4)):
        with room.along(a, wall, u, z=1.5):
            services.pin_board(a, rng)
    for _ in range(5):
        start = (rng.uniform(-9, 9), rng.uniform(-4, 4), room.height - 1.2)
        end = (start[0] + rng.uniform(-4, 4), start[1] + rng.uniform(-2, 2), rng.uniform(2.4, 5.0))
        a.tube(hanging(start, end, 0.4, 13), 0.02, "rubber", DARK_GREY)
