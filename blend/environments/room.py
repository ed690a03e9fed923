"""A room's shell: floor, ceiling and four walls with windows, doors and gates."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from enum import Enum

import numpy as np

from blend.environments.assembly import Assembly
from blend.environments.palette import (
    ALUMINIUM,
    BLACK,
    DARK_GREY,
    LIGHT_GREY,
    STEEL_FURNITURE,
    WHITE,
    Colour,
    pick,
    vary,
)
from blend.environments.prints import PrintKind, any_of

THICK = 0.22
"""Thickness of the walls, metres, as deep as a window's reveal looks."""


class Wall(Enum):
    """A wall, named by its side of the room; the value is the turn, in degrees, that points its y into the room."""

    EAST = 90
    NORTH = 180
    WEST = 270
    SOUTH = 0


class Hole(Enum):
    """The kinds of openings in a wall."""

    WINDOW = "window"
    DOOR = "door"
    GATE = "gate"


@dataclass(frozen=True, slots=True)
class Opening:
    """An opening in a wall, metres.

    Attributes:
        hole: kind of opening.
        middle: position of the opening's middle along the wall's own x, from the wall's middle.
        width: width of the opening.
        sill: height of its lower edge over the floor.
        height: height from its lower to its upper edge.
    """

    hole: Hole
    middle: float
    width: float
    sill: float
    height: float


@dataclass(frozen=True, slots=True)
class Style:
    """The look of a room's shell.

    Attributes:
        wall: material of the walls.
        upper: tint of the walls above `dado`.
        lower: tint of the walls below `dado`.
        floor: material of the floor.
        dado: height up to which the walls have the lower tint, metres.
        floor_tint: tint of the floor.
        ceiling: material of the ceiling.
        ceiling_tint: tint of the ceiling.
        frames: tint of the window frames.
        panes: number of panes of a window, across and up.
    """

    wall: str
    upper: Colour
    lower: Colour
    floor: str
    dado: float = 0.0
    floor_tint: Colour = (1.0, 1.0, 1.0)
    ceiling: str = "wall"
    ceiling_tint: Colour = WHITE
    frames: Colour = WHITE
    panes: tuple[int, int] = (2, 2)


@dataclass(frozen=True, slots=True)
class Room:
    """A box-shaped room, metres; the camera stands near the origin.

    Attributes:
        west: x of the west wall.
        east: x of the east wall.
        south: y of the south wall.
        north: y of the north wall.
        height: height of the ceiling over the floor at z = 0.
        style: look of the shell.
        openings: windows, doors and gates of each wall.
    """

    west: float
    east: float
    south: float
    north: float
    height: float
    style: Style
    openings: dict[Wall, tuple[Opening, ...]] = field(default_factory=dict)

    def length(self, wall: Wall) -> float:
        """Compute the length of a wall, metres."""
        return self.east - self.west if wall in {Wall.NORTH, Wall.SOUTH} else self.north - self.south

    @contextmanager
    def along(self, a: Assembly, wall: Wall, u: float = 0.0, off: float = 0.0, z: float = 0.0) -> Iterator[Assembly]:
        """Place things at a wall: x runs along the wall and y points into the room.

        Args:
            a: assembly that receives the things.
            wall: the wall.
            u: distance of the origin from the wall's middle, along the wall, metres.
            off: distance of the origin from the wall's face, metres.
            z: height of the origin, metres.
        """
        x, y = 0.5 * (self.west + self.east), 0.5 * (self.south + self.north)
        place = {
            Wall.EAST: (self.east - off, y + u),
            Wall.WEST: (self.west + off, y - u),
            Wall.NORTH: (x - u, self.north - off),
            Wall.SOUTH: (x + u, self.south + off),
        }[wall]
        with a.at(*place, z, turn=wall.value):
            yield a

    def build(self, a: Assembly) -> None:
        """Build floor, ceiling and walls with their windows, doors and gates."""
        width, depth = self.east - self.west, self.north - self.south
        middle = (0.5 * (self.west + self.east), 0.5 * (self.south + self.north))
        a.box((*middle, -0.1), (width + 1, depth + 1, 0.1), self.style.floor, self.style.floor_tint)
        a.box((*middle, self.height), (width + 1, depth + 1, 0.1), self.style.ceiling, self.style.ceiling_tint)
        for wall in Wall:
            with self.along(a, wall):
                _wall(a, self.length(wall), self.height, self.style, self.openings.get(wall, ()))


def _wall(a: Assembly, length: float, height: float, style: Style, openings: Sequence[Opening]) -> None:
    edges = [-0.5 * length - THICK]
    for opening in sorted(openings, key=lambda each: each.middle):
        left, right = opening.middle - 0.5 * opening.width, opening.middle + 0.5 * opening.width
        _panel(a, edges[-1], left, 0.0, height, style)
        _panel(a, left, right, 0.0, opening.sill, style)
        _panel(a, left, right, opening.sill + opening.height, height, style)
        with a.at(opening.middle, 0.0, opening.sill):
            _FILLED[opening.hole](a, opening, style)
        edges.append(right)
    _panel(a, edges[-1], 0.5 * length + THICK, 0.0, height, style)
    if style.wall in {"wall"}:
        _skirting(a, length, openings)


def _panel(a: Assembly, left: float, right: float, low: float, high: float, style: Style) -> None:
    """A part of a wall with its front at y = 0."""
    middle, width = 0.5 * (left + right), right - left
    cut = min(max(style.dado, low), high)
    for bottom, top, tint in ((low, cut, style.lower), (cut, high, style.upper)):
        if top - bottom > 0.001 and width > 0.001:
            a.box((middle, -0.5 * THICK, bottom), (width, THICK, top - bottom), style.wall, tint)


