"""What lies about that is not cable, but looks like it. All of it is background in every label.

Places are metres, x right and y up in the picture; bearings are degrees from the x axis; colours are sRGB levels.
"""

from enum import StrEnum
from typing import Annotated

from pydantic import Field

from farm.model import Metres, Model, Rgb

Seed = Annotated[int, Field(ge=0, lt=2**63)]


class StickKind(StrEnum):
    """Something long, round and stiff, on which cables come to lie."""

    PEN = "pen"
    PENCIL = "pencil"
    PIPE = "pipe"
    ROD = "rod"
    SCREWDRIVER = "screwdriver"


class Stick(Model):
    """A stick, which falls with the cables as a stiff rod."""

    kind: StickKind
    diameter_m: Metres
    length_m: Metres
    x_m: float
    y_m: float
    start_height_m: Annotated[float, Field(ge=0)]
    rotation_deg: float
    colour: Rgb
    pattern_seed: Seed


class SheetKind(StrEnum):
    """Something flat on the floor, thinner than can be seen."""

    TAPE = "tape"
    HAZARD_TAPE = "hazard_tape"
    PAPER = "paper"
    LABEL = "label"
    RULER = "ruler"
    PAINTED_LINE = "painted_line"
    SLOT = "slot"
    SEAM = "seam"


class Sheet(Model):
    """A flat thing: a rectangle about (x, y), its length along its bearing."""

    kind: SheetKind
    x_m: float
    y_m: float
    rotation_deg: float
    length_m: Metres
    width_m: Metres
    colour: Rgb
    pattern_seed: Seed


class PartKind(StrEnum):
    """Something small that lies where no cable is."""

    WASHER = "washer"
    NUT = "nut"
    SCREW = "screw"
    CONNECTOR = "connector"
    CABLE_TIE = "cable_tie"


class Part(Model):
    """A small thing about (x, y); it is left out where a cable came to lie."""

    kind: PartKind
    x_m: float
    y_m: float
    rotation_deg: float
    size_m: Metres
    colour: Rgb
    pattern_seed: Seed
