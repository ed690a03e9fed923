"""Curves: smoothing and bent rods."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from farm.spec.category import Category
from farm.spec.job import Job
from tests.stand_in import stand_in_scene
from worker.curves import smooth, tangents
from worker.simulate.shapes import bent_rod, height_at, start_nodes


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


CABLE = (
    stand_in_scene(Job(category=Category.FAR, index=0))
    .cables[0]
    .model_copy(update={"bends_per_m": (20.0, -30.0, 40.0, 10.0), "rotation_deg": 37.0, "x_m": 0.01, "y_m": -0.02})
)
RISES: list[dict[str, Any]] = [{}, {"rise_m": 0.02}, {"heights_m": (0.0, 0.01, 0.002, 0.009, 0.0, 0.0, 0.004)}]


@pytest.mark.parametrize("count", [40, 81])
@pytest.mark.parametrize("rises", RISES)
def test_every_start_has_the_cables_length_in_equal_segments(rises: dict[str, Any], count: int) -> None:
    """Whether level, rising evenly or with heights along it."""
    cable = CABLE.model_copy(update=rises)
    segments = np.linalg.norm(np.diff(start_nodes(cable, count), axis=0), axis=1)
    assert segments == pytest.approx(np.full(count - 1, cable.length_m / (count - 1)), rel=1e-12)


def test_a_start_that_rises_evenly_ends_higher_by_its_rise() -> None:
    """From node to node the rise is the same."""
    nodes = start_nodes(CABLE.model_copy(update={"rise_m": 0.02}), 41)
    assert np.diff(nodes[:, 2]) == pytest.approx(np.full(40, 0.02 / 40))


def test_a_level_start_is_the_bent_rod_in_its_place() -> None:
    """It is turned and shifted, and no more."""
    plan, nodes = bent_rod(CABLE.length_m, CABLE.bends_per_m, 81), start_nodes(CABLE, 81)
    turn = np.radians(37.0)
    assert nodes[:, 0].tolist() == (0.01 + np.cos(turn) * plan[:, 0] - np.sin(turn) * plan[:, 1]).tolist()
    assert set(nodes[:, 2].tolist()) == {CABLE.diameter_m / 2 + CABLE.start_height_m}


def test_a_start_with_heights_keeps_to_the_plan_of_the_level_one() -> None:
    """Every node lies within a thirtieth of a radius of the level curve in plan view, at the height of that place."""
    cable = CABLE.model_copy(update=RISES[2])
    level = start_nodes(CABLE, 8001)[:, :2]
    nodes = start_nodes(cable, 161)
    away = np.linalg.norm(nodes[:, None, :2] - level[None], axis=2)
    assert away.min(axis=1).max() < cable.diameter_m / 60
    along = away.argmin(axis=1) * cable.length_m / 8000
    raised = nodes[:, 2] - cable.diameter_m / 2 - cable.start_height_m
    assert raised == pytest.approx(height_at(cable, along), abs=cable.diameter_m / 60)


def test_tangents_are_unit_vectors() -> None:
    """Tangents have length 1, whatever the spacing of the points."""
    curve = np.cumsum(np.random.default_rng(1).uniform(0.1, 1.0, size=(20, 3)), axis=0)
    assert np.linalg.norm(tangents(curve), axis=1) == pytest.approx(np.ones(20))
