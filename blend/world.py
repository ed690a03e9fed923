"""The world: HDRI or flat grey by one mix factor, the HDRI plain or doubled by another (as published)."""

from typing import Any

import bpy

from blend import names
from blend.nodes import add_node, link

GREY = 0.05
"""Radiance of the flat world, as Blender's own default."""


def add_world(scene: Any) -> None:
    """Give the scene its world."""
    world = bpy.data.worlds.new(names.WORLD)
    scene.world = world
    world.use_nodes = True
    tree = world.node_tree
    tree.nodes.clear()
    coordinate = add_node(tree, "ShaderNodeTexCoord", "coordinate", (-1300, 0))
    mapping = add_node(tree, "ShaderNodeMapping", names.WORLD_MAPPING, (-1100, 0))
    image = add_node(tree, "ShaderNodeTexEnvironment", names.WORLD_IMAGE, (-900, 0))
    plain = add_node(tree, "ShaderNodeBackground", "plain", (-600, 0))
    doubled = add_node(tree, "ShaderNodeAddShader", "doubled", (-400, -150))
    brightness = add_node(tree, "ShaderNodeMixShader", names.WORLD_BRIGHTNESS, (-200, 0))
    grey = add_node(tree, "ShaderNodeBackground", "grey", (-200, -250))
    switch = add_node(tree, "ShaderNodeMixShader", names.WORLD_SWITCH, (0, 0))
    output = add_node(tree, "ShaderNodeOutputWorld", "output", (200, 0))
    grey.inputs["Color"].default_value = (GREY, GREY, GREY, 1.0)
    brightness.inputs["Fac"].default_value = 0.0
    switch.inputs["Fac"].default_value = 1.0
    link(tree, coordinate, "Generated", mapping, "Vector")
    link(tree, mapping, "Vector", image, "Vector")
    link(tree, image, "Color", plain, "Color")
    link(tree, plain, "Background", doubled, 0)
    link(tree, plain, "Background", doubled, 1)
    link(tree, plain, "Background", brightness, 1)
    link(tree, doubled, "Shader", brightness, 2)
    link(tree, brightness, "Shader", switch, 1)
    link(tree, grey, "Background", switch, 2)
    link(tree, switch, "Shader", output, "Surface")
