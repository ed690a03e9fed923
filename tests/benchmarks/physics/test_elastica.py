"""The heavy elastica against its limits and published values."""

import numpy as np
import pytest

from benchmarks.physics.elastica import droop_ratio, drooping_shape


@pytest.mark.parametrize(
    ("slenderness", "ratio"),
    [
        (0.1, 0.01250),
        (1, 0.12456),
        (5, 0.58572),
        (10, 1.06680),
        (20, 1.86393),
        (50, 3.70556),
        (100, 5.88810),
        (1000, 21.3354),
    ],
)
def test_the_master_curve_is_met(slenderness: float, ratio: float) -> None:
    """H/W equals the published table to its digits."""
    assert droop_ratio(slenderness) == pytest.approx(ratio, abs=5.1e-6 if slenderness < 1000 else 5.1e-5)


def test_a_stiff_cantilever_droops_by_an_eighth_of_its_slenderness() -> None:
    """For small slopes H/W is G/8; the next term is of third order."""
    assert droop_ratio(0.01) == pytest.approx(0.01 / 8, rel=1e-5)


def test_a_slender_cantilever_hangs_like_a_chain() -> None:
    """H/W approaches sqrt(G/2) from below, by about 1/sqrt(G)."""
    assert droop_ratio(1e4) == pytest.approx(np.sqrt(1e4 / 2), rel=2 / np.sqrt(1e4))


@pytest.mark.parametrize("slenderness", [0.01, 3.0, 1e4])
def test_the_shape_has_its_length(slenderness: float) -> None:
    """The chords of a fine sampling add up to one, and the shape starts level."""
    points = drooping_shape(slenderness, np.linspace(0, 1, 20_001))
    steps = np.diff(points, axis=0)
    assert np.linalg.norm(steps, axis=1).sum() == pytest.approx(1, abs=1e-6)
    assert abs(steps[0, 1]) < 0.01 * steps[0, 0]


@pytest.mark.parametrize("slenderness", [0.3, 7.0, 300.0])
def test_the_weight_beyond_balances_the_moment(slenderness: float) -> None:
    """At the clamp theta' is G times the mean lever arm, an integral over the shape."""
    arc = np.linspace(0, 1, 4001)
    out, _ = drooping_shape(slenderness, arc).T
    step = 1e-5
    first = drooping_shape(slenderness, np.array([step]))[0]
    bend = 2 * first[1] / step**2
    lever = np.sum((out[1:] + out[:-1]) / 2) / 4000
    assert bend == pytest.approx(slenderness * lever, rel=1e-3)


@pytest.mark.parametrize("slenderness", [0.001, 1e5, float("nan")])
def test_a_slenderness_outside_the_range_is_refused(slenderness: float) -> None:
    """A slenderness outside the range is refused, and NaN too."""
    with pytest.raises(ValueError, match="slenderness"):
        droop_ratio(slenderness)
