"""The ranges of the cables' start positions and curves, and of the wind that pushes them while they fall."""

from typing import Annotated

from pydantic import Field

from farm.model import Model
from farm.spec.ranges.tangle import TangleRanges
from farm.spec.ranges.types import (
    BendRange,
    Fraction,
    FractionRange,
    LengthRange,
    NotNegative,
    NotNegativeRange,
    PositiveRange,
    Range,
)

BEND_KNOTS = 7
"""Number of equally spaced points along a cable at which its natural curvature is sampled."""

SPACING_DIAMETERS = 1.5
"""Least height of a cable's start above that of the cable below it, in that cable's diameters; it leaves room for the
cloth's collision distance."""


class WindRanges(Model):
    """The ranges of the wind; `farm.scene.physics.Wind` explains what has no description here. The gusts are ours.

    Attributes:
        flow_per_strength: flow of the wind field over its strength.
        speed_per_strength_m_s: speed of the air for the rod solver over the field's strength; it is ours, and gives a
            light breeze of 2.5 m/s at full strength.
        gust_share: amplitude of each gust, as a share of the mean speed.
        gust_period_s: period of each gust, in seconds.
    """

    bearing_deg: Range = (0.0, 360.0)
    distance: NotNegativeRange = (5.0, 8.0)
    height: NotNegativeRange = (0.0, 3.0)
    tilt_deg: Range = (60.0, 120.0)
    strength: NotNegativeRange = (0.0, 10.0)
    flow_per_strength: NotNegative = 0.2
    speed_per_strength_m_s: NotNegative = 0.25
    gust_share: FractionRange = (0.0, 0.3)
    gust_period_s: PositiveRange = (0.02, 0.2)


class PlacementRanges(Model):
    """The ranges of the cables' start, one above the other. Heights, spacing, bends, loops and coils are ours.

    The published cables start straight, and the cloth's own drift bends them.

    Attributes:
        free_x_m: x of the middle of a cable in a free disposition, in metres.
        free_y_m: y of the middle of a cable in a free disposition, in metres.
        free_rotation_deg: mean bearing of a cable in a free disposition.
        aligned_x_m: x of the middle of an aligned cable, in metres.
        aligned_y_m: y of the middle of an aligned cable, in metres.
        aligned_bearing_deg: common bearing of aligned cables.
        aligned_deviation_deg: deviation of each cable from the common bearing.
        drop_height_m: height of the lowest cable's start above the floor, in metres; sticks may lift it.
        spacing_m: least height of a cable's start above that of the cable below it, in metres.
        bend_per_m: natural curvature at each of `BEND_KNOTS` points along a cable, in 1/m: the rest of the coil that it
            came from.
        loop_share: share of the cables without a coil that have a loop.
        loop_radius_m: radius of a loop, in metres, sampled log-uniformly.
        coil_share: share of the cables that are coiled all along.
        coil_radius_m: radius of a coil, in metres, sampled log-uniformly.
        tangle: ranges of tangles.
    """

    free_x_m: LengthRange = (-0.025, 0.025)
    free_y_m: LengthRange = (-0.035, 0.035)
    free_rotation_deg: Range = (0.0, 180.0)
    aligned_x_m: LengthRange = (-0.012, 0.012)
    aligned_y_m: LengthRange = (-0.014, 0.014)
    aligned_bearing_deg: Range = (0.0, 360.0)
    aligned_deviation_deg: Range = (-10.0, 10.0)
    drop_height_m: Annotated[float, Field(ge=0, le=0.2)] = 0.004
    spacing_m: Annotated[float, Field(gt=0, le=0.1)] = 0.004
    bend_per_m: BendRange = (-5.0, 5.0)
    loop_share: Fraction = 0.0
    loop_radius_m: PositiveRange = (0.012, 0.04)
    coil_share: Fraction = 0.0
    coil_radius_m: PositiveRange = (0.015, 0.05)
    tangle: TangleRanges = TangleRanges()
