"""Clutter in the open template's picture: sheets, sticks, pegs and parts. The next picture removes them first."""

from typing import Any

import bpy
import numpy as np

from blend import names
from blend.mesh import MeshArrays, add_mesh, starts_of
from blend.nodes import add_node, link
from farm.model import Rgb
from farm.scene.clutter import Part, Peg, Sheet, Stick
from worker.blender.image_cache import ImageCache
from worker.blender.remove import remove_blocks
from worker.clutter.parts import part_solid
from worker.clutter.peg import peg_solid
from worker.clutter.print import Print
from worker.clutter.sheet import print_sheet, sheet_corners
from worker.clutter.solid import Finish, Solid
from worker.clutter.sticks import placed_on, stick_solid
from worker.colour import light_of
from worker.curves import Points
from worker.geometry import SettledGeometry

PREFIX = "clutter"
"""First word of the names of everything that is added here."""

LOWEST_SHEET_M = 20e-6
"""Height of the lowest sheet above the floor: far less than a pixel, yet enough for rays to tell them apart."""

SHEET_STEP_M = 10e-6
"""Height of each further sheet above the one before."""


def add_clutter(geometry: SettledGeometry, image_cache: ImageCache) -> None:
    """Add a scene's clutter, after removing that of the picture before.

    A scene without a visible floor gets none.

    Args:
        geometry: the settled scene.
        image_cache: the holder of the sheets' images.
    """
    remove_blocks(f"{PREFIX}.")
    if geometry.scene.floor is None:
        return
    for number, sheet in enumerate(geometry.scene.sheets):
        _add_sheet(f"{PREFIX}.sheet.{number}", sheet, LOWEST_SHEET_M + number * SHEET_STEP_M, image_cache)
    for number, (stick, nodes) in enumerate(geometry.sticks):
        _add_stick(f"{PREFIX}.stick.{number}", stick, nodes)
    for number, (peg, _) in enumerate(geometry.pegs):
        _add_peg(f"{PREFIX}.peg.{number}", peg)
    for number, part in enumerate(geometry.parts):
        _add_part(f"{PREFIX}.part.{number}", part)


def _add_stick(name: str, stick: Stick, nodes: Points) -> None:
    solid, finishes = stick_solid(stick)
    axes, origin = placed_on(nodes)
    placed = solid.turned(axes).moved(origin)
    # Grain runs along the stick, so it is looked up in the stick's own coordinates.
    _add_solid(name, placed, solid, finishes, stick.pattern_seed)


def _add_peg(name: str, peg: Peg) -> None:
    solid, finishes = peg_solid(peg)
    _add_solid(name, solid.moved((peg.x_m, peg.y_m, 0.0)), solid, finishes, peg.pattern_seed)


def _add_part(name: str, part: Part) -> None:
    solid, finishes = part_solid(part)
    turn = np.radians(part.rotation_deg)
    cosine, sine = np.cos(turn), np.sin(turn)
    rotation = np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    _add_solid(name, solid.turned(rotation).moved((part.x_m, part.y_m, 0.0)), solid, finishes, part.pattern_seed)


def _add_solid(name: str, placed: Solid, local: Solid, finishes: tuple[Finish, ...], seed: int) -> None:
    arrays = MeshArrays(
        vertices_m=placed.vertices_m,
        corners=placed.corners,
        face_starts=starts_of(placed.sizes),
        smooth=placed.smooth,
        materials=placed.finishes,
        attributes={"grain": local.vertices_m},
    )
    materials = [_solid_material(f"{name}.{number}", finish, seed) for number, finish in enumerate(finishes)]
    add_mesh(bpy.data.scenes[names.PICTURE_SCENE], name, arrays, materials)


