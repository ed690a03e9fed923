"""The beam over a ridge, against the balance of forces, its own equation, and finite differences on a floor."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import lsq_linear

from benchmarks.physics.gates import crossing_error
from benchmarks.physics.ridge import RidgeCrossing, fit_lifted
from worker.simulate.checks.measure import Gate

positive = st.floats(1e-6, 1e3)


@given(stiffness=positive, weight=positive, lift=positive)
def test_ridge_and_touchdowns_carry_the_lifted_weight(stiffness: float, weight: float, lift: float) -> None:
    """Together they carry a length of 2 a at w per metre."""
    crossing = RidgeCrossing(stiffness, weight, lift)
    carried = crossing.ridge_reaction_n + 2 * crossing.touchdown_reaction_n
    assert carried == pytest.approx(2 * weight * crossing.lift_off_m)


def test_the_shape_obeys_the_beams_equation() -> None:
    """By differences EI y'''' = -w, with y = d on the ridge, and y, y' and y'' zero at the touchdown."""
    crossing = RidgeCrossing(2.0, 3.0, 0.1)
    a = crossing.lift_off_m
    step = a / 50
    fourth = np.diff(crossing.height_m(0.5 * a + step * np.arange(5)), 4)[0] / step**4
    assert 2.0 * fourth == pytest.approx(-3.0, rel=1e-3)
    assert crossing.height_m(np.array([0.0, a, 1.5 * a])).tolist() == pytest.approx([0.1, 0, 0])
    assert crossing.height_m(np.array([a * (1 - 1e-3)]))[0] < 0.1 * 5e-9


def test_a_beam_of_finite_differences_on_a_floor_meets_gate_six() -> None:
    """The least energy above a floor that can only push, with 16 nodes to the lift-off length, meets gate 6.

    The error of central differences is (l / a)^2, 0.4 %.
    """
    stiffness, weight, lift, radius = 7.9e-6, 0.046, 0.002, 0.001
    reference = RidgeCrossing(stiffness, weight, lift)
    edge, half = reference.lift_off_m / 16, 40
    count = 2 * half + 1
    # Both ends lie flat, so the two nodes beyond each are at zero, too.
    curvature = np.zeros((count + 2, count))
    for row in range(count + 2):
        for column, value in ((row - 2, 1.0), (row - 1, -2.0), (row, 1.0)):
            if 0 <= column < count:
                curvature[row, column] = value
    matrix = stiffness / edge**3 * curvature.T @ curvature
    root = np.linalg.cholesky(matrix)
    # Half y K y + w l y is least where |R' y + R^-1 w l| is least.
    target = -np.linalg.solve(root, np.full(count, weight * edge))
    lowest = np.zeros(count)
    lowest[half] = lift
    heights = lsq_linear(root.T, target, bounds=(lowest, np.inf), method="bvls", tol=1e-14).x
    reactions = matrix @ heights + weight * edge
    nodes = np.stack([edge * np.arange(count), np.zeros(count), heights + radius], axis=1)
    found = crossing_error(nodes, reactions, radius_m=radius, reference=reference)
    assert found.lift_off_error < 0.01
    assert found.reaction_error < 0.01
    assert found.misfit < 0.01
    assert Gate.LIFT_OFF.on_target(found.lift_off_error)


def test_too_few_lifted_nodes_are_refused() -> None:
    """Three nodes are refused, as they determine length, place and height without any check."""
    crossing = RidgeCrossing(1.0, 1.0, 0.01)
    x = np.arange(-4, 5) * crossing.lift_off_m * 0.6
    with pytest.raises(ValueError, match="four nodes"):
        fit_lifted(x, crossing.height_m(x))


def test_a_crossing_needs_positive_figures() -> None:
    """A crossing without stiffness, weight or lift is refused."""
    with pytest.raises(ValueError, match="positive"):
        RidgeCrossing(0.0, 1.0, 1.0)
