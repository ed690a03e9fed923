"""What lights the picture: a lamp in a grey world, or an HDRI."""

from typing import Any

import bpy
import numpy as np
from mathutils import Euler

from blend import names
from farm.scene import AreaLamp, HdriWorld, PointLamp
from worker.images import ImageShelf
from worker.library import AssetLibrary
from worker.upper_world import upper_world


def set_lamps(lamp: PointLamp | AreaLamp | None) -> None:
    """Light the lamp that a scene has, and no other."""
    point, area = bpy.data.objects[names.POINT_LAMP], bpy.data.objects[names.AREA_LAMP]
    point.hide_render, area.hide_render = not isinstance(lamp, PointLamp), not isinstance(lamp, AreaLamp)
    if isinstance(lamp, PointLamp):
        bearing = np.radians(lamp.bearing_deg)
        point.location = (lamp.radius_m * np.cos(bearing), lamp.radius_m * np.sin(bearing), lamp.height_m)
        point.data.energy = lamp.power_w
        point.data.shadow_soft_size = lamp.size_m
    elif isinstance(lamp, AreaLamp):
        area.location.x = lamp.x_m
        area.data.energy = lamp.power_w


def set_world(world: HdriWorld | None, library: AssetLibrary, shelf: ImageShelf, *, above_floor: bool) -> None:
    """Set the world to an HDRI, or to grey.

    Args:
        world: the HDRI; None for grey.
        library: where it is.
        shelf: the images that this process holds.
        above_floor: whether all that it does is to light a floor from above.

    Raises:
        AssetError: if the HDRI can't be had.
    """
    nodes = bpy.data.worlds[names.WORLD].node_tree.nodes
    nodes[names.WORLD_SWITCH].inputs["Fac"].default_value = 1.0 if world is None else 0.0
    if world is None:
        nodes[names.WORLD_IMAGE].image = None
        return
    turn = Euler((np.radians(world.tilt_deg), 0.0, np.radians(world.rotation_deg)), "XYZ")
    nodes[names.WORLD_BRIGHTNESS].inputs["Fac"].default_value = world.brightness
    nodes[names.WORLD_MAPPING].inputs["Rotation"].default_value = turn
    path = library.hdri(world.hdri)
    if above_floor and _is_turned_by_mapping_alone(nodes):
        light = upper_world(shelf.radiance(path), np.array(turn.to_matrix(), np.float64))
        nodes[names.WORLD_IMAGE].image = shelf.light(path.name, light)
    else:
        nodes[names.WORLD_IMAGE].image = shelf.panorama(path)


def _is_turned_by_mapping_alone(nodes: Any) -> bool:
    """Whether the template maps directions onto the HDRI as the farm's own does; an artist may have changed it."""
    image, mapping = nodes[names.WORLD_IMAGE], nodes[names.WORLD_MAPPING]
    from_mapping = [link.from_node.name for link in image.inputs["Vector"].links]
    from_directions = [(link.from_node.type, link.from_socket.name) for link in mapping.inputs["Vector"].links]
    return (
        image.projection == "EQUIRECTANGULAR"
        and from_mapping == [mapping.name]
        and from_directions == [("TEX_COORD", "Generated")]
        and mapping.vector_type == "POINT"
        and tuple(mapping.inputs["Location"].default_value) == (0.0, 0.0, 0.0)
        and tuple(mapping.inputs["Scale"].default_value) == (1.0, 1.0, 1.0)
    )
