"""Weaves plans of cables over and under each other: finds heights along them with the least bending. Pure numpy.

The heights of each cable are a cubic spline, and bending and the gaps at all meetings are a convex quadratic program:
least energy with linear inequalities, which is a problem of least distance (Lawson and Hanson 1974, "Solving Least
Squares Problems", ch. 23).
"""

import itertools
from collections.abc import Collection, Sequence
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

_GIVE = 0.5
"""Share of a meeting's gap that the one strand makes; its partner makes the rest."""

_AT_ONCE = 8
"""Meetings that may give way for each of them that does before the next attempt."""


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


def weave(plans: Sequence[Plan], meetings: Sequence[Meeting], over: Sequence[bool]) -> Weave | None:
    """Find the heights with the least bending at which every meeting has its gap.

    Args:
        plans: the plans.
        meetings: all meetings of the plans.
        over: for each meeting, whether its first strand is over the second.

    Returns:
        The heights, or None if no heights keep all gaps.
    """
    bases = [_basis(plan) for plan in plans]
    first = _solve(plans, bases, meetings, over, None)
    if first is None:
        return None
    steeper = _slants(bases, meetings, first)
    leans = bool((steeper > _LEAN).any())
    heights = _solve(plans, bases, meetings, over, steeper) if leans else first
    return None if heights is None else _finished(plans, bases, heights)


def _slants(bases: Sequence[CubicSpline], meetings: Sequence[Meeting], heights: Sequence[Array]) -> Array:
    """Compute for each pair of places by how much their slopes bring the strands nearer than their heights are.

    Two lines that cross in plan view at a right angle, with slopes a and b, are as far apart as their heights over
    sqrt(1 + a^2 + b^2).
    """
    slopes = [
        (bases[each.one](each.one_m, 1) @ heights[each.one], bases[each.other](each.other_m, 1) @ heights[each.other])
        for each in meetings
    ]
    slants: Array = np.concatenate([np.sqrt(1 + one**2 + other**2) for one, other in slopes] or [np.ones(0)])
    return slants


def _solve(
    plans: Sequence[Plan],
    bases: Sequence[CubicSpline],
    meetings: Sequence[Meeting],
    over: Sequence[bool],
    wider: Array | None,
) -> list[Array] | None:
    """Find the heights of each cable with the least bending, with gaps that are wider by factors (pairs of places,)."""
    starts = np.concatenate([[0], np.cumsum([knots_of(plan) for plan in plans])])
    unit_m = float(np.mean([plan.radius_m for plan in plans]))
    rows = sum(len(meeting.one_m) for meeting in meetings)
    constraints, gaps = np.zeros((rows, starts[-1])), np.zeros(rows)
    row = 0
    for meeting, is_over in zip(meetings, over, strict=True):
        here = slice(row, row + len(meeting.one_m))
        sign = 1.0 if is_over else -1.0
        one, other = (slice(starts[k], starts[k + 1]) for k in (meeting.one, meeting.other))
        constraints[here, one] += sign * bases[meeting.one](meeting.one_m)
        constraints[here, other] -= sign * bases[meeting.other](meeting.other_m)
        gaps[here] = GAP * (plans[meeting.one].radius_m + plans[meeting.other].radius_m) / unit_m
        row = here.stop
    if wider is not None:
        gaps *= wider
    factors = [np.linalg.cholesky(_energy(plan, basis)) for plan, basis in zip(plans, bases, strict=True)]
    factors = [factor * weight for factor, weight in zip(factors, _weights(plans), strict=True)]
    scaled = np.empty_like(constraints)
    for k, factor in enumerate(factors):
        part = slice(starts[k], starts[k + 1])
        scaled[:, part] = solve_triangular(factor, constraints[:, part].T, lower=True).T
    distance = _least_distance(scaled, gaps)
    if distance is None:
        return None
    return [
        unit_m * solve_triangular(factor, distance[starts[k] : starts[k + 1]], lower=True, trans="T")
        for k, factor in enumerate(factors)
    ]


