"""Samples the diagrams of tangles: where cables run in plan view, and what passes over what."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from farm.scene.cable import Cable
from farm.scene.clutter import Peg
from farm.spec.ranges.tangle import TangleRanges
from worker.sample.diagram import Choice, Diagram, plan_of, turned
from worker.sample.meetings import Array, Meeting
from worker.sample.values import chance, level, log_uniform, pattern_seed, rgb, uniform

_HEAP_KNOTS = 13
"""Number of equally spaced points at which the curvature of a heap's cables is sampled."""

_TIGHTEST_DIAMETERS = 4.0
"""Least radius of a bend, in diameters of the cable."""

_REACH = 0.15
"""Largest distance of what makes a tangle from the picture's middle along each axis, as a share of its shorter edge."""

_LOOSE_DIAMETERS = (3.0, 6.0)
"""Distance of the cables of a bundle that others run through, in mean diameters: nearer ones can't pass over one and
under the next."""

_TIGHT_DIAMETERS = (1.15, 2.0)
"""Distance of the cables of a bundle that is all over or all under another, in mean diameters."""

_STRAY_DEG = 4.0
"""Standard deviation of the bearings of a bundle's cables, in degrees."""

_LOOP_TURNS = (0.75, 1.1)
"""Turns of a loop that is threaded: with less than one its ends cross in an open angle."""

_LOOP_ROOM_RADII = 12.0
"""Least length of a cable with such a loop, in radii of the loop: its circumference, and as much for its ends."""

_WIDEST_LOOP = 0.2
"""Largest radius of such a loop, as a share of the picture's shorter edge; a thick cable's may be wider."""

_CURL_KNOTS = (33, 257)
"""Fewest and most points that describe the curvature of a cable with a loop, or one that runs round a peg."""

_WIDEST_PEG = 0.12
"""Largest diameter of a peg, as a share of the picture's shorter edge."""

_PEG_ROOM = 0.15
"""Air between a peg and the cables about it at the start, in radii of the cable."""

_PUSHES = 6
"""Times that a cable is pushed away from a peg before another diagram is drawn."""


def heap_up(ranges: TangleRanges, cables: tuple[Cable, ...], edge_m: float, rng: np.random.Generator) -> Diagram:
    """Draw a heap: curly cables that cross at random; the arguments of all draws are those of `tangle`."""
    laid = []
    for cable in cables:
        bends = rng.uniform(*ranges.heap_bend_per_m, size=_HEAP_KNOTS)
        laid.append(_moved(cable, _place(edge_m, rng), float(rng.uniform(0.0, 360.0)), _eased(bends, cable)))
    return Diagram(tuple(laid), _at_random(rng))


