"""Weaves plans of cables over and under each other: finds heights along them with the least bending. Pure numpy.

The heights of each cable are a cubic spline, and bending and the gaps at all meetings are a convex quadratic program:
least energy with linear inequalities, which is a problem of least distance (Lawson and Hanson 1974, "Solving Least
Squares Problems", ch. 23).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.linalg import solve_triangular
from scipy.optimize import nnls

from worker.sample.meetings import Array, Meeting, Plan

GAP = 1.2
"""Least difference of height where plans meet, in sums of the two radii."""

STEEPEST = 0.6
"""Steepest slope of a woven cable, as rise over distance in plan view."""

KNOT_RADII = 6.0
"""Distance of the heights that describe a cable, in radii of the cable."""

_KNOTS = (9, 97)
"""Fewest and most heights of a cable."""

_BED_RADII = 40.0
"""Length, in radii, over which a woven cable comes back to the common level: that of a beam on an elastic bed."""

_STIFFEST = 30.0
"""Largest ratio of stiffness that decides which of two cables gives way more."""

_LEAN = 1.05
"""Factor by which slopes bring strands nearer, from which on gaps are made wider by it."""


@dataclass(frozen=True, slots=True)
class Weave:
    """Heights of woven cables.

    Attributes:
        heights_m: for each cable (K,) metres, heights of its underside at equally spaced places from end to end; the
            lowest of all is at 0.
        slopes: for each cable, its steepest slope.
        steepest_m: for each cable, the place along it with that slope, in metres.
    """

    heights_m: tuple[Array, ...]
    slopes: tuple[float, ...]
    steepest_m: tuple[float, ...]


def knots_of(plan: Plan) -> int:
    """Count the heights that describe a cable."""
    return int(np.clip(round(plan.length_m / (KNOT_RADII * plan.radius_m)), *_KNOTS))


def knot_spacings_m(plans: Sequence[Plan]) -> list[float]:
    """Compute for each plan the distance of its heights along it, in metres."""
    return [plan.length_m / (knots_of(plan) - 1) for plan in plans]


class Loom:
    """Finds heights for one diagram, whatever is chosen to be over and under in it."""

    def __init__(self, plans: Sequence[Plan], meetings: Sequence[Meeting]) -> None:
        """Set up the parts of the program that no choice changes.

        Args:
            plans: the plans.
            meetings: all meetings of the plans.
        """
        self._plans, self._meetings = plans, meetings
        self._bases = [_basis(plan) for plan in plans]
        self._starts = np.concatenate([[0], np.cumsum([knots_of(plan) for plan in plans])])
        self._unit_m = float(np.mean([plan.radius_m for plan in plans]))
        self._factors = [
            weight * np.linalg.cholesky(_energy(plan, basis))
            for plan, basis, weight in zip(plans, self._bases, _weights(plans), strict=True)
        ]
        self._pairs = np.array([len(each.one_m) for each in meetings], np.int64)
        both = [plans[each.one].radius_m + plans[each.other].radius_m for each in meetings]
        self._gaps = np.repeat(GAP / self._unit_m * np.array(both), self._pairs)
        self._rises = self._scaled(self._above())
        self._slopes = [
            (self._bases[each.one](each.one_m, 1), self._bases[each.other](each.other_m, 1)) for each in meetings
        ]

    def weave(self, over: Sequence[bool]) -> Weave | None:
        """Find the heights with the least bending at which every meeting has its gap.

        Args:
            over: for each meeting, whether its first strand is over the second.

        Returns:
            The heights, or None if no heights keep all gaps.
        """
        signs = np.repeat(np.where(np.array(over, np.bool_), 1.0, -1.0), self._pairs)
        level = self._solve(signs, self._gaps)
        if level is None:
            return None
        woven, slants = self._finished(level), self._slants(level)
        if max(woven.slopes) > STEEPEST or not bool((slants > _LEAN).any()):
            return woven
        wider = self._solve(signs, slants * self._gaps)
        return None if wider is None else self._finished(wider)

    def _above(self) -> Array:
        """Matrix (pairs, heights) of the height of each meeting's first strand above its second."""
        rows = np.zeros((int(self._pairs.sum()), int(self._starts[-1])))
        row = 0
        for each in self._meetings:
            here = slice(row, row + len(each.one_m))
            rows[here, self._part(each.one)] += self._bases[each.one](each.one_m)
            rows[here, self._part(each.other)] -= self._bases[each.other](each.other_m)
            row = here.stop
        return rows

    def _part(self, cable: int) -> slice:
        return slice(int(self._starts[cable]), int(self._starts[cable + 1]))

    def _scaled(self, rows: Array) -> Array:
        """Write the rows for unknowns whose sum of squares is the energy."""
        scaled = np.empty_like(rows)
        for cable, factor in enumerate(self._factors):
            part = self._part(cable)
            scaled[:, part] = solve_triangular(factor, rows[:, part].T, lower=True).T
        return scaled

    def _solve(self, signs: Array, gaps: Array) -> list[Array] | None:
        """Find the heights of each cable's centreline, in metres."""
        distance = _least_distance(signs[:, None] * self._rises, gaps)
        if distance is None:
            return None
        return [
            self._unit_m * solve_triangular(factor, distance[self._part(cable)], lower=True, trans="T")
            for cable, factor in enumerate(self._factors)
        ]

    def _slants(self, heights: Sequence[Array]) -> Array:
        """Compute for each pair of places by how much slopes bring the strands nearer than their heights are.

        Two lines that cross in plan view at a right angle, with slopes a and b, are as far apart as their heights over
        sqrt(1 + a^2 + b^2).
        """
        slants = [
            np.sqrt(1 + (one @ heights[each.one]) ** 2 + (other @ heights[each.other]) ** 2)
            for each, (one, other) in zip(self._meetings, self._slopes, strict=True)
        ]
        return np.concatenate([*slants, np.ones(0)])

    def _finished(self, heights: Sequence[Array]) -> Weave:
        """Turn heights of centrelines to those of undersides, the lowest at 0, and measure slopes."""
        parts = [
            (basis, np.linspace(0.0, plan.length_m, 4 * knots_of(plan)), height - plan.radius_m)
            for plan, basis, height in zip(self._plans, self._bases, heights, strict=True)
        ]
        lowest = min(float(min((basis(place) @ height).min(), height.min())) for basis, place, height in parts)
        slopes = [np.abs(basis(place, 1) @ height) for basis, place, height in parts]
        return Weave(
            heights_m=tuple(height - lowest for _, _, height in parts),
            slopes=tuple(float(slope.max()) for slope in slopes),
            steepest_m=tuple(
                float(place[int(slope.argmax())]) for (_, place, _), slope in zip(parts, slopes, strict=True)
            ),
        )


