"""The layout of a circuit board: footprints placed at random, and traces routed between them on a lattice."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import StrEnum

import numpy as np
import numpy.typing as npt

CELL_MM = 0.6
"""Pitch of the lattice on which pins, traces and vias lie, millimetres."""
VIA_MM = 0.75
"""Diameter of a via's copper, millimetres: wider than one cell, narrower than two."""
OCTANTS = ((1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1))
"""The eight directions of a trace, each 45 degrees after the one before."""


class BodyKind(StrEnum):
    """The kind of component on a footprint."""

    CHIP = "chip"
    RESISTOR = "resistor"
    CAPACITOR = "capacitor"
    HEADER = "header"


LETTERS = {BodyKind.CHIP: "U", BodyKind.RESISTOR: "R", BodyKind.CAPACITOR: "C", BodyKind.HEADER: "J"}
"""Letter with which the names of components of each kind begin, as on real boards."""


@dataclass(frozen=True)
class Pad:
    """An area of bare metal: position of the middle, size, and the drill's diameter or 0, in millimetres."""

    x: float
    y: float
    width: float
    height: float
    drill: float = 0.0


@dataclass(frozen=True)
class Trace:
    """A copper line through `path`, corners in millimetres of shape (n, 2), `width` wide."""

    path: npt.NDArray[np.float64]
    width: float


@dataclass(frozen=True)
class Body:
    """A component's body: middle and size in millimetres, and its name on the board."""

    kind: BodyKind
    x: float
    y: float
    width: float
    height: float
    name: str


@dataclass
class CircuitBoard:
    """All that lies on a board; positions in millimetres, which wrap round the tile."""

    pads: list[Pad] = field(default_factory=list)
    vias: list[tuple[float, float]] = field(default_factory=list)
    traces: list[Trace] = field(default_factory=list)
    bodies: list[Body] = field(default_factory=list)


@dataclass(frozen=True)
class _Row:
    """Pins side by side.

    Attributes:
        pins: Lattice cell of each pin, column and line, counted from the footprint's middle.
        octant: Index into `OCTANTS` of the direction in which the pins point.
        length: Length of a pad along that direction, millimetres.
        breadth: Width of a pad across it, millimetres.
        drill: Diameter of the hole, millimetres; 0 for a pad without a hole.
    """

    pins: tuple[tuple[int, int], ...]
    octant: int
    length: float
    breadth: float
    drill: float = 0.0


@dataclass(frozen=True)
class _Footprint:
    """Room that a component takes on the board.

    Attributes:
        kind: Kind of component.
        half: Half the extent in lattice cells, columns and lines.
        rows: Rows of pins.
        body: Width and height of the component's body, millimetres.
    """

    kind: BodyKind
    half: tuple[int, int]
    rows: tuple[_Row, ...]
    body: tuple[float, float]


def lay_out(rng: np.random.Generator, size_mm: float) -> CircuitBoard:
    """Place components on a square board whose edges meet, and route traces from their pins.

    Args:
        rng: Source of the randomness.
        size_mm: Edge of the tile, a whole number of cells (`CELL_MM`); otherwise traces break at its edges.

    Returns:
        The board.
    """
    lattice = _Lattice(round(size_mm / CELL_MM))
    board = CircuitBoard()
    placed: list[tuple[_Footprint, int, int]] = []
    turns = (0, 1)
    wanted = [_square_chip(12)] * 4 + [_square_chip(8)] * 5
    wanted += [_long_chip(pins, turn) for pins in (4, 7, 8) for turn in turns] * 4
    wanted += [_header(lines, pins, turn) for lines in (1, 2) for pins in (5, 10) for turn in turns] * 2
    wanted += [_passive(kind, turn) for kind in (BodyKind.RESISTOR, BodyKind.CAPACITOR) for turn in turns] * 75
    for number, footprint in enumerate(wanted):
        place = lattice.find_room(rng, footprint.half)
        if place is None:
            continue
        placed.append((footprint, *place))
        x, y = (place[0] + 0.5) * CELL_MM, (place[1] + 0.5) * CELL_MM
        board.bodies.append(Body(footprint.kind, x, y, *footprint.body, f"{LETTERS[footprint.kind]}{number + 1}"))
    for footprint, column, line in placed:
        for row in footprint.rows:
            _fan_out(rng, lattice, board, row, column, line)
    for _ in range(70):
        _bus(rng, lattice, board)
    return board


