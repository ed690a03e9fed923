"""Materials of the environments: Cycles shaders that read a solid's tint, its own axes and its UV map.

A material is named by a word, such as `paint`, or by `surface:` and the name of one of `assets.surfaces`.
"""

from collections.abc import Callable
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from assets.surfaces.catalogue import SURFACES
from assets.surfaces.recipe import recipe_generator
from blend.environments.shader import Shader

SURFACE_PREFIX = "surface:"
"""Prefix of a material's name that shows one of the farm's own surfaces."""
SURFACE_PIXELS = 1024
"""Texels along an edge of a surface's tile: 0.5 mm each on a tile of 0.5 m, far finer than a panorama shows."""

_PRINTED = frozenset({"print", "screen"})
"""Names of the materials that show a part of the atlas."""

_SHAPELESS = ("concrete", "asphalt")
"""Prefixes of the names of surfaces without courses, which look right at any scale."""


def make_material(name: str, atlas: Any) -> Any:
    """Make the material called `name`; `atlas` is the image with all prints.

    Raises:
        KeyError: no material has that name.
    """
    shader = Shader(name)
    if name.startswith(SURFACE_PREFIX):
        _surface(shader, name.removeprefix(SURFACE_PREFIX))
    elif name in _PRINTED:
        _shown(shader, atlas, shines=name == "screen")
    else:
        _BUILT[name](shader)
    return shader.material


def is_known(name: str) -> bool:
    """Whether a material has that name."""
    return name in _BUILT or name in _PRINTED or name.removeprefix(SURFACE_PREFIX) in SURFACES


def new_image(name: str, pixels: NDArray[np.uint8], *, colour: bool = True) -> Any:
    """Make a Blender image from sRGB (H, W, 3) or from plain numbers (H, W), 0 to 255, the top row first."""
    height, width = pixels.shape[:2]
    image = bpy.data.images.new(name, width, height, alpha=False)
    image.colorspace_settings.name = "sRGB" if colour else "Non-Color"
    rgba = np.ones((height, width, 4), np.float32)
    rgba[..., :3] = (pixels[::-1] if pixels.ndim == 3 else pixels[::-1, :, None]) / np.float32(255.0)
    image.pixels.foreach_set(rgba.ravel())
    image.update()
    return image


def _surface(shader: Shader, name: str) -> None:
    """One of the farm's own surfaces, with large stains that hide how its tile repeats."""
    recipe = SURFACES[name]
    maps = recipe.build(recipe_generator(recipe), SURFACE_PIXELS)
    scale = 1.0 / recipe.size_m
    stains = shader.span(shader.noise(0.45, detail=4.0), 0.72, 1.14)
    image = new_image(name, maps.colour)
    colour = shader.image(image, scale)
    if name.startswith(_SHAPELESS):
        # Patches show the same tile at another scale, so that no spot visibly repeats.
        patches = shader.span(shader.noise(0.8, detail=2.0), 0.0, 1.0, 0.44, 0.56)
        colour = shader.mixed(patches, colour, shader.image(image, 0.37 * scale))
    tinted = shader.times(colour, shader.tint.outputs["Color"])
    shader.colour(shader.times(tinted, stains))
    shader.roughness(shader.image(new_image(f"{name} roughness", maps.roughness, colour=False), scale))
    if isinstance(maps.metallic, float):
        shader.set(metallic=maps.metallic)
    normal = shader.node("ShaderNodeNormalMap", uv_map="uv")
    shader.link(shader.image(new_image(f"{name} normal", maps.normal, colour=False), scale), normal.inputs["Color"])
    shader.link(normal.outputs[0], shader.surface.inputs["Normal"])


def _shown(shader: Shader, atlas: Any, *, shines: bool) -> None:
    colour = shader.times(shader.image(atlas), shader.tint.outputs["Color"])
    shader.set(roughness=0.5 if not shines else 0.25)
    if shines:
        shader.set(base_color=(0.01, 0.01, 0.012, 1.0), emission_strength=1.0)
        shader.link(colour, shader.surface.inputs["Emission Color"])
    else:
        shader.colour(colour)


def _paint(shader: Shader) -> None:
    """Painted metal: uneven and a little dirty."""
    tint = shader.times(shader.tint.outputs["Color"], shader.span(shader.noise(3.0), 0.82, 1.06))
    dirt = shader.span(shader.noise(6.0, (1, 1, 0.25), 5.0), 0.0, 0.55, 0.56, 0.78)
    shader.colour(shader.mixed(dirt, tint, (0.06, 0.05, 0.04)))
    shader.roughness(shader.span(shader.noise(14.0), 0.28, 0.55))


