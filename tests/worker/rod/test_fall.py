"""How a drawn cable becomes a rod."""

import pytest

from worker.rod.fall import FINEST_RADII, segment_m

RADIUS_M = 0.0015


def test_segments_of_a_cable_are_so_many_radii_long() -> None:
    """A cable of 1e7 Pa bends under its weight over (1e7 r^2 / 4 rho g)^(1/3), 49 radii."""
    assert segment_m(RADIUS_M, 1e7, 1500.0, segment_radii=4.0) == pytest.approx(4 * RADIUS_M)


def test_what_bends_more_tightly_has_shorter_segments() -> None:
    """Half of (E r^2 / 4 rho g)^(1/3): here six radii, if E = 4 rho g r 6^3."""
    modulus = 4 * 1500.0 * 9.81 * RADIUS_M * 6**3
    assert segment_m(RADIUS_M, modulus, 1500.0, segment_radii=4.0) == pytest.approx(3 * RADIUS_M)


def test_segments_have_a_least_length() -> None:
    """However soft a rod is."""
    assert segment_m(RADIUS_M, 1.0, 1500.0, segment_radii=4.0) == pytest.approx(FINEST_RADII * RADIUS_M)
