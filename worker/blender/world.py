"""What lights the picture, and what is behind the cables: lamps in a grey world, or an HDRI."""

from typing import Any

import bpy
import numpy as np
from mathutils import Euler
from numpy.typing import NDArray

from blend import names
from blend.world import is_as_built
from farm.scene.backdrop import HdriWorld
from farm.scene.camera import Camera
from farm.scene.light import AreaLamp, GreyWorld, Lamp, PointLamp, StudioLamp
from worker.backdrop.panorama import Panorama, backdrop, upper_world
from worker.blender.asset_files import AssetLibrary
from worker.blender.image_cache import ImageCache
from worker.blender.lamps import add_studio_lamp, remove_studio_lamps
from worker.camera.black_body import black_body

_TEMPLATES_GREY = "farm_templates_grey"
"""Under this name the node itself keeps its colour and strength as they came with the template."""


def set_lamps(lamps: tuple[Lamp, ...]) -> None:
    """Light the lamps that a scene has, and no other."""
    bpy.data.objects[names.POINT_LAMP].hide_render = bpy.data.objects[names.AREA_LAMP].hide_render = True
    remove_studio_lamps()
    for number, lamp in enumerate(lamps, start=1):
        if isinstance(lamp, StudioLamp):
            add_studio_lamp(lamp, number)
        else:
            _light(lamp)


def _light(lamp: PointLamp | AreaLamp) -> None:
    point, area = bpy.data.objects[names.POINT_LAMP], bpy.data.objects[names.AREA_LAMP]
    if isinstance(lamp, PointLamp):
        point.hide_render = False
        bearing = np.radians(lamp.bearing_deg)
        point.location = (lamp.radius_m * np.cos(bearing), lamp.radius_m * np.sin(bearing), lamp.height_m)
        point.data.energy = lamp.power_w
        point.data.shadow_soft_size = lamp.size_m
    else:
        area.hide_render = False
        area.location.x = lamp.x_m
        area.data.energy = lamp.power_w


def set_grey_world(grey: GreyWorld | None = None) -> None:
    """Set the world to grey; None is the template's own."""
    nodes = bpy.data.worlds[names.WORLD].node_tree.nodes
    nodes[names.WORLD_SWITCH].inputs["Fac"].default_value = 1.0
    nodes[names.WORLD_IMAGE].image = None
    _set_grey(nodes[names.WORLD_GREY], grey)


def _set_grey(node: Any, grey: GreyWorld | None) -> None:
    colour, strength = node.inputs["Color"], node.inputs["Strength"]
    if _TEMPLATES_GREY not in node:
        node[_TEMPLATES_GREY] = [*colour.default_value, strength.default_value]
    if grey is None:
        *colour.default_value, strength.default_value = node[_TEMPLATES_GREY]
    else:
        colour.default_value = (*black_body(grey.temperature_k), 1.0)
        strength.default_value = grey.radiance


def set_hdri_world(world: HdriWorld, library: AssetLibrary, image_cache: ImageCache, *, only_lights: bool) -> None:
    """Set the world to an HDRI.

    Args:
        world: the HDRI.
        library: where it is.
        image_cache: the images that this process holds.
        only_lights: the camera sees nothing of it, and a floor hides its lower half.

    Raises:
        AssetError: if the HDRI can't be had.
    """
    nodes = bpy.data.worlds[names.WORLD].node_tree.nodes
    nodes[names.WORLD_SWITCH].inputs["Fac"].default_value = 0.0
    _set_grey(nodes[names.WORLD_GREY], None)
    nodes[names.WORLD_BRIGHTNESS].inputs["Fac"].default_value = world.brightness
    image, path = nodes[names.WORLD_IMAGE], library.hdri(world.hdri)
    if only_lights and is_as_built(bpy.data.worlds[names.WORLD]):
        image.image = image_cache.light(path.name, upper_world(image_cache.radiance(path), _turn(world)))
        # The map of bright parts has a place for each texel; between texels it would be wrong.
        image.interpolation = "Closest"
        nodes[names.WORLD_MAPPING].inputs["Rotation"].default_value = (0.0, 0.0, 0.0)
    else:
        image.image = image_cache.panorama(path)
        image.interpolation = "Linear"
        nodes[names.WORLD_MAPPING].inputs["Rotation"].default_value = _euler(world)


def backdrop_of(
    world: HdriWorld, camera: Camera, resolution: int, library: AssetLibrary, image_cache: ImageCache
) -> Panorama | None:
    """What the camera sees of an HDRI, (resolution, resolution, 3); None if the template shows it in its own way.

    Raises:
        AssetError: if the HDRI can't be had.
    """
    if not is_as_built(bpy.data.worlds[names.WORLD]):
        return None
    seen = backdrop(image_cache.radiance(library.hdri(world.hdri)), _turn(world), camera, resolution)
    return seen * np.float32(1.0 + world.brightness)


def _euler(world: HdriWorld) -> Any:
    return Euler((np.radians(world.tilt_deg), 0.0, np.radians(world.rotation_deg)), "XYZ")


def _turn(world: HdriWorld) -> NDArray[np.float64]:
    """(3, 3), takes a direction in the world to one in the panorama, as the template's Mapping node does."""
    return np.array(_euler(world).to_matrix(), np.float64)
