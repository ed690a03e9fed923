"""A cable before its fall: where it starts, what it is made of, and what it looks like."""

from enum import StrEnum
from typing import Annotated, Literal

from pydantic import Field

from farm.model import Metres, Model, Rgb, Share, Vector3


class CableMaterial(Model):
    """The published surface: colour, the dirt's density and pattern, and the second ramp's position.

    Colours are 8-bit levels of linear light, as the published set-up reads them.
    """

    kind: Literal["procedural"] = "procedural"
    colour: Rgb
    dirt_colour: Rgb
    dirt_position: float
    dirt_mapping: Vector3
    dirt_offset: float
    reflection_position: float


class Sheath(StrEnum):
    """What is around a cable's conductors."""

    PLAIN = "plain"
    TRANSLUCENT = "translucent"
    BRAIDED = "braided"


class StripeKind(StrEnum):
    """How a second colour runs along a cable."""

    STRAIGHT = "straight"
    SPIRAL = "spiral"


class Stripe(Model):
    """A second colour.

    Attributes:
        colour: sRGB levels.
        share: of the circumference that it takes, all stripes together.
        count: of stripes around the cable.
        pitch_m: length of one turn of a spiral; of a straight one, how slowly the cable's own twist turns it.
    """

    kind: StripeKind
    colour: Rgb
    share: Share
    count: Annotated[int, Field(ge=1, le=4)]
    pitch_m: Metres


class Marking(Model):
    """Text printed along a cable, again and again.

    Attributes:
        colour: sRGB levels.
        height_share: height of the letters over the cable's diameter.
        repeat_m: from one beginning to the next.
    """

    text: Annotated[str, Field(min_length=1, max_length=60, pattern=r"^[ -~]+$")]
    colour: Rgb
    height_share: Share
    repeat_m: Metres


class Skin(Model):
    """A sheath that is drawn as an image around and along the cable. Colours are sRGB levels.

    Attributes:
        roughness: of the surface: 0.15 is glossy, 0.75 matt.
        dirt: share of the surface that is soiled.
        wear: share that is rubbed paler.
        pattern_seed: of everything that is irregular in it.
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
        along: where its middle is, as a share of the bundle's length.
        width_m: along the bundle.
        colour: sRGB levels.
    """

    along: Share
    width_m: Metres
    colour: Rgb


class Bundle(Model):
    """Strands that lie around each other in the place of one cable, whose diameter is that of a circle around them all.

    Attributes:
        strand_diameter_m: of each of them.
        lay_m: length over which they turn once around each other; negative is left-handed.
        phase_deg: of that turn at the start.
    """

    kind: Literal["bundle"] = "bundle"
    strands: Annotated[tuple[Skin, ...], Field(min_length=2, max_length=7)]
    strand_diameter_m: Metres
    lay_m: float
    phase_deg: float
    ties: tuple[Tie, ...]


def envelope_ratio(strands: int) -> float:
    """Diameter of the smallest circle around equal circles over theirs, for 2 to 7 of them (Graham 1968)."""
    return (2.0, 1.0 + 2.0 / 3.0**0.5, 1.0 + 2.0**0.5, 1.0 + (2.0 + 2.0 / 5.0**0.5) ** 0.5, 3.0, 3.0)[strands - 2]


Look = Annotated[CableMaterial | Skin | Bundle, Field(discriminator="kind")]


class EndKind(StrEnum):
    """How a cable ends."""

    CUT = "cut"
    STRIPPED = "stripped"
    FERRULE = "ferrule"


class CableEnd(Model):
    """One end of a cable.

    Attributes:
        bare_m: length without sheath, a part of the cable's length; 0 for one that is just cut.
        collar: sRGB levels of a ferrule's plastic collar.
    """

    kind: EndKind = EndKind.CUT
    bare_m: Annotated[float, Field(ge=0)] = 0.0
    collar: Rgb = (0, 0, 0)


class Cable(Model):
    """One cable before the fall: a level curve whose middle is at (x, y, start_height_m).

    Attributes:
        rotation_deg: mean bearing of the cable, counted from the x axis.
        bends_per_m: its natural curvature in 1/m at equally spaced points from end to end; all 0 is straight.
        rise_m: how much higher its end starts than its beginning, so that loops and coils lie on themselves.
        youngs_modulus_pa: bending stiffness over the second moment of area of a full round section.
        density_kg_m3: mass over volume.
        material: what is seen of it; a bundle has several strands.
        ends: where it starts and where it stops.
    """

    diameter_m: Annotated[float, Field(gt=0)]
    length_m: Annotated[float, Field(gt=0)]
    x_m: float
    y_m: float
    start_height_m: Annotated[float, Field(ge=0)]
    rotation_deg: float
    bends_per_m: Annotated[tuple[float, ...], Field(min_length=2)]
    rise_m: float = 0.0
    youngs_modulus_pa: Annotated[float, Field(gt=0)]
    density_kg_m3: Annotated[float, Field(gt=0)]
    material: Look
    ends: tuple[CableEnd, CableEnd] = (CableEnd(), CableEnd())
