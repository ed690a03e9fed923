"""A scene made real in the open template: cables, floor, light, world and camera. Sets everything, every time."""

from assets.colour import REC709_LUMINANCE
from farm.scene.backdrop import HdriWorld
from farm.scene.scene import Scene
from farm.spec.category import Background, CategoryTraits
from farm.spec.rendering import CableDetail, Economy
from worker.backdrop.matte import Backdrop, covered_by
from worker.backdrop.panorama import Panorama, lens_radius_m
from worker.backdrop.photograph import plate_backdrop
from worker.blender.asset_files import AssetLibrary
from worker.blender.cables import add_cables, remove_cables, shadow_slope
from worker.blender.camera import has_round_aperture, set_camera
from worker.blender.clutter import add_clutter
from worker.blender.floor import set_floor, set_unseen_floor
from worker.blender.image_cache import ImageCache
from worker.blender.world import backdrop_of, set_grey_world, set_hdri_world, set_lamps
from worker.cable.pieces import pieces_of
from worker.camera.view import View
from worker.curves import smooth
from worker.simulate.shapes import CableShapes

PLATE_LUMINANCE = 0.3
"""Mean luminance of a photograph behind the cables, where the surroundings that light them tell none."""


def build_scene(
    scene: Scene,
    shapes: CableShapes,
    library: AssetLibrary,
    image_cache: ImageCache,
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
        image_cache: the images that this process holds.
        traits: of the scene's category.
        resolution: pixels along an edge of the picture.
        detail: how finely cables are modelled.
        economy: what is left out.

    Returns:
        What is behind the cables, if the renderer is to leave it out.

    Raises:
        AssetError: if a texture or HDRI can't be had.
    """
    image_cache.begin_picture()
    if not economy.keep_loaded:
        image_cache.forget()
    remove_cables()
    view = View.of(scene.camera, resolution).undistorted()
    curves = [smooth(nodes, detail.points_per_segment) for nodes in shapes.nodes_m]
    pieces = pieces_of(scene, curves, shapes.sticks_m)
    slope = shadow_slope(scene.lamps)
    add_cables(pieces, detail.sides, view, image_cache, slope=slope, whole=not economy.cables_in_view)
    if scene.floor is None:
        set_unseen_floor(image_cache)
    else:
        # Wear is drawn on what is seen, so it needs a view whatever is left out.
        seen = view if economy.texture_window or scene.floor.wear is not None else None
        set_floor(scene.floor, library.surface(scene.floor.texture), image_cache, seen)
    add_clutter(scene, shapes.sticks_m, curves, image_cache)
    set_lamps(scene.lamps)
    set_camera(scene.camera)
    if scene.hdri_world is None:
        set_grey_world(scene.grey_world)
        return None
    light = _behind(scene, scene.hdri_world, library, image_cache, resolution, economy)
    is_seen = traits.background is Background.HDRI and light is None
    set_hdri_world(scene.hdri_world, library, image_cache, only_lights=economy.upper_world and not is_seen)
    if light is None:
        return None
    return Backdrop(light, covered_by(pieces, view, lens_radius_m(scene.camera), detail.sides))


def _behind(
    scene: Scene, world: HdriWorld, library: AssetLibrary, image_cache: ImageCache, resolution: int, economy: Economy
) -> Panorama | None:
    """The view behind cables without a floor, where it is looked up: a photograph always is."""
    if scene.floor is not None or (scene.plate is None and not (economy.backdrop and has_round_aperture())):
        return None
    seen = backdrop_of(world, scene.camera, resolution, library, image_cache)
    if scene.plate is None:
        return seen
    # As bright as what would be seen of the surroundings that light the cables.
    luminance = PLATE_LUMINANCE if seen is None else float((seen @ REC709_LUMINANCE).mean())
    photograph = image_cache.photograph(library.plate(scene.plate.name))
    return plate_backdrop(photograph, scene.plate, resolution, scene.plate.blur_px, luminance)
