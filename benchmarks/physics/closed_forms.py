"""Reference solutions in closed form, or one root away from it. SI units."""

from dataclasses import dataclass
from functools import cache

import numpy as np
from scipy.optimize import brentq
from scipy.special import jn_zeros

STANDARD_GRAVITY_M_S2 = 9.80665
"""Standard acceleration of free fall, m/s^2."""


@dataclass(frozen=True, slots=True)
class Catenary:
    """A perfectly flexible cable hung between two points of one height: z = c cosh(x / c).

    A real cable approaches it where the slenderness rho g A L^3 / (E I) is above 1e4.

    Attributes:
        parameter_m: c, the horizontal tension divided by the weight per length.
        sag_m: depth of the lowest point below the ends.
    """

    parameter_m: float
    sag_m: float


def catenary(span_m: float, length_m: float) -> Catenary:
    """The catenary of given span D and length L: L = 2 c sinh(D / 2c), sag = c (cosh(D / 2c) - 1).

    Raises:
        ValueError: if the span isn't positive, or the length doesn't exceed it by at least a share of 1e-9.
    """
    if not (span_m > 0 and length_m >= span_m * (1 + 1e-9)):
        raise ValueError(f"no cable of {length_m:g} m hangs over a span of {span_m:g} m")
    ratio = length_m / span_m
    # With u = D / 2c: 1 + u^2/6 <= sinh(u)/u bounds u from above, and so does its growth like exp(u) / 2u.
    most = min(np.sqrt(6 * (ratio - 1)), 2 + 2 * np.log(2 * ratio))
    half = float(brentq(lambda u: np.sinh(u) / u - ratio, 0.1 * most, 1.001 * most, xtol=1e-15, rtol=1e-14))
    parameter = span_m / (2 * half)
    # 2 sinh(u / 2)^2 is cosh(u) - 1 without the loss of digits at small u.
    return Catenary(parameter_m=parameter, sag_m=parameter * 2 * float(np.sinh(half / 2)) ** 2)


@cache
def hanging_chain_frequency_rad_s(length_m: float, gravity_m_s2: float = STANDARD_GRAVITY_M_S2) -> float:
    """First angular frequency of a flexible cable hung at one end: (j / 2) sqrt(g / L), j the first zero of J0.

    j / 2 = 1.2024 (Daniel Bernoulli 1733).
    """
    return float(jn_zeros(0, 1)[0] / 2 * np.sqrt(gravity_m_s2 / length_m))


@cache
def cantilever_frequency_rad_s(bending_stiffness_n_m2: float, mass_per_length_kg_m: float, length_m: float) -> float:
    """First angular frequency of a beam clamped at one end, without gravity: b^2 sqrt(EI / (rho A L^4)).

    b is the first root of cos(b) cosh(b) = -1, b^2 = 3.5160 (Euler-Bernoulli).
    """
    root = float(brentq(lambda b: np.cos(b) * np.cosh(b) + 1, 1.5, 2.5, xtol=1e-14))
    return root**2 * float(np.sqrt(bending_stiffness_n_m2 / (mass_per_length_kg_m * length_m**4)))


def incline_acceleration_m_s2(slope_rad: float, friction: float, gravity_m_s2: float = STANDARD_GRAVITY_M_S2) -> float:
    """Acceleration of a straight cable released on a slope: g (sin a - mu cos a), or 0 where tan a <= mu (Coulomb)."""
    return max(0.0, gravity_m_s2 * float(np.sin(slope_rad) - friction * np.cos(slope_rad)))


def euler_fall_m(time_s: float, step_s: float, gravity_m_s2: float = STANDARD_GRAVITY_M_S2) -> float:
    """Drop in free fall from rest, exactly as semi-implicit Euler computes it: g t^2 (1 + h / t) / 2.

    The method updates the velocity first, then the position, which gives g h^2 (1 + 2 + ... + n) with t = n h. So the
    error is of first order, +g t h / 2.
    """
    return gravity_m_s2 * time_s * (time_s + step_s) / 2
