"""The ranges of what lies about and is not cable."""

from typing import Annotated

from pydantic import AfterValidator, Field

from farm.model import Model
from farm.spec.ranges.types import CountRange, Fraction, in_order

StickDiameter = Annotated[float, Field(ge=0.001, le=0.05)]


StickLength = Annotated[float, Field(ge=0.01, le=1.0)]


class ClutterRanges(Model):
    """What lies about and is not cable; drawn over floors alone.

    Attributes:
        share: of the pictures over a floor that have any.
        sticks: pens, pipes, tools: how many of those pictures' have.
        stick_diameter_m: of them.
        stick_length_m: of them.
        sheets: tapes, papers, rulers, painted lines, slots.
        parts: washers, nuts, screws, connectors.
    """

    share: Fraction = 0.0
    sticks: CountRange = (0, 2)
    stick_diameter_m: Annotated[tuple[StickDiameter, StickDiameter], AfterValidator(in_order)] = (0.003, 0.012)
    stick_length_m: Annotated[tuple[StickLength, StickLength], AfterValidator(in_order)] = (0.08, 0.20)
    sheets: CountRange = (0, 3)
    parts: CountRange = (0, 6)
