"""Makes a Blender scene of an assembly, with lamps, sky and a panorama camera."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np
from mathutils import Matrix
from numpy.typing import NDArray

from blend.environments.assembly import Assembly, Daylight, Part
from blend.environments.materials import make_material, new_image
from blend.environments.palette import Colour
from blend.environments.prints import draw_atlas
from blend.environments.sky import draw_sky
from blend.mesh import MeshArrays, add_mesh, starts_of


@dataclass(frozen=True, slots=True)
class Light:
    """The light of a place apart from its lamps, and the position of the camera in it.

    Attributes:
        camera_m: position of the camera, x, y, z.
        ambient: light from all around where nothing is near, which stands for many bounces.
        sky: radiance of the sky at the horizon, as seen through windows.
        overcast: 0 blue sky to 1 grey.
        daylight: radiance of the light that comes in by windows.
        sun: irradiance of the sun; 0 for none.
        sun_bearing_deg, sun_height_deg: bearing and height of the sun.
        reach_m: distance within which a wall keeps the ambient light away.
        town: buildings and trees stand on the horizon.
    """

    camera_m: tuple[float, float, float]
    ambient: Colour = (0.5, 0.5, 0.5)
    sky: float = 6.0
    overcast: float = 0.5
    daylight: float = 6.0
    sun: float = 0.0
    sun_bearing_deg: float = 0.0
    sun_height_deg: float = 35.0
    reach_m: float = 2.5
    town: bool = True


def stage(assembly: Assembly, light: Light, rng: np.random.Generator) -> Any:
    """Make an assembly the content of the open, empty file.

    Returns:
        The scene, all but its render settings.
    """
    scene = bpy.context.scene
    atlas = new_image("prints", draw_atlas(rng))
    for material in sorted(assembly.parts):
        add_mesh(scene, material, _arrays(assembly.parts[material]), [make_material(material, atlas)])
    for number, opening in enumerate(assembly.daylight):
        _let_in(scene, number, opening, light)
    if light.sun > 0:
        _shine(scene, light)
    scene.world = _world(light, rng)
    _camera(scene, light)
    return scene


def _arrays(parts: list[Part]) -> MeshArrays:
    """Join all parts of a material into one mesh."""
    polygons = list(_polygons(parts))
    sizes = np.concatenate([np.full(len(faces), faces.shape[1]) for faces, _ in polygons])
    return MeshArrays(
        vertices_m=np.concatenate([part.points for part in parts]),
        corners=np.concatenate([faces.ravel() for faces, _ in polygons]),
        face_starts=starts_of(sizes),
        smooth=np.concatenate([np.full(len(faces), part.smooth) for faces, part in polygons]),
        uv=np.concatenate([_uv(part) for part in parts]),
        attributes={
            "tint": np.concatenate([part.tint for part in parts]),
            "local": np.concatenate([part.local for part in parts]),
        },
    )


def _polygons(parts: list[Part]) -> Iterator[tuple[NDArray[np.int64], Part]]:
    first = 0
    for part in parts:
        for faces in part.faces:
            yield faces + first, part
        first += len(part.points)


def _uv(part: Part) -> NDArray[np.float64]:
    """(loops, 2): the given map, or metres along the two axes in which a face mostly lies."""
    if part.uv is not None:
        return np.concatenate([part.uv[faces.ravel()] for faces in part.faces])
    mapped = []
    for faces in part.faces:
        corners = part.local[faces]
        across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 1])
        facing = np.argmax(np.abs(across), axis=1)
        axes = np.array([[1, 2], [0, 2], [0, 1]])[facing]
        mapped.append(np.take_along_axis(corners, axes[:, None, :], axis=2).reshape(-1, 2))
    return np.concatenate(mapped)


def _let_in(scene: Any, number: int, opening: Daylight, light: Light) -> None:
    lamp: Any = bpy.data.lights.new(f"daylight {number}", "AREA")
    lamp.shape, lamp.size, lamp.size_y = "RECTANGLE", opening.width_m, opening.height_m
    lamp.energy = light.daylight * math.pi * opening.width_m * opening.height_m
    lamp.color = (0.86, 0.93, 1.0)
    made = bpy.data.objects.new(lamp.name, lamp)
    # A lamp shines along its own -z, and its own y is up.
    own = Matrix(((1, 0, 0, 0), (0, 0, -1, 0), (0, 1, 0, 0.5 * opening.height_m), (0, 0, 0, 1)))
    made.matrix_world = Matrix(opening.frame.tolist()) @ own
    made.visible_camera = made.visible_glossy = False
    scene.collection.objects.link(made)


def _shine(scene: Any, light: Light) -> None:
    lamp: Any = bpy.data.lights.new("sun", "SUN")
    lamp.energy, lamp.angle, lamp.color = light.sun, math.radians(1.0), (1.0, 0.9, 0.76)
    made = bpy.data.objects.new("sun", lamp)
    made.rotation_euler = (0.0, math.radians(90 - light.sun_height_deg), math.radians(light.sun_bearing_deg))
    scene.collection.objects.link(made)


def _world(light: Light, rng: np.random.Generator) -> Any:
    """Make the world: diffuse rays get the even ambient light, and all others the sky."""
    world: Any = bpy.data.worlds.new("surroundings")
    world.use_nodes = True
    tree = world.node_tree
    tree.nodes.clear()
    sky = tree.nodes.new("ShaderNodeTexEnvironment")
    sky.image = new_image("sky", draw_sky(rng, light.overcast, town=light.town))
    seen, lit, mix, path, out = (
        tree.nodes.new(f"ShaderNode{kind}")
        for kind in ("Background", "Background", "MixShader", "LightPath", "OutputWorld")
    )
    seen.inputs["Strength"].default_value = light.sky
    lit.inputs["Color"].default_value = (*light.ambient, 1.0)
    for source, target in (
        (sky.outputs["Color"], seen.inputs["Color"]),
        (path.outputs["Is Diffuse Ray"], mix.inputs["Fac"]),
        (seen.outputs[0], mix.inputs[1]),
        (lit.outputs[0], mix.inputs[2]),
        (mix.outputs[0], out.inputs["Surface"]),
    ):
        tree.links.new(source, target)
    world.light_settings.distance = light.reach_m
    world.light_settings.ao_factor = 1.0
    world.cycles.sampling_method = "NONE"
    return world


def _camera(scene: Any, light: Light) -> None:
    camera: Any = bpy.data.cameras.new("panorama")
    camera.type, camera.panorama_type = "PANO", "EQUIRECTANGULAR"
    camera.clip_start = 0.01
    made = bpy.data.objects.new("panorama", camera)
    made.location = light.camera_m
    made.rotation_euler = (math.pi / 2, 0.0, -math.pi / 2)
    scene.collection.objects.link(made)
    scene.camera = made
