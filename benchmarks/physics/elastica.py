"""A cable clamped at one end that bends under its own weight: the heavy elastica.

With s the arc length over the length, from the clamp, and theta the slope below the horizontal,

    theta'' = -G (1 - s) cos(theta),    theta(0) = 0,    theta'(1) = 0,    G = rho g A L^3 / (E I).

The tip then lies W = integral of cos(theta) outwards and H = integral of sin(theta) downwards, both as shares of the
length. H/W as a function of G is the cantilever master curve of Romero et al. 2021, "Physical validation of simulators
in computer graphics".
"""

from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_bvp

LEAST_SLENDERNESS = 0.01
"""Least slenderness G, without unit: below it H/W is practically G/8."""
MOST_SLENDERNESS = 1e4
"""Largest slenderness G, without unit: above it the cable hangs almost straight down."""

_NEARLY_STRAIGHT = 2.0
"""Slenderness up to which the solution for small slopes is a good enough first guess."""
_CONTINUATION = 4.0
"""Factor between a slenderness and the lower one whose solution is its first guess."""
_TOLERANCE = 1e-8
"""Relative tolerance of the solver's residuals."""


def droop_ratio(slenderness: float) -> float:
    """H/W of the tip; G/8 for small G, sqrt(G/2) for large.

    Args:
        slenderness: slenderness G, without unit, 0.01 to 1e4.

    Raises:
        ValueError: if the slenderness is outside its range.
    """
    out, down = drooping_shape(slenderness, np.ones(1))[0]
    return float(down / out)


def drooping_shape(slenderness: float, arc: NDArray[np.float64]) -> NDArray[np.float64]:
    """The shape of the whole cable.

    Args:
        slenderness: slenderness G, without unit, 0.01 to 1e4.
        arc: arc lengths from the clamp as shares of the length, (N,), 0 to 1.

    Returns:
        Distances outwards and downwards of each point, as shares of the length, (N, 2).

    Raises:
        ValueError: if the slenderness is outside its range.
    """
    if not LEAST_SLENDERNESS <= slenderness <= MOST_SLENDERNESS:
        raise ValueError(f"slenderness {slenderness:g} is not within {LEAST_SLENDERNESS:g} to {MOST_SLENDERNESS:g}")
    state: NDArray[np.float64] = _solve(float(slenderness)).sol(arc)
    return state[2:].T


@cache
def _solve(slenderness: float) -> Any:
    """Solve the boundary value problem in theta, theta', x and z, by continuation from less slender cables."""

    def rates(s: NDArray[np.float64], state: NDArray[np.float64]) -> NDArray[np.float64]:
        theta, bend = state[0], state[1]
        return np.stack([bend, -slenderness * (1 - s) * np.cos(theta), np.cos(theta), np.sin(theta)])

    def ends(clamp: NDArray[np.float64], tip: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.array([clamp[0], tip[1], clamp[2], clamp[3]])

    if slenderness <= _NEARLY_STRAIGHT:
        s = np.linspace(0, 1, 33)
        theta = slenderness * (1 - (1 - s) ** 3) / 6
        guess = np.stack([theta, slenderness * (1 - s) ** 2 / 2, s, np.zeros_like(s)])
    else:
        nearby = _solve(slenderness / _CONTINUATION)
        s, guess = nearby.x, nearby.y
    solution = solve_bvp(rates, ends, s, guess, tol=_TOLERANCE, max_nodes=100_000)
    if not solution.success:
        raise ArithmeticError(f"the elastica of slenderness {slenderness:g} was not solved: {solution.message}")
    return solution
