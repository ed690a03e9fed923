"""Builds the meshes of washers, nuts, screws, connectors and cable ties. Pure numpy.

A part lies on z = 0 about the origin, its length along x. Its size is its greatest extent; washers and nuts take the
nearest standard size, and screws a standard thread that suits their length.
"""

from collections.abc import Callable, Mapping
from functools import lru_cache

import numpy as np

from farm.scene.clutter import Part, PartKind
from worker.clutter.solid import (
    SIDES,
    Array,
    Finish,
    Section,
    Solid,
    box,
    joined,
    section,
    strap,
    turned_on_lathe,
)

WASHERS_MM = ((3.2, 7.0, 0.5), (4.3, 9.0, 0.8), (5.3, 10.0, 1.0), (6.4, 12.0, 1.6), (8.4, 16.0, 1.6))
"""Diameters of the hole and the outside, and thickness, of washers M3, M4, M5, M6 and M8, in millimetres (ISO 7089)."""

NUTS_MM = ((3.0, 5.5, 2.4), (4.0, 7.0, 3.2), (5.0, 8.0, 4.7), (6.0, 10.0, 5.2), (8.0, 13.0, 6.8))
"""Diameter of the thread, width across flats and height of nuts, in millimetres (ISO 4032)."""

SCREWS_MM = (
    (3.0, 5.5, 3.0, 2.5, 0.5),
    (4.0, 7.0, 4.0, 3.0, 0.7),
    (5.0, 8.5, 5.0, 4.0, 0.8),
    (6.0, 10.0, 6.0, 5.0, 1.0),
)
"""Diameter of the thread, diameter and height of the head, width across the socket's flats, and pitch of socket head
screws, in millimetres (ISO 4762)."""

CONNECTOR_PITCH_M = 2.54e-3
"""Distance between two contacts of a connector, in metres: a tenth of an inch, the commonest pitch."""

ZINC = Finish(colour=(196, 198, 202), roughness=0.3, metallic=1.0, mottle=0.2, grain_m=0.0015)
YELLOW_ZINC = Finish(colour=(202, 180, 120), roughness=0.32, metallic=1.0, mottle=0.35, grain_m=0.002)
BLACK_OXIDE = Finish(colour=(52, 52, 54), roughness=0.4, metallic=0.9, mottle=0.3, grain_m=0.001)
BRASS = Finish(colour=(214, 178, 102), roughness=0.28, metallic=1.0, mottle=0.2)
TIN = Finish(colour=(206, 206, 204), roughness=0.25, metallic=1.0, mottle=0.1)
GOLD = Finish(colour=(226, 188, 104), roughness=0.22, metallic=1.0, mottle=0.1)


def part_solid(part: Part) -> tuple[Solid, tuple[Finish, ...]]:
    """Build a part about the origin, on the floor, without its rotation.

    Returns:
        The mesh, and the finishes that its faces number.
    """
    return _made(part.kind, part.size_m, part.colour, part.pattern_seed)


def part_extent(part: Part) -> tuple[float, float]:
    """Measure the radius of the circle about a part's middle that holds it, and its height, both in metres."""
    vertices = part_solid(part)[0].vertices_m
    return float(np.hypot(vertices[:, 0], vertices[:, 1]).max()), float(vertices[:, 2].max())


@lru_cache(maxsize=64)
def _made(kind: PartKind, size_m: float, colour: tuple[int, int, int], seed: int) -> tuple[Solid, tuple[Finish, ...]]:
    solid, finishes = _MAKERS[kind](size_m, colour, np.random.default_rng(seed))
    low, high = solid.vertices_m.min(axis=0), solid.vertices_m.max(axis=0)
    return solid.moved((-(low[0] + high[0]) / 2, -(low[1] + high[1]) / 2, -low[2])), finishes


def _metal(rng: np.random.Generator) -> Finish:
    return (ZINC, ZINC, YELLOW_ZINC, BLACK_OXIDE, BRASS)[int(rng.integers(5))]


