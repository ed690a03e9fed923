"""Pegs: their meshes, and the outlines that labels take."""

import numpy as np

from farm.scene.clutter import Peg
from worker.clutter.peg import peg_outline, peg_solid

PEG = Peg(x_m=0.01, y_m=-0.02, diameter_m=0.012, height_m=0.04, colour=(200, 60, 20), pattern_seed=3)


def test_a_peg_stands_on_the_floor_and_is_as_high_and_wide_as_drawn() -> None:
    """Its mesh reaches from the floor to its height, and its radius from its axis."""
    solid, finishes = peg_solid(PEG)
    assert np.ptp(solid.vertices_m[:, 2]) == 0.04
    assert solid.vertices_m[:, 2].min() == 0.0
    assert np.isclose(np.linalg.norm(solid.vertices_m[:, :2], axis=1).max(), 0.006)
    assert set(solid.finishes.tolist()) == set(range(len(finishes)))


def test_the_faces_of_a_peg_look_outwards() -> None:
    """The volume that the faces enclose with the floor is above 0, and that of a cylinder but for the bevel."""
    solid, _ = peg_solid(PEG)
    corners = solid.vertices_m[solid.corners].reshape(-1, 4, 3)
    volume = sum(
        float(np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, k], corners[:, k + 1])).sum()) / 6
        for k in (1, 2)
    )
    assert 0.97 < volume / (np.pi * 0.006**2 * 0.04) < 1.0


def test_the_outline_is_that_of_the_mesh() -> None:
    """Cylinders end to end from the floor to the top, in the peg's place."""
    (shaft, radius), (edge, narrow) = peg_outline(PEG)
    assert np.allclose(shaft[:, :2], [0.01, -0.02])
    assert (shaft[0, 2], edge[-1, 2]) == (0.0, 0.04)
    assert shaft[-1, 2] == edge[0, 2]
    assert 0.9 * radius < narrow < radius == 0.006
