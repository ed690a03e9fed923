"""One scene before its fall: every random value of a picture.

Lengths are in metres, angles in degrees, powers in watts; each colour says whether its levels are sRGB or linear. World
axes: x to the right and y up in the picture, z towards the camera; the floor's surface is at z = 0.
"""

from typing import Annotated

from pydantic import Field

from farm.model import Model
from farm.scene.backdrop import HdriWorld, Plate
from farm.scene.cable import Cable
from farm.scene.camera import Camera, Development
from farm.scene.clutter import Part, Peg, Sheet, Stick
from farm.scene.floor import Floor
from farm.scene.light import GreyWorld, Lamp
from farm.scene.physics import Friction, Wind


class Scene(Model):
    """Every random value of one attempt at one job. A scene has either lamps or an `hdri_world`.

    Attributes:
        attempt: number of the attempt, from 0; each samples another scene.
        cables: the cables, the lowest start first unless they are tangled; none in a picture of the background alone.
        vertex_mass: mass of each vertex of the cloth, in Blender's units; the rod solver does not take it.
        friction: coefficients of friction.
        wind: wind while the cables fall.
        floor: floor that the picture shows; None if it is hidden and the HDRI or a photograph is behind the cables.
        lamps: lamps; none if an HDRI lights the scene.
        grey_world: light around the lamps; None for the template's own.
        hdri_world: HDRI that lights the scene, if there are no lamps.
        plate: photograph behind the cables; None shows the floor or the HDRI.
        sticks: long objects, which start below the cables and fall with them.
        pegs: fixed upright posts on the floor.
        sheets: flat objects on the floor, the lowest first.
        parts: small objects on the floor.
        camera: camera and lens.
        development: settings of the sensor and its electronics; None for Blender's view transform.
        render_seed: seed of the renderer's noise.
    """

    attempt: Annotated[int, Field(ge=0)]
    cables: tuple[Cable, ...]
    vertex_mass: Annotated[float, Field(gt=0)]
    friction: Friction
    wind: Wind
    floor: Floor | None
    lamps: tuple[Lamp, ...]
    grey_world: GreyWorld | None = None
    hdri_world: HdriWorld | None
    plate: Plate | None = None
    sticks: tuple[Stick, ...] = ()
    pegs: tuple[Peg, ...] = ()
    sheets: tuple[Sheet, ...] = ()
    parts: tuple[Part, ...] = ()
    camera: Camera
    development: Development | None = None
    render_seed: Annotated[int, Field(ge=0, lt=2**31)]
