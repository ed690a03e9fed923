"""The ranges of where the cables start, and of the wind that pushes them while they fall."""

from typing import Annotated

from pydantic import Field

from farm.model import Model
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


SPACING_DIAMETERS = 1.5
"""Cables start at least so many diameters above each other, which leaves room for the cloth's collision distance."""


class WindRanges(Model):
    """The wind field: where it stands, how it points and how hard it blows, in the cloth's units.

    `speed_per_strength_m_s`, for the rod solver, and the gusts are ours: at full strength a light breeze of 2.5 m/s.
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
    """Where the cables start, at stacked heights. `drop_height_m`, `spacing_m` and `bend_per_m` are ours.

    `bend_per_m` is a cable's natural curvature, drawn at `BEND_KNOTS` points along it: what is left of the coil it
    came from. The published cables start straight and are bent by the cloth's own drift. Cables with a loop
    somewhere, or coiled all along, are ours too.
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
