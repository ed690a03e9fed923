"""The length of a rod's segments."""

import numpy as np

from farm.scene.physics import GRAVITY_M_S2
from worker.simulate.rod.model import Array

FINEST_RADII = 2.0
"""Length of the shortest segments, in radii."""

LONGER = 1.5
"""Ratio of the length of segments to the length asked for, where nothing asks for shorter ones."""

LONGEST_RADII = 6.0
"""Length of the longest segments, in radii, unless longer ones are asked for."""

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


def longest_radii(segment_radii: float) -> float:
    """Compute the length of a gently curved rod's segments, in radii, from the length asked for.

    Contacts lie on smooth curves, so segments need not be that short: at 6 radii instead of 4, the textbook's errors
    double and stay within their gates, and a fall costs half.
    """
    return max(segment_radii, min(LONGER * segment_radii, LONGEST_RADII))


def largest_turn_rad(nodes: Array) -> float:
    """Compute the largest angle between two segments of a line of nodes, (N, 3), in radians."""
    edges = np.diff(nodes, axis=0)
    across = np.linalg.norm(np.cross(edges[:-1], edges[1:]), axis=1)
    along = np.einsum("ij,ij->i", edges[:-1], edges[1:])
    return float(np.arctan2(across, along).max())
