"""Makes the open template show a settled scene: sets cables, floor, light, world and camera for every picture."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from assets.colour import REC709_LUMINANCE
from farm.scene.backdrop import HdriWorld
from farm.scene.scene import Scene
from farm.spec.rendering import Economy
from worker.backdrop.matte import Matte, covered_by
from worker.backdrop.photograph import photograph_backdrop
from worker.blender.asset_files import AssetLibrary
from worker.blender.cables import add_cables, shadow_slope
from worker.blender.camera import has_round_aperture, set_camera
from worker.blender.clutter import add_clutter
from worker.blender.floor import set_floor, set_unseen_floor
from worker.blender.image_cache import ImageCache
from worker.blender.world import hdri_backdrop, set_grey_world, set_hdri_world, set_lamps
from worker.geometry import SettledGeometry

PLATE_LUMINANCE = 0.3
"""Mean luminance of a photograph behind the cables, if an artist changed how the template shows the HDRI around it."""


@dataclass(frozen=True, slots=True)
class BuiltScene:
    """The scene that the template shows, and the backdrop that its render lacks.

    Attributes:
        scene: the scene as drawn.
        matte: the backdrop, which the render leaves out; None where Blender renders all there is.
    """

    scene: Scene
    matte: Matte | None


def build_scene(
    geometry: SettledGeometry, library: AssetLibrary, image_cache: ImageCache, economy: Economy
) -> BuiltScene:
    """Set the template's picture to a settled scene.

    Args:
        geometry: geometry of the settled scene.
        library: the files of textures and HDRIs.
        image_cache: the images that this process holds.
        economy: choice of what is left out to save time.

    Raises:
        AssetError: if a texture or HDRI can't be had.
    """
    scene, view = geometry.scene, geometry.rendered_view
    image_cache.begin_picture()
    if not economy.keep_loaded:
        image_cache.forget()
    add_cables(
        geometry.pieces,
        geometry.detail.sides,
        view,
        image_cache,
        slope=shadow_slope(scene.lamps),
        whole=not economy.cables_in_view,
    )
    if scene.floor is None:
        set_unseen_floor(image_cache)
    else:
        # Wear is drawn on what is seen, so it needs a view whatever is left out.
        seen = view if economy.texture_window or scene.floor.wear is not None else None
        set_floor(scene.floor, library.surface(scene.floor.texture), image_cache, seen)
    add_clutter(geometry, image_cache)
    set_lamps(scene.lamps)
    set_camera(scene.camera, view)
    if scene.hdri_world is None:
        set_grey_world(scene.grey_world)
        return BuiltScene(scene, None)
    backdrop = _backdrop(geometry, scene.hdri_world, library, image_cache, economy)
    is_seen = scene.floor is None and backdrop is None
    set_hdri_world(scene.hdri_world, library, image_cache, only_lights=economy.upper_world and not is_seen)
    if backdrop is None:
        return BuiltScene(scene, None)
    covered = covered_by(geometry.pieces, view, geometry.lens_radius_m, geometry.detail.sides)
    return BuiltScene(scene, Matte(covered, backdrop))


def _backdrop(
    geometry: SettledGeometry, world: HdriWorld, library: AssetLibrary, image_cache: ImageCache, economy: Economy
) -> NDArray[np.float32] | None:
    """Make the backdrop of cables without a floor; None if there is a floor, or if Blender renders the HDRI itself."""
    scene = geometry.scene
    if scene.floor is not None or (scene.plate is None and not (economy.backdrop and has_round_aperture())):
        return None
    seen = hdri_backdrop(world, geometry.rendered_view, geometry.lens_radius_m, library, image_cache)
    if scene.plate is None:
        return seen
    # The photograph is as bright as the part of the HDRI that it stands in for.
    luminance = PLATE_LUMINANCE if seen is None else float((seen @ REC709_LUMINANCE).mean())
    photograph = image_cache.photograph(library.plate(scene.plate.name))
    return photograph_backdrop(photograph, scene.plate, geometry.resolution, scene.plate.blur_px, luminance)
