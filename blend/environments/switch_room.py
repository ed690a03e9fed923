"""Rooms full of electrical cabinets, some of them open: breakers, rails, ducts, terminals and wires."""

import numpy as np

from blend.environments import furniture, lamps, services, storage
from blend.environments.assembly import Assembly
from blend.environments.goods import coil, papers, tool_box
from blend.environments.layout import Piece, clutter, line_up
from blend.environments.palette import (
    ALUMINIUM,
    BLACK,
    CABLES,
    COPPER,
    DARK_GREY,
    GREEN,
    GREY,
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
from blend.environments.prints import PrintKind, any_of
from blend.environments.room import Room, Style, Wall, door, windows
from blend.environments.scene import Light
from blend.environments.solids import hanging
from blend.environments.tools import BENCH, meter

Rng = np.random.Generator
CABINETS = palette("c9cac5 b5b8b6 d6d3c6 8d979c a9aca4")
"""Colours of electrical cabinets."""
WIRES = palette("1c3f9a 141414 8a5a30 7a7c7e b02020 2a8a3a d8c020 e8e8e4 d8701c 1c3f9a 141414")
"""Colours of wires in cabinets; blue and black are listed twice, since they are the most common."""


def breakers(a: Assembly, rng: Rng, width: float, z: float) -> None:
    """A rail with circuit breakers and other devices side by side, `width` long, with its lower edge at z."""
    a.box((0, 0.02, z + 0.055), (width, 0.02, 0.035), "metal", STEEL)
    x = -0.5 * width + 0.01
    while x < 0.5 * width - 0.03:
        own = rng.choice([0.018, 0.018, 0.036, 0.054, 0.09])
        body = vary(rng, pick(rng, (WHITE, LIGHT_GREY, WHITE, DARK_GREY, GREY)), 0.06)
        repeats = int(rng.integers(1, 9)) if own < 0.04 else 1
        for _ in range(repeats):
            if x + own > 0.5 * width:
                return
            a.box((x + 0.5 * own, 0.05, z), (own - 0.001, 0.07, 0.09), "plastic", body, bevel=0.002)
            a.box((x + 0.5 * own, 0.09, z + 0.022), (own - 0.003, 0.02, 0.045), "plastic", body, bevel=0.002)
            lever = pick(rng, (BLACK, BLACK, (0.02, 0.1, 0.4), ORANGE, RED, GREEN))
            a.box((x + 0.5 * own, 0.105, z + 0.035), (min(0.012, 0.6 * own), 0.014, 0.02), "plastic", lever)
            if own > 0.05:
                a.picture((x + 0.5 * own, 0.1008, z + 0.022), (own * 0.8, 0.044), any_of(rng, PrintKind.LABEL))
            x += own
        x += rng.uniform(0.0, 0.05)


def terminals(a: Assembly, rng: Rng, width: float, z: float) -> None:
    """A rail of terminals, each with a wire."""
    a.box((0, 0.02, z + 0.02), (width, 0.02, 0.035), "metal", STEEL)
    for x in np.arange(-0.5 * width + 0.02, 0.5 * width - 0.02, 0.0085):
        tint = pick(rng, (GREY, GREY, LIGHT_GREY, (0.02, 0.1, 0.5), (0.3, 0.5, 0.05), ORANGE))
        a.box((float(x), 0.05, z), (0.0075, 0.05, 0.055), "plastic", tint)
        if rng.random() < 0.75:
            wire = pick(rng, WIRES)
            end = (float(x) + rng.normal(0, 0.01), 0.05, z - 0.07)
            a.tube([(float(x), 0.075, z + 0.01), (float(x), 0.09, z - 0.02), end], 0.0022, "plastic", wire)


def wire_duct(a: Assembly, place: tuple[float, float, float], size: tuple[float, float]) -> None:
    """A slotted wire duct; `size` is its extent along x and z."""
    x, y, z = place
    a.box((x, y + 0.03, z), (size[0], 0.06, size[1]), "plastic", (0.34, 0.36, 0.36))
    a.box((x, y + 0.063, z), (size[0], 0.006, size[1]), "plastic", (0.42, 0.44, 0.44))
    along = 0 if size[0] > size[1] else 1
    for place_along in np.arange(-0.5, 0.5, 0.02 / max(size)):
        offset = float(place_along) * max(size)
        for side in (-0.5, 0.5):
            if along == 0:
                a.box(
                    (x + offset, y + 0.03, z + (0.5 + side) * size[1] - 0.002), (0.008, 0.055, 0.004), "rubber", BLACK
                )
            else:
                spot = (x + side * size[0], y + 0.03, z + 0.5 * size[1] + offset)
                a.box(spot, (0.004, 0.055, 0.008), "rubber", BLACK)


def looms(a: Assembly, rng: Rng, width: float, low: float, high: float, count: int) -> None:
    """`count` loose wires between the heights `low` and `high`."""
    for _ in range(count):
        x = rng.uniform(-0.48, 0.48) * width
        other = x + rng.normal(0, 0.08)
        start, end = (x, rng.uniform(0.06, 0.11), high), (other, rng.uniform(0.06, 0.13), low)
        bulge = (0.5 * (x + other) + rng.normal(0, 0.03), rng.uniform(0.11, 0.16), 0.5 * (low + high))
        share = np.linspace(0, 1, 9)[:, None]
        points = (
            np.array(start) * (1 - share) ** 2 + 2 * np.array(bulge) * share * (1 - share) + np.array(end) * share**2
        )
        a.tube(points, rng.choice([0.002, 0.003, 0.005]), "plastic", pick(rng, WIRES))


def mounting_plate(a: Assembly, rng: Rng, width: float, low: float, high: float) -> None:
    """A plate with rails of devices, wire ducts between them, drives, and many loose wires."""
    a.box((0, 0.005, low), (width, 0.01, high - low), "metal" if rng.random() < 0.5 else "paint", (0.62, 0.62, 0.58))
    for side in (-0.5, 0.5):
        wire_duct(a, (side * (width - 0.06), 0.01, low), (0.05, high - low))
    z, inner = high - 0.08, width - 0.14
    while z > low + 0.22:
        wire_duct(a, (0, 0.01, z), (inner, 0.045))
        z -= 0.045
        style = rng.random()
        if style < 0.5:
            breakers(a, rng, inner, z - 0.1)
            looms(a, rng, inner, z - 0.02, z + 0.05, 14)
            z -= 0.16
        elif style < 0.68:
            terminals(a, rng, inner, z - 0.1)
            z -= 0.17
        elif style < 0.88 and z > low + 0.4:
            for x in np.arange(-0.5 * inner + 0.07, 0.5 * inner - 0.05, 0.135):
                drive = vary(rng, pick(rng, (DARK_GREY, LIGHT_GREY, (0.02, 0.12, 0.3), GREY)))
                a.box((float(x), 0.09, z - 0.28), (0.115, 0.16, 0.25), "plastic", drive, bevel=0.006)
                a.picture((float(x), 0.1705, z - 0.15), (0.09, 0.1), any_of(rng, PrintKind.PANEL))
                a.box((float(x), 0.1705, z - 0.26), (0.09, 0.003, 0.06), "plastic", BLACK)
            looms(a, rng, inner, z - 0.33, z - 0.25, 12)
            z -= 0.36
        else:
            for x in (-0.25, 0.25):
                a.box(
                    (x * inner, 0.06, z - 0.17),
                    (0.36 * inner, 0.1, 0.13),
                    "plastic",
                    pick(rng, (DARK_GREY, BLACK, GREY)),
                    bevel=0.005,
                )
                for n in range(8):
                    a.box(
                        (x * inner - 0.14 * inner + n * 0.035 * inner, 0.112, z - 0.06),
                        (0.012, 0.003, 0.008),
                        "glow",
                        pick(rng, ((0.2, 4.0, 0.4), (4.0, 0.8, 0.1), (0.2, 2.0, 0.3))),
                    )
            looms(a, rng, inner, z - 0.2, z - 0.14, 10)
            z -= 0.23
    wire_duct(a, (0, 0.01, low + 0.02), (inner, 0.06))
    looms(a, rng, inner, low - 0.25, low + 0.2, 34)


def open_cabinet(a: Assembly, rng: Rng) -> None:
    """A cabinet whose door is off or swung open."""
    width, deep, high, tint = 1.0, 0.5, 2.0, vary(rng, pick(rng, CABINETS), 0.05)
    a.box((0, 0.02, 0.1), (width, 0.03, high - 0.1), "paint", tint)
    for side in (-0.5, 0.5):
        a.box((side * (width - 0.02), 0.5 * deep, 0.1), (0.02, deep, high - 0.1), "paint", tint, bevel=0.004)
        a.box((side * (width - 0.05), deep - 0.02, 0.1), (0.045, 0.04, high - 0.1), "paint", tint, bevel=0.004)
    for z in (0.1, high - 0.03):
        a.box((0, 0.5 * deep, z), (width, deep, 0.03), "paint", tint)
    a.box((0, 0.5 * deep, 0.0), (width, deep, 0.1), "paint", DARK_GREY)
    with a.at(0, 0.12):
        mounting_plate(a, rng, width - 0.12, 0.38, high - 0.12)
    a.box((0, 0.3, high - 0.06), (0.5, 0.04, 0.025), "glow", (16.0, 17.0, 18.0))
    if rng.random() < 0.7:
        side = 1.0 if rng.random() < 0.5 else -1.0
        with a.at(side * 0.5 * width, deep, turn=side * rng.uniform(75, 112)):
            a.box((-side * 0.5 * width, 0.0, 0.1), (width, 0.025, high - 0.1), "paint", tint, bevel=0.004)
            a.picture((-side * 0.5 * width, 0.014, 0.9), (0.4, 0.55), any_of(rng, PrintKind.DRAWING))
            a.box((-side * 0.5 * width, 0.03, 0.5), (0.45, 0.04, 0.3), "plastic", LIGHT_GREY, bevel=0.005)


def closed_cabinet(a: Assembly, rng: Rng) -> None:
    """A cabinet with meters, lamps, switches and signs on its door."""
    width, deep, high, tint = 0.8, 0.5, 2.0, vary(rng, pick(rng, CABINETS), 0.05)
    a.box((0, 0.5 * deep, 0.0), (width, deep - 0.02, 0.1), "paint", DARK_GREY)
    a.box((0, 0.5 * deep, 0.1), (width, deep, high - 0.1), "paint", tint, bevel=0.006)
    a.box((0, deep + 0.01, 0.12), (width - 0.02, 0.02, high - 0.14), "paint", vary(rng, tint, 0.03), bevel=0.006)
    front = deep + 0.021
    a.box((0.42 * width, front, 1.0), (0.03, 0.03, 0.16), "plastic", BLACK, bevel=0.006)
    for n in range(int(rng.integers(2, 4))):
        x = -0.22 + 0.22 * n
        a.box((x, front, 1.62), (0.15, 0.03, 0.15), "plastic", BLACK, bevel=0.004)
        a.picture((x, front + 0.016, 1.63), (0.13, 0.13), any_of(rng, PrintKind.DIAL))
    for row in range(2):
        for n in range(5):
            tone = pick(rng, ((0.05, 1.6, 0.15), (1.8, 0.1, 0.06), (1.6, 1.0, 0.05), (0.1, 0.1, 0.1), (0.1, 0.1, 0.1)))
            place = (-0.24 + 0.12 * n, front - 0.005, 1.46 - 0.12 * row)
            a.cylinder(place, 0.022, 0.02, "metal", STEEL, axis="y", sides=12)
            a.cylinder(place, 0.016, 0.032, "glow" if tone[0] + tone[1] > 1 else "plastic", tone, axis="y", sides=12)
            a.picture((place[0], front, place[2] - 0.055), (0.06, 0.018), any_of(rng, PrintKind.LABEL))
    a.cylinder((0.0, front - 0.005, 1.12), 0.06, 0.03, "plastic", YELLOW, axis="y", sides=18)
    a.box((0.0, front + 0.04, 1.07), (0.03, 0.04, 0.1), "plastic", RED, bevel=0.006)
    a.picture((-0.1, front, 0.75), (0.18, 0.18), any_of(rng, PrintKind.SIGN))
    for n in range(7):
        a.box((0, front, 0.25 + 0.03 * n), (0.36, 0.004, 0.012), "rubber", BLACK)
    a.picture((0.0, front, 1.83), (0.5, 0.06), any_of(rng, PrintKind.LABEL))


def transformer(a: Assembly, rng: Rng) -> None:
    """A dry-type transformer with copper bars, behind a guard rail."""
    for x in (-0.45, 0.0, 0.45):
        a.cylinder((x, 0.4, 0.25), 0.2, 0.85, "paint", pick(rng, ((0.35, 0.08, 0.04), (0.1, 0.14, 0.3))), sides=20)
        a.cylinder((x, 0.4, 0.2), 0.1, 1.0, "metal", DARK_GREY)
        a.box((x, 0.55, 1.2), (0.06, 0.02, 0.5), "metal", COPPER)
    for z in (0.08, 1.18):
        a.box((0, 0.4, z), (1.4, 0.22, 0.16), "paint", DARK_GREY, bevel=0.01)
    for z in (0.6, 1.05):
        a.box((0, 0.85, z), (1.7, 0.04, 0.06), "paint", YELLOW)
    for x in (-0.85, 0.85):
        a.box((x, 0.85, 0), (0.06, 0.06, 1.1), "paint", YELLOW)
    a.picture((0.3, 0.872, 0.72), (0.3, 0.3), any_of(rng, PrintKind.SIGN))


CLOSED = Piece(closed_cabinet, 0.81, 0.5)
"""A closed cabinet, to be lined up."""
OPEN = Piece(open_cabinet, 1.01, 0.5)
"""An open cabinet, to be lined up."""


def build(a: Assembly, rng: Rng, variant: int) -> Light:
    """Build a switch room: a narrow one with the camera close to open cabinets, or a larger one with rows of them."""
    close = variant % 2 == 0
    style = Style(
        wall="wall" if close else "blocks",
        upper=(0.7, 0.7, 0.66),
        lower=(0.45, 0.52, 0.55),
        dado=1.4,
        floor="surface:rubber_studs" if close else "surface:linoleum",
        floor_tint=(0.8, 0.8, 0.85) if close else (0.6, 0.75, 0.7),
        ceiling="wall",
        ceiling_tint=(0.62, 0.62, 0.6),
    )
    room = Room(
        west=-2.1 if close else -4.4,
        east=2.0 if close else 5.0,
        south=-1.7 if close else -2.7,
        north=1.7 if close else 2.8,
        height=3.0 if close else 3.3,
        style=style,
        openings={
            Wall.WEST: (door(0.3 if close else 1.2, 1.1),),
            Wall.EAST: () if close else windows(1, 2.0, 1.4, 1.4, 1.1),
        },
    )
    room.build(a)
    for wall in (Wall.NORTH, Wall.SOUTH):
        with room.along(a, wall):
            half = 0.5 * room.length(wall)
            shown = (OPEN, OPEN, OPEN, CLOSED) if close else (CLOSED, OPEN)
            line_up(a, rng, shown, -half + 0.3, half - 0.2, 0.006)
    with room.along(a, Wall.EAST):
        half = 0.5 * room.length(Wall.EAST) - 0.6
        line_up(a, rng, (OPEN, CLOSED) if close else (CLOSED, Piece(transformer, 1.8)), -half, half, 0.02)
    with room.along(a, Wall.WEST):
        half = 0.5 * room.length(Wall.WEST)
        if not close:
            line_up(a, rng, (Piece(storage.steel_shelf, 1.25), Piece(services.fuse_board, 0.9)), -half + 0.5, 0.4)
            with a.at(-1.0, 0.0, 1.6):
                services.pin_board(a, rng)
    _loose(a, rng, room, close=close)
    for y in (-0.9, 0.9) if close else (-1.6, 0.0, 1.7):
        with a.at(0.0 if close else 0.3, y):
            services.cable_tray(a, rng, room.east - room.west - 0.3, room.height - 0.6, 0.4)
    for x in (-0.8, 0.9) if close else (-2.8, 0.2, 3.2):
        with a.at(x, 0.0, turn=90):
            lamps.tube(a, room.height, lamps.COOL, 1.5, 0.12)
    for _ in range(14):
        x, side = rng.uniform(room.west + 0.4, room.east - 0.4), 1.0 if rng.random() < 0.5 else -1.0
        y = (room.north if side > 0 else -room.south) - 0.3
        start, end = (x, side * y, 2.0), (x + rng.normal(0, 0.2), side * (y - 0.5), room.height - 0.55)
        a.tube(hanging(start, end, 0.1), rng.uniform(0.008, 0.02), "rubber", pick(rng, CABLES))
    return Light(
        camera_m=(0.0, 0.0, 1.4),
        sky=5.0,
        overcast=0.5,
        daylight=6.0,
        ambient=(0.16, 0.16, 0.17),
        reach_m=1.2,
    )


def _loose(a: Assembly, rng: Rng, room: Room, *, close: bool) -> None:
    """Add tools, coils and papers that lie about, and the things that hang on the free wall."""
    if close:
        with a.at(-1.5, -0.7, turn=60):
            furniture.trolley(a, rng)
        spots: tuple[tuple[float, float], ...] = ((0.9, 0.45), (-0.9, 0.75), (0.7, -0.7))
    else:
        with a.at(2.2, 0.35, turn=100):
            furniture.trolley(a, rng)
        with a.at(-2.0, -0.3, turn=80):
            a.box((0, 0.35, 0.72), (1.4, 0.7, 0.04), "wood", (0.5, 0.36, 0.22), bevel=0.006)
            furniture.legs(a, (1.4, 0.7, 0.72), "metal", ALUMINIUM)
            clutter(a, rng, (*BENCH, Piece(papers, 0.26, 0.34)), (1.35, 0.65), 0.76, density=0.9)
        spots = ((-1.4, 1.3), (1.1, -1.3), (3.4, 1.1), (0.4, 1.5))
    for x, y in spots:
        with a.at(x, y, turn=rng.uniform(0, 360)):
            pick(rng, (coil, tool_box, meter, furniture.stool))(a, rng)
    for u, z, thing in ((-0.8, 1.5, services.poster), (1.3, 1.6, services.sign)):
        with room.along(a, Wall.WEST, u, z=z):
            thing(a, rng)
    with room.along(a, Wall.WEST, -0.45 if close else 0.35):
        services.extinguisher(a, rng)