def _skirting(a: Assembly, length: float, openings: Sequence[Opening]) -> None:
    left = -0.5 * length
    for opening in sorted((each for each in openings if each.sill < 0.1), key=lambda each: each.middle):
        right = opening.middle - 0.5 * opening.width
        a.box((0.5 * (left + right), 0.008, 0.0), (right - left, 0.016, 0.09), "plastic", DARK_GREY)
        left = opening.middle + 0.5 * opening.width
    a.box((0.5 * (left + 0.5 * length), 0.008, 0.0), (0.5 * length - left, 0.016, 0.09), "plastic", DARK_GREY)


def _window(a: Assembly, opening: Opening, style: Style) -> None:
    width, height, (across, up) = opening.width, opening.height, style.panes
    back, bar = -0.6 * THICK, 0.05
    for x in np.linspace(-0.5 * width, 0.5 * width, across + 1):
        a.box((float(x), back, 0.0), (bar, 0.06, height), "plastic", style.frames, bevel=0.006)
    for z in np.linspace(0.0, height - bar, up + 1):
        a.box((0.0, back, float(z)), (width, 0.055, bar), "plastic", style.frames, bevel=0.006)
    a.box((0.0, -0.04, -0.03), (width + 0.12, 0.3, 0.03), "plastic", LIGHT_GREY, bevel=0.006)
    with a.at(0.0, -THICK - 0.05):
        a.daylight_through(width, height)


def _door(a: Assembly, opening: Opening, _style: Style) -> None:
    width, height, rng = opening.width, opening.height, a.rng
    leaf = vary(rng, pick(rng, STEEL_FURNITURE))
    for side in (-1, 1):
        a.box((side * 0.5 * width, 0.0, 0.0), (0.09, 0.1, height), "paint", DARK_GREY, bevel=0.006)
    a.box((0.0, 0.0, height - 0.05), (width + 0.09, 0.1, 0.09), "paint", DARK_GREY, bevel=0.006)
    a.box((0.0, -0.05, 0.01), (width - 0.04, 0.05, height - 0.06), "paint", leaf, bevel=0.006)
    a.box((0.0, -0.024, 0.06), (width - 0.1, 0.006, 0.2), "metal", ALUMINIUM)
    a.cylinder((0.4 * width, -0.02, 1.03), 0.012, 0.06, "metal", ALUMINIUM, axis="y")
    a.box((0.4 * width - 0.05, 0.035, 1.02), (0.13, 0.02, 0.022), "metal", ALUMINIUM, bevel=0.005)
    if rng.random() < 0.5:
        a.box((0.0, -0.03, 1.25), (0.3, 0.02, 0.6), "dark glass", (0.05, 0.06, 0.07))
    else:
        a.picture((-0.1, -0.022, 1.5), (0.26, 0.26), any_of(rng, PrintKind.SIGN))


def _gate(a: Assembly, opening: Opening, _style: Style) -> None:
    """A sectional gate with a row of small windows, in steel rails."""
    width, height, rng = opening.width, opening.height, a.rng
    tint, rows = vary(rng, pick(rng, STEEL_FURNITURE)), max(4, round(height / 0.55))
    row = height / rows
    a.box((0.0, -0.16, 0.0), (width, 0.04, height), "paint", DARK_GREY)
    for n in range(rows):
        a.box((0.0, -0.08, n * row + 0.006), (width, 0.05, row - 0.012), "paint", tint, bevel=0.012)
        if n == 2:
            for x in np.arange(-0.5 * width + 0.5, 0.5 * width - 0.3, 0.9):
                a.box((float(x), -0.052, n * row + 0.12), (0.6, 0.012, row - 0.24), "glow", (4.5, 4.9, 5.4))
    for side in (-1, 1):
        a.box((side * (0.5 * width + 0.06), 0.04, 0.0), (0.12, 0.1, height + 0.2), "metal", ALUMINIUM, bevel=0.01)
        for n in range(8):
            tone = BLACK if n % 2 else (0.75, 0.5, 0.02)
            a.box((side * (0.5 * width + 0.19), 0.02, n * 0.15), (0.12, 0.03, 0.15), "paint", tone)
    a.cylinder((-0.5 * width, 0.1, height + 0.15), 0.09, width, "metal", LIGHT_GREY, axis="x")


_FILLED: dict[Hole, Callable[[Assembly, Opening, Style], None]] = {
    Hole.WINDOW: _window,
    Hole.DOOR: _door,
    Hole.GATE: _gate,
}


def windows(count: int, length: float, width: float, sill: float, height: float) -> tuple[Opening, ...]:
    """Make `count` equal windows, spread evenly over the given length of a wall; metres."""
    middles = (np.arange(count) + 0.5) / count * length - 0.5 * length
    return tuple(Opening(Hole.WINDOW, float(middle), width, sill, height) for middle in middles)


def door(middle: float, width: float = 0.95, height: float = 2.1) -> Opening:
    """Make a door; `middle` counts from the wall's middle, metres."""
    return Opening(Hole.DOOR, middle, width, 0.0, height)


def gate(middle: float, width: float = 3.4, height: float = 3.4) -> Opening:
    """Make a gate for vehicles; `middle` counts from the wall's middle, metres."""
    return Opening(Hole.GATE, middle, width, 0.0, height)
