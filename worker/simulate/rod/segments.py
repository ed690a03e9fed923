"""The length of a rod's segments."""

import numpy as np

from farm.scene.physics import GRAVITY_M_S2
from worker.simulate.rod.model import Array

FINEST_RADII = 2.0
"""Length of the shortest segments, in radii."""

KNOT_RADII = 4.0
"""Length of the longest segments of a knotted cable, in radii: a knot's loop may have a radius of a few."""

MOST_TURN_RAD = 0.5
"""Largest angle between two segments of a cable at its start. In tight coils, contact between longer ones errs by some
hundredths of the radius."""


def segment_m(radius_m: float, youngs_modulus_pa: float, density_kg_m3: float, segment_radii: float) -> float:
    """Choose the length of a rod's segments, in metres.

    It is `segment_radii` radii, or half the length over which the rod bends under its weight, (EI / rho g A)^(1/3), if
    that is less: that length is below twelve radii for thick cables of the softest materials alone.

    Args:
        radius_m: radius of the rod, in metres.
        youngs_modulus_pa: Young's modulus, in pascals.
        density_kg_m3: density, in kg/m3.
        segment_radii: length of the segments of most rods, in radii.
    """
    bending_m = (youngs_modulus_pa * radius_m**2 / (4 * density_kg_m3 * GRAVITY_M_S2)) ** (1 / 3)
    return float(min(segment_radii * radius_m, max(bending_m / 2, FINEST_RADII * radius_m)))


def largest_turn_rad(nodes: Array) -> float:
    """Compute the largest angle between two segments of a line of nodes, (N, 3), in radians."""
    edges = np.diff(nodes, axis=0)
    across = np.linalg.norm(np.cross(edges[:-1], edges[1:]), axis=1)
    along = np.einsum("ij,ij->i", edges[:-1], edges[1:])
    return float(np.arctan2(across, along).max())
