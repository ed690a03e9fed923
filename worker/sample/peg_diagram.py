"""Samples the diagram of cables that run round a peg."""

import numpy as np

from farm.scene.cable import Cable
from farm.scene.clutter import Peg
from farm.spec.ranges.tangle import TangleRanges
from worker.sample.diagram import Diagram, plan_of
from worker.sample.lay import TIGHTEST_DIAMETERS, at_place, at_random, curled, gentle, moved, place_near_middle
from worker.sample.meetings import Array
from worker.sample.values import chance, level, log_uniform, pattern_seed, rgb, uniform

_WIDEST_PEG = 0.12
"""Largest diameter of a peg, as a share of the picture's shorter edge."""

_PEG_ROOM = 0.15
"""Air between a peg and the cables about it at the start, in radii of the cable."""

_PUSHES = 6
"""Times that a cable is pushed away from a peg before another diagram is drawn."""


def run_round_peg(
    ranges: TangleRanges, cables: tuple[Cable, ...], edge_m: float, rng: np.random.Generator
) -> Diagram | None:
    """Draw a peg and one to three cables that run round it; the others keep their places, clear of the peg."""
    x, y = place_near_middle(edge_m, rng)
    peg = Peg(
        x_m=float(x),
        y_m=float(y),
        diameter_m=min(log_uniform(rng, ranges.peg_diameter_m), _WIDEST_PEG * edge_m),
        height_m=uniform(rng, ranges.peg_height_m),
        colour=rgb(rng, (0, 255)),
        pattern_seed=pattern_seed(rng),
    )
    # Cables that bend tightly enough to touch the peg go first.
    order = sorted(rng.permutation(len(cables)).tolist(), key=lambda number: not _can_touch(cables[number], peg))
    count = level(rng, (1, min(3, len(cables))))
    beside = chance(rng, 0.5)
    laid = dict(enumerate(cables))
    taken_m = 0.0
    for number in order[:count]:
        laid[number] = _wrapped(ranges, cables[number], peg, taken_m, rng)
        taken_m += 1.1 * cables[number].diameter_m if beside else 0.0
    for number in order[count:]:
        cable = cables[number]
        beside_it = moved(cable, place_near_middle(edge_m, rng), cable.rotation_deg, gentle(cable, 10.0))
        laid[number] = _pushed_clear(beside_it, peg)
    if any(_lack_m(cable, peg)[0] > 0 for cable in laid.values()):
        return None
    return Diagram(tuple(laid[k] for k in range(len(cables))), at_random(rng), peg=peg)


def _can_touch(cable: Cable, peg: Peg) -> bool:
    """Whether a cable bends as tightly as a peg is thick."""
    return TIGHTEST_DIAMETERS * cable.diameter_m <= _nearest_m(cable, peg)


def _nearest_m(cable: Cable, peg: Peg) -> float:
    """Compute the least radius with which a cable runs round a peg, in metres."""
    return peg.diameter_m / 2 + (0.5 + _PEG_ROOM / 2) * cable.diameter_m


def _wrapped(ranges: TangleRanges, cable: Cable, peg: Peg, aside_m: float, rng: np.random.Generator) -> Cable:
    """Lay a cable round a peg, `aside_m` metres farther out than it could."""
    radius = max(_nearest_m(cable, peg) + aside_m, TIGHTEST_DIAMETERS * cable.diameter_m)
    turn = np.radians(uniform(rng, ranges.peg_wrap_deg))
    sign = 1.0 if chance(rng, 0.5) else -1.0
    middle_m = float(rng.uniform(0.4, 0.6)) * cable.length_m
    arc_m = min(float(turn) * radius, 0.6 * cable.length_m)
    bends = curled(cable, sign / radius, middle_m, arc_m)
    wrapped = moved(cable, np.zeros(2), float(rng.uniform(0.0, 360.0)), bends)
    plan = plan_of(wrapped)
    here = round(middle_m / plan.step_m)
    tangent = plan.points_m[here + 1] - plan.points_m[here - 1]
    normal = sign * np.array([-tangent[1], tangent[0]]) / np.linalg.norm(tangent)
    return at_place(wrapped, np.array([peg.x_m, peg.y_m]) - plan.points_m[here] - radius * normal)


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
    least = peg.diameter_m / 2 + (0.5 + _PEG_ROOM / 10) * cable.diameter_m
    return float(least - distance[nearest]), away[nearest] / max(float(distance[nearest]), 1e-9)
