"""The backdrop behind the cables: the HDRI that also lights them, or a photograph."""

from typing import Annotated

from pydantic import Field

from farm.model import Model


class Plate(Model):
    """A part of one of the user's photographs, shown behind the cables.

    Attributes:
        name: name of the photograph in the dataset's header.
        x: position of the part in the photograph, from the left (0) to the right (1).
        y: position of the part in the photograph, from the top (0) to the bottom (1).
        zoom: width of the part, as a share of that of the largest part of the picture's shape.
        mirror: whether left and right are swapped.
        blur_px: radius of the blur disc, in pixels of the picture.
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
        hdri: name of the HDRI in the dataset's header.
        rotation_deg: rotation about the HDRI's vertical, in degrees.
        tilt_deg: tilt of the HDRI, in degrees: at 0 its zenith is above the floor; at 90 the camera looks at its
            horizon, upright.
        brightness: light added to the HDRI's own, as a share of it: 0 adds none, 1 doubles it.
    """

    hdri: str
    rotation_deg: float
    tilt_deg: float
    brightness: Annotated[float, Field(ge=0, le=1)]
