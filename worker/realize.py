"""A scene made real in the open template: cables, floor, light, world and camera. Sets everything, every time."""

<<<<<<< HEAD
from assets.hdris import LUMINANCE
from farm.category import Background, CategoryTraits
from farm.lights import HdriWorld
=======
import math
from typing import Any

import bpy
import numpy as np

from blend import names
from assets.hdris import LUMINANCE
from farm.category import Background, CategoryTraits
from farm.lights import HdriWorld
from farm.lights import Lamp, StudioLamp
from farm.looks import CableMaterial, Rgb
>>>>>>> h-camera
from farm.rendering import CableDetail, Economy
from farm.scene import Scene
from worker.cable_objects import add_cables, remove_cables
from worker.camera import has_round_aperture, set_camera
from worker.clutter.place import add_clutter
from worker.floor import set_floor, set_unseen_floor
from worker.images import ImageShelf
from worker.library import AssetLibrary
from worker.matte import Backdrop, covered_by
from worker.panorama import Panorama, lens_radius_m
from worker.pieces import pieces_of
from worker.plate import plate_backdrop
from worker.shapes import CableShapes, smooth
from worker.surroundings import backdrop_of, set_grey_world, set_hdri_world, set_lamps
from worker.view import View

<<<<<<< HEAD
=======
DIRT_EDGE = 0.05
"""Distance of the two stops of the dirt ramp: how soft the edge of a spot is."""

SHADOW_SLOPE = 3.0
"""How far a shadow reaches, in the height of what throws it: that of the lowest published lamp, 15 m away at 5 m."""

>>>>>>> h-camera
PLATE_LUMINANCE = 0.3
"""Mean luminance of a photograph behind the cables, where the surroundings that light them tell none."""


def realize(
    scene: Scene,
    shapes: CableShapes,
    library: AssetLibrary,
    shelf: ImageShelf,
    *,
    traits: CategoryTraits,
    resolution: int,
    detail: CableDetail,
    economy: Economy,
) -> Backdrop | None:
    """Set the picture's scene to `scene`, with settled cables and clutter.

    Args:
        scene: what was drawn.
        shapes: its cables and sticks, settled.
        library: where the textures and HDRIs are.
        shelf: the images that this process holds.
        traits: of the scene's category.
        resolution: pixels along an edge of the picture.
        detail: how finely cables are modelled.
        economy: what is left out.

    Returns:
        What is behind the cables, if the renderer is to leave it out.

    Raises:
        AssetError: if a texture or HDRI can't be had.
    """
    shelf.begin_picture()
    if not economy.keep_loaded:
        shelf.forget()
    remove_cables()
    view = View.of(scene.camera, resolution).undistorted()
<<<<<<< HEAD
    curves = [smooth(nodes, detail.points_per_segment) for nodes in shapes.nodes_m]
    pieces = pieces_of(scene, curves)
    add_cables(pieces, detail.sides, view, shelf, whole=not economy.cables_in_view)
=======
    curves = [smooth(nodes, detail.points_per_segment) for nodes in nodes_m]
    slope = _shadow_slope(scene.lamps)
    for number, (cable, curve) in enumerate(zip(scene.cables, curves, strict=True), start=1):
        _add_cable(number, cable, curve, detail, view if economy.cables_in_view else None, slope)
>>>>>>> h-camera
    if scene.floor is None:
        set_unseen_floor(shelf)
    else:
        # Wear is drawn on what is seen, so it needs a view whatever is left out.
        seen = view if economy.texture_window or scene.floor.wear is not None else None
        set_floor(scene.floor, library.surface(scene.floor.texture), shelf, seen)
    add_clutter(scene, shapes.sticks_m, curves, shelf)
    set_lamps(scene.lamps)
    set_camera(scene.camera)
    if scene.hdri_world is None:
        set_grey_world(scene.grey_world)
        return None
    light = _behind(scene, scene.hdri_world, library, shelf, resolution, economy)
    is_seen = traits.background is Background.HDRI and light is None
    set_hdri_world(scene.hdri_world, library, shelf, only_lights=economy.upper_world and not is_seen)
    if light is None:
        return None
<<<<<<< HEAD
    return Backdrop(light, covered_by(pieces, view, lens_radius_m(scene.camera), detail.sides))
=======
    radii_m = np.array([cable.diameter_m / 2 for cable in scene.cables])
    return Backdrop(light, covered_by(curves, radii_m, view, lens_radius_m(scene.camera), detail.sides))


