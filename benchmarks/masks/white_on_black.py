"""Turn the open scene into one whose render is a mask, as in the published method: white cables on black."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bpy

from blend import names
from worker.cable.piece import OCCLUDER


@contextmanager
def white_on_black() -> Iterator[Any]:
    """Show the built scene's cables white on black inside `with`.

    The lens is the picture's, depth of field included. The floor, the lamps and the world are left out. Cables and
    lamps stay changed: build the scene again before another picture. What hides cables is black.

    Yields:
        Blender's scene of the picture.
    """
    scene = bpy.data.scenes[names.PICTURE_SCENE]
    view = scene.view_settings
    kept = view.view_transform
    floor = bpy.data.objects[names.FLOOR]
    world = bpy.data.worlds.new("black")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.0, 0.0, 0.0, 1.0)
    white, black = _emission("white", 1.0), _emission("black", 0.0)
    for piece in [item for item in scene.objects if item.name.startswith(f"{names.CABLE}.")]:
        hides = piece.name.startswith(f"{names.CABLE}.{OCCLUDER}.")
        piece.data.materials[0] = black if hides else white
    for lamp in [item for item in scene.objects if item.type == "LIGHT"]:
        lamp.hide_render = True
    floor.hide_render = True
    picture_world, scene.world = scene.world, world
    view.view_transform = "Raw"
    try:
        yield scene
    finally:
        view.view_transform = kept
        floor.hide_render = False
        scene.world = picture_world
        bpy.data.worlds.remove(world)


def _emission(name: str, strength: float) -> Any:
    material = bpy.data.materials.new(f"{names.CABLE}.{name}")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    emission = tree.nodes.new("ShaderNodeEmission")
    emission.inputs["Strength"].default_value = strength
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(emission.outputs["Emission"], output.inputs["Surface"])
    return material
