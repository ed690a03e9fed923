"""The ranges of what cables look like, beyond the published surface; all of it is off unless a style turns it on.

A *share* is a chance from 0 to 1, drawn once for each cable unless it says otherwise.
"""

from typing import Annotated

from pydantic import AfterValidator, Field

from farm.model import Model
from farm.range_types import (
    CountRange,
    DiameterRange,
    Fraction,
    FractionRange,
    NotNegative,
    PositiveRange,
    StrandCountRange,
    StripeCountRange,
    in_order,
)

Weight = NotNegative
LayDiameters = Annotated[float, Field(ge=3, le=1e5)]
TieWidth = Annotated[float, Field(ge=0.001, le=0.02)]
StickDiameter = Annotated[float, Field(ge=0.001, le=0.05)]
StickLength = Annotated[float, Field(ge=0.01, le=1.0)]


class PaletteRanges(Model):
    """Where a sheath's colour comes from, by weight; `neutral` is black, white and grey.

    The codes are those of DIN 47100 (data cables) and IEC 60757 (the colours of conductors).
    """

    uniform_rgb: Weight = 1.0
    neutral: Weight = 0.0
    din_47100: Weight = 0.0
    iec_60757: Weight = 0.0


class SkinRanges(Model):
    """Sheaths drawn as images around and along a cable.

    Attributes:
        share: of the pictures whose cables have skins; the others have the published surface.
        alike_share: of the pictures in which all cables are of one thickness, sheath and finish, only coloured apart.
        stripe_share: two-coloured cables.
        spiral_share: of these, those whose stripe winds round; the others' is straight.
        stripe_width: of the circumference, all stripes together.
        stripe_count: around the cable.
        spiral_pitch_diameters: length of a turn over the diameter.
        roughness: 0.15 is glossy, 0.75 matt.
        translucent_share: sheaths through which strands of copper are seen.
        braided_share: textile or metal braid.
        marking_share: printed text.
        dirt: share of the surface that is soiled, 0 at the low end for as many as are clean.
        clean_share: cables without any dirt.
        wear: share of the surface that is rubbed.
    """

    share: Fraction = 0.0
    alike_share: Fraction = 1.0
    palette: PaletteRanges = PaletteRanges()
    stripe_share: Fraction = 0.0
    spiral_share: Fraction = 0.5
    stripe_width: FractionRange = (0.1, 0.5)
    stripe_count: StripeCountRange = (1, 2)
    spiral_pitch_diameters: PositiveRange = (2.0, 8.0)
    roughness: FractionRange = (0.15, 0.75)
    translucent_share: Fraction = 0.0
    braided_share: Fraction = 0.0
    marking_share: Fraction = 0.0
    dirt: FractionRange = (0.0, 0.25)
    clean_share: Fraction = 0.5
    wear: FractionRange = (0.0, 0.2)


class BundleRanges(Model):
    """Bundles of strands with ties, in the place of single cables.

    Attributes:
        share: cables that are bundles.
        strands: how many.
        strand_diameter_m: of each strand; thicker where `CableRanges.narrowest_share` asks for it.
        lay_diameters: length of one turn around each other over the bundle's diameter.
        ties: how many a bundle has.
        tie_width_m: along the bundle.
    """

    share: Fraction = 0.0
    strands: StrandCountRange = (2, 7)
    strand_diameter_m: DiameterRange = (0.001, 0.002)
    lay_diameters: Annotated[tuple[LayDiameters, LayDiameters], AfterValidator(in_order)] = (15.0, 40.0)
    ties: CountRange = (0, 3)
    tie_width_m: Annotated[tuple[TieWidth, TieWidth], AfterValidator(in_order)] = (0.0025, 0.0048)


class EndRanges(Model):
    """How cables end.

    Attributes:
        stripped_share: ends with bare copper.
        ferrule_share: ends with a ferrule and its collar.
        bare_m: length without sheath.
    """

    stripped_share: Fraction = 0.0
    ferrule_share: Fraction = 0.0
    bare_m: PositiveRange = (0.005, 0.012)


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