def _upright(solid: Solid) -> Solid:
    """Stand a solid up: its x axis becomes z."""
    return solid.turned(np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]]))


def _washer(size_m: float, _: tuple[int, int, int], rng: np.random.Generator) -> tuple[Solid, tuple[Finish, ...]]:
    hole, outside, thick = (1e-3 * each for each in min(WASHERS_MM, key=lambda row: abs(row[1] - 1e3 * size_m)))
    inner, outer, edge = hole / 2, outside / 2, 0.08e-3
    profile = [
        [(edge, inner), (0.0, inner + edge)],
        [(0.0, inner + edge), (0.0, outer - edge)],
        [(0.0, outer - edge), (edge, outer)],
        [(edge, outer), (thick - edge, outer)],
        [(thick - edge, outer), (thick, outer - edge)],
        [(thick, outer - edge), (thick, inner + edge)],
        [(thick, inner + edge), (thick - edge, inner)],
        [(thick - edge, inner), (edge, inner)],
    ]
    return _upright(turned_on_lathe([section(each, 0) for each in profile], SIDES)), (_metal(rng),)


def _nut(size_m: float, _: tuple[int, int, int], rng: np.random.Generator) -> tuple[Solid, tuple[Finish, ...]]:
    """Build a hexagon with a threaded hole, its corners cut by a cone of 30 degrees above and below."""
    wanted = 1e3 * size_m * np.cos(np.pi / 6)
    thread, flats, height = (1e-3 * each for each in min(NUTS_MM, key=lambda row: abs(row[1] - wanted)))
    angle = 2 * np.pi * np.arange(SIDES) / SIDES
    toward = (angle + np.pi / 6) % (np.pi / 3) - np.pi / 6
    wall = flats / 2 / np.cos(toward)
    ring = np.full(SIDES, 0.95 * flats / 2)
    cut = (wall - 0.95 * flats / 2) * np.tan(np.radians(30))
    hole = np.full(SIDES, thread / 2)
    turns = max(3, round(height / (0.16 * thread)))
    along = np.linspace(height - 0.1 * thread, 0.1 * thread, 4 * turns + 1)
    depth = np.tile([0.0, -0.035, -0.07, -0.035], turns + 1)[: len(along)] * thread
    low, high = np.zeros(SIDES), np.full(SIDES, height)
    sections = [
        Section(np.stack([low, low]), np.stack([1.12 * hole, ring]), 0),
        Section(np.stack([low, cut]), np.stack([ring, wall]), 0),
        Section(np.stack([cut, high - cut]), np.stack([wall, wall]), 0),
        Section(np.stack([high - cut, high]), np.stack([wall, ring]), 0),
        Section(np.stack([high, high]), np.stack([ring, 1.12 * hole]), 0),
        Section(np.stack([high, high - 0.1 * thread]), np.stack([1.12 * hole, hole]), 0),
        Section(along, thread / 2 + depth, 0),
        Section(np.stack([low + 0.1 * thread, low]), np.stack([hole, 1.12 * hole]), 0),
    ]
    solid = turned_on_lathe(sections, SIDES)
    # The six walls are flat, though their vertices are those of a lathe.
    walls = slice(2 * SIDES, 3 * SIDES)
    solid.smooth[walls] = False
    return _upright(solid), (_metal(rng),)


