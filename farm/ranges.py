"""The range of every random parameter, with the published defaults.

Source: Malvido Fresnillo et al., "Generation of realistic synthetic cable images to train deep learning
segmentation models", Machine Vision and Applications 35(4), 2024, doi 10.1007/s00138-024-01562-y.

Lengths are metres of the picture, in which cables are true to size (2 mm thick); angles are degrees. The wind's
numbers are those of a Blender wind field in the fall's own units (ARCHITECTURE.md, "Two scales"). Where the
publication gives no figure (cable length, drop height, spacing, f-number) the default is ours and marked so.
"""

from typing import Annotated, Self

from pydantic import AfterValidator, Field, model_validator

from farm.model import Model


def _in_order(bounds: tuple[float, float]) -> tuple[float, float]:
    if bounds[0] > bounds[1]:
        raise ValueError(f"the low end {bounds[0]} is above the high end {bounds[1]}")
    return bounds


def _counts_in_order(bounds: tuple[int, int]) -> tuple[int, int]:
    _in_order(bounds)
    return bounds


Fraction = Annotated[float, Field(ge=0, le=1)]
Length = Annotated[float, Field(ge=-10, le=10)]
Positive = Annotated[float, Field(gt=0, le=1e5)]
NotNegative = Annotated[float, Field(ge=0, le=1e5)]
Level = Annotated[int, Field(ge=0, le=255)]
Modulus = Annotated[float, Field(ge=1e5, le=1e10)]
Density = Annotated[float, Field(ge=100, le=20_000)]
FrictionCoefficient = Annotated[float, Field(ge=0, le=2)]
CableCount = Annotated[int, Field(ge=1, le=8)]

Bend = Annotated[float, Field(ge=-15, le=15)]
BEND_KNOTS = 7

Range = Annotated[tuple[float, float], AfterValidator(_in_order)]
FractionRange = Annotated[tuple[Fraction, Fraction], AfterValidator(_in_order)]
LengthRange = Annotated[tuple[Length, Length], AfterValidator(_in_order)]
PositiveRange = Annotated[tuple[Positive, Positive], AfterValidator(_in_order)]
NotNegativeRange = Annotated[tuple[NotNegative, NotNegative], AfterValidator(_in_order)]
ModulusRange = Annotated[tuple[Modulus, Modulus], AfterValidator(_in_order)]
DensityRange = Annotated[tuple[Density, Density], AfterValidator(_in_order)]
FrictionRange = Annotated[tuple[FrictionCoefficient, FrictionCoefficient], AfterValidator(_in_order)]
LevelRange = Annotated[tuple[Level, Level], AfterValidator(_counts_in_order)]
CableCountRange = Annotated[tuple[CableCount, CableCount], AfterValidator(_counts_in_order)]


SPACING_DIAMETERS = 1.5
"""Cables start at least so far above each other, which leaves room for the cloth's collision distance."""


class FloorRanges(Model):
    """Where the floor's texture lies. Offsets are counted in whole tiles of the texture."""

    offset_x: Range = (-100.0, 100.0)
    offset_y: Range = (-100.0, 100.0)
    rotation_deg: Range = (0.0, 360.0)
    scale: PositiveRange = (0.7, 1.5)


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
    came from. The published cables start straight and are bent by the cloth's own drift.
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
    bend_per_m: Annotated[tuple[Bend, Bend], AfterValidator(_in_order)] = (-5.0, 5.0)


class CableRanges(Model):
    """How many cables, how thick (ours: one value), how long (ours), how heavy and stiff, and their surface.

    `vertex_mass` is the published setting of the cloth. Young's modulus (drawn evenly in its logarithm), density and
    friction are ours: soft silicone leads to stiff sheathed wire. Modulus and density are those of a full round
    section of the cable's diameter with the cable's bending stiffness and weight.
    """

    count: CableCountRange = (1, 8)
    diameter_m: Annotated[float, Field(ge=0.0005, le=0.02)] = 0.002
    length_m: Annotated[float, Field(ge=0.05, le=2.0)] = 0.40
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


class LampRanges(Model):
    """The one lamp of a concentrated light: a point or an area light, distances in metres."""

    area_share: Fraction = 0.5
    point_bearing_deg: Range = (0.0, 360.0)
    point_radius_m: PositiveRange = (5.0, 6.5)
    point_height_m: PositiveRange = (5.0, 6.5)
    point_power_w: NotNegativeRange = (800.0, 1500.0)
    point_size_m: PositiveRange = (0.1, 2.0)
    area_distance_m: PositiveRange = (4.0, 15.0)
    area_power_w: NotNegativeRange = (400.0, 1800.0)


class WorldRanges(Model):
    """The HDRI's turn, its brightness when it is a dark one, and its tilt over a floor."""

    rotation_deg: Range = (-180.0, 180.0)
    dark_brightness: FractionRange = (0.10, 0.60)
    close_tilts_deg: Annotated[tuple[float, ...], Field(min_length=1)] = (0.0, 90.0)


class CameraRanges(Model):
    """The camera's heights, which set the cable's size in pixels. The f-number is ours.

    Above 1.5 m a picture would show the edge of the floor.
    """

    heights_m: Annotated[tuple[Annotated[float, Field(ge=0.02, le=1.5)], ...], Field(min_length=1)] = (
        0.09,
        0.12,
        0.15,
        0.16,
        0.18,
        0.20,
        0.22,
        0.24,
        0.27,
        0.30,
        0.33,
    )
    f_number: Annotated[float, Field(ge=0.5, le=128)] = 8.0


class Ranges(Model):
    """Every range, by the part of the scene it belongs to."""

    floor: FloorRanges = FloorRanges()
    wind: WindRanges = WindRanges()
    placement: PlacementRanges = PlacementRanges()
    cable: CableRanges = CableRanges()
    lamp: LampRanges = LampRanges()
    world: WorldRanges = WorldRanges()
    camera: CameraRanges = CameraRanges()

    @model_validator(mode="after")
    def _fit_each_other(self) -> Self:
        diameter = self.cable.diameter_m
        if self.placement.spacing_m < SPACING_DIAMETERS * diameter:
            raise ValueError(
                f"placement.spacing_m {self.placement.spacing_m} is below {SPACING_DIAMETERS} times cable.diameter_m "
                f"{diameter}: cables would start inside each other"
            )
        pile = self.cable.count[1] * diameter
        if min(self.camera.heights_m) < 2 * pile:
            raise ValueError(
                f"camera.heights_m {min(self.camera.heights_m)} is below twice the highest pile, {pile:g} m "
                "(cable.count times cable.diameter_m): the camera would be among the cables"
            )
        return self
