"""Strands around each other: they stay within their circle, beside each other, and turn."""

import numpy as np
import pytest
from scipy.spatial.distance import cdist

from farm.scene.cable import envelope_ratio
from worker.cable.strands import places, strand_radius, turning

COUNTS = range(2, 8)


@pytest.mark.parametrize("count", COUNTS)
def test_strands_touch_and_do_not_overlap(count: int) -> None:
    """The closest two middles are one diameter apart."""
    middles = places(count)
    distances = cdist(middles, middles)[np.triu_indices(count, 1)]
    assert len(middles) == count
    assert distances.min() == pytest.approx(2.0)


@pytest.mark.parametrize("count", COUNTS)
def test_strands_lie_within_their_circle_and_reach_it(count: int) -> None:
    """The outermost strand touches the circle from within."""
    assert np.linalg.norm(places(count), axis=1).max() + 1.0 == pytest.approx(envelope_ratio(count))


@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.parametrize("lay_diameters", [4.0, -15.0, 40.0])
def test_turning_strands_do_not_cut_each_other(count: int, lay_diameters: float) -> None:
    """Finely sampled points of two neighbours are never closer than a diameter, and hardly farther."""
    reach_m = 0.003
    lay_m = lay_diameters * 2 * reach_m
    radius_m = strand_radius(count, 1.0, reach_m, lay_m)
    arc = np.linspace(0.0, abs(lay_m), 2001)
    curve = np.stack([arc, np.zeros_like(arc), np.full_like(arc, reach_m)], axis=1)
    offsets = places(count) * strand_radius(count, 1.0, reach_m, 0.0)
    lines = turning(curve, offsets, arc, lay_m, 30.0)
    nearest = min(cdist(a[900:1100], b).min() for i, a in enumerate(lines) for b in lines[:i])
    assert 2 * radius_m <= nearest * (1 + 1e-4)
    assert 2 * radius_m >= 0.9 * nearest


def test_a_strand_comes_back_after_its_lay() -> None:
    """After its lay a strand is at the same place beside the centreline."""
    arc = np.linspace(0.0, 0.2, 201)
    curve = np.stack([arc, np.zeros_like(arc), np.zeros_like(arc)], axis=1)
    line = turning(curve, places(2) * 0.001, arc, 0.1, 0.0)[0]
    assert line[0, 1:] == pytest.approx(line[100, 1:], abs=1e-9)
    assert line[0, 1:] == pytest.approx(-line[50, 1:], abs=1e-9)


def test_strands_that_do_not_turn_keep_their_sides() -> None:
    """With a lay of 0 strands don't turn."""
    arc = np.linspace(0.0, 0.2, 201)
    curve = np.stack([arc, np.zeros_like(arc), np.zeros_like(arc)], axis=1)
    line = turning(curve, places(3) * 0.001, arc, 0.0, 50.0)[1]
    assert np.ptp(line[:, 1:], axis=0) == pytest.approx([0.0, 0.0], abs=1e-12)


def test_thin_strands_stay_thin() -> None:
    """An envelope with room to spare makes no strand thicker."""
    assert strand_radius(3, 0.0005, 0.01, 0.0) == 0.0005
