"""The mask as the published method makes it: cables emit white, all else is black, rendered by Cycles."""

from typing import Any

import bpy
import cv2
import numpy as np
from numpy.typing import NDArray

from blend import names
from worker.render import render_picture

SAMPLES = 1024

_SAME_SO_FAR = 128
"""Samples after which Cycles leaves a pixel that is all black or all white, with all around it: most of the picture."""


def render_coverage(samples: int = SAMPLES) -> NDArray[np.float64]:
    """Render the cables of the realized scene white on black.

    The lens is the picture's, depth of field included. The floor, the lamps and the world are left out, which changes
    the open scene: realize it again before another picture.

    Args:
        samples: Cycles samples a pixel.

    Returns:
        (H, W) coverage by cables, 0 to 1, as filtered by Cycles' pixel filter.

    Raises:
        RenderError: if Blender gives no picture.
    """
    scene = bpy.data.scenes[names.PICTURE_SCENE]
    view = scene.view_settings
    kept = view.view_transform
    floor = bpy.data.objects[names.FLOOR]
    world = bpy.data.worlds.new("black")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.0, 0.0, 0.0, 1.0)
    white = _white()
    for cable in [item for item in scene.objects if item.name.startswith(f"{names.CABLE}.")]:
        cable.data.materials[0] = white
    for lamp in (names.POINT_LAMP, names.AREA_LAMP):
        bpy.data.objects[lamp].hide_render = True
    floor.hide_render = True
    picture_world, scene.world = scene.world, world
    view.view_transform = "Raw"
    scene.cycles.samples = samples
    scene.cycles.use_adaptive_sampling = True
    scene.cycles.adaptive_min_samples = min(_SAME_SO_FAR, samples)
    scene.cycles.adaptive_threshold = 1e-4
    scene.cycles.max_bounces = 0
    scene.cycles.use_denoising = False
    try:
        grey = cv2.cvtColor(render_picture(), cv2.COLOR_RGB2GRAY)
    finally:
        view.view_transform = kept
        floor.hide_render = False
        scene.world = picture_world
        bpy.data.worlds.remove(world)
    coverage: NDArray[np.float64] = grey / 255.0
    return coverage


def _white() -> Any:
    material = bpy.data.materials.new(f"{names.CABLE}.white")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    emission = tree.nodes.new("ShaderNodeEmission")
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(emission.outputs["Emission"], output.inputs["Surface"])
    return material