def _screw(size_m: float, _: tuple[int, int, int], rng: np.random.Generator) -> tuple[Solid, tuple[Finish, ...]]:
    """Build a socket head screw on its side: it rests on the rim of its head and the end of its thread."""
    fitting = [row for row in SCREWS_MM if row[2] + 1.5 * row[0] <= 1e3 * size_m] or [SCREWS_MM[0]]
    thread, wide, head, socket, pitch = (1e-3 * each for each in fitting[int(rng.integers(len(fitting)))])
    length = max(size_m, head + 1.5 * thread)
    r, rim, edge, hole = thread / 2, wide / 2, 0.06 * wide, socket / 2 / np.cos(np.pi / 6)
    turns = int((length - head - 0.5 * thread) / pitch)
    start = length - 0.3 * r - turns * pitch
    along = np.linspace(start, length - 0.3 * r, 4 * turns + 1)
    depth = np.tile([0.0, -0.5, -1.0, -0.5], turns + 1)[: len(along)] * 0.5 * pitch
    sections = [
        section([(0.5 * head, 0.0), (0.5 * head, hole)], 1),
        section([(0.5 * head, hole), (0.0, hole)], 1),
        section([(0.0, hole), (0.0, rim - edge)], 0),
        section([(0.0, rim - edge), (0.3 * edge, rim - 0.3 * edge), (edge, rim)], 0),
        section([(edge, rim), (head, rim)], 0),
        section([(head, rim), (head, r)], 0),
        section([(head, r), (start, r)], 0),
        Section(along, r + depth, 0),
        section([(along[-1], r), (length, 0.75 * r)], 0),
        section([(length, 0.75 * r), (length, 0.0)], 0),
    ]
    solid = turned_on_lathe(sections, SIDES)
    tilt = np.arctan2(rim - r, length - 0.3 * r - head)
    cosine, sine = np.cos(tilt), np.sin(tilt)
    metal = _metal(rng)
    dark = Finish(colour=(30, 30, 32), roughness=0.6, metallic=metal.metallic)
    return solid.turned(np.array([[cosine, 0, sine], [0, 1, 0], [-sine, 0, cosine]])), (metal, dark)


def _connector(
    size_m: float, colour: tuple[int, int, int], rng: np.random.Generator
) -> tuple[Solid, tuple[Finish, ...]]:
    """Build a housing of one or two rows with a window over each contact, or a pin header."""
    rows = int(rng.integers(1, 3))
    pitch = CONNECTOR_PITCH_M
    pins = int(np.clip(round(size_m / pitch), 2, 16))
    wide, tall = pins * pitch, rows * pitch
    plastic = Finish(colour=colour, roughness=0.45, mottle=0.04, grain_m=0.003)
    contact = GOLD if rng.random() < 0.5 else TIN
    dark = Finish(colour=(14, 14, 15), roughness=0.8)
    places = (np.arange(pins) - (pins - 1) / 2) * pitch
    if rng.random() < 0.5:
        return _header(places, rows, wide), (plastic, contact, dark)
    deep = min(14e-3, max(6e-3, 0.9 * wide))
    solids = [box((-wide / 2, -deep / 2, 0.0), (wide / 2, deep / 2, tall), 0.25e-3, 0)]
    lip = 0.12e-3
    for x in places:
        # A window is a dark floor in a frame that stands out a little, with the spring of the contact inside.
        y0, y1 = -0.1 * deep, 0.22 * deep
        solids.append(box((x - 0.62e-3, y0, tall - 0.2e-3), (x + 0.62e-3, y1, tall + 0.02e-3), 0.01e-3, 2))
        solids.append(box((x - 0.3e-3, y0 + 0.3e-3, tall), (x + 0.3e-3, y1 - 0.5e-3, tall + 0.1e-3), 0.04e-3, 1))
        for side in (-1, 1):
            edge = x + side * 0.75e-3
            solids.append(box((edge - lip, y0, tall - lip), (edge + lip, y1, tall + lip), 0.05e-3, 0))
        for row in range(rows):
            z = (row + 0.5) * pitch
            front = -deep / 2
            solids.append(box((x - 0.5e-3, front - 0.02e-3, z - 0.5e-3), (x + 0.5e-3, front, z + 0.5e-3), 0.005e-3, 2))
    keyed = rng.random() < 0.5
    if keyed:
        solids.append(box((-0.2 * wide, deep / 2 - 3e-3, tall), (0.2 * wide, deep / 2, tall + 0.8e-3), 0.2e-3, 0))
    return joined(solids), (plastic, contact, dark)