class _Lattice:
    """The cells of the board and whether each is taken; opposite edges meet."""

    def __init__(self, cells: int) -> None:
        self.cells = cells
        self.taken = np.zeros((cells, cells), np.bool_)

    def find_room(self, rng: np.random.Generator, half: tuple[int, int]) -> tuple[int, int] | None:
        """Take a free rectangle with a margin of three cells for traces.

        Args:
            rng: Source of the randomness.
            half: Half the extent of the rectangle in cells, columns and lines.

        Returns:
            Column and line of the rectangle's middle; None if 80 random places are all taken.
        """
        for _ in range(80):
            column, line = (int(i) for i in rng.integers(self.cells, size=2))
            if not self.taken[self._block(column, line, half[0] + 3, half[1] + 3)].any():
                self.taken[self._block(column, line, *half)] = True
                return column, line
        return None

    def walk(self, column: int, line: int, legs: Sequence[tuple[int, int]]) -> list[tuple[int, int]]:
        """Lead a trace along legs (octant, steps) until it is done or something is in its way.

        Returns:
            The corners in cells, not wrapped; the start alone if already the first step is blocked.
        """
        corners = [(column, line)]
        self.taken[line % self.cells, column % self.cells] = True
        for octant, steps in legs:
            across, down = OCTANTS[octant % 8]
            for _ in range(steps):
                if not self._passable(column, line, across, down):
                    return [*corners, (column, line)] if (column, line) != corners[-1] else corners
                column, line = column + across, line + down
                self.taken[line % self.cells, column % self.cells] = True
            if (column, line) != corners[-1]:
                corners.append((column, line))
        return corners

    def is_free(self, column: int, line: int) -> bool:
        """Whether a cell isn't taken."""
        return not self.taken[line % self.cells, column % self.cells]

    def _passable(self, column: int, line: int, across: int, down: int) -> bool:
        if not self.is_free(column + across, line + down):
            return False
        # A slanting step must not cross another trace that slants the other way.
        return across == 0 or down == 0 or self.is_free(column + across, line) or self.is_free(column, line + down)

    def _block(self, column: int, line: int, half_x: int, half_y: int) -> tuple[npt.NDArray[np.intp], ...]:
        rows = np.arange(line - half_y, line + half_y + 1) % self.cells
        return np.ix_(rows, np.arange(column - half_x, column + half_x + 1) % self.cells)


def _fan_out(
    rng: np.random.Generator, lattice: _Lattice, board: CircuitBoard, row: _Row, column: int, line: int
) -> None:
    """Put down a row's pads and lead their traces away side by side, staggered so that they turn together."""
    across, down = OCTANTS[row.octant]
    turn = int(rng.choice([-1, 1]))
    first, slant, last = int(rng.integers(1, 9)), int(rng.integers(3, 26)), int(rng.integers(4, 60))
    width = float(rng.choice([0.25, 0.3, 0.45]))
    reach = 2 if row.length > 1.3 else 1
    count = len(row.pins)
    for number, (pin_x, pin_y) in enumerate(row.pins):
        x, y = column + pin_x, line + pin_y
        lying = across != 0
        size = (row.length, row.breadth) if lying else (row.breadth, row.length)
        board.pads.append(Pad(*_mm(x, y), *size, row.drill))
        if rng.random() < 0.12:
            continue
        # Pins are numbered to the right or downwards; traces on the inner side of the turn turn first.
        order = count - 1 - number if (turn > 0) == (row.octant in (0, 6)) else number
        legs = ((row.octant, first + order), (row.octant + turn, slant), (row.octant, last))
        start = (x + reach * across, y + reach * down)
        if lattice.is_free(*start):
            _draw(board, [(x, y), *lattice.walk(*start, legs)], width)


