"""Sticks stay within the radius with which they fell, and their outlines are those of their meshes."""

from itertools import pairwise

import numpy as np
import pytest

from farm.clutter import StickKind
from tests.worker.clutter.test_solid import volume_m3
from tests.worker.clutter.things import make_stick
from worker.clutter.sticks import PENCIL_CORNER, placed_on, stick_outline, stick_solid

SEEDS = range(6)


@pytest.mark.parametrize("kind", StickKind)
@pytest.mark.parametrize("seed", SEEDS)
def test_a_stick_is_as_long_and_thick_as_it_fell(kind: StickKind, seed: int) -> None:
    """Nothing of it is outside, save a pencil's corners; it looks outwards; each face has a finish."""
    stick = make_stick(kind, seed=seed)
    solid, finishes = stick_solid(stick)
    most = stick.diameter_m / 2 * (PENCIL_CORNER if kind is StickKind.PENCIL else 1.0)
    assert solid.vertices_m[:, 0].min() == pytest.approx(0.0, abs=1e-9)
    assert solid.vertices_m[:, 0].max() == pytest.approx(stick.length_m)
    assert np.hypot(solid.vertices_m[:, 1], solid.vertices_m[:, 2]).max() <= most * 1.06
    assert np.abs(solid.vertices_m[:, 2]).max() <= stick.diameter_m / 2 * 1.001
    assert volume_m3(solid) > 0
    assert 0 <= solid.finishes.min() <= solid.finishes.max() < len(finishes)


@pytest.mark.parametrize("kind", StickKind)
@pytest.mark.parametrize("seed", SEEDS)
def test_an_outline_is_as_wide_as_the_mesh(kind: StickKind, seed: int) -> None:
    """At each place along it, seen from above, to a twentieth of the radius."""
    stick = make_stick(kind, seed=seed)
    solid, _ = stick_solid(stick)
    nodes = np.array([[0.0, 0.0, 0.0], [stick.length_m / 2, 0.0, 0.0], [stick.length_m, 0.0, 0.0]])
    pieces = stick_outline(stick, nodes)
    width = np.zeros(1400)
    place = (np.arange(1400) + 0.5) * stick.length_m / 1400
    start = 0
    for size in solid.sizes:
        face = solid.vertices_m[solid.corners[start : start + size]]
        start += size
        inside = (place >= face[:, 0].min()) & (place <= face[:, 0].max())
        if inside.any():
            order = np.argsort(face[:, 0])
            width[inside] = np.maximum(width[inside], np.interp(place[inside], face[order, 0], face[order, 1]))
    outline = np.zeros(1400)
    for curve, radius in pieces:
        outline[(place >= curve[0, 0]) & (place <= curve[-1, 0])] = radius
    # Where the radius jumps, a step of a place along it may be on either side.
    error = np.minimum.reduce([np.abs(np.roll(outline, shift) - width) for shift in (-2, -1, 0, 1, 2)])
    allowed = 0.12 if kind is StickKind.PENCIL else 0.06
    assert np.percentile(error, 99) <= allowed * stick.diameter_m / 2


def test_a_rod_is_a_few_cylinders() -> None:
    """A plain one: its body and its two chamfers, joined end to end."""
    nodes = np.array([[0.0, 0.0, 0.004], [0.14, 0.0, 0.004]])
    pieces = stick_outline(make_stick(StickKind.PIPE), nodes)
    assert pieces[0][0][0] == pytest.approx(nodes[0], abs=2e-4)
    assert pieces[-1][0][-1] == pytest.approx(nodes[1], abs=2e-4)
    for (before, _), (after, _) in pairwise(pieces):
        assert after[0] == pytest.approx(before[-1])
    assert max(radius for _, radius in pieces) == pytest.approx(0.004, rel=0.01)


def test_a_stick_lies_along_its_nodes() -> None:
    """Its axes are at right angles, right-handed, x along the nodes and z up."""
    axes, origin = placed_on(np.array([[0.1, 0.0, 0.01], [0.1, 0.1, 0.01]]))
    assert axes == pytest.approx(np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]]))
    assert origin == pytest.approx(np.array([0.1, 0.0, 0.01]))
