"""Samples the diagrams of tangles: where cables run in plan view, and what passes over what."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from farm.scene.cable import Cable
from farm.spec.ranges.tangle import TangleRanges
from worker.sample.diagram import Diagram, plan_of, turned
from worker.sample.lay import TIGHTEST_DIAMETERS, at_place, at_random, curled, eased, gentle, moved, place_near_middle
from worker.sample.meetings import Array, Meeting
from worker.sample.values import chance, level, log_uniform, uniform

_HEAP_CURL = (0.12, 0.35)
"""Range of the radius of a heap's curls, as a share of the picture's shorter edge."""

_HEAP_SPACING_RADII = 1.5
"""Distance along a cable of the points at which a heap's curvature is sampled, in radii of its curls."""

_HEAP_KNOTS = (7, 49)
"""Fewest and most of these points."""

_HEAP_TURNS = 0.25
"""Chance that a cable's curls turn the other way from one of these points on."""

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


def heap_up(ranges: TangleRanges, cables: tuple[Cable, ...], edge_m: float, rng: np.random.Generator) -> Diagram:
    """Draw a heap: curly cables that cross at random; the arguments of all draws are those of `tangle`."""
    laid = []
    for cable in cables:
        radius = max(uniform(rng, _HEAP_CURL) * edge_m, TIGHTEST_DIAMETERS * cable.diameter_m)
        count = int(np.clip(np.ceil(cable.length_m / (_HEAP_SPACING_RADII * radius)), *_HEAP_KNOTS))
        turns = np.where(rng.random(count) < _HEAP_TURNS, -1.0, 1.0)
        curls = (1.0 if chance(rng, 0.5) else -1.0) * np.cumprod(turns) / radius
        bends = eased(curls + rng.uniform(*ranges.heap_bend_per_m, size=count), cable)
        curled = moved(cable, np.zeros(2), float(rng.uniform(0.0, 360.0)), bends)
        # The middle of all that the cable covers is near the picture's, not that of its length.
        laid.append(at_place(curled, place_near_middle(edge_m, rng) - plan_of(curled).points_m.mean(axis=0)))
    return Diagram(tuple(laid), at_random(rng))


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
        middle, common = place_near_middle(edge_m, rng), 0.5 * gentle(cables[group[0]], 10.0)
        aside = np.zeros(len(group))
        for k in range(1, len(group)):
            pair = cables[group[k - 1]].diameter_m + cables[group[k]].diameter_m
            aside[k] = aside[k - 1] + between * pair / 2 * float(rng.uniform(0.9, 1.3))
        aside -= aside.mean()
        for k, number in enumerate(group):
            place = middle + turned(np.array([0.0, aside[k]]), mean)
            laid[number] = moved(
                cables[number], place, mean + float(rng.normal(0.0, _STRAY_DEG)), eased(common, cables[number])
            )
    if through:
        return Diagram(tuple(laid[k] for k in range(len(cables))), at_random(rng))
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
    place, bearing = place_near_middle(edge_m, rng), float(rng.uniform(0.0, 360.0))
    laid[runner] = moved(cables[runner], place, bearing, gentle(cables[runner], 5.0))
    path = plan_of(laid[runner])
    loops = {number: _with_loop(ranges, cables[number], thick, edge_m, rng) for number in looped}
    between = min(0.5 * sum(loop.width_m for loop in loops.values()) + 2 * thick, 0.6 * path.length_m)
    for k, (number, loop) in enumerate(loops.items()):
        at = path.length_m / 2 + between * (k - (len(looped) - 1) / 2)
        laid[number] = at_place(loop.cable, path.points_m[round(at / path.step_m)] - loop.centre_m)
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
    return max(TIGHTEST_DIAMETERS * cable.diameter_m, 2.5 * (cable.diameter_m + through_m))


def _most_loop_m(cable: Cable) -> float:
    """Compute the largest radius of a loop for which a cable is long enough, in metres."""
    return cable.length_m / _LOOP_ROOM_RADII


def _with_loop(ranges: TangleRanges, cable: Cable, through_m: float, edge_m: float, rng: np.random.Generator) -> _Loop:
    """Give a cable a loop through which a cable `through_m` thick can run."""
    wanted = min(log_uniform(rng, ranges.threaded_loop_radius_m), _WIDEST_LOOP * edge_m, _most_loop_m(cable))
    radius = max(wanted, _least_loop_m(cable, through_m))
    turn, sign = uniform(rng, _LOOP_TURNS) * 2 * np.pi, 1.0 if chance(rng, 0.5) else -1.0
    middle_m = float(rng.uniform(0.45, 0.55)) * cable.length_m
    looped = moved(
        cable, np.zeros(2), float(rng.uniform(0.0, 360.0)), curled(cable, sign / radius, middle_m, turn * radius)
    )
    plan = plan_of(looped)
    start, end = middle_m - turn * radius / 2, middle_m + turn * radius / 2
    here = plan.points_m[int(start / plan.step_m) : int(end / plan.step_m) + 1]
    return _Loop(looped, (here.min(axis=0) + here.max(axis=0)) / 2, 2 * radius + cable.diameter_m, start, end)
