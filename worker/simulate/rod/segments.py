"""The length of a rod's segments."""

from farm.scene.physics import GRAVITY_M_S2

FINEST_RADII = 2.0
"""Length of the shortest segments, in radii."""


def segment_m(radius_m: float, youngs_modulus_pa: float, density_kg_m3: float, segment_radii: float) -> float:
    """Choose the length of a rod's segments, in metres.

    It is `segment_radii` radii, or half the length over which the rod bends under its weight, (EI / rho g A)^(1/3), if
    that is less. That length is below eight radii only for rods much softer than any cable.

    Args:
        radius_m: radius of the rod, in metres.
        youngs_modulus_pa: Young's modulus, in pascals.
        density_kg_m3: density, in kg/m3.
        segment_radii: length of the segments of most rods, in radii.
    """
    bending_m = (youngs_modulus_pa * radius_m**2 / (4 * density_kg_m3 * GRAVITY_M_S2)) ** (1 / 3)
    return float(min(segment_radii * radius_m, max(bending_m / 2, FINEST_RADII * radius_m)))
