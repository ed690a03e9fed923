"""The ranges of clutter: objects on the floor that are not cables."""

from typing import Annotated

from pydantic import AfterValidator, Field

from farm.model import Model
from farm.spec.ranges.types import CountRange, Fraction, in_order

StickDiameter = Annotated[float, Field(ge=0.001, le=0.05)]


StickLength = Annotated[float, Field(ge=0.01, le=1.0)]


class ClutterRanges(Model):
    """The ranges of objects on the floor that are not cables; only pictures over a floor have them.

    Attributes:
        share: share of the pictures over a floor that have clutter.
        sticks: number of pens, pipes and tools.
        stick_diameter_m: diameter of a stick, in metres, sampled log-uniformly.
        stick_length_m: length of a stick, in metres.
        sheets: number of tapes, papers, rulers, painted lines and slots.
        parts: number of washers, nuts, screws and connectors.
    """

    share: Fraction = 0.0
    sticks: CountRange = (0, 2)
    stick_diameter_m: Annotated[tuple[StickDiameter, StickDiameter], AfterValidator(in_order)] = (0.003, 0.012)
    stick_length_m: Annotated[tuple[StickLength, StickLength], AfterValidator(in_order)] = (0.08, 0.20)
    sheets: CountRange = (0, 3)
    parts: CountRange = (0, 6)
