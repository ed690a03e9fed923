"""Depth of contact, against geometry and against an exhaustive search."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.distance import cdist

from tests.worker.settled import RADIUS, looped, rod, shapes
from worker.curves import Points, smooth
from worker.simulate.checks.contact import segment_gap
from worker.simulate.checks.measure import measure
from worker.simulate.shapes import bent_rod


@settings(max_examples=60, deadline=None)
@given(
    radii=st.tuples(st.floats(0.0005, 0.003), st.floats(0.0005, 0.003)),
    angle=st.floats(0.3, np.pi - 0.3),
    overlap=st.floats(-0.4, 0.9),
    shift=st.floats(-0.02, 0.02),
)
def test_the_depth_of_a_crossing_is_its_geometry(
    radii: tuple[float, float], angle: float, overlap: float, shift: float
) -> None:
    """The depth is right for two straight cables that overlap, whatever their radii, angle and place."""
    s = np.linspace(-0.1, 0.1, 41)[:, None]
    lower = s * [1.0, 0.0, 0.0] + [0.0, 0.0, radii[0]]
    rise = sum(radii) - overlap * min(radii)
    upper = s * [np.cos(angle), np.sin(angle), 0.0] + [shift, shift / 3, radii[0] + rise]
    figures = measure(shapes(lower, upper, radii=radii))
    assert figures.cable_penetration_max == pytest.approx(max(overlap, 0), abs=1e-9)
    air = -overlap * min(radii)
    assert figures.support_gap == pytest.approx(max(min(0, air / radii[0]), air / radii[1]), abs=1e-9)


@settings(max_examples=30, deadline=None)
@given(distance=st.floats(0.2, 1.99), shift=st.floats(0.0, 0.004))
def test_the_depth_of_parallel_cables_is_their_distance(distance: float, shift: float) -> None:
    """Side by side, the depth is right even if the nodes of the two aren't beside each other."""
    beside = rod(y=distance * RADIUS) + np.array([shift, 0.0, 0.0])
    figures = measure(shapes(rod(), beside))
    assert figures.cable_penetration == pytest.approx(2 - distance, abs=1e-9)
    assert figures.cable_penetration_max == pytest.approx(2 - distance, abs=1e-9)


def test_many_cables_are_measured_like_two() -> None:
    """No pair that the search leaves out is in contact: every pair alone is no deeper than all together."""
    draw = np.random.default_rng(3)
    places = np.pad(draw.uniform(-0.05, 0.05, (10, 2)), ((0, 0), (0, 1)))
    many = [rod(along_y=bool(k % 2), z=RADIUS * (1 + 0.2 * k)) + places[k] for k in range(10)]
    pairs = [measure(shapes(many[a], many[b])).cable_penetration_max for a in range(10) for b in range(a)]
    assert measure(shapes(*many)).cable_penetration_max == pytest.approx(max(pairs), abs=1e-12)


def test_a_tight_bend_does_not_cut_into_itself() -> None:
    """A half circle of two radii leaves a gap of two radii inside, and has no depth."""
    angle = np.linspace(0, np.pi, 33)
    arc = np.stack([2 * RADIUS * np.cos(angle), 2 * RADIUS * np.sin(angle), np.full_like(angle, RADIUS)], axis=1)
    assert measure(shapes(arc)).cable_penetration_max == 0


def test_a_flat_loop_cuts_into_itself() -> None:
    """A flat loop, whose centrelines meet, is two radii deep."""
    assert measure(shapes(looped())).cable_penetration_max == pytest.approx(2.0, abs=1e-6)


def wavy(draw: np.random.Generator) -> Points:
    """A bent cable of 0.2 m, 1 to 4 mm above the floor."""
    plan = bent_rod(0.2, tuple(draw.normal(0, 30, 5)), 41) + draw.uniform(-0.03, 0.03, 2)
    height = draw.uniform(0.001, 0.003) + 0.001 * np.sin(np.linspace(0, 9, 41)) ** 2
    return np.column_stack([plan, height])


@pytest.mark.parametrize("seed", range(12))
def test_random_cables_are_as_deep_as_a_search_of_everything_finds(seed: int) -> None:
    """The depth is right within the error of an exhaustive search with 60 samples a span."""
    draw = np.random.default_rng(seed)
    nodes, radii = [wavy(draw) for _ in range(3)], tuple(draw.uniform(0.0006, 0.002, 3))
    fine = [smooth(each, 60) for each in nodes]
    deepest = 0.0
    for a in range(3):
        for b in range(a, 3):
            distance = cdist(fine[a], fine[b])
            if a == b:
                arc = np.arange(len(fine[a])) * 0.2 / (len(fine[a]) - 1)
                distance[np.abs(arc[:, None] - arc) < 4 * radii[a]] = np.inf
            depth = (radii[a] + radii[b] - distance.min()) / min(radii[a], radii[b])
            deepest = max(deepest, depth)
    step = 0.2 / 40 / 60
    assert measure(shapes(*nodes, radii=radii)).cable_penetration_max == pytest.approx(deepest, abs=step / min(radii))


def test_the_gap_of_segments_is_that_of_their_nearest_points() -> None:
    """The gap is right for crossed, collinear and parallel segments, and for a point."""
    p, p_end = np.zeros((4, 3)), np.tile([1.0, 0, 0], (4, 1))
    q = np.array([[0.5, -1, 0.3], [2, 0, 0], [0.2, 0.4, 0], [0.5, 0, 0.7]])
    q_end = np.array([[0.5, 1, 0.3], [3, 5, 0], [0.7, 0.4, 0], [0.5, 0, 0.7]])
    assert segment_gap(p, p_end, q, q_end) == pytest.approx([0.3, 1.0, 0.4, 0.7])