def _plastic(shader: Shader) -> None:
    shader.colour(shader.times(shader.tint.outputs["Color"], shader.span(shader.noise(8.0), 0.9, 1.04)))
    shader.roughness(shader.span(shader.noise(20.0), 0.3, 0.5))


def _rubber(shader: Shader) -> None:
    shader.colour(shader.tint.outputs["Color"])
    shader.set(roughness=0.75)


def _metal(shader: Shader) -> None:
    """Bare metal, brushed along its longest axis."""
    brushed = shader.noise(40.0, (0.04, 1.0, 1.0), 4.0)
    tint = shader.times(shader.tint.outputs["Color"], shader.span(shader.noise(2.5), 0.7, 1.05))
    shader.colour(shader.times(tint, shader.span(brushed, 0.85, 1.05)))
    shader.roughness(shader.span(brushed, 0.24, 0.45))
    shader.set(metallic=1.0)


def _chrome(shader: Shader) -> None:
    shader.colour(shader.tint.outputs["Color"])
    shader.set(metallic=1.0, roughness=0.12)


def _rust(shader: Shader) -> None:
    patch = shader.span(shader.noise(5.0, detail=6.0), 0.0, 1.0, 0.42, 0.6)
    shader.colour(shader.mixed(patch, shader.tint.outputs["Color"], (0.12, 0.045, 0.02)))
    shader.set(roughness=0.75)


def _wood(shader: Shader) -> None:
    grain = shader.noise(22.0, (0.05, 1.0, 1.0), 5.0)
    tint = shader.times(shader.tint.outputs["Color"], shader.span(shader.noise(2.0, (0.4, 1, 1)), 0.75, 1.08))
    shader.colour(shader.times(tint, shader.span(grain, 0.62, 1.1)))
    shader.roughness(shader.span(grain, 0.62, 0.42))


def _card(shader: Shader) -> None:
    fluted = shader.noise(60.0, (0.05, 1.0, 1.0), 2.0)
    tint = shader.times(shader.tint.outputs["Color"], shader.span(shader.noise(4.0), 0.86, 1.05))
    shader.colour(shader.times(tint, shader.span(fluted, 0.93, 1.03)))
    shader.set(roughness=0.85)


def _fabric(shader: Shader) -> None:
    shader.colour(shader.times(shader.tint.outputs["Color"], shader.span(shader.noise(60.0), 0.7, 1.2)))
    shader.set(roughness=0.95, sheen_weight=0.3)


def _wall(shader: Shader) -> None:
    """Painted plaster with stains and marks."""
    broad = shader.span(shader.noise(0.6, detail=5.0), 0.86, 1.05)
    tint = shader.times(shader.tint.outputs["Color"], broad)
    marks = shader.span(shader.noise(2.2, (1, 0.35, 1), 7.0), 0.0, 0.3, 0.58, 0.75)
    shader.colour(shader.mixed(marks, tint, (0.1, 0.085, 0.07)))
    shader.bump(shader.noise(60.0), 0.002)
    shader.set(roughness=0.8)


def _brick(shader: Shader) -> None:
    brick = shader.node("ShaderNodeTexBrick")
    for name, value in (("Scale", 1.0), ("Mortar Size", 0.008), ("Brick Width", 0.25), ("Row Height", 0.075)):
        brick.inputs[name].default_value = value
    brick.inputs["Mortar"].default_value = (0.32, 0.3, 0.27, 1.0)
    brick.inputs["Color1"].default_value, brick.inputs["Color2"].default_value = (1, 1, 1, 1), (0.5, 0.45, 0.42, 1)
    shader.link(shader.uv(1.0), brick.inputs["Vector"])
    tinted = shader.times(brick.outputs["Color"], shader.tint.outputs["Color"])
    shader.colour(shader.times(tinted, shader.span(shader.noise(1.2, detail=6.0), 0.65, 1.15)))
    shader.bump(brick.outputs["Fac"], -0.006)
    shader.set(roughness=0.9)


def _blocks(shader: Shader) -> None:
    """Painted concrete blocks."""
    brick = shader.node("ShaderNodeTexBrick")
    for name, value in (("Scale", 1.0), ("Mortar Size", 0.006), ("Brick Width", 0.4), ("Row Height", 0.2)):
        brick.inputs[name].default_value = value
    brick.inputs["Mortar"].default_value = (0.75, 0.75, 0.75, 1.0)
    brick.inputs["Color1"].default_value, brick.inputs["Color2"].default_value = (1, 1, 1, 1), (0.93, 0.93, 0.93, 1)
    shader.link(shader.uv(1.0), brick.inputs["Vector"])
    tinted = shader.times(brick.outputs["Color"], shader.tint.outputs["Color"])
    shader.colour(shader.times(tinted, shader.span(shader.noise(0.8, detail=6.0), 0.8, 1.08)))
    shader.bump(brick.outputs["Fac"], -0.006)
    shader.set(roughness=0.7)


