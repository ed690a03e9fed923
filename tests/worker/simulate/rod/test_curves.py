"""The rods' splines, and the closest places of two of them."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.worker.simulate.physics.rods import RADIUS_M, rod
from worker.curves import smooth
from worker.simulate.checks.measure import Gate
from worker.simulate.rod.arrays import flatten
from worker.simulate.rod.curves import closest_on_curves, find_bends, find_bulge, point
from worker.simulate.rod.model import Array
from worker.simulate.rod.narrow_phase import closest

SEED = st.integers(0, 2**32 - 1)
SEGMENT_M = 4 * RADIUS_M


def winding(draw: np.random.Generator, nodes: int, bend: float) -> Array:
    """Nodes (n, 3) at equal distances whose edges turn at random."""
    edges = np.cumsum(draw.normal(0, bend, (nodes - 1, 3)), axis=0) + np.array([1.0, 0.0, 0.0])
    edges *= SEGMENT_M / np.linalg.norm(edges, axis=1, keepdims=True)
    return np.concatenate([np.zeros((1, 3)), np.cumsum(edges, axis=0)])


def arc(curvature_radii: float, bearing: float, tilt: float, middle_m: Array, segment_m: float = SEGMENT_M) -> Array:
    """Ten nodes on an arc in a tilted plane, with the middle of the middle segment at a place."""
    turn = segment_m * curvature_radii / RADIUS_M * (np.arange(9) - 4)
    edges = segment_m * np.stack([np.cos(turn), np.sin(turn) * np.cos(tilt), np.sin(turn) * np.sin(tilt)], axis=1)
    nodes = np.concatenate([np.zeros((1, 3)), np.cumsum(edges, axis=0)])
    cosine, sine = np.cos(bearing), np.sin(bearing)
    placed: Array = (nodes - nodes[4:6].mean(axis=0)) @ [[cosine, sine, 0], [-sine, cosine, 0], [0, 0, 1]] + middle_m
    return placed


def bends_of(*rods_m: Array) -> tuple[Array, Array]:
    """The places (3, nodes) of rods with these nodes, and the second derivatives of their curves."""
    bodies, motion = flatten([rod(nodes) for nodes in rods_m])
    bends = np.empty(motion.x.shape)
    find_bends(bodies, motion.x, bends)
    return motion.x, bends


@settings(max_examples=30, deadline=None)
@given(seed=SEED, nodes=st.integers(4, 30), bend=st.floats(0, 2))
def test_the_curve_is_the_one_that_is_rendered(seed: int, nodes: int, bend: float) -> None:
    """At every share of every segment the point is that of SciPy's spline, to rounding."""
    draw = np.random.default_rng(seed)
    places = winding(draw, nodes, bend)
    x, bends = bends_of(winding(draw, 7, bend), places)
    curve = smooth(places, 5).T
    for n in range(curve.shape[1] - 1):
        at = [point(x, bends, c, 7 + n // 5, n % 5 / 5) for c in range(3)]
        assert at == pytest.approx(curve[:, n].tolist(), abs=1e-14)


@settings(max_examples=50, deadline=None)
@given(seed=SEED, bend=st.floats(0, 5))
def test_the_curve_leaves_its_chord_by_no_more_than_the_bulges_of_its_ends(seed: int, bend: float) -> None:
    """|C(t) - chord(t)| <= max(bulge[i], bulge[i + 1]) at every t, however the rod turns, to rounding."""
    nodes = winding(np.random.default_rng(seed), 13, bend)
    _, bends = bends_of(nodes)
    bulge = np.empty(13)
    find_bulge(bends, bulge)
    parts = 16
    t = np.arange(parts)[:, None] / parts
    off = smooth(nodes, parts)[:-1].reshape(12, parts, 3) - (nodes[:-1, None] + t * np.diff(nodes, axis=0)[:, None])
    assert (np.linalg.norm(off, axis=2).max(axis=1) <= np.maximum(bulge[:-1], bulge[1:]) + 1e-15).all()


@settings(max_examples=200, deadline=None)
@given(
    curvatures=st.tuples(st.floats(0, 0.125), st.floats(0, 0.125)),
    tilts=st.tuples(st.floats(0, 6.3), st.floats(0, 6.3)),
    bearing=st.floats(-1.6, 1.6),
    aside=st.floats(-0.5, 0.5),
    apart=st.floats(1.9, 2.2),
)
def test_the_closest_places_are_those_of_the_curves(
    curvatures: tuple[float, float], tilts: tuple[float, float], bearing: float, aside: float, apart: float
) -> None:
    """Arcs down to the tightest coil's, of 8 radii: the least distance of 81 x 81 places, within gate 2's target.

    A tight arc that crosses a straight one twice within a segment has two closest places, and neither may be found.
    """
    one = arc(curvatures[0], 0.0, tilts[0], np.zeros(3))
    other = arc(curvatures[1], bearing, tilts[1], RADIUS_M * np.array([aside, 0.0, apart]))
    assert excess_m(one, other) <= Gate.CABLE_PENETRATION.value.target * RADIUS_M


@pytest.mark.parametrize(
    ("thickness", "curvatures", "tilts_deg", "bearing_deg", "apart"),
    [
        (1, (0.06, 0.0), (0, 240), 10, 2.04),
        (1, (0.08, 0.04), (330, 210), 5, 2.04),
        (1, (0.08, 0.08), (0, 180), 20, 1.96),
        (2, (0.04, 0.04), (30, 150), 10, 3.0),
    ],
)
def test_curves_that_run_along_each_other_are_closest_where_they_touch(
    thickness: int, curvatures: tuple[float, float], tilts_deg: tuple[float, float], bearing_deg: float, apart: float
) -> None:
    """Arcs side by side that touch between the segments' ends, where chords are not closest: within 0.005 radii."""
    tilts, bearing = np.radians(tilts_deg), float(np.radians(bearing_deg))
    one = arc(curvatures[0], 0.0, tilts[0], np.zeros(3), 6 * RADIUS_M)
    middle_m = RADIUS_M * np.array([float(curvatures != (0.08, 0.04)), 0.0, apart])
    other = arc(curvatures[1], bearing, tilts[1], middle_m, 6 * thickness * RADIUS_M)
    assert excess_m(one, other) <= 0.005 * RADIUS_M


def excess_m(one: Array, other: Array) -> float:
    """The distance found between two rods' middle segments, less the least of 81 x 81 places, in metres."""
    x, bends = bends_of(one, other)
    s, t = closest_on_curves(x, bends, 4, 14, *closest(x, 4, 14))
    assert 0.0 <= s <= 1.0
    assert 0.0 <= t <= 1.0
    shares = np.linspace(0, 1, 81)
    here, there = (np.array([[point(x, bends, c, i, u) for c in range(3)] for u in shares]) for i in (4, 14))
    least = np.linalg.norm(here[:, None] - there[None], axis=2).min()
    found = np.linalg.norm([point(x, bends, c, 4, s) - point(x, bends, c, 14, t) for c in range(3)])
    return float(found - least)
