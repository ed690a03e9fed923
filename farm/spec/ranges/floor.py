"""The ranges of the floor: the position of its texture, and its wear."""

from typing import Annotated

from pydantic import AfterValidator, Field

from farm.model import Model
from farm.spec.ranges.types import Fraction, FractionRange, NotNegativeRange, Range, ScaleRange, StopsRange, in_order

Scratches = Annotated[float, Field(ge=0, le=1000)]


Albedo = Annotated[float, Field(ge=0.001, le=0.9)]


JointSpread = Annotated[float, Field(ge=0, le=0.003)]


class WearRanges(Model):
    """The ranges of a floor's wear; `farm.scene.floor.Wear` and `JointFill` explain what has no description here.

    Attributes:
        share: share of the floors that are worn.
        brightness_ev: change of the floor's brightness, in stops.
        tint_ev: further change of each of red, green and blue, in stops.
        stained_share: share of the worn floors that have stains.
        scratched_share: share of the worn floors that have scratches.
        dusty_share: share of the worn floors that have dust.
        refilled_share: share of the worn floors whose joints are filled otherwise.
        joint_albedo: albedo of the joints' filling in green light, sampled log-uniformly.
        joint_warmth_ev: excess of the filling's red over its green, in stops; its blue is as much below the green.
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
    """The ranges of the floor.

    Attributes:
        offset_x: offset of the texture along its x axis, in tiles.
        offset_y: offset of the texture along its y axis, in tiles.
        rotation_deg: rotation of the texture.
        scale: factor of the texture's size on the floor.
        light_share: share of floors that are chosen from the light surfaces alone (see `farm.spec.header`), as tables
            are light; it is ours.
        wear: ranges of the wear.
    """

    offset_x: Range = (-100.0, 100.0)
    offset_y: Range = (-100.0, 100.0)
    rotation_deg: Range = (0.0, 360.0)
    scale: ScaleRange = (0.7, 1.5)
    light_share: Fraction = 0.0
    wear: WearRanges = WearRanges()
