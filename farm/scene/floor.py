"""The floor: its texture, how it lies, and its wear."""

from typing import Annotated

from pydantic import Field

from farm.model import Model

FLOOR_REACH_M = 0.6
"""Distance from the middle of the template's floor to its nearest edge: what no camera may look beyond."""


class JointFill(Model):
    """What fills a floor's joints, or has gathered in them: grout, sand, dirt, sealant.

    Attributes:
        albedo: of red, green and blue light.
        cover: share that it hides of what the texture shows there.
        spread_m: how far it reaches onto the edges of the pieces.
    """

    albedo: tuple[
        Annotated[float, Field(ge=0, le=1)], Annotated[float, Field(ge=0, le=1)], Annotated[float, Field(ge=0, le=1)]
    ]
    cover: Annotated[float, Field(ge=0, le=1)]
    spread_m: Annotated[float, Field(ge=0)]


class Wear(Model):
    """What a floor has been through, beyond what its texture shows.

    Attributes:
        brightness: its colour's factor, in linear light.
        tint: factors of red, green and blue beside that.
        saturation: 1 leaves colours as they are.
        contrast: of the texture about its mean; 1 leaves it as it is.
        stains: share of the floor under dried puddles.
        scratches: of them, a square decimetre.
        dust: share of the floor under a film of dust.
        mirrored: whether the texture is turned over.
        pattern_seed: of stains, scratches, dust and joints.
        joints: what fills its joints; None leaves them as the texture shows them.
    """

    brightness: Annotated[float, Field(gt=0)]
    tint: tuple[float, float, float]
    saturation: Annotated[float, Field(ge=0)]
    contrast: Annotated[float, Field(ge=0)]
    stains: Annotated[float, Field(ge=0, le=1)]
    scratches: Annotated[float, Field(ge=0)]
    dust: Annotated[float, Field(ge=0, le=1)]
    mirrored: bool
    pattern_seed: Annotated[int, Field(ge=0, lt=2**63)]
    joints: JointFill | None = None


class Floor(Model):
    """The floor's texture and how it lies; offsets in tiles."""

    texture: str
    offset_x: float
    offset_y: float
    rotation_deg: float
    scale: float
    wear: Wear | None = None
