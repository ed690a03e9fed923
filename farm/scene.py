"""One scene, drawn and not yet fallen: every random value of a picture, free of Blender.

Lengths are metres, angles degrees, powers watts, colours 8-bit levels of linear light, unless a field says
otherwise. World axes: x right and y up in the picture, z towards the camera, the floor's surface at z = 0.
"""

from typing import Annotated

from pydantic import Field

from farm.clutter import Part, Sheet, Stick
from farm.lights import GreyWorld, HdriWorld, Lamp
from farm.looks import CableEnd, Look
from farm.model import Model
from farm.photograph import Camera, Development


class Cable(Model):
    """One cable before the fall: a level curve whose middle is at (x, y, start_height_m).

    Attributes:
        rotation_deg: mean bearing of the cable, counted from the x axis.
        bends_per_m: its natural curvature in 1/m at equally spaced points from end to end; all 0 is straight.
        rise_m: how much higher its end starts than its beginning, so that loops and coils lie on themselves.
        youngs_modulus_pa: bending stiffness over the second moment of area of a full round section.
        density_kg_m3: mass over volume.
        material: what is seen of it; a bundle has several strands.
        ends: where it starts and where it stops.
    """

    diameter_m: Annotated[float, Field(gt=0)]
    length_m: Annotated[float, Field(gt=0)]
    x_m: float
    y_m: float
    start_height_m: Annotated[float, Field(ge=0)]
    rotation_deg: float
    bends_per_m: Annotated[tuple[float, ...], Field(min_length=2)]
    rise_m: float = 0.0
    youngs_modulus_pa: Annotated[float, Field(gt=0)]
    density_kg_m3: Annotated[float, Field(gt=0)]
    material: Look
    ends: tuple[CableEnd, CableEnd] = (CableEnd(), CableEnd())


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


class Scene(Model):
    """Everything drawn for one attempt at one job.

    `floor` is None where the floor is hidden from the camera. There are lamps or an `hdri_world`; `grey_world` is None
    for the template's own, and so is `development` for its view transform.
    """

    attempt: Annotated[int, Field(ge=0)]
    cables: Annotated[tuple[Cable, ...], Field(min_length=1)]
    vertex_mass: Annotated[float, Field(gt=0)]
    friction: Friction
    wind: Wind
    floor: Floor | None
    lamps: tuple[Lamp, ...]
    grey_world: GreyWorld | None = None
    hdri_world: HdriWorld | None
    plate: Plate | None = None
    sticks: tuple[Stick, ...] = ()
    sheets: tuple[Sheet, ...] = ()
    parts: tuple[Part, ...] = ()
    camera: Camera
    development: Development | None = None
    render_seed: Annotated[int, Field(ge=0, lt=2**31)]
