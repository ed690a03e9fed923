from itertools import pairwise

import numpy as np
import numpy.typing as npt
import pytest

from assets.surfaces.kit.circuit_layout import CELL_MM, CircuitBoard, lay_out

SIZE_MM = 300.0
CELLS = round(SIZE_MM / CELL_MM)


@pytest.fixture(scope="module")
def board() -> CircuitBoard:
    """One board."""
    return lay_out(np.random.default_rng(0), SIZE_MM)


def cells(path: npt.NDArray[np.float64]) -> list[tuple[int, int]]:
    """The lattice cells that a trace visits, corner to corner, wrapped into the tile."""
    corners = np.rint(path / CELL_MM - 0.5).astype(int)
    visited = [tuple(corners[0])]
    for start, end in pairwise(corners):
        steps = int(np.abs(end - start).max())
        visited += [tuple(start + (end - start) * i // steps) for i in range(1, steps + 1)]
    return [(int(x) % CELLS, int(y) % CELLS) for x, y in visited]


def test_traces_run_straight_or_at_45_degrees(board: CircuitBoard) -> None:
    """Every leg of every trace follows one of the eight directions."""
    for trace in board.traces:
        across, down = np.abs(np.diff(trace.path, axis=0)).T
        assert ((across < 1e-9) | (down < 1e-9) | (np.abs(across - down) < 1e-6)).all()


def test_no_two_traces_meet(board: CircuitBoard) -> None:
    """No cell of the lattice belongs to two traces: nothing is short-circuited."""
    visited = [cell for trace in board.traces for cell in cells(trace.path)]
    assert len(visited) > 5000
    assert len(visited) == len(set(visited))


def test_components_do_not_overlap(board: CircuitBoard) -> None:
    """The middles of two bodies lie further apart than half their sizes, across the tile's edges too."""
    centres = np.array([(body.x, body.y) for body in board.bodies])
    halves = np.array([(body.width, body.height) for body in board.bodies]) / 2
    gap = np.abs(centres[:, None] - centres[None])
    gap = np.minimum(gap, SIZE_MM - gap) - (halves[:, None] + halves[None])
    apart = gap.max(axis=2)
    np.fill_diagonal(apart, 1.0)
    assert apart.min() > 0


def test_most_components_find_room(board: CircuitBoard) -> None:
    """The board is well filled, and every component has its own name."""
    names = [body.name for body in board.bodies]
    assert len(names) > 250
    assert len(set(names)) == len(names)


def test_the_same_seed_lays_out_the_same_board(board: CircuitBoard) -> None:
    """All randomness comes from the generator."""
    again = lay_out(np.random.default_rng(0), SIZE_MM)
    assert again.pads == board.pads
    assert again.vias == board.vias
