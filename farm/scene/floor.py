"""The floor: its texture, the texture's position, and its wear."""

from typing import Annotated

from pydantic import Field

from farm.model import Model

FLOOR_REACH_M = 0.6
"""Distance from the middle of the template's floor to its nearest edge, in metres: no camera may look beyond it."""


class JointFill(Model):
    """The filling of a floor's joints, or what has gathered in them: grout, sand, dirt, sealant.

    Attributes:
        albedo: albedo in red, green and blue light, 0 to 1.
        cover: share of the texture's own colour that the filling hides.
        spread_m: distance by which the filling reaches onto the pieces beside the joint, in metres.
    """

    albedo: tuple[
        Annotated[float, Field(ge=0, le=1)], Annotated[float, Field(ge=0, le=1)], Annotated[float, Field(ge=0, le=1)]
    ]
    cover: Annotated[float, Field(ge=0, le=1)]
    spread_m: Annotated[float, Field(ge=0)]


class Wear(Model):
    """The wear of a floor, which changes what its texture shows.

    Attributes:
        brightness: factor of the texture's linear light.
        tint: further factors of red, green and blue.
        saturation: factor of the colours' distance from grey; 1 leaves them as they are.
        contrast: factor of the texture's distance from its mean; 1 leaves it as it is.
        stains: share of the floor under dried puddles.
        scratches: number of scratches in a square decimetre.
        dust: share of the floor under a film of dust.
        mirrored: whether the texture's left and right are swapped.
        pattern_seed: seed of the stains, scratches, dust and joints.
        joints: filling of the floor's joints; None leaves them as the texture shows them.
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
    """The floor's texture and its position.

    Attributes:
        texture: name of the surface in the dataset's header.
        offset_x: offset of the texture along its own x axis, in tiles.
        offset_y: offset of the texture along its own y axis, in tiles.
        rotation_deg: rotation of the texture about the origin, in degrees.
        scale: factor of the texture's size on the floor.
        wear: wear of the floor; None leaves the texture as it is.
    """

    texture: str
    offset_x: float
    offset_y: float
    rotation_deg: float
    scale: float
    wear: Wear | None = None