def _finished(plans: Sequence[Plan], bases: Sequence[CubicSpline], heights: Sequence[Array]) -> Weave:
    """Turn heights of centrelines to those of undersides, lift them so that the lowest is at 0, and measure slopes."""
    heights = [height - plan.radius_m for plan, height in zip(plans, heights, strict=True)]
    places = [np.linspace(0.0, plan.length_m, 4 * knots_of(plan)) for plan in plans]
    values = [basis(place) @ height for basis, place, height in zip(bases, places, heights, strict=True)]
    lowest = min(min(float(value.min()), float(each.min())) for value, each in zip(values, heights, strict=True))
    slopes = [np.abs(basis(place, 1) @ height) for basis, place, height in zip(bases, places, heights, strict=True)]
    return Weave(
        heights_m=tuple(height - lowest for height in heights),
        slopes=tuple(float(slope.max()) for slope in slopes),
        steepest_m=tuple(float(place[int(slope.argmax())]) for place, slope in zip(places, slopes, strict=True)),
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


def weave_near(
    plans: Sequence[Plan],
    meetings: Sequence[Meeting],
    wanted: Sequence[bool],
    safe: Sequence[bool],
    firm: Collection[int] = (),
) -> tuple[Weave, tuple[bool, ...]] | None:
    """Weave as wanted, but give way to a safe choice, meeting by meeting, where a cable would be too steep.

    Args:
        plans: the plans.
        meetings: all meetings of the plans.
        wanted: for each meeting, whether its first strand is to be over the second.
        safe: a choice of the same kind that needs no steep cables, such as an order of the cables.
        firm: numbers of the meetings that must stay as wanted.

    Returns:
        The heights and the choice that they follow; None if all that may give way has, and one is too steep still.
    """
    chosen = list(wanted)
    given_way = [k in firm or want == safe[k] for k, want in enumerate(wanted)]
    lifts = [_GIVE * GAP * (plans[meeting.one].radius_m + plans[meeting.other].radius_m) for meeting in meetings]
    while True:
        culprit, slope = _steepest_step(meetings, chosen, given_way, lifts)
        if culprit is None or slope <= STEEPEST:
            break
        chosen[culprit], given_way[culprit] = safe[culprit], True
    while True:
        found = weave(plans, meetings, chosen)
        if found is not None and max(found.slopes, default=0.0) <= STEEPEST:
            return found, tuple(chosen)
        if all(given_way):
            return None
        for _ in range(max(1, given_way.count(False) // _AT_ONCE)):
            culprit = _nearest(meetings, given_way, found)
            if culprit is None:
                culprit, _ = _steepest_step(meetings, chosen, given_way, lifts)
            if culprit is None:
                culprit = given_way.index(False)
            chosen[culprit], given_way[culprit] = safe[culprit], True


def _steepest_step(
    meetings: Sequence[Meeting], chosen: Sequence[bool], given_way: Sequence[bool], lifts: Sequence[float]
) -> tuple[int | None, float]:
    """Find the meeting, of those that may give way, whose neighbour on a strand asks for the steepest step to it.

    A strand that is over at one meeting and under at the next rises by half of either's gap from the end of one to the
    beginning of the other.
    """
    strands: dict[int, list[tuple[float, float, int, bool]]] = {}
    for number, (meeting, is_over) in enumerate(zip(meetings, chosen, strict=True)):
        for cable, places, above in (
            (meeting.one, meeting.one_m, is_over),
            (meeting.other, meeting.other_m, not is_over),
        ):
            strands.setdefault(cable, []).append((float(places.min()), float(places.max()), number, above))
    worst: tuple[int | None, float] = (None, 0.0)
    for along in strands.values():
        along.sort()
        for (_, end, before, was_above), (start, _, after, above) in itertools.pairwise(along):
            free = [number for number in (before, after) if not given_way[number]]
            if was_above == above or not free:
                continue
            rise = (lifts[before] + lifts[after]) / 2
            slope = rise / max(start - end, 1e-3 * rise)
            if slope > worst[1]:
                worst = (free[-1], slope)
    return worst


def _nearest(meetings: Sequence[Meeting], given_way: Sequence[bool], found: Weave | None) -> int | None:
    """Find the meeting, of those that may give way, that is nearest to the steepest place of all cables."""
    if found is None:
        return None
    cable = int(np.argmax(found.slopes))
    place = found.steepest_m[cable]
    away = {
        number: min(
            float(np.abs(places - place).min())
            for k, places in ((meeting.one, meeting.one_m), (meeting.other, meeting.other_m))
            if k == cable
        )
        for number, meeting in enumerate(meetings)
        if not given_way[number] and cable in {meeting.one, meeting.other}
    }
    return min(away, key=lambda number: away[number]) if away else None
