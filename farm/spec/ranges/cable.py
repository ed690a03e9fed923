"""The ranges of cables: their number, thickness, stiffness and look.

Everything beyond the published surface is off unless a style turns it on.

A *share* is a chance from 0 to 1, decided once for each cable unless its description says otherwise.
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
    """The weights by which a palette of sheath colours is chosen; only their ratios count.

    Attributes:
        uniform_rgb: weight of any colour.
        neutral: weight of black, white and grey.
        din_47100: weight of the code of DIN 47100, for data cables.
        iec_60757: weight of the code of IEC 60757, for conductors.
    """

    uniform_rgb: Weight = 1.0
    neutral: Weight = 0.0
    din_47100: Weight = 0.0
    iec_60757: Weight = 0.0


class SkinRanges(Model):
    """The ranges of skins: sheaths that are painted as images around and along a cable.

    Attributes:
        share: share of the pictures whose cables have skins; the others have the published surface.
        alike_share: share of the pictures whose cables have one thickness, sheath and finish, and differ in colour.
        palette: weights of the palettes of colours.
        stripe_share: share of cables with stripes of a second colour.
        spiral_share: share of striped cables whose stripes wind round; the others have straight ones.
        stripe_width: share of the circumference that all stripes together take.
        stripe_count: number of stripes around the cable.
        spiral_pitch_diameters: length of one turn of a spiral, in diameters of the cable.
        roughness: roughness of the surface: 0.15 is glossy, 0.75 matt.
        translucent_share: share of sheaths that let strands of copper show through.
        braided_share: share of sheaths that are a braid of textile or metal.
        marking_share: share of cables with printed text.
        dirt: share of the surface that is soiled, for cables that are not clean.
        clean_share: share of cables without dirt.
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
    """The ranges of bundles of strands with ties, in the place of single cables.

    Attributes:
        share: share of cables with skins that are bundles.
        strands: number of strands.
        strand_diameter_m: diameter of each strand, in metres; thicker if `CableRanges.narrowest_share` asks for it.
        lay_diameters: length over which the strands turn once around each other, in diameters of the bundle.
        ties: number of ties around a bundle.
        tie_width_m: width of a tie along the bundle, in metres.
    """

    share: Fraction = 0.0
    strands: StrandCountRange = (2, 7)
    strand_diameter_m: DiameterRange = (0.001, 0.002)
    lay_diameters: Annotated[tuple[LayDiameters, LayDiameters], AfterValidator(in_order)] = (15.0, 40.0)
    ties: CountRange = (0, 3)
    tie_width_m: Annotated[tuple[TieWidth, TieWidth], AfterValidator(in_order)] = (0.0025, 0.0048)


class EndRanges(Model):
    """The ranges of cables' ends.

    Attributes:
        stripped_share: share of ends with bare copper.
        ferrule_share: share of ends with a ferrule and its collar.
        bare_m: length without sheath, in metres; at least two diameters of the cable.
    """

    stripped_share: Fraction = 0.0
    ferrule_share: Fraction = 0.0
    bare_m: PositiveRange = (0.005, 0.012)


WidestShare = Annotated[float, Field(ge=0.01, le=1)]

LeastShare = Annotated[float, Field(ge=0, le=0.2)]
"""A picture's least share of pixels that show a cable. Above 0.2 most scenes of either style would be drawn in vain."""


class CableRanges(Model):
    """The ranges of cables. Diameter (one value), length, Young's modulus, density and friction are ours.

    Young's modulus and density are those of a full round section of the cable's diameter that has the cable's bending
    stiffness and weight; they range from soft silicone leads to stiff sheathed wire.

    Attributes:
        count: number of cables in a picture.
        background_share: share of the pictures that have no cable: floor, clutter, light and camera are as in others,
            and the mask is empty.
        least_visible_share: least share of a picture's pixels that show a cable. A scene that shows less is drawn again
            before it is rendered; pictures without cables are exempt.
        count_draws: number of uniform draws of which the largest is taken: three draws from 1 to 8 give 6.5 on average.
        diameter_m: diameter in metres, sampled log-uniformly; one number stands for a range without width.
        narrowest_share: smallest diameter, as a share of the picture's longer edge on the floor.
        widest_share: largest diameter, as a share of the picture's longer edge on the floor.
        length_m: length of a cable, in metres; one number stands for a range without width.
        far_length_m: length of a cable in far pictures, in metres; None is `length_m`. A far picture shows no floor, so
            a cable that ends in it seems to float.
        vertex_mass: mass of each vertex of the cloth, the published setting.
        youngs_modulus_pa: Young's modulus in pascals, sampled log-uniformly.
        density_kg_m3: density in kg/m3.
        friction_floor: coefficient of friction between a cable and the floor.
        friction_cable: coefficient of friction between two cables.
        colour: levels of each channel of the published surface's colour.
        dirt_position: position on the published colour ramp from which dirt shows.
        dirt_offset: offset of the published dirt pattern, in each of its four coordinates.
        dirt_colour: levels of each channel of the published dirt's colour.
        reflection_position: position of the published reflection ramp's second element.
        skin: ranges of skins.
        bundle: ranges of bundles.
        ends: ranges of the ends.
    """

    count: CableCountRange = (1, 8)
    background_share: Fraction = 0.0
    least_visible_share: LeastShare = 0.0
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
        """Compute the range of diameters, in metres, in a picture whose longer edge on the floor is `seen_m` metres."""
        narrowest, widest = self.narrowest_share * seen_m, self.widest_share * seen_m
        low, high = (min(max(end, narrowest), widest) for end in self.diameter_m)
        return low, high
