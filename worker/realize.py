"""A scene made real in the open template: cables, floor, light, world and camera. Sets everything, every time."""

from typing import Any

import bpy
import numpy as np

from blend import names
from farm.lens import FOCAL_LENGTH_MM, SENSOR_MM
from farm.scene import AreaLamp, Cable, CableMaterial, Camera, Floor, HdriWorld, PointLamp, Rgb, Scene
from worker.images import ImageShelf
from worker.library import AssetLibrary
from worker.shapes import Points
from worker.tube import sweep

TUBE_SIDES = 20
"""Corners of a cable's cross-section; its silhouette is then within half a per cent of the radius."""

DIRT_EDGE = 0.05
"""Distance of the two stops of the dirt ramp: how soft the edge of a spot is."""


def realize(
    scene: Scene, curves: list[Points], library: AssetLibrary, shelf: ImageShelf, *, camera_sees_floor: bool
) -> None:
    """Set the picture's scene to `scene`, with settled cables.

    Args:
        scene: what was drawn.
        curves: the settled centrelines, finely sampled (N, 3), metres, one a cable.
        library: where the textures and HDRIs are.
        shelf: the images that this process holds.
        camera_sees_floor: False hides the floor from the camera alone.

    Raises:
        AssetError: if a texture or HDRI can't be had.
    """
    remove_cables()
    for number, (cable, curve) in enumerate(zip(scene.cables, curves, strict=True), start=1):
        _add_cable(number, cable, curve)
    _set_floor(scene.floor, library, shelf, seen=camera_sees_floor)
    _set_lamps(scene.lamp)
    _set_world(scene.hdri_world, library, shelf)
    _set_camera(scene.camera)


def remove_cables() -> None:
    """Remove the cables of the picture before."""
    prefix = f"{names.CABLE}."
    for collection in (bpy.data.objects, bpy.data.meshes, bpy.data.materials):
        for block in [block for block in collection if block.name.startswith(prefix)]:
            collection.remove(block)


def _add_cable(number: int, cable: Cable, curve: Points) -> None:
    name = f"{names.CABLE}.{number}"
    tube = sweep(curve, cable.diameter_m / 2, TUBE_SIDES)
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(tube.vertices_m))
    mesh.vertices.foreach_set("co", tube.vertices_m.ravel())
    mesh.loops.add(len(tube.corners))
    mesh.loops.foreach_set("vertex_index", tube.corners)
    mesh.polygons.add(len(tube.face_sizes))
    mesh.polygons.foreach_set("loop_start", np.concatenate([[0], np.cumsum(tube.face_sizes)[:-1]]).astype(np.int32))
    mesh.uv_layers.new(name="along").uv.foreach_set("vector", tube.uvs.ravel())
    mesh.update(calc_edges=True)
    mesh.normals_split_custom_set(tube.normals)
    mesh.materials.append(_cable_material(name, cable.material))
    bpy.data.scenes[names.PICTURE_SCENE].collection.objects.link(bpy.data.objects.new(name, mesh))


def _cable_material(name: str, wanted: CableMaterial) -> Any:
    material = bpy.data.materials[names.CABLE].copy()
    material.name = name
    nodes = material.node_tree.nodes
    nodes[names.CABLE_MAPPING].inputs["Location"].default_value = wanted.dirt_mapping
    nodes[names.CABLE_NOISE].inputs["W"].default_value = wanted.dirt_offset
    clean, dirty = nodes[names.CABLE_COLOUR_RAMP].color_ramp.elements
    clean.position = wanted.dirt_position
    clean.color = _linear(wanted.colour)
    dirty.position = min(1.0, wanted.dirt_position + DIRT_EDGE)
    dirty.color = _linear(wanted.dirt_colour)
    nodes[names.CABLE_REFLECTION_RAMP].color_ramp.elements[1].position = wanted.reflection_position
    return material


def _linear(colour: Rgb) -> tuple[float, float, float, float]:
    """Levels as shares of linear light, which is how the published set-up reads them: the colours come out pastel."""
    red, green, blue = (level / 255.0 for level in colour)
    return (red, green, blue, 1.0)


