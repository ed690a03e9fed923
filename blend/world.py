"""The world: HDRI or flat grey by one mix factor, the HDRI plain or doubled by another (as published)."""

from typing import Any, Final

import bpy

from blend import names
from blend.nodes import add_node, link

GREY = 0.05
"""Radiance of the flat world, as Blender's own default."""

_LINKS: Final = (
    ("coordinate", "Generated", names.WORLD_MAPPING, "Vector"),
    (names.WORLD_MAPPING, "Vector", names.WORLD_IMAGE, "Vector"),
    (names.WORLD_IMAGE, "Color", "plain", "Color"),
    ("plain", "Background", "doubled", 0),
    ("plain", "Background", "doubled", 1),
    ("plain", "Background", names.WORLD_BRIGHTNESS, 1),
    ("doubled", "Shader", names.WORLD_BRIGHTNESS, 2),
    (names.WORLD_BRIGHTNESS, "Shader", names.WORLD_SWITCH, 1),
    (names.WORLD_GREY, "Background", names.WORLD_SWITCH, 2),
    (names.WORLD_SWITCH, "Shader", "output", "Surface"),
)
"""The links of the world's nodes: a node, its output, the node that it leads to, and that one's input."""


def add_world(scene: Any) -> None:
    """Give the scene its world."""
    world = bpy.data.worlds.new(names.WORLD)
    scene.world = world
    world.use_nodes = True
    tree = world.node_tree
    tree.nodes.clear()
    add_node(tree, "ShaderNodeTexCoord", "coordinate", (-1300, 0))
    add_node(tree, "ShaderNodeMapping", names.WORLD_MAPPING, (-1100, 0))
    add_node(tree, "ShaderNodeTexEnvironment", names.WORLD_IMAGE, (-900, 0))
    add_node(tree, "ShaderNodeBackground", "plain", (-600, 0))
    add_node(tree, "ShaderNodeAddShader", "doubled", (-400, -150))
    brightness = add_node(tree, "ShaderNodeMixShader", names.WORLD_BRIGHTNESS, (-200, 0))
    grey = add_node(tree, "ShaderNodeBackground", names.WORLD_GREY, (-200, -250))
    switch = add_node(tree, "ShaderNodeMixShader", names.WORLD_SWITCH, (0, 0))
    add_node(tree, "ShaderNodeOutputWorld", "output", (200, 0))
    grey.inputs["Color"].default_value = (GREY, GREY, GREY, 1.0)
    brightness.inputs["Fac"].default_value = 0.0
    switch.inputs["Fac"].default_value = 1.0
    for source, output, target, socket in _LINKS:
        link(tree, tree.nodes[source], output, tree.nodes[target], socket)


def is_as_built(world: Any) -> bool:
    """Whether a template's world is still the farm's own, so that it shows an HDRI turned, brightened and no more."""
    nodes = world.node_tree.nodes
    if any(source not in nodes or target not in nodes for source, _, target, _ in _LINKS):
        return False
    expected = {(nodes[a].outputs[b], nodes[c].inputs[d]) for a, b, c, d in _LINKS}
    found = {(each.from_socket, each.to_socket) for each in world.node_tree.links if not each.is_muted}
    image, mapping, plain = nodes[names.WORLD_IMAGE], nodes[names.WORLD_MAPPING], nodes["plain"]
    return (
        found == expected
        and not any(node.mute for node in nodes)
        and image.projection == "EQUIRECTANGULAR"
        and mapping.vector_type == "POINT"
        and tuple(mapping.inputs["Location"].default_value) == (0.0, 0.0, 0.0)
        and tuple(mapping.inputs["Scale"].default_value) == (1.0, 1.0, 1.0)
        and plain.inputs["Strength"].default_value == 1.0
    )
