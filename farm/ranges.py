"""The range of every random parameter, with the published defaults.

Source: Malvido Fresnillo et al., "Generation of realistic synthetic cable images to train deep learning
segmentation models", Machine Vision and Applications 35(4), 2024, doi 10.1007/s00138-024-01562-y.

Lengths are metres of the picture, in which cables are true to size (2.4 mm thick); angles are degrees. The wind's
numbers are those of a Blender wind field in the fall's own units (ARCHITECTURE.md, "Two scales"). Where the
publication gives no figure (cable length, drop height, spacing, f-number) the default is ours and marked so.
"""

from typing import Annotated, Self

from pydantic import AfterValidator, Field, model_validator

from farm.camera_ranges import CameraRanges, DevelopmentRanges
from farm.lens import FOCAL_LENGTH_MM, SENSOR_MM
from farm.light_ranges import LampRanges, PlateRanges, StudioRanges, WorldRanges
from farm.look_ranges import BundleRanges, ClutterRanges, EndRanges, SkinRanges
from farm.model import Model
from farm.range_types import (
    BendRange,
    CableCountRange,
    CableLengthRange,
    DensityRange,
    DiameterRange,
    Fraction,
    FractionRange,
    FrictionRange,
    LengthRange,
    LevelRange,
    ModulusRange,
    NotNegative,
    NotNegativeRange,
    PositiveRange,
    Range,
    ScaleRange,
    StopsRange,
    in_order,
)

Scratches = Annotated[float, Field(ge=0, le=1000)]
Albedo = Annotated[float, Field(ge=0.001, le=0.9)]
JointSpread = Annotated[float, Field(ge=0, le=0.003)]
WidestShare = Annotated[float, Field(ge=0.01, le=1)]

BEND_KNOTS = 7

SPACING_DIAMETERS = 1.5
"""Cables start at least so many diameters above each other, which leaves room for the cloth's collision distance."""


class WearRanges(Model):
    """What a floor has been through, beyond what its texture shows; see `farm.scene.Wear` for each.

    Attributes:
        share: of the floors that are changed so.
        brightness_ev: stops, by which its colour is brighter or darker.
        tint_ev: stops of red, green and blue beside that.
        stained_share: of these floors that have stains; likewise for scratches, dust and refilled joints.
        joint_albedo: of what fills them, drawn evenly in its logarithm.
        joint_warmth_ev: stops, by which it is redder than green, and as much less blue.
    """

    share: Fraction = 0.0
    brightness_ev: StopsRange = (-0.5, 0.7)
    tint_ev: StopsRange = (-0.12, 0.12)
    saturation: NotNegativeRange = (0.5, 1.2)
    contrast: NotNegativeRange = (0.7, 1.3)
    stained_share: Fraction = 0.3
    stains: FractionRange = (0.02, 0.2)
    scratched_share: Fraction = 0.3
    scratches: Annotated[tuple[Scratches, Scratches], AfterValidator(in_order)] = (1.0, 12.0)
    dusty_share: Fraction = 0.3
    dust: FractionRange = (0.05, 0.35)
    refilled_share: Fraction = 0.5
    joint_albedo: Annotated[tuple[Albedo, Albedo], AfterValidator(in_order)] = (0.02, 0.5)
    joint_warmth_ev: StopsRange = (-0.1, 0.4)
    joint_cover: FractionRange = (0.5, 1.0)
    joint_spread_m: Annotated[tuple[JointSpread, JointSpread], AfterValidator(in_order)] = (0.0, 0.0006)


class FloorRanges(Model):
    """Where the floor's texture lies. Offsets are counted in whole tiles of the texture.

    `light_share` is ours: of the floors that are drawn from the light surfaces alone (`farm.header`), as tables are.
    """

    offset_x: Range = (-100.0, 100.0)
    offset_y: Range = (-100.0, 100.0)
    rotation_deg: Range = (0.0, 360.0)
    scale: ScaleRange = (0.7, 1.5)
    light_share: Fraction = 0.0
    wear: WearRanges = WearRanges()


class WindRanges(Model):
    """The wind field: where it stands, how it points and how hard it blows, in the cloth's units.

    `speed_per_strength_m_s`, for the rod solver, and the gusts are ours: at full strength a light breeze of 2.5 m/s.
    """

    bearing_deg: Range = (0.0, 360.0)
    distance: NotNegativeRange = (5.0, 8.0)
    height: NotNegativeRange = (0.0, 3.0)
    tilt_deg: Range = (60.0, 120.0)
    strength: NotNegativeRange = (0.0, 10.0)
    flow_per_strength: NotNegative = 0.2
    speed_per_strength_m_s: NotNegative = 0.25
    gust_share: FractionRange = (0.0, 0.3)
    gust_period_s: PositiveRange = (0.02, 0.2)


class PlacementRanges(Model):
    """Where the cables start, at stacked heights. `drop_height_m`, `spacing_m` and `bend_per_m` are ours.

    `bend_per_m` is a cable's natural curvature, drawn at `BEND_KNOTS` points along it: what is left of the coil it
    came from. The published cables start straight and are bent by the cloth's own drift. Cables with a loop
    somewhere, or coiled all along, are ours too.
    """

    free_x_m: LengthRange = (-0.025, 0.025)
    free_y_m: LengthRange = (-0.035, 0.035)
    free_rotation_deg: Range = (0.0, 180.0)
    aligned_x_m: LengthRange = (-0.012, 0.012)
    aligned_y_m: LengthRange = (-0.014, 0.014)
    aligned_bearing_deg: Range = (0.0, 360.0)
    aligned_deviation_deg: Range = (-10.0, 10.0)
    drop_height_m: Annotated[float, Field(ge=0, le=0.2)] = 0.004
    spacing_m: Annotated[float, Field(gt=0, le=0.1)] = 0.004
    bend_per_m: BendRange = (-5.0, 5.0)
    loop_share: Fraction = 0.0
    loop_radius_m: PositiveRange = (0.012, 0.04)
    coil_share: Fraction = 0.0
    coil_radius_m: PositiveRange = (0.015, 0.05)


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


class Ranges(Model):
    """Every range, by the part of the scene it belongs to."""

    floor: FloorRanges = FloorRanges()
    wind: WindRanges = WindRanges()
    placement: PlacementRanges = PlacementRanges()
    cable: CableRanges = CableRanges()
    clutter: ClutterRanges = ClutterRanges()
    lamp: LampRanges = LampRanges()
    studio: StudioRanges = StudioRanges()
    world: WorldRanges = WorldRanges()
    plate: PlateRanges = PlateRanges()
    camera: CameraRanges = CameraRanges()
    development: DevelopmentRanges = DevelopmentRanges()

    @model_validator(mode="after")
    def _fit_each_other(self) -> Self:
        lowest = min(self.camera.heights_m)
        pile = self.cable.count[1] * self.cable.diameters_m(seen_width_m(lowest))[1]
        if lowest < 2 * pile:
            raise ValueError(
                f"camera.heights_m {lowest} is below twice the highest pile, {pile:g} m "
                "(cable.count times the thickest cable): the camera would be among the cables"
            )
        return self


def seen_width_m(height_m: float) -> float:
    """Width of the floor that the published lens sees from a height."""
    return height_m * SENSOR_MM / FOCAL_LENGTH_MM
