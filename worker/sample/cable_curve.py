"""Samples the natural curve of a cable: gentle bends, a loop, or a coil."""

from dataclasses import dataclass

import numpy as np

from farm.spec.ranges.placement import SPACING_DIAMETERS, PlacementRanges
from worker.sample.values import chance, log_uniform

FINE_KNOTS = 33
"""Number of equally spaced points that describe the curvature of a cable with a loop or a coil."""

_LOOP_TURNS = (1.02, 1.3)
"""Range of the turns that a loop makes: a little more than one, so that the cable leaves about as it came."""

_COIL_UNEVENNESS = 0.08
"""Standard deviation of a coil's curvature between its points, as a share of the mean: no coil is a perfect circle."""


@dataclass(frozen=True, slots=True)
class Course:
    """The natural curve of a cable.

    Attributes:
        bends_per_m: natural curvature at equally spaced points from end to end, in 1/m.
        rise_m: height of the cable's end above its beginning at the start of the fall, in metres.
    """

    bends_per_m: tuple[float, ...]
    rise_m: float


def sample_course(
    ranges: PlacementRanges,
    bends_per_m: tuple[float, ...],
    length_m: float,
    diameter_m: float,
    rng: np.random.Generator,
) -> Course:
    """Sample whether a cable is coiled, has a loop, or keeps its gentle bends.

    The end of a cable that crosses itself starts high enough to lie on the part before.

    Args:
        ranges: ranges of the style.
        bends_per_m: gentle bends, a natural curvature at equally spaced points from end to end, in 1/m.
        length_m: length of the cable, in metres.
        diameter_m: diameter of the cable, in metres.
        rng: random generator of the look.
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
    # The added curvature is a bell whose peak is 1 / radius and whose area is the turn.
    width = abs(turn) * radius / np.sqrt(2 * np.pi) / length_m
    bump = np.sign(turn) / radius * np.exp(-0.5 * np.square((along - middle) / width))
    # Along the cable, the two passes of the crossing are about one circumference apart.
    rise = SPACING_DIAMETERS * diameter_m * length_m / (2 * np.pi * radius)
    return Course(tuple((gentle + bump).tolist()), float(rise))
