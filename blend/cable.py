"""The cable that every rendered cable copies, with the published procedural material; and the one of drawn sheaths.

In the published material a Colour Ramp mixes the cable's colour with dirt, its position sets the dirt's density;
Mapping and Noise Texture drive its factor; a second Colour Ramp sets Metallic and Roughness.
"""

import math
from typing import Any

import bpy

from blend import names
from blend.nodes import add_node, link

_RADIUS_M, _LENGTH_M, _SIDES = 0.001, 0.05, 16
"""The tube that carries the material; no picture shows it, as every picture has tubes of its own cables."""


def add_cable(scene: Any) -> None:
    """Add a short straight tube, hidden from renders, that carries the material."""
    mesh = bpy.data.meshes.new(names.CABLE)
    ring = [
        (_RADIUS_M * math.cos(2 * math.pi * k / _SIDES), _RADIUS_M * (1 + math.sin(2 * math.pi * k / _SIDES)))
        for k in range(_SIDES)
    ]
    ends = (-_LENGTH_M / 2, _LENGTH_M / 2)
    vertices = [(x, y, z) for x in ends for y, z in ring]
    faces = [(k, (k + 1) % _SIDES, _SIDES + (k + 1) % _SIDES, _SIDES + k) for k in range(_SIDES)]
    mesh.from_pydata(vertices, [], faces)
    mesh.uv_layers.new(name="along")
    mesh.materials.append(_material())
    cable = bpy.data.objects.new(names.CABLE, mesh)
    cable.hide_render = True
    scene.collection.objects.link(cable)


def _material() -> Any:
    material = bpy.data.materials.new(names.CABLE)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    coordinate = add_node(tree, "ShaderNodeTexCoord", "coordinate", (-1100, 0))
    mapping = add_node(tree, "ShaderNodeMapping", names.CABLE_MAPPING, (-900, 0))
    noise = add_node(tree, "ShaderNodeTexNoise", names.CABLE_NOISE, (-700, 0), noise_dimensions="4D")
    noise.inputs["Scale"].default_value = 250.0  # per metre: spots of a few millimetres
    noise.inputs["Detail"].default_value = 3.0
    noise.inputs["Roughness"].default_value = 0.6
    dirt = add_node(tree, "ShaderNodeValToRGB", names.CABLE_COLOUR_RAMP, (-450, 150))
    dirt.color_ramp.elements[0].position = 0.75
    dirt.color_ramp.elements[0].color = (0.1, 0.4, 0.6, 1.0)
    dirt.color_ramp.elements[1].position = 0.80
    dirt.color_ramp.elements[1].color = (0.0, 0.0, 0.0, 1.0)
    reflection = add_node(tree, "ShaderNodeValToRGB", names.CABLE_REFLECTION_RAMP, (-450, -150))
    reflection.color_ramp.elements[0].position = 0.40
    reflection.color_ramp.elements[0].color = (0.28, 0.28, 0.28, 1.0)
    reflection.color_ramp.elements[1].position = 0.65
    reflection.color_ramp.elements[1].color = (0.50, 0.50, 0.50, 1.0)
    surface = add_node(tree, "ShaderNodeBsdfPrincipled", "surface", (-100, 0))
    output = add_node(tree, "ShaderNodeOutputMaterial", "output", (200, 0))
    link(tree, coordinate, "UV", mapping, "Vector")
    link(tree, mapping, "Vector", noise, "Vector")
    link(tree, noise, "Fac", dirt, "Fac")
    link(tree, noise, "Fac", reflection, "Fac")
    link(tree, dirt, "Color", surface, "Base Color")
    link(tree, reflection, "Color", surface, "Metallic")
    link(tree, reflection, "Color", surface, "Roughness")
    link(tree, surface, "BSDF", output, "Surface")
    return material


def add_skin() -> None:
    """Add the material of drawn sheaths: images for colour, roughness and relief, under an optional clear coat.

    No object has it, so it has a user of its own. Texture coordinates run from 0 to 1 along the cable and around it.
    """
    material = bpy.data.materials.new(names.SKIN)
    material.use_fake_user = True
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    colour = add_node(tree, "ShaderNodeTexImage", names.SKIN_COLOUR, (-700, 250))
    roughness = add_node(tree, "ShaderNodeTexImage", names.SKIN_ROUGHNESS, (-700, -50))
    normal = add_node(tree, "ShaderNodeTexImage", names.SKIN_NORMAL, (-700, -350))
    relief = add_node(tree, "ShaderNodeNormalMap", "relief", (-400, -350))
    surface = add_node(tree, "ShaderNodeBsdfPrincipled", names.SKIN_SURFACE, (-100, 0))
    surface.inputs["Coat IOR"].default_value = 1.5
    surface.inputs["Sheen Roughness"].default_value = 0.3
    output = add_node(tree, "ShaderNodeOutputMaterial", "output", (200, 0))
    link(tree, colour, "Color", surface, "Base Color")
    link(tree, roughness, "Color", surface, "Roughness")
    link(tree, normal, "Color", relief, "Color")
    link(tree, relief, "Normal", surface, "Normal")
    link(tree, surface, "BSDF", output, "Surface")
