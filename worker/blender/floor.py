"""The picture's floor: its textures and how they lie."""

from typing import Any

import bpy
import numpy as np

from assets.surfaces.kit.maps import joint_distance_mm
from blend import names
from farm.scene.floor import Floor, Wear
from worker.blender.asset_files import SurfaceFiles
from worker.blender.image_cache import ImageCache, TextureFile
from worker.camera.view import View
from worker.colour import Texels
from worker.floor.marks import marks_on, sized
from worker.floor.wear import turned_over, worn_colour, worn_roughness
from worker.floor.window import TextureWindow, texels_to_floor, tile_coordinates, window_on

UNSEEN_FLOOR = 0.4
"""Albedo, and roughness, of a floor that is not seen and only throws light back at the cables."""

UNKNOWN_ROUGHNESS = 0.6
"""Roughness of a surface without a map of it, and of marks on one."""

MOST_WORN_TILES = 4.0
"""Most tiles along the edge of a worn window. More than 1, so that marks do not repeat with the tiles."""

_UNTEXTURED = Floor(texture="", offset_x=0.0, offset_y=0.0, rotation_deg=0.0, scale=1.0)


def set_unseen_floor(image_cache: ImageCache) -> None:
    """Make the floor plain and hide it from the camera alone."""
    floor = bpy.data.objects[names.FLOOR]
    floor.visible_camera = False
    nodes = bpy.data.materials[names.FLOOR].node_tree.nodes
    nodes[names.FLOOR_COLOUR].image = image_cache.constant(UNSEEN_FLOOR, colour=True)
    nodes[names.FLOOR_ROUGHNESS].image = image_cache.constant(UNSEEN_FLOOR)
    nodes[names.FLOOR_METALLIC].image = image_cache.constant(0.0)
    nodes[names.FLOOR_NORMAL].image = image_cache.flat_normal()
    # The map's tangents reach the last bit of the light that the floor throws back, so none may be left over.
    _place_texture(floor.data, _UNTEXTURED, 1.0, TextureWindow.whole())


def set_floor(floor: Floor, files: SurfaceFiles, image_cache: ImageCache, view: View | None) -> None:
    """Show a surface.

    Wear is drawn on the texels that are seen. A surface with a map in floating point has none.

    Args:
        floor: the floor as drawn: its surface's place, turn and scale, and its wear.
        files: the surface's maps.
        image_cache: the images that this process holds.
        view: the camera, beyond whose view no texel is needed; None to take all texels.

    Raises:
        AssetError: if a map can't be read.
    """
    floor_object = bpy.data.objects[names.FLOOR]
    floor_object.visible_camera = True
    maps = {
        names.FLOOR_COLOUR: TextureFile(files.colour, colour=True),
        names.FLOOR_ROUGHNESS: TextureFile(files.roughness, invert=files.gloss) if files.roughness else None,
        names.FLOOR_NORMAL: TextureFile(files.normal, flip_green=files.flip_green) if files.normal else None,
        names.FLOOR_METALLIC: None if isinstance(files.metallic, float) else TextureFile(files.metallic),
    }
    given = {node: file for node, file in maps.items() if file is not None}
    is_worn = floor.wear is not None
    texels = {node: image_cache.texels(file, reduced=is_worn) for node, file in given.items()} if view else {}
    decoded = {node: pixels for node, pixels in texels.items() if pixels is not None}
    window = TextureWindow.whole()
    if view is not None and len(decoded) == len(given):
        sizes = tuple((pixels.shape[0], pixels.shape[1]) for pixels in decoded.values())
        window = window_on(floor, files.size_m, view, sizes, MOST_WORN_TILES if is_worn else 1.0)
    metallic = files.metallic if isinstance(files.metallic, float) else 0.0
    plain = {
        names.FLOOR_ROUGHNESS: image_cache.constant(UNKNOWN_ROUGHNESS),
        names.FLOOR_NORMAL: image_cache.flat_normal(),
        names.FLOOR_METALLIC: image_cache.constant(metallic),
    }
    worn: dict[str, Texels] = {}
    if floor.wear is not None and len(decoded) == len(given):
        joints = image_cache.texels(TextureFile(files.joints)) if files.joints and floor.wear.joints else None
        worn = _worn(floor, floor.wear, files.size_m, decoded, joints, window)
    nodes = bpy.data.materials[names.FLOOR].node_tree.nodes
    for node, file in maps.items():
        if node in worn:
            nodes[node].image = image_cache.for_picture(f"worn {node}", worn[node], colour=node == names.FLOOR_COLOUR)
        elif file is None:
            nodes[node].image = plain[node]
        elif node in decoded:
            part = window.cut(decoded[node], colour=file.colour)
            nodes[node].image = image_cache.for_picture(file.path.name, part, colour=file.colour)
        else:
            nodes[node].image = image_cache.whole(file)
    _place_texture(floor_object.data, floor, files.size_m, window)


def _worn(
    floor: Floor, wear: Wear, size_m: float, maps: dict[str, Texels], joints: Texels | None, window: TextureWindow
) -> dict[str, Texels]:
    """The windows of the maps with the floor's wear, and a map of roughness where marks need one.

    Metal stays metal under marks: stains and dust are films, which colour it and take its gloss.

    Args:
        floor: the floor as drawn.
        wear: its wear.
        size_m: edge of a tile at scale 1.
        maps: the tile's texels by the name of their node.
        joints: the tile's map of joints, of the colour's size; None for a surface without joints.
        window: the part of the tile that is seen.
    """
    seen = {node: _cut(pixels, wear, window, node) for node, pixels in maps.items()}
    rows, columns = seen[names.FLOOR_COLOUR].shape[:2]
    to_floor = texels_to_floor(window, rows, columns, floor, size_m)
    to_joint_m = None if joints is None else floor.scale * joint_distance_mm(_cut(joints, wear, window)) / 1000
    marks = marks_on(wear, rows, columns, to_floor, to_joint_m)
    worn = {**seen, names.FLOOR_COLOUR: worn_colour(seen[names.FLOOR_COLOUR], wear, marks)}
    if marks.any:
        rough = seen.get(names.FLOOR_ROUGHNESS, np.full((rows, columns), round(255 * UNKNOWN_ROUGHNESS), np.uint8))
        worn[names.FLOOR_ROUGHNESS] = worn_roughness(rough, sized(marks, *rough.shape[:2]))
    return worn


def _cut(pixels: Texels, wear: Wear, window: TextureWindow, node: str = "") -> Texels:
    """The part of a map in the window, mirrored if the floor is."""
    whole = turned_over(pixels, normal=node == names.FLOOR_NORMAL) if wear.mirrored else pixels
    return window.cut(whole, colour=node == names.FLOOR_COLOUR)


def _place_texture(mesh: Any, floor: Floor, size_m: float, window: TextureWindow) -> None:
    """Write the texture's offset, turn and scale into the floor's UV map."""
    coordinates = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", coordinates)
    corners = np.empty(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    across = coordinates.reshape(-1, 3)[corners, :2].astype(np.float64)
    uvs = window.place(tile_coordinates(across, floor, size_m))
    mesh.uv_layers[0].uv.foreach_set("vector", uvs.astype(np.float32).ravel())
    mesh.update()
