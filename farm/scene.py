"""One scene, drawn and not yet fallen: every random value of a picture, free of Blender.

Lengths are metres, angles degrees, powers watts, colours 8-bit levels of linear light, unless a field says
otherwise. World axes: x right and y up in the picture, z towards the camera, the floor's surface at z = 0.
"""

from typing import Annotated, Literal

from pydantic import Field

from farm.model import Model, Vector3

Rgb = tuple[
    Annotated[int, Field(ge=0, le=255)],
    Annotated[int, Field(ge=0, le=255)],
    Annotated[int, Field(ge=0, le=255)],
]


class CableMaterial(Model):
    """A cable's surface: colour, the dirt's density and pattern, and the second ramp's position."""

    colour: Rgb
    dirt_colour: Rgb
    dirt_position: float
    dirt_mapping: Vector3
    dirt_offset: float
    reflection_position: float


class Cable(Model):
    """One cable before the fall: a level curve whose middle is at (x, y, start_height_m).

    Attributes:
        rotation_deg: mean bearing of the cable, counted from the x axis.
        bends_per_m: its natural curvature in 1/m at equally spaced points from end to end; all 0 is straight.
        youngs_modulus_pa: bending stiffness over the second moment of area of a full round section.
        density_kg_m3: mass over volume.
    """

    diameter_m: Annotated[float, Field(gt=0)]
    length_m: Annotated[float, Field(gt=0)]
    x_m: float
    y_m: float
    start_height_m: Annotated[float, Field(ge=0)]
    rotation_deg: float
    bends_per_m: Annotated[tuple[float, ...], Field(min_length=2)]
    youngs_modulus_pa: Annotated[float, Field(gt=0)]
    density_kg_m3: Annotated[float, Field(gt=0)]
    material: CableMaterial


class Gust(Model):
    """One swing of the wind's speed: `share` of the mean, as a sine of the given period and phase."""

    share: Annotated[float, Field(ge=0, le=1)]
    period_s: Annotated[float, Field(gt=0)]
    phase_deg: float


class Friction(Model):
    """Coulomb's coefficients, for a cable on the floor and on another cable."""

    floor: Annotated[float, Field(ge=0)]
    cable: Annotated[float, Field(ge=0)]


class Wind(Model):
    """The wind that pushes the cables while they fall.

    The bearing is where it comes from, as seen from the cables; a tilt of 90 degrees blows level, less blows up.
    Distance, height, strength and flow are those of a wind field in the cloth's own units; `speed_m_s` and `gusts`
    are what the rod solver takes.
    """

    bearing_deg: float
    distance: float
    height: float
    tilt_deg: float
    strength: float
    flow: float
    speed_m_s: Annotated[float, Field(ge=0)]
    gusts: tuple[Gust, ...]


class Floor(Model):
    """The floor's texture and how it lies; offsets in tiles."""

    texture: str
    offset_x: float
    offset_y: float
    rotation_deg: float
    scale: float


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


class Plate(Model):
    """The part of a photograph that stands behind the cables of a far picture: a square, out of focus.

    Attributes:
        name: the photograph's, in the dataset's catalogue.
        x: where the square lies between the photograph's left edge, 0, and its right, 1.
        y: the same from its top, 0, to its bottom, 1.
        zoom: edge of the square, as a share of the photograph's short side.
        mirror: left and right are swapped.
        blur_px: radius of the lens's disc, in pixels of the picture.
    """

    name: str
    x: Annotated[float, Field(ge=0, le=1)]
    y: Annotated[float, Field(ge=0, le=1)]
    zoom: Annotated[float, Field(ge=0.3, le=1)]
    mirror: bool
    blur_px: Annotated[float, Field(ge=0)]


class Camera(Model):
    """A camera straight above the origin, focused on the floor."""

    height_m: Annotated[float, Field(gt=0)]
    f_number: Annotated[float, Field(gt=0)]


class Scene(Model):
    """Everything drawn for one attempt at one job.

    `floor` is None where the floor is hidden from the camera; of `lamp` and `hdri_world` exactly one is given.
    """

    attempt: Annotated[int, Field(ge=0)]
    cables: Annotated[tuple[Cable, ...], Field(min_length=1)]
    vertex_mass: Annotated[float, Field(gt=0)]
    friction: Friction
    wind: Wind
    floor: Floor | None
    lamp: Annotated[PointLamp | AreaLamp, Field(discriminator="kind")] | None
    hdri_world: HdriWorld | None
    camera: Camera
    render_seed: Annotated[int, Field(ge=0, lt=2**31)]
