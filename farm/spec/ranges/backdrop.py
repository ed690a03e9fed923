"""The ranges of the backdrop behind the cables: an HDRI, or a photograph."""

from typing import Annotated

from pydantic import AfterValidator, Field

from farm.model import Model
from farm.spec.ranges.types import Fraction, FractionRange, Range, ZoomRange, in_order

Blur = Annotated[float, Field(ge=0, le=64)]


class WorldRanges(Model):
    """The ranges of the HDRI that lights a scene.

    Attributes:
        rotation_deg: rotation about the HDRI's vertical.
        dark_brightness: share of its light that is added to a dark HDRI; others stay as they are.
        one_over_floors: whether one HDRI lights all pictures over a floor.
        close_tilts_deg: tilts of which a picture over a floor has one; see `farm.scene.backdrop.HdriWorld`.
    """

    rotation_deg: Range = (-180.0, 180.0)
    dark_brightness: FractionRange = (0.10, 0.60)
    one_over_floors: bool = True
    close_tilts_deg: Annotated[tuple[float, ...], Field(min_length=1)] = (0.0, 90.0)


class PlateRanges(Model):
    """The ranges of the user's photographs behind far cables.

    Attributes:
        share: share of the far pictures that show a photograph, if the dataset has any.
        zoom: width of the visible part, as a share of that of the largest part of the picture's shape.
        blur_px: radius of the blur disc, in pixels of a picture whose longer edge is 512 px.
    """

    share: Fraction = 0.5
    zoom: ZoomRange = (0.4, 1.0)
    blur_px: Annotated[tuple[Blur, Blur], AfterValidator(in_order)] = (0.0, 8.0)