def _header(places_m: Array, rows: int, wide_m: float) -> Solid:
    """Build a pin header on its side: a bar of plastic, notched between the pins, which stick out on both sides."""
    pitch, pin = CONNECTOR_PITCH_M, 0.32e-3
    tall = rows * pitch
    solids = []
    for x in places_m:
        solids.append(box((x - pitch / 2, -pitch / 2, 0.0), (x + pitch / 2, pitch / 2, tall), 0.4e-3, 0))
        for row in range(rows):
            z = (row + 0.5) * pitch
            solids.append(box((x - pin, -pitch / 2 - 3e-3, z - pin), (x + pin, pitch / 2 + 6e-3, z + pin), 0.12e-3, 1))
    core = 0.45 * pitch
    solids.append(box((-wide_m / 2 + 0.1e-3, -core, 0.1e-3), (wide_m / 2 - 0.1e-3, core, tall - 0.1e-3), 0.1e-3, 0))
    return joined(solids)


def _cable_tie(
    size_m: float, colour: tuple[int, int, int], rng: np.random.Generator
) -> tuple[Solid, tuple[Finish, ...]]:
    """Build a cable tie on edge: closed to a loop and cut off, or open and curved."""
    wide, thick = float(rng.uniform(2.5e-3, 4.5e-3)), 1.1e-3
    plastic = Finish(colour=colour, roughness=0.35, mottle=0.03)
    if rng.random() < 0.5:
        radius = max(size_m / 2 - 3.5e-3, 3e-3)
        angle = np.linspace(-0.5 * np.pi + 0.02, 1.5 * np.pi - 0.02, 96)
        out = radius * (1 + 0.07 * np.cos(2 * angle + float(rng.uniform(0, 2 * np.pi))))
        curve = np.stack([out * np.cos(angle), out * np.sin(angle), np.full_like(angle, wide / 2)], axis=1)
        tail = float(rng.uniform(1e-3, 4e-3))
    else:
        arc = max(size_m - 4e-3, 6e-3) * 1.05
        turn = float(rng.uniform(0.4, 2.4))
        bearing = turn * np.linspace(-0.5, 0.5, 96) * (1 + 0.3 * np.sin(np.linspace(0, 4, 96)))
        level = np.cumsum(np.stack([np.cos(bearing), np.sin(bearing)], axis=1), axis=0) * arc / 96
        curve = np.column_stack([level, np.full(96, wide / 2)])
        tail = 0.0
    solids = [strap(curve, wide, thick, 0)]
    start, along = curve[0], curve[1] - curve[0]
    solids.append(_tie_head(start, along, wide, thick, tail))
    return joined(solids), (plastic, Finish(colour=(20, 20, 20), roughness=0.8))


def _tie_head(start: Array, along: Array, wide_m: float, thick_m: float, tail_m: float) -> Solid:
    """Build the block at a tie's beginning, with the slot for its tail, and the stub of the tail if it was cut off."""
    half = 0.72 * wide_m
    high = wide_m * 1.35
    block = box((-2 * half, -half + 0.3e-3, 0.0), (0.2e-3, half + 0.3e-3, high), 0.35e-3, 0)
    slot = box((-1.45 * half, -half, 0.25 * high), (-0.55 * half, -half + 0.32e-3, 0.75 * high), 0.01e-3, 1)
    solids = [block, slot]
    if tail_m:
        out = half + 0.3e-3
        middle = -half
        solids.append(
            box((middle - thick_m / 2, out, 0.15 * high), (middle + thick_m / 2, out + tail_m, 0.85 * high), 0.2e-3, 0)
        )
    x, y = along[:2] / np.hypot(along[0], along[1])
    turn = np.array([[x, -y, 0.0], [y, x, 0.0], [0.0, 0.0, 1.0]])
    return joined(solids).turned(turn).moved((start[0], start[1], 0.0))


_MAKERS: Mapping[
    PartKind, Callable[[float, tuple[int, int, int], np.random.Generator], tuple[Solid, tuple[Finish, ...]]]
] = {
    PartKind.WASHER: _washer,
    PartKind.NUT: _nut,
    PartKind.SCREW: _screw,
    PartKind.CONNECTOR: _connector,
    PartKind.CABLE_TIE: _cable_tie,
}
