"""The ranges of tangles: cables that start woven over and under each other, knotted, or run round a peg."""

from typing import Annotated, Self

from pydantic import AfterValidator, Field, model_validator

from farm.model import Model
from farm.spec.ranges.types import BendRange, Fraction, FractionRange, PositiveRange, in_order

LoopDiameters = Annotated[float, Field(ge=3, le=50)]
CrossingAngle = Annotated[float, Field(ge=20, le=90)]
WrapAngle = Annotated[float, Field(ge=30, le=720)]
PegDiameter = Annotated[float, Field(ge=0.002, le=0.05)]
PegHeight = Annotated[float, Field(ge=0.005, le=0.2)]


class TangleRanges(Model):
    """The ranges of tangles. All are ours: the published cables start level, one above the other.

    A picture has at most one kind. Aligned categories have knots alone, as every other kind would undo the alignment;
    pegs stand on visible floors alone. A picture that draws a kind for which it has too few cables has no tangle.

    Attributes:
        heap_share: share of the pictures of two cables or more that are a heap: curly cables which cross over and under
            each other at random.
        knot_share: share of the pictures in which one cable has a knot.
        threaded_share: share of the pictures of two cables or more in which one cable runs through others' loops.
        crossed_bundles_share: share of the pictures of three cables or more in which two groups of nearly parallel
            cables cross.
        peg_share: share of the pictures in which cables run round a peg.
        heap_bend_per_m: natural curvature at points along a heap's cables beside that of their curls, in 1/m.
        figure_eight_share: share of the knots that are figures of eight; the others are overhand knots.
        knot_loop_diameters: radius of a knot's loop, in diameters of its cable, sampled log-uniformly.
        knot_set_share: share of its curvature that a knotted cable keeps by itself.
        threaded_loop_radius_m: radius of a loop that is threaded, in metres, sampled log-uniformly.
        crossing_deg: angle at which two groups cross, in degrees.
        peg_diameter_m: diameter of a peg, in metres, sampled log-uniformly.
        peg_height_m: height of a peg, in metres; it is higher than the cables round it, and lower than what a camera
            sees.
        peg_wrap_deg: angle by which a cable runs round a peg, in degrees.
    """

    heap_share: Fraction = 0.0
    knot_share: Fraction = 0.0
    threaded_share: Fraction = 0.0
    crossed_bundles_share: Fraction = 0.0
    peg_share: Fraction = 0.0
    heap_bend_per_m: BendRange = (-15.0, 15.0)
    figure_eight_share: Fraction = 0.4
    knot_loop_diameters: Annotated[tuple[LoopDiameters, LoopDiameters], AfterValidator(in_order)] = (4.0, 12.0)
    knot_set_share: FractionRange = (0.3, 1.0)
    threaded_loop_radius_m: PositiveRange = (0.010, 0.035)
    crossing_deg: Annotated[tuple[CrossingAngle, CrossingAngle], AfterValidator(in_order)] = (30.0, 90.0)
    peg_diameter_m: Annotated[tuple[PegDiameter, PegDiameter], AfterValidator(in_order)] = (0.004, 0.020)
    peg_height_m: Annotated[tuple[PegHeight, PegHeight], AfterValidator(in_order)] = (0.015, 0.05)
    peg_wrap_deg: Annotated[tuple[WrapAngle, WrapAngle], AfterValidator(in_order)] = (60.0, 400.0)

    @property
    def share(self) -> float:
        """Share of the pictures that draw any kind of tangle."""
        return self.heap_share + self.knot_share + self.threaded_share + self.crossed_bundles_share + self.peg_share

    @model_validator(mode="after")
    def _is_a_share(self) -> Self:
        if self.share > 1.0 + 1e-9:
            raise ValueError(f"the shares of tangles add up to {self.share:g}, above 1")
        return self
