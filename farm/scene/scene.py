"""One scene, drawn and not yet fallen: every random value of a picture, free of Blender.

Lengths are metres, angles degrees, powers watts, colours 8-bit levels of linear light, unless a field says
otherwise. World axes: x right and y up in the picture, z towards the camera, the floor's surface at z = 0.
"""

from typing import Annotated

from pydantic import Field

from farm.model import Model
from farm.scene.backdrop import HdriWorld, Plate
from farm.scene.cable import Cable
from farm.scene.camera import Camera, Development
from farm.scene.clutter import Part, Sheet, Stick
from farm.scene.floor import Floor
from farm.scene.light import GreyWorld, Lamp
from farm.scene.physics import Friction, Wind


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
