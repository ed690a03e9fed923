"""Sticks stay within the radius with which they fell, and their outlines are those of their meshes."""

from itertools import pairwise

import cv2
import numpy as np
import pytest

from farm.scene.clutter import StickKind
from farm.scene.picture_size import PictureSize
from tests.worker.clutter.test_solid import volume_m3
from tests.worker.clutter.things import make_stick
from tests.worker.scenes import tubular
from worker.camera.view import View
from worker.clutter.solid import SIDES
from worker.clutter.stick_kinds import PENCIL_CORNER
from worker.clutter.sticks import placed_on, stick_outline, stick_solid
from worker.label.coverage import cover
from worker.label.silhouette import silhouettes

SEEDS = range(4)


@pytest.mark.parametrize("kind", StickKind)
@pytest.mark.parametrize("seed", SEEDS)
def test_a_stick_is_as_long_and_thick_as_it_fell(kind: StickKind, seed: int) -> None:
    """Nothing is outside the radius but a pencil's corners; faces look outwards and have a finish."""
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
def test_a_label_of_the_outline_covers_the_rendered_mesh(kind: StickKind, seed: int) -> None:
    """In a corner of the picture, seen from the side, the masks differ only at the stick's edge."""
    stick = make_stick(kind, seed=seed, length_m=0.06)
    turn = np.radians(35.0)
    ends = 0.045 + 0.03 * np.outer([-1, 1], [np.cos(turn), np.sin(turn)])
    nodes = np.column_stack([ends, np.full(2, stick.diameter_m / 2)])
    view = View(height_m=0.2, resolution=PictureSize.square(512))
    solid, _ = stick_solid(stick)
    axes, origin = placed_on(nodes)
    corners = view.project(solid.turned(axes).moved(origin).vertices_m)[solid.corners]
    seen = np.zeros((512, 512), np.uint8)
    start = 0
    for size in solid.sizes:
        cv2.fillConvexPoly(seen, np.rint((corners[start : start + size] - 0.5) * 256).astype(np.int32), (1,), shift=8)
        start += size
    pieces = stick_outline(stick, nodes)
    drawn = silhouettes([tubular(curve, radius) for curve, radius in pieces], view, SIDES)
    label = cover(drawn.quads_px, np.ones(len(drawn.quads_px), np.int64), 512, 512) > 0
    # OpenCV fills every pixel that a polygon touches, which is half a pixel more all round.
    edge = len(cv2.findContours(seen, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)[0][0])
    assert np.count_nonzero(label & (seen == 0)) <= 0.4 * edge
    assert abs(np.count_nonzero(seen) - 0.5 * edge - np.count_nonzero(label)) <= 0.5 * edge


def test_a_rod_is_a_few_cylinders() -> None:
    """A plain rod is its body and two chamfers, joined end to end."""
    nodes = np.array([[0.0, 0.0, 0.004], [0.14, 0.0, 0.004]])
    pieces = stick_outline(make_stick(StickKind.PIPE), nodes)
    assert pieces[0][0][0] == pytest.approx(nodes[0], abs=2e-4)
    assert pieces[-1][0][-1] == pytest.approx(nodes[1], abs=2e-4)
    for (before, _), (after, _) in pairwise(pieces):
        assert after[0] == pytest.approx(before[-1])
    assert max(radius for _, radius in pieces) == pytest.approx(0.004, rel=0.01)


def test_a_stick_lies_along_its_nodes() -> None:
    """The axes are orthogonal and right-handed, x along the nodes and z up."""
    axes, origin = placed_on(np.array([[0.1, 0.0, 0.01], [0.1, 0.1, 0.01]]))
    assert axes == pytest.approx(np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]]))
    assert origin == pytest.approx(np.array([0.1, 0.0, 0.01]))
