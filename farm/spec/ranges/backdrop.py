"""The ranges of what is behind the cables: the HDRI, or a photograph."""

from typing import Annotated

from pydantic import AfterValidator, Field

from farm.model import Model
from farm.spec.ranges.types import Fraction, FractionRange, Range, ZoomRange, in_order

Blur = Annotated[float, Field(ge=0, le=64)]


class WorldRanges(Model):
    """The HDRI's turn, its brightness if it is a dark one, its tilt over a floor, and whether it is the same there."""

    rotation_deg: Range = (-180.0, 180.0)
    dark_brightness: FractionRange = (0.10, 0.60)
    one_over_floors: bool = True
    close_tilts_deg: Annotated[tuple[float, ...], Field(min_length=1)] = (0.0, 90.0)


class PlateRanges(Model):
    """The user's photographs behind far cables, where there are any.

    Attributes:
        share: of the far pictures that have one.
        zoom: edge of the seen square over the photograph's shorter side.
        blur_px: radius by which it is out of focus, at 512 px.
    """

    share: Fraction = 0.5
    zoom: ZoomRange = (0.4, 1.0)
    blur_px: Annotated[tuple[Blur, Blur], AfterValidator(in_order)] = (0.0, 8.0)
