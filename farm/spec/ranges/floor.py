"""The ranges of the floor: how its texture lies, and its wear."""

from typing import Annotated

from pydantic import AfterValidator, Field

from farm.model import Model
from farm.spec.ranges.types import Fraction, FractionRange, NotNegativeRange, Range, ScaleRange, StopsRange, in_order

Scratches = Annotated[float, Field(ge=0, le=1000)]


Albedo = Annotated[float, Field(ge=0.001, le=0.9)]


JointSpread = Annotated[float, Field(ge=0, le=0.003)]


class WearRanges(Model):
    """What a floor has been through, beyond what its texture shows; see `farm.scene.scene.Wear` for each.

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

    `light_share` is ours: the share of floors that are drawn from the light surfaces alone (`farm.spec.header`), as
    tables are.
    """

    offset_x: Range = (-100.0, 100.0)
    offset_y: Range = (-100.0, 100.0)
    rotation_deg: Range = (0.0, 360.0)
    scale: ScaleRange = (0.7, 1.5)
    light_share: Fraction = 0.0
    wear: WearRanges = WearRanges()
