"""The picture's floor: its textures and how they lie."""

from typing import Any

import bpy
import numpy as np

from blend import names
from farm.scene import Floor
from worker.images import ImageShelf, TextureFile
from worker.library import SurfaceFiles
from worker.texture_window import TextureWindow, tile_coordinates, window_on
from worker.view import View

UNSEEN_FLOOR = 0.4
"""Albedo and roughness of a floor that only throws light back at the cables."""

UNKNOWN_ROUGHNESS = 0.6

_UNTEXTURED = Floor(texture="", offset_x=0.0, offset_y=0.0, rotation_deg=0.0, scale=1.0)


def set_unseen_floor(shelf: ImageShelf) -> None:
    """Make the floor plain and hide it from the camera alone."""
    floor = bpy.data.objects[names.FLOOR]
    floor.visible_camera = False
    nodes = bpy.data.materials[names.FLOOR].node_tree.nodes
    nodes[names.FLOOR_COLOUR].image = shelf.constant(UNSEEN_FLOOR, colour=True)
    nodes[names.FLOOR_ROUGHNESS].image = shelf.constant(UNSEEN_FLOOR)
    nodes[names.FLOOR_METALLIC].image = shelf.constant(0.0)
    nodes[names.FLOOR_NORMAL].image = shelf.flat_normal()
    # The map's tangents reach the last bit of the light that the floor throws back, so none may be left over.
    _place_texture(floor.data, _UNTEXTURED, 1.0, TextureWindow.whole())


def set_floor(floor: Floor, files: SurfaceFiles, shelf: ImageShelf, view: View | None) -> None:
    """Show a surface.

    Args:
        floor: how its texture lies.
        files: its maps.
        shelf: the images that this process holds.
        view: of the camera, beyond which no texel is needed; None for all of them.

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
    texels = {node: shelf.texels(file) for node, file in given.items()} if view else {}
    decoded = {node: pixels for node, pixels in texels.items() if pixels is not None}
    window = TextureWindow.whole()
    if view is not None and len(decoded) == len(given):
        sizes = tuple((pixels.shape[0], pixels.shape[1]) for pixels in decoded.values())
        window = window_on(floor, files.size_m, view, sizes)
    plain = {
        names.FLOOR_ROUGHNESS: shelf.constant(UNKNOWN_ROUGHNESS),
        names.FLOOR_NORMAL: shelf.flat_normal(),
        names.FLOOR_METALLIC: shelf.constant(files.metallic if isinstance(files.metallic, float) else 0.0),
    }
    nodes = bpy.data.materials[names.FLOOR].node_tree.nodes
    for node, file in maps.items():
        if file is None:
            nodes[node].image = plain[node]
        elif node in decoded:
            nodes[node].image = shelf.window(file, decoded[node], window)
        else:
            nodes[node].image = shelf.whole(file)
    _place_texture(floor_object.data, floor, files.size_m, window)


def _place_texture(mesh: Any, floor: Floor, size_m: float, window: TextureWindow) -> None:
    """Write offset, turn and scale into the UV map."""
    coordinates = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", coordinates)
    corners = np.empty(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    across = coordinates.reshape(-1, 3)[corners, :2].astype(np.float64)
    uvs = window.place(tile_coordinates(across, floor, size_m))
    mesh.uv_layers[0].uv.foreach_set("vector", uvs.astype(np.float32).ravel())
    mesh.update()