def _bus(rng: np.random.Generator, lattice: _Lattice, board: CircuitBoard) -> None:
    """Lead parallel traces over free ground, from via to via."""
    column, line = (int(i) for i in rng.integers(lattice.cells, size=2))
    octant, turn = 2 * int(rng.integers(4)), int(rng.choice([-1, 1]))
    first, slant, last = (int(i) for i in rng.integers((6, 2, 6), (60, 24, 60)))
    side_x, side_y = OCTANTS[(octant + 2) % 8]
    width = float(rng.choice([0.25, 0.3, 0.6]))
    count = int(rng.integers(2, 9))
    for number in range(count):
        order = number if turn < 0 else count - 1 - number
        start = (column + 2 * number * side_x, line + 2 * number * side_y)
        if lattice.is_free(*start):
            legs = ((octant, first + order), (octant + turn, slant), (octant, last))
            corners = lattice.walk(*start, legs)
            if len(corners) > 1:
                board.vias.append(_mm(*corners[0]))
                _draw(board, corners, width)


def _draw(board: CircuitBoard, corners: list[tuple[int, int]], width: float) -> None:
    """Add a trace through lattice corners, with a via at its end."""
    if len(corners) < 2:
        return
    board.traces.append(Trace(np.array([_mm(*corner) for corner in corners]), width))
    board.vias.append(_mm(*corners[-1]))


def _mm(column: int, line: int) -> tuple[float, float]:
    return (column + 0.5) * CELL_MM, (line + 0.5) * CELL_MM


def _square_chip(pins: int) -> _Footprint:
    """Make the footprint of a square chip with pins on four sides."""
    reach = pins + 1
    places = range(1 - pins, pins, 2)
    rows = (
        _Row(tuple((i, -reach) for i in places), 6, 1.5, 0.6),
        _Row(tuple((i, reach) for i in places), 2, 1.5, 0.6),
        _Row(tuple((-reach, i) for i in places), 4, 1.5, 0.6),
        _Row(tuple((reach, i) for i in places), 0, 1.5, 0.6),
    )
    side = 2 * reach * CELL_MM - 2.2
    return _Footprint(BodyKind.CHIP, (reach + 1, reach + 1), rows, (side, side))


def _long_chip(pins: int, turned: int) -> _Footprint:
    """Make the footprint of a long chip with pins on two sides."""
    places = range(1 - pins, pins, 2)
    body = (2.0 * pins * CELL_MM, 3.9)
    if turned:
        rows = (
            _Row(tuple((-5, i) for i in places), 4, 1.6, 0.65),
            _Row(tuple((5, i) for i in places), 0, 1.6, 0.65),
        )
        return _Footprint(BodyKind.CHIP, (6, pins), rows, (body[1], body[0]))
    rows = (_Row(tuple((i, -5) for i in places), 6, 1.6, 0.65), _Row(tuple((i, 5) for i in places), 2, 1.6, 0.65))
    return _Footprint(BodyKind.CHIP, (pins, 6), rows, body)


def _header(lines: int, pins: int, turned: int) -> _Footprint:
    """Make the footprint of a pin header: plated holes 2.4 mm apart in one or two lines."""
    places = [4 * i - 2 * (pins - 1) for i in range(pins)]
    offsets = (0,) if lines == 1 else (-2, 2)
    rows = []
    for offset in offsets:
        pointing = offset >= 0
        if turned:
            rows.append(_Row(tuple((offset, i) for i in places), 0 if pointing else 4, 1.65, 1.65, 0.95))
        else:
            rows.append(_Row(tuple((i, offset) for i in places), 2 if pointing else 6, 1.65, 1.65, 0.95))
    body = (4 * pins * CELL_MM, 2.5 * lines)
    half = (2 * pins, 1 + 2 * (lines - 1))
    if turned:
        return _Footprint(BodyKind.HEADER, (half[1], half[0]), tuple(rows), (body[1], body[0]))
    return _Footprint(BodyKind.HEADER, half, tuple(rows), body)


def _passive(kind: BodyKind, turned: int) -> _Footprint:
    """Make the footprint of a resistor or capacitor with two ends."""
    if turned:
        rows = (_Row(((0, -2),), 6, 1.1, 1.3), _Row(((0, 2),), 2, 1.1, 1.3))
        return _Footprint(kind, (1, 3), rows, (1.25, 2.6))
    rows = (_Row(((-2, 0),), 4, 1.1, 1.3), _Row(((2, 0),), 0, 1.1, 1.3))
    return _Footprint(kind, (3, 1), rows, (2.6, 1.25))