def _set_floor(floor: Floor | None, library: AssetLibrary, shelf: ImageShelf, *, seen: bool) -> None:
    floor_object = bpy.data.objects[names.FLOOR]
    floor_object.visible_camera = seen
    nodes = bpy.data.materials[names.FLOOR].node_tree.nodes
    if floor is None:
        nodes[names.FLOOR_COLOUR].image = shelf.constant(UNSEEN_FLOOR, colour=True)
        nodes[names.FLOOR_ROUGHNESS].image = shelf.constant(UNSEEN_FLOOR)
        nodes[names.FLOOR_METALLIC].image = shelf.constant(0.0)
        nodes[names.FLOOR_NORMAL].image = shelf.flat_normal()
        # The map's tangents reach the last bit of the light that the floor throws back, so none may be left over.
        _place_texture(floor_object.data, UNTEXTURED, 1.0)
        return
    files = library.surface(floor.texture)
    nodes[names.FLOOR_COLOUR].image = shelf.load(files.colour, colour=True)
    nodes[names.FLOOR_ROUGHNESS].image = (
        shelf.load(files.roughness, invert=files.gloss) if files.roughness else shelf.constant(0.6)
    )
    nodes[names.FLOOR_NORMAL].image = (
        shelf.load(files.normal, flip_green=files.flip_green) if files.normal else shelf.flat_normal()
    )
    nodes[names.FLOOR_METALLIC].image = (
        shelf.constant(files.metallic) if isinstance(files.metallic, float) else shelf.load(files.metallic)
    )
    _place_texture(floor_object.data, floor, files.size_m)


UNSEEN_FLOOR = 0.4
"""Albedo and roughness of a floor that only throws light back at the cables."""

UNTEXTURED = Floor(texture="", offset_x=0.0, offset_y=0.0, rotation_deg=0.0, scale=1.0)


def _place_texture(mesh: Any, floor: Floor, size_m: float) -> None:
    """Write offset, turn and scale into the UV map."""
    coordinates = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", coordinates)
    corners = np.empty(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    across = coordinates.reshape(-1, 3)[corners, :2].astype(np.float64) / (size_m * floor.scale)
    turn = np.radians(floor.rotation_deg)
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    # Whole tiles make no difference to the picture, and single precision keeps more of the rest.
    offset = np.mod([floor.offset_x, floor.offset_y], 1.0)
    uvs = across @ rotation.T + offset
    mesh.uv_layers[0].uv.foreach_set("vector", uvs.astype(np.float32).ravel())
    mesh.update()


def _set_lamps(lamp: PointLamp | AreaLamp | None) -> None:
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


def _set_world(world: HdriWorld | None, library: AssetLibrary, shelf: ImageShelf) -> None:
    nodes = bpy.data.worlds[names.WORLD].node_tree.nodes
    nodes[names.WORLD_SWITCH].inputs["Fac"].default_value = 1.0 if world is None else 0.0
    if world is None:
        nodes[names.WORLD_IMAGE].image = None
        return
    nodes[names.WORLD_IMAGE].image = shelf.load(library.hdri(world.hdri))
    nodes[names.WORLD_BRIGHTNESS].inputs["Fac"].default_value = world.brightness
    nodes[names.WORLD_MAPPING].inputs["Rotation"].default_value = (
        np.radians(world.tilt_deg),
        0.0,
        np.radians(world.rotation_deg),
    )


def _set_camera(camera: Camera) -> None:
    """Straight down through the published lens, whatever the template's is: the masks take it for granted."""
    camera_object = bpy.data.objects[names.CAMERA]
    camera_object.location = (0.0, 0.0, camera.height_m)
    camera_object.rotation_mode = "XYZ"
    camera_object.rotation_euler = (0.0, 0.0, 0.0)
    camera_object.scale = (1.0, 1.0, 1.0)
    data = camera_object.data
    data.type = "PERSP"
    data.lens, data.sensor_width, data.sensor_fit = FOCAL_LENGTH_MM, SENSOR_MM, "HORIZONTAL"
    data.shift_x = data.shift_y = 0.0
    data.dof.focus_distance = camera.height_m
    data.dof.aperture_fstop = camera.f_number
