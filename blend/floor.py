"""The floor of the picture: one quad whose UV map places the texture, with image textures and no other nodes.

The texture's offset, turn and scale are put into the UV map rather than into a Mapping node: nothing is then
evaluated per sample, and the normal map's tangents turn with the texture.
"""

from typing import Any

import bpy

from blend import names
from blend.nodes import add_node, link
from farm.scene.floor import FLOOR_REACH_M


def add_floor(scene: Any) -> None:
    """Add the floor at z = 0."""
    mesh = bpy.data.meshes.new(names.FLOOR)
    edge = FLOOR_REACH_M
    mesh.from_pydata([(-edge, -edge, 0), (edge, -edge, 0), (edge, edge, 0), (-edge, edge, 0)], [], [(0, 1, 2, 3)])
    mesh.uv_layers.new(name="texture")
    mesh.materials.append(_material())
    scene.collection.objects.link(bpy.data.objects.new(names.FLOOR, mesh))


def _material() -> Any:
    material = bpy.data.materials.new(names.FLOOR)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    colour = add_node(tree, "ShaderNodeTexImage", names.FLOOR_COLOUR, (-800, 300))
    roughness = add_node(tree, "ShaderNodeTexImage", names.FLOOR_ROUGHNESS, (-800, 0))
    metallic = add_node(tree, "ShaderNodeTexImage", names.FLOOR_METALLIC, (-800, -300))
    normal = add_node(tree, "ShaderNodeTexImage", names.FLOOR_NORMAL, (-800, -600))
    bump = add_node(tree, "ShaderNodeNormalMap", "normal map", (-450, -600))
    surface = add_node(tree, "ShaderNodeBsdfPrincipled", "surface", (-100, 0))
    output = add_node(tree, "ShaderNodeOutputMaterial", "output", (200, 0))
    link(tree, colour, "Color", surface, "Base Color")
    link(tree, roughness, "Color", surface, "Roughness")
    link(tree, metallic, "Color", surface, "Metallic")
    link(tree, normal, "Color", bump, "Color")
    link(tree, bump, "Normal", surface, "Normal")
    link(tree, surface, "BSDF", output, "Surface")
    return material
