"""What is behind the cables: the HDRI that also lights them, or a photograph."""

from typing import Annotated

from pydantic import Field

from farm.model import Model


class Plate(Model):
    """A photograph of the user's behind the cables.

    Attributes:
        name: in the dataset's catalogue.
        x: where the seen square lies between the left (0) and the right (1).
        y: likewise, between top and bottom.
        zoom: edge of the seen square over the photograph's shorter side.
        mirror: whether left and right are swapped.
        blur_px: radius of the disc by which it is out of focus, in the picture's pixels.
    """

    name: str
    x: Annotated[float, Field(ge=0, le=1)]
    y: Annotated[float, Field(ge=0, le=1)]
    zoom: Annotated[float, Field(ge=0.3, le=1)]
    mirror: bool
    blur_px: Annotated[float, Field(ge=0)]


class HdriWorld(Model):
    """The HDRI that lights the scene.

    Attributes:
        hdri: its name in the dataset's catalogue.
        rotation_deg: turn about the vertical of the HDRI.
        tilt_deg: 0: its zenith is above the floor; 90: the camera looks at its horizon, upright.
        brightness: the second mix factor; 0 leaves the HDRI as it is, 1 doubles it.
    """

    hdri: str
    rotation_deg: float
    tilt_deg: float
    brightness: Annotated[float, Field(ge=0, le=1)]
