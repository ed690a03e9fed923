"""The tightening of an overhand knot against Audoly, Clauvelin and Neukirch (2007); see `benchmarks.physics.knots`."""

from functools import cache

import pytest

from benchmarks.physics.knots import Pulled, pull


@cache
def pulled(asked: float, friction: float = 0.0) -> Pulled:
    """A knot at rest, which several tests look at."""
    return pull(asked, friction)


@pytest.mark.parametrize("asked", [20.0, 40.0])
def test_a_knot_without_friction_has_the_loop_that_its_pull_balances(asked: float) -> None:
    """T R^2 / B = 1/2 + O(h / R): the first neglected term counts once; segments of 0.45 sqrt(h R) add 3 % of it."""
    knot = pulled(asked)
    assert knot.pull == pytest.approx(0.5, abs=1 / knot.loop)


@pytest.mark.parametrize("asked", [20.0, 40.0])
def test_a_loop_bends_most_where_it_leaves_the_braid(asked: float) -> None:
    """Half the spread of its curvature, over the mean, is 0.94 e (1 + O(e)), e = sqrt(h / R)."""
    knot = pulled(asked)
    assert knot.spread == pytest.approx(knot.spread_in_theory, rel=knot.e)


@pytest.mark.parametrize("friction", [0.05, -0.05])
def test_friction_holds_a_knot_that_tightens_or_opens(friction: float) -> None:
    """T R^2 / B = 1/2 +- mu sigma / e, sigma = 0.492, with mu < e / 4.

    The first neglected terms are that of h / R in bending, which counts once, and that of e in friction, about
    mu sigma, which counts twice.
    """
    knot = pulled(20.0, friction)
    assert knot.pull == pytest.approx(knot.pull_in_theory, abs=1 / knot.loop + abs(friction))