def _solid_material(name: str, finish: Finish, seed: int) -> Any:
    """Principled, its colour and roughness varied by noise: nothing that was ever touched looks the same all over."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    place = add_node(tree, "ShaderNodeAttribute", "grain", (-900, 0), attribute_name="grain")
    mapping = add_node(tree, "ShaderNodeMapping", "stretch", (-700, 0))
    per_m = 1 / finish.grain_m
    mapping.inputs["Scale"].default_value = (per_m / finish.streaks, per_m, per_m)
    mapping.inputs["Location"].default_value = (seed % 97, seed % 89, seed % 83)
    noise = add_node(tree, "ShaderNodeTexNoise", "mottle", (-500, 0))
    noise.inputs["Scale"].default_value = 1.0
    noise.inputs["Detail"].default_value = 4.0
    surface = add_node(tree, "ShaderNodeBsdfPrincipled", "surface", (0, 0))
    output = add_node(tree, "ShaderNodeOutputMaterial", "output", (300, 0))
    colour = add_node(tree, "ShaderNodeMix", "colour", (-200, 150), data_type="RGBA")
    base = np.array(_light_of_colour(finish.colour)[:3])
    for slot, factor in (("A", 1 - finish.mottle), ("B", 1 + 0.5 * finish.mottle)):
        tint = (*np.minimum(base * factor, 1.0).tolist(), 1.0)
        next(i for i in colour.inputs if i.name == slot and i.type == "RGBA").default_value = tint
    gloss = add_node(tree, "ShaderNodeMapRange", "gloss", (-200, -150))
    gloss.inputs["From Min"].default_value, gloss.inputs["From Max"].default_value = 0.3, 0.7
    gloss.inputs["To Min"].default_value = 0.8 * finish.roughness
    gloss.inputs["To Max"].default_value = min(1.3 * finish.roughness, 1.0)
    link(tree, place, "Vector", mapping, "Vector")
    link(tree, mapping, "Vector", noise, "Vector")
    link(tree, noise, "Fac", colour, 0)
    link(tree, noise, "Fac", gloss, "Value")
    tree.links.new(next(o for o in colour.outputs if o.type == "RGBA"), surface.inputs["Base Color"])
    link(tree, gloss, "Result", surface, "Roughness")
    surface.inputs["Metallic"].default_value = finish.metallic
    surface.inputs["Coat Weight"].default_value = finish.coat
    surface.inputs["Coat Roughness"].default_value = 0.12
    link(tree, surface, "BSDF", output, "Surface")
    return material


def _add_sheet(name: str, sheet: Sheet, height_m: float, image_cache: ImageCache) -> None:
    drawn = print_sheet(sheet)
    corners = sheet_corners(sheet, drawn.margin_m)
    arrays = MeshArrays(
        vertices_m=np.column_stack([corners, np.full(len(corners), height_m)]),
        corners=np.arange(4),
        face_starts=np.zeros(1, np.int32),
        smooth=False,
        uv=np.array([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]),
        uv_name="print",
    )
    add_mesh(bpy.data.scenes[names.PICTURE_SCENE], name, arrays, [_sheet_material(name, drawn, image_cache)])


def _sheet_material(name: str, drawn: Print, image_cache: ImageCache) -> Any:
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    surface = add_node(tree, "ShaderNodeBsdfPrincipled", "surface", (0, 0))
    output = add_node(tree, "ShaderNodeOutputMaterial", "output", (300, 0))
    surface.inputs["Metallic"].default_value = drawn.metallic
    surface.inputs["Specular IOR Level"].default_value = drawn.specular
    colour = add_node(tree, "ShaderNodeTexImage", "colour", (-600, 300), extension="EXTEND")
    colour.image = image_cache.for_picture(f"{name}.colour", drawn.colour, colour=True)
    link(tree, colour, "Color", surface, "Base Color")
    roughness = add_node(tree, "ShaderNodeTexImage", "roughness", (-600, 0), extension="EXTEND")
    roughness.image = image_cache.for_picture(f"{name}.roughness", drawn.roughness, colour=False)
    link(tree, roughness, "Color", surface, "Roughness")
    if drawn.normal is not None:
        relief = add_node(tree, "ShaderNodeTexImage", "relief", (-600, -300), extension="EXTEND")
        relief.image = image_cache.for_picture(f"{name}.normal", drawn.normal, colour=False)
        bump = add_node(tree, "ShaderNodeNormalMap", "normal map", (-300, -300))
        link(tree, relief, "Color", bump, "Color")
        link(tree, bump, "Normal", surface, "Normal")
    if drawn.alpha is not None:
        alpha = add_node(tree, "ShaderNodeTexImage", "alpha", (-600, -600), extension="EXTEND")
        alpha.image = image_cache.for_picture(f"{name}.alpha", drawn.alpha, colour=False)
        link(tree, alpha, "Color", surface, "Alpha")
    link(tree, surface, "BSDF", output, "Surface")
    return material


def _light_of_colour(colour: Rgb) -> tuple[float, float, float, float]:
    """The linear light of an sRGB colour: red, green, blue and an alpha of 1, each 0 to 1."""
    red, green, blue = (float(light) for light in light_of(np.array(colour, np.uint8)))
    return red, green, blue, 1.0
