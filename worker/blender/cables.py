"""Cables in the open picture: a mesh for each piece, a material for each surface."""

import math
from collections.abc import Sequence
from typing import Any

import bpy
import numpy as np

from blend import names
from blend.mesh import MeshArrays, add_mesh
from farm.model import Rgb
from farm.scene.cable import CableMaterial
from farm.scene.light import Lamp, StudioLamp
from worker.blender.image_cache import ImageCache
from worker.blender.remove import remove_blocks
from worker.cable.piece import Convex, Piece, Plain, Tubular
from worker.cable.plain import draw_plain
from worker.cable.skin import SkinImages, draw_skin
from worker.cable.tube import Tube, loft, sweep
from worker.camera.view import View
from worker.curves import parts_near

DIRT_EDGE = 0.05
"""Distance of the dirt ramp's two stops, which makes the edge of a spot that soft."""

SHADOW_SLOPE = 3.0
"""Reach of a shadow over its object's height under the lowest published lamp, which is 15 m away and 5 m high."""


def shadow_slope(lamps: Sequence[Lamp]) -> float:
    """Compute the reach of the longest shadow over its object's height; a lamp below 1 degree counts as at 1 degree."""
    elevations_deg = [max(lamp.elevation_deg, 1.0) for lamp in lamps if isinstance(lamp, StudioLamp)]
    return max([SHADOW_SLOPE, *(1.0 / math.tan(math.radians(elevation)) for elevation in elevations_deg)])


def add_cables(
    pieces: Sequence[Piece], sides: int, view: View, image_cache: ImageCache, *, slope: float, whole: bool
) -> None:
    """Add a settled scene's cables, after removing those of the picture before.

    Args:
        pieces: the cables in pieces.
        sides: corners of a tube's cross-section.
        view: the camera.
        image_cache: the holder of the images of skins.
        slope: reach of the longest shadow over its object's height.
        whole: whether to add cables that leave the view wholly, not only what is seen or may throw a shadow into it.
    """
    remove_blocks(f"{names.CABLE}.")
    materials: dict[object, Any] = {}
    for number, piece in enumerate(pieces):
        name = f"{names.CABLE}.{piece.instance}.{number}"
        made = list(_meshes(piece, sides, None if whole else view, slope))
        if not made:
            continue
        key = _identity(piece)
        if key not in materials:
            materials[key] = _material(name, piece, view, image_cache)
        for place, tube in made:
            _add_tube(f"{name}.{place}", tube, materials[key], smooth=isinstance(piece, Tubular))


def _identity(piece: Piece) -> object:
    """Compute the key of a piece's material. A sheath has a material of its own, drawn for its own length."""
    if isinstance(piece.surface, Plain):
        return piece.surface
    return piece.instance


def _meshes(piece: Piece, sides: int, view: View | None, slope: float) -> list[tuple[int, Tube]]:
    """The meshes of a piece, each with the point of the piece's curve at which it starts."""
    if isinstance(piece, Convex):
        return [(0, loft(piece.rings))]
    curve, points = piece.curve, len(piece.curve)
    if view is None:
        parts = [slice(0, points)]
    else:
        half_m = float(np.abs(view.floor_corners_m()[:, :2]).max())
        widest_m = 2 * float(np.max(piece.radius_m))
        parts = parts_near(curve, half_m + slope * float(curve[:, 2].max()) + widest_m)
    return [(part.start, _tube(piece, part, sides)) for part in parts]


def _tube(piece: Tubular, part: slice, sides: int) -> Tube:
    start_m = piece.start_m + (piece.end_m - piece.start_m) * part.start / (len(piece.curve) - 1)
    radius_m = piece.radius_m if isinstance(piece.radius_m, float) else piece.radius_m[part]
    tube = sweep(piece.curve[part], radius_m, sides, start_m=start_m)
    if not isinstance(piece.surface, CableMaterial):
        tube.uvs[:] /= (piece.whole_m, 2 * np.pi * float(np.mean(piece.radius_m)))
    return tube


def _add_tube(name: str, tube: Tube, material: Any, *, smooth: bool) -> None:
    arrays = MeshArrays(
        vertices_m=tube.vertices_m,
        corners=tube.corners,
        face_starts=tube.face_starts,
        smooth=smooth,
        uv=tube.uvs,
        uv_name="along",
    )
    add_mesh(bpy.data.scenes[names.PICTURE_SCENE], name, arrays, [material])


def _material(name: str, piece: Piece, view: View, image_cache: ImageCache) -> Any:
    if isinstance(piece, Convex):
        return _drawn(name, draw_plain(piece.surface), image_cache)
    if isinstance(piece.surface, Plain):
        return _drawn(name, draw_plain(piece.surface), image_cache)
    if isinstance(piece.surface, CableMaterial):
        return _published(name, piece.surface)
    diameter_m = 2 * float(np.max(piece.radius_m))
    return _drawn(name, draw_skin(piece.surface, piece.whole_m, diameter_m, 1.0 / view.pixels_per_m), image_cache)


def _published(name: str, wanted: CableMaterial) -> Any:
    material = bpy.data.materials[names.CABLE].copy()
    material.name = name
    nodes = material.node_tree.nodes
    nodes[names.CABLE_MAPPING].inputs["Location"].default_value = wanted.dirt_mapping
    nodes[names.CABLE_NOISE].inputs["W"].default_value = wanted.dirt_offset
    clean, dirty = nodes[names.CABLE_COLOUR_RAMP].color_ramp.elements
    clean.position = wanted.dirt_position
    clean.color = _levels_as_light(wanted.colour)
    dirty.position = min(1.0, wanted.dirt_position + DIRT_EDGE)
    dirty.color = _levels_as_light(wanted.dirt_colour)
    nodes[names.CABLE_REFLECTION_RAMP].color_ramp.elements[1].position = wanted.reflection_position
    return material


def _drawn(name: str, images: SkinImages, image_cache: ImageCache) -> Any:
    material = bpy.data.materials[names.SKIN].copy()
    material.name = name
    tree = material.node_tree
    tree.nodes[names.SKIN_COLOUR].image = image_cache.for_picture(f"{name} colour", images.colour, colour=True)
    tree.nodes[names.SKIN_ROUGHNESS].image = image_cache.for_picture(
        f"{name} roughness", images.roughness, colour=False
    )
    surface = tree.nodes[names.SKIN_SURFACE]
    if images.normal is None:
        # Tangents are worked out for every mesh whose material asks for them.
        for way in list(surface.inputs["Normal"].links):
            tree.links.remove(way)
    else:
        tree.nodes[names.SKIN_NORMAL].image = image_cache.for_picture(f"{name} normal", images.normal, colour=False)
    surface.inputs["Metallic"].default_value = images.metallic
    surface.inputs["Coat Weight"].default_value = images.coat
    surface.inputs["Coat Roughness"].default_value = images.coat_roughness
    surface.inputs["Sheen Weight"].default_value = images.haze
    return material


def _levels_as_light(colour: Rgb) -> tuple[float, float, float, float]:
    """Take levels for linear light, without sRGB's curve, as the published set-up does: colours come out pastel.

    Returns:
        Red, green, blue and an alpha of 1, each 0 to 1.
    """
    red, green, blue = (level / 255.0 for level in colour)
    return (red, green, blue, 1.0)