def _basis(plan: Plan) -> CubicSpline:
    """The spline of each height of a cable, as one function of the place along it: (K,) metres to (K, heights)."""
    knots = np.linspace(0.0, plan.length_m, knots_of(plan))
    return CubicSpline(knots, np.eye(len(knots)), bc_type="natural")


def _energy(plan: Plan, basis: CubicSpline) -> Array:
    """The energy of bending and of the bed, as a matrix (heights, heights): integral of (b^4 z''^2 + z^2) over b."""
    bed = _BED_RADII * plan.radius_m
    spacing = plan.length_m / (knots_of(plan) - 1)
    # Two of Gauss's points in each span are exact for z''^2, the square of a straight line.
    middles = spacing * (np.arange(knots_of(plan) - 1) + 0.5)
    places = np.concatenate([middles - spacing / np.sqrt(12), middles + spacing / np.sqrt(12)])
    bend, height = basis(places, 2), basis(places)
    energy: Array = spacing / (2 * bed) * (bed**4 * bend.T @ bend + height.T @ height)
    return energy


def _weights(plans: Sequence[Plan]) -> Array:
    stiffness = np.array([plan.stiffness for plan in plans])
    stiffness = np.clip(stiffness / np.median(stiffness), 1 / _STIFFEST, _STIFFEST)
    weights: Array = np.sqrt(stiffness)
    return weights


def _least_distance(constraints: Array, gaps: Array) -> Array | None:
    """Find the shortest x (N,) with `constraints` (K, N) @ x >= `gaps` (K,); None if there is none."""
    if len(gaps) == 0:
        return np.zeros(constraints.shape[1])
    matrix = np.vstack([constraints.T, gaps])
    wanted = np.zeros(len(matrix))
    wanted[-1] = 1.0
    try:
        dual, _ = nnls(matrix, wanted)
    except RuntimeError:
        return None
    rest = matrix @ dual - wanted
    if -rest[-1] < 1e-9:
        return None
    shortest: Array = rest[:-1] / -rest[-1]
    return shortest if bool((constraints @ shortest >= gaps - 1e-4).all()) else None
