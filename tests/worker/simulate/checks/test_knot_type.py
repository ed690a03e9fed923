"""The kind of a knot, told by its determinant."""

import numpy as np
import pytest

from worker.curves import Points
from worker.simulate.checks.knot_type import FIGURE_EIGHT, OVERHAND, UNKNOTTED, determinant


def around_a_torus(turns: int, waves: int, heights: int) -> Points:
    """A closed knot (2 + cos(waves t)) about the z axis, cut open at its outermost point, with tails along x."""
    t = np.linspace(0, 2 * np.pi, 400)
    reach = 2 + np.cos(waves * t)
    knot = np.stack([reach * np.sin(turns * t), -reach * np.cos(turns * t), np.sin(heights * t)], axis=1)
    tail = np.stack([np.linspace(0.1, 4, 20), np.full(20, -3.0), np.zeros(20)], axis=1)
    return np.concatenate([tail[::-1] * [-1, 1, 1], knot, tail])


TREFOIL = around_a_torus(2, 3, 3)
EIGHT = around_a_torus(3, 2, 4)


def turned(curve: Points) -> Points:
    """A curve, seen from somewhere else."""
    rotation = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    view: Points = curve @ rotation
    return view


@pytest.mark.parametrize(("curve", "value"), [(TREFOIL, OVERHAND), (EIGHT, FIGURE_EIGHT)])
def test_the_textbooks_knots_have_their_determinants(curve: Points, value: int) -> None:
    """A trefoil has 3, a figure-eight knot 5 (Livingston 1993, table 1)."""
    assert determinant(curve) == value


@pytest.mark.parametrize(("curve", "value"), [(TREFOIL, OVERHAND), (EIGHT, FIGURE_EIGHT)])
def test_the_mirror_image_has_the_same_determinant(curve: Points, value: int) -> None:
    """The determinant does not tell right from left."""
    assert determinant(curve * [1, 1, -1]) == value


def test_the_view_does_not_matter_for_long_tails() -> None:
    """A trefoil seen askew has other crossings and the same determinant."""
    far = TREFOIL.copy()
    far[:20, 0] *= 20
    far[-20:, 0] *= 20
    assert determinant(turned(far)) == OVERHAND


def test_two_knots_multiply_their_determinants() -> None:
    """A trefoil and a figure-eight knot on one cable have 3 x 5."""
    assert determinant(np.concatenate([TREFOIL, EIGHT + np.array([12.0, 0.0, 0.0])])) == OVERHAND * FIGURE_EIGHT


def test_a_coil_is_no_knot() -> None:
    """A cable that lies on itself in turns, end above beginning, comes straight when it is pulled."""
    t = np.linspace(0, 7 * np.pi, 300)
    coil = np.stack([(1 + 0.05 * t) * np.cos(t), (1 + 0.05 * t) * np.sin(t), 0.1 * t], axis=1)
    assert determinant(coil) == UNKNOTTED


@pytest.mark.parametrize("curve", [TREFOIL, EIGHT])
def test_other_crossings_in_the_same_plan_make_no_knot(curve: Points) -> None:
    """A curve that lies over its earlier parts at every crossing is unknotted, whatever its plan."""
    rising = curve.copy()
    rising[:, 2] = np.linspace(0, 1, len(curve))
    assert determinant(rising) == UNKNOTTED


def test_a_straight_cable_is_unknotted() -> None:
    """A curve without a crossing has 1."""
    assert determinant(np.array([[0.0, 0, 0], [1, 0.1, 0], [2, 0, 0]])) == UNKNOTTED
