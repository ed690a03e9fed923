"""The ranges of cables: how many, how thick, how stiff, and what they look like.

What goes beyond the published surface is off unless a style turns it on.

A *share* is a chance from 0 to 1, drawn once for each cable unless it says otherwise.
"""

from typing import Annotated, Self

from pydantic import AfterValidator, Field, model_validator

from farm.model import Model
from farm.spec.ranges.types import (
    CableCountRange,
    CableLengthRange,
    CountRange,
    DensityRange,
    DiameterRange,
    Fraction,
    FractionRange,
    FrictionRange,
    LevelRange,
    ModulusRange,
    NotNegative,
    PositiveRange,
    Range,
    StrandCountRange,
    StripeCountRange,
    in_order,
)

Weight = NotNegative
LayDiameters = Annotated[float, Field(ge=3, le=1e5)]
TieWidth = Annotated[float, Field(ge=0.001, le=0.02)]


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


WidestShare = Annotated[float, Field(ge=0.01, le=1)]


class CableRanges(Model):
    """How many cables, how thick (ours: one value), how long (ours), how heavy and stiff, and their surface.

    Of `count_draws` even draws of the count the largest holds: with three, up to eight cables are six on average.
    Far cables may have a length of their own: over a floor that is not seen, one that ends in the picture floats.
    Diameters are drawn evenly in their logarithm, from what is neither narrower than `narrowest_share` of the picture
    nor wider than `widest_share`.

    `vertex_mass` is the published setting of the cloth. Young's modulus (drawn evenly in its logarithm), density and
    friction are ours: soft silicone leads to stiff sheathed wire. Modulus and density are those of a full round
    section of the cable's diameter with the cable's bending stiffness and weight.
    """

    count: CableCountRange = (1, 8)
    count_draws: Annotated[int, Field(ge=1, le=10)] = 3
    diameter_m: DiameterRange = (0.0024, 0.0024)
    narrowest_share: Fraction = 0.0
    widest_share: WidestShare = 1.0
    length_m: CableLengthRange = (0.40, 0.40)
    far_length_m: CableLengthRange | None = None
    vertex_mass: PositiveRange = (0.3, 0.5)
    youngs_modulus_pa: ModulusRange = (1e6, 3e7)
    density_kg_m3: DensityRange = (1200.0, 2500.0)
    friction_floor: FrictionRange = (0.3, 0.6)
    friction_cable: FrictionRange = (0.2, 0.5)
    colour: LevelRange = (0, 255)
    dirt_position: FractionRange = (0.65, 0.89)
    dirt_offset: Range = (-500.0, 500.0)
    dirt_colour: LevelRange = (0, 4)
    reflection_position: FractionRange = (0.60, 0.70)
    skin: SkinRanges = SkinRanges()
    bundle: BundleRanges = BundleRanges()
    ends: EndRanges = EndRanges()

    @model_validator(mode="after")
    def _narrowest_below_widest(self) -> Self:
        if self.narrowest_share > self.widest_share:
            raise ValueError(f"narrowest_share {self.narrowest_share:g} is above widest_share {self.widest_share:g}")
        return self

    def diameters_m(self, seen_m: float) -> tuple[float, float]:
        """The range of diameters in a picture that shows `seen_m` of the floor from side to side."""
        narrowest, widest = self.narrowest_share * seen_m, self.widest_share * seen_m
        low, high = (min(max(end, narrowest), widest) for end in self.diameter_m)
        return low, high