def _ribbed(shader: Shader) -> None:
    """Corrugated sheet: ribs across the longer axis of a panel."""
    wave = shader.node("ShaderNodeTexWave", wave_type="BANDS", bands_direction="X")
    wave.inputs["Scale"].default_value = 1.6
    shader.link(shader.uv(1.0), wave.inputs["Vector"])
    tint = shader.times(shader.tint.outputs["Color"], shader.span(shader.noise(0.9, (1, 0.3, 1), 5.0), 0.75, 1.08))
    shader.colour(shader.times(tint, shader.span(wave.outputs["Fac"], 0.72, 1.05, 0.0, 1.0)))
    shader.bump(wave.outputs["Fac"], 0.03)
    shader.set(roughness=0.5, metallic=0.3)


def _tiles(shader: Shader) -> None:
    """Square tiles of 0.6 m with a fine grain, as in a suspended ceiling."""
    brick = shader.node("ShaderNodeTexBrick", offset=0.0)
    for name, value in (("Scale", 1.0), ("Mortar Size", 0.012), ("Brick Width", 0.6), ("Row Height", 0.6)):
        brick.inputs[name].default_value = value
    brick.inputs["Mortar"].default_value = (0.62, 0.62, 0.62, 1.0)
    brick.inputs["Color1"].default_value, brick.inputs["Color2"].default_value = (1, 1, 1, 1), (0.94, 0.94, 0.93, 1)
    shader.link(shader.uv(1.0), brick.inputs["Vector"])
    tinted = shader.times(brick.outputs["Color"], shader.tint.outputs["Color"])
    shader.colour(shader.times(tinted, shader.span(shader.noise(35.0), 0.88, 1.04)))
    shader.set(roughness=0.9)


def _pegboard(shader: Shader) -> None:
    """Perforated sheet: dark holes 38 mm apart."""
    voronoi = shader.node("ShaderNodeTexVoronoi")
    voronoi.inputs["Scale"].default_value, voronoi.inputs["Randomness"].default_value = 26.0, 0.0
    shader.link(shader.uv(1.0), voronoi.inputs["Vector"])
    hole = shader.span(voronoi.outputs["Distance"], 1.0, 0.0, 0.16, 0.24)
    shader.colour(shader.mixed(hole, shader.tint.outputs["Color"], (0.015, 0.015, 0.015)))
    shader.set(roughness=0.55)


def _ground(shader: Shader) -> None:
    shader.colour(shader.times(shader.tint.outputs["Color"], shader.span(shader.noise(3.0, detail=9.0), 0.55, 1.3)))
    shader.set(roughness=1.0)


def _leaf(shader: Shader) -> None:
    shader.colour(shader.tint.outputs["Color"])
    shader.set(roughness=0.6)


def _glass(shader: Shader) -> None:
    """A thin pane: it shows what is behind it, tinted, and a reflection."""
    clear, shiny, mix = (shader.node(f"ShaderNode{kind}") for kind in ("BsdfTransparent", "BsdfGlossy", "MixShader"))
    shader.link(shader.tint.outputs["Color"], clear.inputs["Color"])
    shiny.inputs["Roughness"].default_value = 0.04
    rim = shader.node("ShaderNodeFresnel")
    rim.inputs["IOR"].default_value = 1.4
    shader.link(rim.outputs[0], mix.inputs["Fac"])
    shader.link(clear.outputs[0], mix.inputs[1])
    shader.link(shiny.outputs[0], mix.inputs[2])
    shader.put_out(mix.outputs[0])


def _dark_glass(shader: Shader) -> None:
    shader.colour(shader.tint.outputs["Color"])
    shader.set(roughness=0.06, ior=1.6)


def _glow(shader: Shader) -> None:
    """A material that shines; its tint is its radiance."""
    emission = shader.node("ShaderNodeEmission")
    shader.link(shader.tint.outputs["Color"], emission.inputs["Color"])
    shader.put_out(emission.outputs[0])


_BUILT: dict[str, Callable[[Shader], None]] = {
    "paint": _paint,
    "plastic": _plastic,
    "rubber": _rubber,
    "metal": _metal,
    "chrome": _chrome,
    "rust": _rust,
    "wood": _wood,
    "card": _card,
    "fabric": _fabric,
    "wall": _wall,
    "brick": _brick,
    "blocks": _blocks,
    "ribbed": _ribbed,
    "tiles": _tiles,
    "pegboard": _pegboard,
    "ground": _ground,
    "leaf": _leaf,
    "glass": _glass,
    "dark glass": _dark_glass,
    "glow": _glow,
}