def cross_bundles(ranges: TangleRanges, cables: tuple[Cable, ...], edge_m: float, rng: np.random.Generator) -> Diagram:
    """Draw two groups of nearly parallel cables that cross: one group on the other, or cables over and under."""
    through = chance(rng, 0.5)
    between = uniform(rng, _LOOSE_DIAMETERS if through else _TIGHT_DIAMETERS)
    order = rng.permutation(len(cables))
    groups = order[: (len(cables) + 1) // 2], order[(len(cables) + 1) // 2 :]
    bearing = float(rng.uniform(0.0, 360.0))
    bearings = bearing, bearing + uniform(rng, ranges.crossing_deg) * (1.0 if chance(rng, 0.5) else -1.0)
    laid = dict(enumerate(cables))
    for group, mean in zip(groups, bearings, strict=True):
        middle, common = _place(edge_m, rng), 0.5 * np.array(cables[group[0]].bends_per_m)
        aside = np.zeros(len(group))
        for k in range(1, len(group)):
            pair = cables[group[k - 1]].diameter_m + cables[group[k]].diameter_m
            aside[k] = aside[k - 1] + between * pair / 2 * float(rng.uniform(0.9, 1.3))
        aside -= aside.mean()
        for k, number in enumerate(group):
            place = middle + turned(np.array([0.0, aside[k]]), mean)
            laid[number] = _moved(
                cables[number], place, mean + float(rng.normal(0.0, _STRAY_DEG)), _eased(common, cables[number])
            )
    if through:
        return Diagram(tuple(laid[k] for k in range(len(cables))), _at_random(rng))
    upper = set(groups[0].tolist()) if chance(rng, 0.5) else set(groups[1].tolist())

    def one_on_the_other(meetings: Sequence[Meeting], safe: list[bool]) -> list[bool]:
        return [
            each.one in upper if (each.one in upper) != (each.other in upper) else fallback
            for each, fallback in zip(meetings, safe, strict=True)
        ]

    return Diagram(tuple(laid[k] for k in range(len(cables))), one_on_the_other)


def thread(ranges: TangleRanges, cables: tuple[Cable, ...], edge_m: float, rng: np.random.Generator) -> Diagram | None:
    """Draw a cable that runs through the loops of one or two others, over one side of a loop and under the other."""
    runner, *others = rng.permutation(len(cables)).tolist()
    thick = cables[runner].diameter_m
    looped = [number for number in others if _least_loop_m(cables[number], thick) <= _most_loop_m(cables[number])]
    looped = looped[: level(rng, (1, 2))]
    if not looped:
        return None
    laid = dict(enumerate(cables))
    place, bearing = _place(edge_m, rng), float(rng.uniform(0.0, 360.0))
    laid[runner] = _moved(cables[runner], place, bearing, _gentle(cables[runner], 5.0))
    path = plan_of(laid[runner])
    loops = {number: _with_loop(ranges, cables[number], thick, edge_m, rng) for number in looped}
    between = min(0.5 * sum(loop.width_m for loop in loops.values()) + 2 * thick, 0.6 * path.length_m)
    for k, (number, loop) in enumerate(loops.items()):
        at = path.length_m / 2 + between * (k - (len(looped) - 1) / 2)
        x, y = path.points_m[round(at / path.step_m)] - loop.centre_m
        laid[number] = loop.cable.model_copy(update={"x_m": float(x), "y_m": float(y)})
    first_over = {number: chance(rng, 0.5) for number in looped}

    def through(meetings: Sequence[Meeting]) -> dict[int, bool]:
        """Whether the runner is over, for each of its meetings with a loop, in turn along it."""
        over: dict[int, bool] = {}
        for number, loop in loops.items():
            met = sorted(
                (float(each.one_m[each.closest] if each.one == runner else each.other_m[each.closest]), k)
                for k, each in enumerate(meetings)
                if {each.one, each.other} == {runner, number}
                and loop.holds((each.other_m if each.one == runner else each.one_m)[each.closest])
            )
            over |= {k: first_over[number] == (turn % 2 == 0) for turn, (_, k) in enumerate(met)}
        return over

    def over_and_under(meetings: Sequence[Meeting], safe: list[bool]) -> list[bool]:
        over = through(meetings)
        return [over[k] == (each.one == runner) if k in over else safe[k] for k, each in enumerate(meetings)]

    return Diagram(tuple(laid[k] for k in range(len(cables))), over_and_under, firm=lambda each: set(through(each)))


@dataclass(frozen=True, slots=True)
class _Loop:
    """A cable with a loop, about the origin: the loop's middle (2,) and width, and the places along it, in metres."""

    cable: Cable
    centre_m: Array
    width_m: float
    start_m: float
    end_m: float

    def holds(self, place_m: float) -> bool:
        """Whether a place along the cable belongs to the loop."""
        return self.start_m <= place_m <= self.end_m


def _least_loop_m(cable: Cable, through_m: float) -> float:
    """Compute the least radius of a loop through which a cable `through_m` thick can run, in metres."""
    return max(_TIGHTEST_DIAMETERS * cable.diameter_m, 2.5 * (cable.diameter_m + through_m))


def _most_loop_m(cable: Cable) -> float:
    """Compute the largest radius of a loop for which a cable is long enough, in metres."""
    return cable.length_m / _LOOP_ROOM_RADII


def _with_loop(ranges: TangleRanges, cable: Cable, through_m: float, edge_m: float, rng: np.random.Generator) -> _Loop:
    """Give a cable a loop through which a cable `through_m` thick can run."""
    wanted = min(log_uniform(rng, ranges.threaded_loop_radius_m), _WIDEST_LOOP * edge_m, _most_loop_m(cable))
    radius = max(wanted, _least_loop_m(cable, through_m))
    turn, sign = uniform(rng, _LOOP_TURNS) * 2 * np.pi, 1.0 if chance(rng, 0.5) else -1.0
    middle_m = float(rng.uniform(0.45, 0.55)) * cable.length_m
    looped = _moved(
        cable, np.zeros(2), float(rng.uniform(0.0, 360.0)), _curled(cable, sign / radius, middle_m, turn * radius)
    )
    plan = plan_of(looped)
    start, end = middle_m - turn * radius / 2, middle_m + turn * radius / 2
    here = plan.points_m[int(start / plan.step_m) : int(end / plan.step_m) + 1]
    return _Loop(looped, (here.min(axis=0) + here.max(axis=0)) / 2, 2 * radius + cable.diameter_m, start, end)


def _curled(cable: Cable, bend_per_m: float, middle_m: float, arc_m: float) -> Array:
    """Curl a gently bent cable to an arc of `arc_m` metres about a place along it; return the curvatures, in 1/m."""
    ramp_m = 0.5 / abs(bend_per_m)
    count = int(np.clip(np.ceil(2 * cable.length_m / ramp_m), *_CURL_KNOTS))
    along = np.linspace(0.0, cable.length_m, count)
    share = np.clip(0.5 + (arc_m / 2 - np.abs(along - middle_m)) / (2 * ramp_m), 0.0, 1.0)
    share = share * share * (3 - 2 * share)
    gentle = np.interp(along, np.linspace(0.0, cable.length_m, len(cable.bends_per_m)), _gentle(cable, 4.0))
    curvatures: Array = bend_per_m * share + (1 - share) * gentle
    return curvatures


def run_round_peg(
    ranges: TangleRanges, cables: tuple[Cable, ...], edge_m: float, rng: np.random.Generator
) -> Diagram | None:
    """Draw a peg and one to three cables that run round it; the others keep their places, clear of the peg."""
    x, y = _place(edge_m, rng)
    peg = Peg(
        x_m=float(x),
        y_m=float(y),
        diameter_m=min(log_uniform(rng, ranges.peg_diameter_m), _WIDEST_PEG * edge_m),
        height_m=uniform(rng, ranges.peg_height_m),
        colour=rgb(rng, (0, 255)),
        pattern_seed=pattern_seed(rng),
    )
    order = rng.permutation(len(cables)).tolist()
    count = level(rng, (1, min(3, len(cables))))
    beside = chance(rng, 0.5)
    laid = dict(enumerate(cables))
    taken_m = 0.0
    for number in order[:count]:
        laid[number] = _wrapped(ranges, cables[number], peg, taken_m, rng)
        taken_m += 1.1 * cables[number].diameter_m if beside else 0.0
    for number in order[count:]:
        cable = cables[number]
        beside_it = _moved(cable, _place(edge_m, rng), cable.rotation_deg, _gentle(cable, 10.0))
        laid[number] = _pushed_clear(beside_it, peg)
    if any(_lack_m(cable, peg)[0] > 0 for cable in laid.values()):
        return None
    return Diagram(tuple(laid[k] for k in range(len(cables))), _at_random(rng), peg=peg)


def _wrapped(ranges: TangleRanges, cable: Cable, peg: Peg, aside_m: float, rng: np.random.Generator) -> Cable:
    """Lay a cable round a peg, `aside_m` metres farther out than it could."""
    radius = peg.diameter_m / 2 + (0.5 + _PEG_ROOM) * cable.diameter_m + aside_m
    radius = max(radius, _TIGHTEST_DIAMETERS * cable.diameter_m)
    turn = np.radians(uniform(rng, ranges.peg_wrap_deg))
    sign = 1.0 if chance(rng, 0.5) else -1.0
    middle_m = float(rng.uniform(0.4, 0.6)) * cable.length_m
    arc_m = min(float(turn) * radius, 0.6 * cable.length_m)
    bends = _curled(cable, sign / radius, middle_m, arc_m)
    wrapped = _moved(cable, np.zeros(2), float(rng.uniform(0.0, 360.0)), bends)
    plan = plan_of(wrapped)
    here = round(middle_m / plan.step_m)
    tangent = plan.points_m[here + 1] - plan.points_m[here - 1]
    normal = sign * np.array([-tangent[1], tangent[0]]) / np.linalg.norm(tangent)
    x, y = np.array([peg.x_m, peg.y_m]) - plan.points_m[here] - radius * normal
    return wrapped.model_copy(update={"x_m": float(x), "y_m": float(y)})


def _pushed_clear(cable: Cable, peg: Peg) -> Cable:
    """Move a cable away from a peg until it is clear of it, or has been moved too often."""
    for _ in range(_PUSHES):
        lack, (x, y) = _lack_m(cable, peg)
        if lack <= 0:
            break
        cable = cable.model_copy(update={"x_m": cable.x_m + 1.2 * lack * x, "y_m": cable.y_m + 1.2 * lack * y})
    return cable


def _lack_m(cable: Cable, peg: Peg) -> tuple[float, Array]:
    """Compute the distance by which a cable is too near to a peg, and the direction (2,) away from it."""
    away = plan_of(cable).points_m - [peg.x_m, peg.y_m]
    distance = np.linalg.norm(away, axis=1)
    nearest = int(distance.argmin())
    least = peg.diameter_m / 2 + (0.5 + 0.2 * _PEG_ROOM) * cable.diameter_m
    return float(least - distance[nearest]), away[nearest] / max(float(distance[nearest]), 1e-9)


def _at_random(rng: np.random.Generator) -> Choice:
    """Choose over or under for each meeting, each as likely."""
    return lambda meetings, _: (rng.random(len(meetings)) < 0.5).tolist()


def _eased(bends_per_m: Array, cable: Cable) -> Array:
    """Limit curvatures to what a cable of its thickness takes."""
    tightest = 1 / (_TIGHTEST_DIAMETERS * cable.diameter_m)
    eased: Array = np.clip(bends_per_m, -tightest, tightest)
    return eased


def _gentle(cable: Cable, most_per_m: float) -> Array:
    """Limit the curvatures of a cable, of which a coil or a loop may have been drawn."""
    return _eased(np.clip(cable.bends_per_m, -most_per_m, most_per_m), cable)


def _place(edge_m: float, rng: np.random.Generator) -> Array:
    return rng.uniform(-_REACH, _REACH, 2) * edge_m


def _moved(cable: Cable, place_m: Array, bearing_deg: float, bends_per_m: Array) -> Cable:
    """Lay a cable, level and without a rise, with its middle at a place (2,)."""
    return cable.model_copy(
        update={
            "x_m": float(place_m[0]),
            "y_m": float(place_m[1]),
            "rotation_deg": bearing_deg,
            "bends_per_m": tuple(float(bend) for bend in bends_per_m),
            "rise_m": 0.0,
        }
    )
