"""Strips of cloth that stand for cables."""

import numpy as np
import pytest

from worker.curves import Points
from worker.simulate.cloth.strip import centreline, zigzag, zigzag_faces


def straight(nodes: int) -> Points:
    """A level straight path along x."""
    return np.stack([np.linspace(0, 1, nodes), np.zeros(nodes), np.full(nodes, 0.3)], axis=1)


def test_the_centreline_undoes_the_zigzag() -> None:
    """On a straight path the alternating offset cancels exactly, at the ends too."""
    path = straight(11)
    assert centreline(zigzag(path, 0.08)) == pytest.approx(path)


def test_faces_point_up() -> None:
    """All normals of a level strip have a positive z, so that wind and collisions see one side."""
    vertices = zigzag(straight(9), 0.08)
    for face in zigzag_faces(9, 0):
        a, b, c = vertices[list(face)]
        assert np.cross(b - a, c - a)[2] > 0


def test_faces_are_counted_from_the_first_vertex() -> None:
    """In a joined mesh a later strip's vertices are numbered after the earlier ones."""
    assert zigzag_faces(4, 100) == [(100, 102, 101), (101, 102, 103)]
