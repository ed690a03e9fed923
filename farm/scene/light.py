"""Lamps that light a scene, and the grey world about them."""

from typing import Annotated, Literal

from pydantic import Field

from farm.model import Model


class PointLamp(Model):
    """A point light: a sphere of radius `size_m`."""

    kind: Literal["point"] = "point"
    bearing_deg: float
    radius_m: float
    height_m: float
    power_w: float
    size_m: float


class AreaLamp(Model):
    """An area light to the left (x < 0) or right of the cables; its height and size are the template's."""

    kind: Literal["area"] = "area"
    x_m: float
    power_w: float


class StudioLamp(Model):
    """A round lamp that faces the cables.

    Attributes:
        elevation_deg: above the floor, seen from the cables.
        irradiance_w_m2: at the cables, on a surface that faces it; 1 there is about as bright as a grey world of 0.3.
        size_m: its diameter; how soft shadows are goes by its share of the distance.
        temperature_k: of a black body of its colour.
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
    """Light from all sides beside a lamp's.

    Attributes:
        radiance: of it, scene-linear.
        temperature_k: of its colour.
    """

    radiance: Annotated[float, Field(ge=0)]
    temperature_k: Annotated[float, Field(ge=1000, le=20_000)]
