"""Tubes: closed, round, facing outwards, with a coordinate along the cable."""

from itertools import pairwise

import numpy as np
import pytest

from worker.cable.tube import sweep
from worker.curves import Points, smooth

SIDES = 20


def curve() -> Points:
    """A gently bent curve of about 0.2 m."""
    s = np.linspace(0, 0.2, 21)
    return smooth(np.stack([s, 0.02 * np.sin(20 * s), 0.001 + 0.01 * s], axis=1), 5)


def test_a_tube_is_closed() -> None:
    """Every edge is shared by exactly two faces, which run along it in opposite directions."""
    tube = sweep(curve(), 0.001, SIDES)
    _, place = np.unique(tube.vertices_m, axis=0, return_inverse=True)
    edges = [
        (int(place[face[k]]), int(place[face[(k + 1) % len(face)]]))
        for face in (tube.corners[a:b] for a, b in pairwise([*tube.face_starts, len(tube.corners)]))
        for k in range(len(face))
    ]
    assert len(set(edges)) == len(edges)
    assert {(b, a) for a, b in edges} == set(edges)


def test_faces_point_outwards() -> None:
    """The signed volume is positive, and near pi r^2 L."""
    tube = sweep(curve(), 0.001, SIDES)
    points = tube.vertices_m.astype(np.float64)
    volume = 0.0
    for a, b in pairwise([*tube.face_starts, len(tube.corners)]):
        face = points[tube.corners[a:b]]
        volume += sum(np.dot(face[0], np.cross(face[k], face[k + 1])) / 6 for k in range(1, len(face) - 1))
    length = np.linalg.norm(np.diff(curve(), axis=0), axis=1).sum()
    assert volume == pytest.approx(np.pi * 0.001**2 * length, rel=0.01)


def test_vertices_stand_around_the_centreline() -> None:
    """The corner radius makes the silhouette right on average: within 1.3 % of r for 20 sides."""
    tube = sweep(curve(), 0.001, SIDES)
    rings = tube.vertices_m.reshape(-1, SIDES, 3)[:-2]
    distance = np.linalg.norm(rings - curve()[:, None], axis=2)
    assert distance == pytest.approx(np.full_like(distance, 2 * 0.001 / (1 + np.cos(np.pi / SIDES))), rel=1e-3)


def test_the_texture_runs_along_the_cable_in_metres() -> None:
    """The coordinate runs from 0 to the cable's length."""
    tube = sweep(curve(), 0.001, SIDES)
    length = np.linalg.norm(np.diff(curve(), axis=0), axis=1).sum()
    along = tube.uvs[: -2 * SIDES, 0]
    assert along.min() == 0.0
    assert along.max() == pytest.approx(length, rel=1e-5)


def test_a_part_of_a_cable_has_the_texture_of_the_whole() -> None:
    """A part that starts at 0.05 m has coordinates from there on."""
    tube = sweep(curve(), 0.001, SIDES, start_m=0.05)
    assert tube.uvs[: -2 * SIDES, 0].min() == pytest.approx(0.05)


def test_the_ends_share_no_vertex_with_the_side() -> None:
    """A mesh that is shaded smooth is then round along the side and flat at the ends."""
    tube = sweep(curve(), 0.001, SIDES)
    side, ends = tube.corners[: -2 * SIDES], tube.corners[-2 * SIDES :]
    assert not set(side.tolist()) & set(ends.tolist())
