"""A knot in a cable, which is tied and pulled before the cable falls."""

from enum import StrEnum
from typing import Annotated

from pydantic import Field

from farm.model import Metres, Model, Share


class KnotKind(StrEnum):
    """The kind of a knot."""

    OVERHAND = "overhand"
    FIGURE_EIGHT = "figure_eight"


class Knot(Model):
    """A knot in a cable.

    Attributes:
        kind: kind of the knot.
        along: position of its middle, as a share of the cable's length.
        loop_radius_m: radius R of its loop, in metres, to which a pull of EI / (2 R^2) at both ends tightens it.
        mirrored: whether every crossing is the other way round.
        set_share: share of the curvature about the vertical that the cable keeps by itself, as copper does.
    """

    kind: KnotKind
    along: Share
    loop_radius_m: Metres
    mirrored: bool
    set_share: Annotated[float, Field(ge=0, le=1)]
