"""Curves: smoothing and bent rods."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from worker.curves import smooth, tangents
from worker.simulate.shapes import bent_rod


def test_a_smooth_curve_passes_through_its_nodes() -> None:
    """Every node is on the curve."""
    nodes = np.random.default_rng(0).normal(size=(9, 3))
    assert smooth(nodes, 5)[::5] == pytest.approx(nodes)


@given(bends=st.lists(st.floats(-20, 20), min_size=2, max_size=9))
def test_a_bent_rod_keeps_its_length(bends: list[float]) -> None:
    """Nodes are equally spaced along the arc: the polyline is shorter only by the chords' sagitta, (kl)^2/24."""
    rod = bent_rod(0.4, tuple(bends), 81)
    length = np.linalg.norm(np.diff(rod, axis=0), axis=1).sum()
    assert 0.4 * (1 - (25 * 0.005) ** 2 / 24) - 1e-6 <= length <= 0.4 + 1e-9


def test_a_constant_bend_gives_a_regular_polygons_arc() -> None:
    """N edges of length l that each turn by k l span a chord of l sin(N k l / 2) / sin(k l / 2)."""
    rod = bent_rod(0.4, (5.0, 5.0, 5.0), 81)
    edge, turn = 0.4 / 80, 5.0 * 0.4 / 80
    chord = edge * np.sin(80 * turn / 2) / np.sin(turn / 2)
    assert np.linalg.norm(rod[-1] - rod[0]) == pytest.approx(chord, rel=1e-12)
    assert np.linalg.norm(np.diff(rod, axis=0), axis=1) == pytest.approx(np.full(80, edge), rel=1e-12)


def test_a_bent_rod_heads_along_x_with_its_middle_at_the_origin() -> None:
    """Its chord has no y component."""
    rod = bent_rod(0.4, (8.0, -3.0, 2.0, 1.0), 81)
    assert rod[40] == pytest.approx([0.0, 0.0])
    assert (rod[-1] - rod[0])[1] == pytest.approx(0.0, abs=1e-12)


def test_tangents_are_unit_vectors() -> None:
    """Tangents have length 1, whatever the spacing of the points."""
    curve = np.cumsum(np.random.default_rng(1).uniform(0.1, 1.0, size=(20, 3)), axis=0)
    assert np.linalg.norm(tangents(curve), axis=1) == pytest.approx(np.ones(20))
