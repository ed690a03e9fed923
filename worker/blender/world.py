"""The picture's light, from lamps in a grey world or from an HDRI, and the backdrop that an HDRI gives."""

from typing import Any

import bpy
import numpy as np
from mathutils import Euler
from numpy.typing import NDArray

from blend import names
from blend.world import is_as_built
from farm.scene.backdrop import HdriWorld
from farm.scene.light import AreaLamp, GreyWorld, Lamp, PointLamp, StudioLamp
from worker.backdrop.panorama import panorama_backdrop, upper_world
from worker.blender.asset_files import AssetLibrary
from worker.blender.image_cache import ImageCache
from worker.blender.lamps import add_studio_lamps
from worker.camera.black_body import black_body
from worker.camera.view import View

_TEMPLATES_GREY = "farm_templates_grey"
"""Name of the property in which the node keeps the colour and strength that it has in the template."""


def set_lamps(lamps: tuple[Lamp, ...]) -> None:
    """Switch on the lamps that a scene has, and no other."""
    bpy.data.objects[names.POINT_LAMP].hide_render = bpy.data.objects[names.AREA_LAMP].hide_render = True
    add_studio_lamps([lamp for lamp in lamps if isinstance(lamp, StudioLamp)])
    for lamp in lamps:
        if not isinstance(lamp, StudioLamp):
            _switch_on(lamp)


def _switch_on(lamp: PointLamp | AreaLamp) -> None:
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
    """Set the world to a grey, the template's own if None is given."""
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
        library: the files of HDRIs.
        image_cache: the images that this process holds.
        only_lights: whether the camera sees nothing of it and a floor hides its lower half.

    Raises:
        AssetError: if the HDRI can't be had.
    """
    nodes = bpy.data.worlds[names.WORLD].node_tree.nodes
    nodes[names.WORLD_SWITCH].inputs["Fac"].default_value = 0.0
    _set_grey(nodes[names.WORLD_GREY], None)
    nodes[names.WORLD_BRIGHTNESS].inputs["Fac"].default_value = world.brightness
    image, path = nodes[names.WORLD_IMAGE], library.hdri(world.hdri)
    if only_lights and is_as_built(bpy.data.worlds[names.WORLD]):
        light = upper_world(image_cache.radiance(path), _turn(world))
        image.image = image_cache.for_picture(path.name, light, colour=True)
        # The map of bright parts has one place for each texel, so between texels it is wrong.
        image.interpolation = "Closest"
        nodes[names.WORLD_MAPPING].inputs["Rotation"].default_value = (0.0, 0.0, 0.0)
    else:
        image.image = image_cache.panorama(path)
        image.interpolation = "Linear"
        nodes[names.WORLD_MAPPING].inputs["Rotation"].default_value = _euler(world)


def hdri_backdrop(
    world: HdriWorld, view: View, lens_radius_m: float, library: AssetLibrary, image_cache: ImageCache
) -> NDArray[np.float32] | None:
    """Make the backdrop that the camera sees of an HDRI, as bright as the template shows it.

    Args:
        world: the HDRI.
        view: the camera.
        lens_radius_m: radius of the camera's aperture, in metres.
        library: the files of HDRIs.
        image_cache: the images that this process holds.

    Returns:
        (H, W, 3) of linear light; None if an artist changed how the template shows an HDRI.

    Raises:
        AssetError: if the HDRI can't be had.
    """
    if not is_as_built(bpy.data.worlds[names.WORLD]):
        return None
    seen = panorama_backdrop(image_cache.radiance(library.hdri(world.hdri)), _turn(world), view, lens_radius_m)
    return seen * np.float32(1.0 + world.brightness)


def _euler(world: HdriWorld) -> Any:
    return Euler((np.radians(world.tilt_deg), 0.0, np.radians(world.rotation_deg)), "XYZ")


def _turn(world: HdriWorld) -> NDArray[np.float64]:
    """Make the matrix (3, 3) that turns the world's directions to the panorama's, like the template's Mapping node."""
    return np.array(_euler(world).to_matrix(), np.float64)
