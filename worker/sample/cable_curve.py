"""A cable's natural curve: what bends it along its length, loops and coils."""

from dataclasses import dataclass

import numpy as np

from farm.spec.ranges.placement import SPACING_DIAMETERS, PlacementRanges
from worker.sample.values import chance, log_uniform

FINE_KNOTS = 33
"""Points along a cable with a loop or a coil, at which its curvature is told."""

_LOOP_TURNS = (1.02, 1.3)
"""A loop turns a little farther than round, so that the cable goes on about as it came."""

_COIL_UNEVENNESS = 0.08


@dataclass(frozen=True, slots=True)
class Course:
    """The natural curvature, at equal distances from end to end, and how much higher the end starts."""

    bends_per_m: tuple[float, ...]
    rise_m: float


def sample_course(
    ranges: PlacementRanges,
    bends_per_m: tuple[float, ...],
    length_m: float,
    diameter_m: float,
    rng: np.random.Generator,
) -> Course:
    """Draw whether a cable is coiled or has a loop, on top of its gentle bends.

    Where it meets itself its end starts high enough to lie on what was laid before.
    """
    if chance(rng, ranges.coil_share):
        radius = max(log_uniform(rng, ranges.coil_radius_m), 4 * diameter_m)
        sign = 1.0 if chance(rng, 0.5) else -1.0
        uneven = 1.0 + rng.normal(0.0, _COIL_UNEVENNESS, FINE_KNOTS)
        turns = length_m / (2 * np.pi * radius)
        rise = SPACING_DIAMETERS * diameter_m * float(turns) if turns > 0.8 else 0.0
        return Course(tuple((sign / radius * uneven).tolist()), rise)
    if chance(rng, ranges.loop_share):
        return _loop(ranges, bends_per_m, length_m, diameter_m, rng)
    return Course(bends_per_m, 0.0)


def _loop(
    ranges: PlacementRanges,
    bends_per_m: tuple[float, ...],
    length_m: float,
    diameter_m: float,
    rng: np.random.Generator,
) -> Course:
    along = np.linspace(0.0, 1.0, FINE_KNOTS)
    gentle = np.interp(along, np.linspace(0.0, 1.0, len(bends_per_m)), bends_per_m)
    radius = max(log_uniform(rng, ranges.loop_radius_m), 4 * diameter_m, length_m / 15)
    turn = float(rng.uniform(*_LOOP_TURNS)) * 2 * np.pi * (1.0 if chance(rng, 0.5) else -1.0)
    middle = float(rng.uniform(0.35, 0.65))
    # A bell whose peak is 1 / radius and whose area is the turn.
    width = abs(turn) * radius / np.sqrt(2 * np.pi) / length_m
    bump = np.sign(turn) / radius * np.exp(-0.5 * np.square((along - middle) / width))
    # The two passes of the crossing are about one circumference apart.
    rise = SPACING_DIAMETERS * diameter_m * length_m / (2 * np.pi * radius)
    return Course(tuple((gentle + bump).tolist()), float(rise))
