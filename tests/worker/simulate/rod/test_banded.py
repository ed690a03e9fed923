"""The equations of a chain of nodes, against a dense solver."""

import numpy as np
import pytest

from worker.simulate.rod.banded import BEYOND, DIAGONAL, LATER, NEXT, OWN, RIGHT, ROW, SOLUTION, solve
from worker.simulate.rod.model import Array


def chain(nodes: int, stiffness: float, *, held: tuple[int, ...] = ()) -> Array:
    """Unit masses under random loads, with some bending stiffness and segments of fixed length."""
    draw = np.random.default_rng(nodes)
    bends = np.diff(np.eye(nodes), n=2, axis=0)
    matrix = np.eye(nodes) + stiffness * bends.T @ bends
    along = draw.normal(size=(nodes - 1, 3))
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    rows = np.full((nodes, ROW), np.nan)
    rows[:, : LATER + 3] = 0.0
    rows[:, DIAGONAL : DIAGONAL + 3] = np.diagonal(matrix)[:, None]
    rows[0, DIAGONAL + 3] = 1.0
    rows[:-1, NEXT : NEXT + 3] = np.diagonal(matrix, 1)[:, None]
    rows[:-2, BEYOND : BEYOND + 3] = np.diagonal(matrix, 2)[:, None]
    rows[1:, OWN : OWN + 3] = along
    rows[:-1, LATER : LATER + 3] = -along
    rows[:, RIGHT : RIGHT + 4] = draw.normal(size=(nodes, 4))
    for node in held:
        hold_height(rows, node)
    return rows


def hold_height(rows: Array, node: int) -> None:
    """Take a node's height out of the equations."""
    rows[node, [NEXT + 2, BEYOND + 2, OWN + 2, LATER + 2]] = 0.0
    rows[node - 1, NEXT + 2] = rows[node - 2, BEYOND + 2] = 0.0
    rows[node, DIAGONAL + 2] = 1.0


def dense(rows: Array) -> Array:
    """The matrix of the equations."""
    nodes = len(rows)
    upper = np.zeros((4 * nodes + 8, 4 * nodes + 8))
    for i, row in enumerate(rows):
        at = 4 * i
        for c in range(3):
            upper[at + c, [at + c + 4, at + c + 8]] = row[[NEXT + c, BEYOND + c]]
            upper[at + c, [at + 3, at + 7]] = row[[OWN + c, LATER + c]]
    matrix: Array = (upper + upper.T)[: 4 * nodes, : 4 * nodes]
    return matrix + np.diag(rows[:, DIAGONAL : DIAGONAL + 4].ravel())


@pytest.mark.parametrize("nodes", [4, 5, 101])
@pytest.mark.parametrize("stiffness", [0.0, 1.0, 1e4])
def test_equations_hold(nodes: int, stiffness: float) -> None:
    """The solution fulfils the equations of soft and of stiff rods, of few nodes and of many."""
    rows = chain(nodes, stiffness)
    expected = np.linalg.solve(dense(rows), rows[:, RIGHT : RIGHT + 4].ravel()).reshape(nodes, 4)
    solve(rows)
    found = rows[:, SOLUTION : SOLUTION + 4]
    assert np.abs(found - expected).max(axis=0) == pytest.approx(0.0, abs=1e-11 * np.abs(expected).max())


def test_a_coordinate_can_be_left_out() -> None:
    """A coordinate that is left out has an equation of its own."""
    rows = chain(30, 10.0, held=(7, 8, 29))
    expected = np.linalg.solve(dense(rows), rows[:, RIGHT : RIGHT + 4].ravel()).reshape(30, 4)
    own = rows[[7, 8, 29], RIGHT + 2].copy()
    solve(rows)
    assert rows[:, SOLUTION : SOLUTION + 4] == pytest.approx(expected, rel=1e-9, abs=1e-11)
    assert rows[[7, 8, 29], SOLUTION + 2] == pytest.approx(own)
