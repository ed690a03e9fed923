"""A cable before its fall: its start, its material and its look."""

from enum import StrEnum
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from farm.model import Metres, Model, Rgb, Share, Vector3
from farm.scene.knot import Knot


class CableMaterial(Model):
    """The published surface, a shader with a colour, a dirt pattern and a reflection.

    Attributes:
        colour: 8-bit levels of linear light, as the published set-up reads them.
        dirt_colour: colour of the dirt, 8-bit levels of linear light.
        dirt_position: position on the colour ramp, 0 to 1, from which the noise shows dirt; higher means less dirt.
        dirt_mapping: offset of the noise pattern in space, in the units of its texture coordinates.
        dirt_offset: fourth coordinate of the noise pattern.
        reflection_position: position of the reflection ramp's second element, 0 to 1.
    """

    kind: Literal["procedural"] = "procedural"
    colour: Rgb
    dirt_colour: Rgb
    dirt_position: float
    dirt_mapping: Vector3
    dirt_offset: float
    reflection_position: float


class Sheath(StrEnum):
    """The kind of sheath around a cable's conductors."""

    PLAIN = "plain"
    TRANSLUCENT = "translucent"
    BRAIDED = "braided"


class StripeKind(StrEnum):
    """The course of stripes of a second colour along a cable."""

    STRAIGHT = "straight"
    SPIRAL = "spiral"


class Stripe(Model):
    """Stripes of a second colour along a cable.

    Attributes:
        kind: whether the stripes run straight or wind round.
        colour: sRGB levels.
        share: share of the circumference that all stripes together take.
        count: number of stripes side by side around the cable.
        pitch_m: length of one turn about the cable, in metres; a straight stripe turns slowly, with the cable's twist.
    """

    kind: StripeKind
    colour: Rgb
    share: Share
    count: Annotated[int, Field(ge=1, le=4)]
    pitch_m: Metres


class Marking(Model):
    """A text printed again and again along a cable.

    Attributes:
        text: 1 to 60 printable ASCII characters.
        colour: sRGB levels.
        height_share: height of the letters, as a share of the cable's diameter.
        repeat_m: distance from the beginning of one text to that of the next, in metres.
    """

    text: Annotated[str, Field(min_length=1, max_length=60, pattern=r"^[ -~]+$")]
    colour: Rgb
    height_share: Share
    repeat_m: Metres


class Skin(Model):
    """A sheath that is painted as an image around and along the cable.

    Attributes:
        sheath: kind of the sheath.
        colour: main colour, sRGB levels.
        roughness: roughness of the surface: 0.15 is glossy, 0.75 matt.
        stripe: stripes of a second colour, if any.
        marking: printed text, if any.
        dirt: share of the surface that is soiled.
        wear: share of the surface that is rubbed paler.
        pattern_seed: seed of every irregular detail in the image.
    """

    kind: Literal["skin"] = "skin"
    sheath: Sheath
    colour: Rgb
    roughness: Share
    stripe: Stripe | None
    marking: Marking | None
    dirt: Share
    wear: Share
    pattern_seed: Annotated[int, Field(ge=0, lt=2**63)]


class Tie(Model):
    """A cable tie around a bundle.

    Attributes:
        along: position of its middle, as a share of the bundle's length.
        width_m: width of the band along the bundle, in metres.
        colour: sRGB levels.
    """

    along: Share
    width_m: Metres
    colour: Rgb


class Bundle(Model):
    """Strands that wind around each other in the place of one cable, whose diameter is that of the circle around them.

    Attributes:
        strands: skins of the strands, 2 to 7.
        strand_diameter_m: diameter of each strand, in metres.
        lay_m: length over which the strands turn once around each other, in metres; negative is left-handed.
        phase_deg: angle of that turn at the cable's start, in degrees.
        ties: cable ties around the strands.
    """

    kind: Literal["bundle"] = "bundle"
    strands: Annotated[tuple[Skin, ...], Field(min_length=2, max_length=7)]
    strand_diameter_m: Metres
    lay_m: float
    phase_deg: float
    ties: tuple[Tie, ...]


def envelope_ratio(strands: int) -> float:
    """Compute the diameter of the smallest circle around 2 to 7 equal circles, in diameters of one (Graham 1968)."""
    return (2.0, 1.0 + 2.0 / 3.0**0.5, 1.0 + 2.0**0.5, 1.0 + (2.0 + 2.0 / 5.0**0.5) ** 0.5, 3.0, 3.0)[strands - 2]


Look = Annotated[CableMaterial | Skin | Bundle, Field(discriminator="kind")]


class EndKind(StrEnum):
    """The kind of a cable's end."""

    CUT = "cut"
    STRIPPED = "stripped"
    FERRULE = "ferrule"


class CableEnd(Model):
    """One end of a cable.

    Attributes:
        kind: kind of the end.
        bare_m: length without sheath, in metres, which is part of the cable's length; 0 for a cut end.
        collar: colour of a ferrule's plastic collar, sRGB levels.
    """

    kind: EndKind = EndKind.CUT
    bare_m: Annotated[float, Field(ge=0)] = 0.0
    collar: Rgb = (0, 0, 0)


class Cable(Model):
    """One cable before the fall: a curve that is level, rises evenly by `rise_m`, or has `heights_m` along it.

    A curve that is not level keeps to the plan of the level one and to its middle; what it climbs, its ends fall short.

    Attributes:
        diameter_m: diameter in metres; of a bundle, that of the circle around its strands.
        length_m: length along the cable, in metres.
        x_m: x of the cable's middle, in metres.
        y_m: y of the cable's middle, in metres.
        start_height_m: height of the underside of the cable's beginning above the floor, in metres; of a cable with
            `heights_m` or a knot, that of its lowest place.
        rotation_deg: mean bearing of the cable, in degrees from the x axis.
        bends_per_m: natural curvature at equally spaced points from end to end, in 1/m; all 0 is straight.
        rise_m: height of the cable's end above its beginning, in metres, so that loops and coils lie on themselves.
        heights_m: heights above `start_height_m` at equally spaced points along the level curve from end to end, in
            metres, in place of `rise_m`, two or more; they weave a tangle. Empty is an even rise.
        knot: knot in the cable, which decides its start in place of `bends_per_m`, `rise_m` and `heights_m`; None is a
            cable without a knot.
        youngs_modulus_pa: bending stiffness over the second moment of area of a full round section, in pascals.
        density_kg_m3: mass over the volume of a full round section, in kg/m3.
        material: look of the cable; that of a bundle holds its strands.
        ends: kinds of the cable's beginning and end.
    """

    diameter_m: Annotated[float, Field(gt=0)]
    length_m: Annotated[float, Field(gt=0)]
    x_m: float
    y_m: float
    start_height_m: Annotated[float, Field(ge=0)]
    rotation_deg: float
    bends_per_m: Annotated[tuple[float, ...], Field(min_length=2)]
    rise_m: float = 0.0
    heights_m: tuple[Annotated[float, Field(ge=0)], ...] = ()
    knot: Knot | None = None
    youngs_modulus_pa: Annotated[float, Field(gt=0)]
    density_kg_m3: Annotated[float, Field(gt=0)]
    material: Look
    ends: tuple[CableEnd, CableEnd] = (CableEnd(), CableEnd())

    @model_validator(mode="after")
    def _can_be_laid(self) -> Self:
        if len(self.heights_m) == 1:
            raise ValueError("heights_m must have two heights or more, or none")
        if abs(self.rise_m) >= self.length_m:
            raise ValueError(f"rise_m must be below the length of {self.length_m:g} m")
        return self
