"""Closed forms against their identities."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from benchmarks.physics.closed_forms import (
    STANDARD_GRAVITY_M_S2,
    cantilever_frequency_rad_s,
    catenary,
    euler_fall_m,
    hanging_chain_frequency_rad_s,
    incline_acceleration_m_s2,
)


@given(span=st.floats(1e-3, 100), slack=st.floats(1e-8, 1e4))
def test_the_catenary_has_its_length_and_sag(span: float, slack: float) -> None:
    """Length, sag and parameter fulfil L^2 = (2 sag + 2 c)^2 - (2 c)^2, whatever the span."""
    length = span * (1 + slack)
    found = catenary(span, length)
    assert 4 * found.sag_m * (found.sag_m + 2 * found.parameter_m) == pytest.approx(length**2, rel=1e-9)
    assert 2 * found.parameter_m * np.sinh(span / (2 * found.parameter_m)) == pytest.approx(length, rel=1e-9)


def test_a_shallow_catenary_is_a_parabola() -> None:
    """A shallow catenary has L = D + 8 sag^2 / 3 D."""
    assert catenary(1.0, 1 + 8 / 3 * 0.01**2).sag_m == pytest.approx(0.01, rel=1e-3)


def test_a_taut_cable_hangs_in_no_catenary() -> None:
    """A length that doesn't exceed the span is refused."""
    with pytest.raises(ValueError, match="hangs"):
        catenary(1.0, 1.0)


def test_first_frequencies_have_their_known_factors() -> None:
    """The factors are 1.2024 for the chain and 3.516 for the cantilever."""
    assert hanging_chain_frequency_rad_s(9.81, 9.81) == pytest.approx(1.2024, abs=5e-5)
    assert cantilever_frequency_rad_s(2.0, 2.0, 1.0) == pytest.approx(3.516, abs=5e-4)


def test_a_cable_slides_where_the_slope_is_steeper_than_friction_holds() -> None:
    """A cable doesn't slide at tan a <= mu, and slides freely without friction."""
    assert incline_acceleration_m_s2(np.arctan(0.39), 0.4) == 0
    assert incline_acceleration_m_s2(np.arctan(0.41), 0.4) > 0
    assert incline_acceleration_m_s2(np.pi / 6, 0.0) == pytest.approx(STANDARD_GRAVITY_M_S2 / 2)


@given(steps=st.integers(1, 500), step=st.floats(1e-5, 1e-2))
def test_the_fall_is_that_of_the_scheme_step_by_step(steps: int, step: float) -> None:
    """The closed form equals a sum over steps that update the velocity first, then the position."""
    speed = drop = 0.0
    for _ in range(steps):
        speed += STANDARD_GRAVITY_M_S2 * step
        drop += speed * step
    assert euler_fall_m(steps * step, step) == pytest.approx(drop, rel=1e-9)
