"""Clutter: objects on the floor that resemble cables. They are background in every label.

Positions are in metres, x to the right and y up in the picture; bearings are in degrees from the x axis; colours are
sRGB levels; a `pattern_seed` is the seed of every irregular detail.
"""

from enum import StrEnum
from typing import Annotated

from pydantic import Field

from farm.model import Metres, Model, Rgb

Seed = Annotated[int, Field(ge=0, lt=2**63)]


class StickKind(StrEnum):
    """The kind of a long, round, stiff object, on which cables come to lie."""

    PEN = "pen"
    PENCIL = "pencil"
    PIPE = "pipe"
    ROD = "rod"
    SCREWDRIVER = "screwdriver"


class Stick(Model):
    """A long, round, stiff object, which falls with the cables as a rod.

    Attributes:
        start_height_m: height of its underside above the floor before the fall, in metres.
        rotation_deg: bearing of its axis.
    """

    kind: StickKind
    diameter_m: Metres
    length_m: Metres
    x_m: float
    y_m: float
    start_height_m: Annotated[float, Field(ge=0)]
    rotation_deg: float
    colour: Rgb
    pattern_seed: Seed


class Peg(Model):
    """A fixed, upright round post, round which cables run. It stands on the floor, and nothing moves it."""

    x_m: float
    y_m: float
    diameter_m: Metres
    height_m: Metres
    colour: Rgb
    pattern_seed: Seed


class SheetKind(StrEnum):
    """The kind of a flat object on the floor, too thin for its thickness to show."""

    TAPE = "tape"
    HAZARD_TAPE = "hazard_tape"
    PAPER = "paper"
    LABEL = "label"
    RULER = "ruler"
    PAINTED_LINE = "painted_line"
    SLOT = "slot"
    SEAM = "seam"


class Sheet(Model):
    """A flat object: a rectangle whose middle is (x, y), its length along its bearing."""

    kind: SheetKind
    x_m: float
    y_m: float
    rotation_deg: float
    length_m: Metres
    width_m: Metres
    colour: Rgb
    pattern_seed: Seed


class PartKind(StrEnum):
    """The kind of a small object that lies where no cable is."""

    WASHER = "washer"
    NUT = "nut"
    SCREW = "screw"
    CONNECTOR = "connector"
    CABLE_TIE = "cable_tie"


class Part(Model):
    """A small object whose middle is (x, y); it is left out if a cable comes to lie there.

    Attributes:
        size_m: wanted length or diameter, in metres; a part of standardized sizes takes the nearest of them.
    """

    kind: PartKind
    x_m: float
    y_m: float
    rotation_deg: float
    size_m: Metres
    colour: Rgb
    pattern_seed: Seed