def remove_cables() -> None:
    """Remove the cables of the picture before."""
    prefix = f"{names.CABLE}."
    for collection in (bpy.data.objects, bpy.data.meshes, bpy.data.materials):
        for block in [block for block in collection if block.name.startswith(prefix)]:
            collection.remove(block)


def _shadow_slope(lamps: tuple[Lamp, ...]) -> float:
    """How far the longest shadow reaches, in the height of what throws it; a lamp at the horizon's is cut short."""
    elevations_deg = [max(lamp.elevation_deg, 1.0) for lamp in lamps if isinstance(lamp, StudioLamp)]
    return max([SHADOW_SLOPE, *(1.0 / math.tan(math.radians(elevation)) for elevation in elevations_deg)])


def _add_cable(
    number: int, cable: Cable, curve: Points, detail: CableDetail, view: View | None, shadow_slope: float
) -> None:
    """Add a cable; of one that leaves the view, the parts that are seen or may throw a shadow into it."""
    if not isinstance(cable.material, CableMaterial):
        raise NotImplementedError  # until skins are drawn
    material = _cable_material(f"{names.CABLE}.{number}", cable.material)
    if view is None:
        parts = [slice(0, len(curve))]
    else:
        half_m = float(np.abs(view.floor_corners_m()[:, :2]).max())
        parts = parts_near(curve, half_m + shadow_slope * float(curve[:, 2].max()) + cable.diameter_m)
    for part in parts:
        start_m = cable.length_m * part.start / (len(curve) - 1)
        tube = sweep(curve[part], cable.diameter_m / 2, detail.sides, start_m=start_m)
        _add_tube(f"{names.CABLE}.{number}.{part.start}", tube, material)


def _add_tube(name: str, tube: Tube, material: Any) -> None:
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(tube.vertices_m))
    mesh.vertices.foreach_set("co", tube.vertices_m.ravel())
    mesh.loops.add(len(tube.corners))
    mesh.loops.foreach_set("vertex_index", tube.corners)
    mesh.polygons.add(len(tube.face_starts))
    mesh.polygons.foreach_set("loop_start", tube.face_starts)
    mesh.uv_layers.new(name="along").uv.foreach_set("vector", tube.uvs.ravel())
    mesh.update(calc_edges=True)
    mesh.materials.append(material)
    bpy.data.scenes[names.PICTURE_SCENE].collection.objects.link(bpy.data.objects.new(name, mesh))


def _cable_material(name: str, wanted: CableMaterial) -> Any:
    material = bpy.data.materials[names.CABLE].copy()
    material.name = name
    nodes = material.node_tree.nodes
    nodes[names.CABLE_MAPPING].inputs["Location"].default_value = wanted.dirt_mapping
    nodes[names.CABLE_NOISE].inputs["W"].default_value = wanted.dirt_offset
    clean, dirty = nodes[names.CABLE_COLOUR_RAMP].color_ramp.elements
    clean.position = wanted.dirt_position
    clean.color = _linear(wanted.colour)
    dirty.position = min(1.0, wanted.dirt_position + DIRT_EDGE)
    dirty.color = _linear(wanted.dirt_colour)
    nodes[names.CABLE_REFLECTION_RAMP].color_ramp.elements[1].position = wanted.reflection_position
    return material


def _linear(colour: Rgb) -> tuple[float, float, float, float]:
    """Levels as shares of linear light, which is how the published set-up reads them: the colours come out pastel."""
    red, green, blue = (level / 255.0 for level in colour)
    return (red, green, blue, 1.0)
>>>>>>> h-camera


def _behind(
    scene: Scene, world: HdriWorld, library: AssetLibrary, shelf: ImageShelf, resolution: int, economy: Economy
) -> Panorama | None:
    """The view behind cables without a floor, where it is looked up: a photograph always is."""
    if scene.floor is not None or (scene.plate is None and not (economy.backdrop and has_round_aperture())):
        return None
    seen = backdrop_of(world, scene.camera, resolution, library, shelf)
    if scene.plate is None:
        return seen
    # As bright as what would be seen of the surroundings that light the cables.
    luminance = PLATE_LUMINANCE if seen is None else float((seen @ LUMINANCE).mean())
    photograph = shelf.photograph(library.plate(scene.plate.name))
    return plate_backdrop(photograph, scene.plate, resolution, scene.plate.blur_px, luminance)
