"""Meshes are closed, face outwards and have the size asked for."""

import numpy as np
import pytest

from worker.clutter.solid import Solid, box, inset, joined, polygon, section, strap, turned_on_lathe


def volume_m3(solid: Solid) -> float:
    """Volume by the divergence theorem, positive if faces look outwards."""
    starts = np.cumsum(solid.sizes) - solid.sizes
    total = 0.0
    for k in range(1, int(solid.sizes.max()) - 1):
        at = starts[solid.sizes > k + 1]
        first, one, other = (solid.vertices_m[solid.corners[at + corner]] for corner in (0, k, k + 1))
        total += float(np.einsum("ij,ij->", first, np.cross(one, other))) / 6
    return total


def test_a_turned_cylinder_has_its_volume() -> None:
    """A turned cylinder has the volume of a prism of 48 sides, 0.3 % less than pi r^2 l."""
    profile = [section(points, 0) for points in ([(0, 0), (0, 2)], [(0, 2), (5, 2)], [(5, 2), (5, 0)])]
    assert volume_m3(turned_on_lathe(profile, 48)) == pytest.approx(np.pi * 4 * 5, rel=0.004)


def test_a_box_faces_outwards() -> None:
    """A box has the volume of its corners, less its bevels."""
    solid = box((0, 0, 0), (3, 4, 5), 0.01, 0)
    assert volume_m3(solid) == pytest.approx(60, rel=0.01)
    assert solid.vertices_m.min(axis=0) == pytest.approx(np.zeros(3))
    assert solid.vertices_m.max(axis=0) == pytest.approx(np.array([3, 4, 5]))


def test_a_strap_faces_outwards() -> None:
    """A straight strap has the volume of a bar with rounded edges."""
    curve = np.column_stack([np.linspace(0, 10, 5), np.zeros(5), np.zeros(5)])
    assert 0.9 * 20 < volume_m3(strap(curve, 2, 1, 0)) < 20


def test_joined_solids_keep_their_faces() -> None:
    """Two joined boxes have the volume of both."""
    both = joined([box((0, 0, 0), (1, 1, 1), 0.001, 0), box((2, 0, 0), (3, 1, 1), 0.001, 1)])
    assert volume_m3(both) == pytest.approx(2, rel=0.01)
    assert set(both.finishes) == {0, 1}


def test_an_inset_moves_edges_not_corners() -> None:
    """The inscribed circle of a hexagon shrinks by exactly the inset."""
    assert inset(polygon(6, 5.0), 1.0) == pytest.approx(polygon(6, 4.0))
