"""The lamps that light a scene, and the grey world around them."""

from typing import Annotated, Literal

from pydantic import Field

from farm.model import Model


class PointLamp(Model):
    """A lamp that shines to all sides, a sphere of radius `size_m`.

    Attributes:
        bearing_deg: bearing of the lamp from the origin, in degrees from the x axis.
        radius_m: horizontal distance from the origin, in metres.
        height_m: height above the floor, in metres.
        power_w: radiant power as Blender counts it, in watts.
        size_m: radius of the sphere, in metres: a larger one throws softer shadows.
    """

    kind: Literal["point"] = "point"
    bearing_deg: float
    radius_m: float
    height_m: float
    power_w: float
    size_m: float


class AreaLamp(Model):
    """An area light beside the cables, whose height and size are the template's.

    Attributes:
        x_m: position to the left (below 0) or right of the cables, in metres.
        power_w: radiant power as Blender counts it, in watts.
    """

    kind: Literal["area"] = "area"
    x_m: float
    power_w: float


class StudioLamp(Model):
    """A round lamp that faces the cables.

    Attributes:
        bearing_deg: bearing of the lamp from the cables, in degrees from the x axis.
        elevation_deg: angle of the lamp above the floor, seen from the cables, in degrees.
        distance_m: distance from the cables, in metres.
        irradiance_w_m2: irradiance at the cables, on a surface that faces the lamp, in W/m2; 1 is about as bright as a
            grey world of radiance 0.3.
        size_m: diameter in metres; its ratio to the distance decides how soft shadows are.
        temperature_k: temperature of a black body of the lamp's colour, in kelvins.
    """

    kind: Literal["studio"] = "studio"
    bearing_deg: float
    elevation_deg: Annotated[float, Field(gt=0, le=90)]
    distance_m: Annotated[float, Field(gt=0)]
    irradiance_w_m2: Annotated[float, Field(ge=0)]
    size_m: Annotated[float, Field(gt=0)]
    temperature_k: Annotated[float, Field(ge=1000, le=20_000)]


Lamp = Annotated[PointLamp | AreaLamp | StudioLamp, Field(discriminator="kind")]


class GreyWorld(Model):
    """Even light from all sides, beside that of the lamps.

    Attributes:
        radiance: radiance in scene-linear units.
        temperature_k: temperature of a black body of the light's colour, in kelvins.
    """

    radiance: Annotated[float, Field(ge=0)]
    temperature_k: Annotated[float, Field(ge=1000, le=20_000)]
