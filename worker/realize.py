"""A scene made real in the open template: cables, floor, light, world and camera. Sets everything, every time."""

import bpy

from blend import names
from farm.category import Background, CategoryTraits
from farm.lens import FOCAL_LENGTH_MM, SENSOR_MM
from farm.photograph import Camera
from farm.rendering import CableDetail, Economy
from farm.scene import Scene
from worker.cable_objects import add_cables, remove_cables
from worker.floor import set_floor, set_unseen_floor
from worker.images import ImageShelf
from worker.library import AssetLibrary
from worker.matte import Backdrop, covered_by
from worker.panorama import lens_radius_m
from worker.pieces import pieces_of
from worker.shapes import Points, smooth
from worker.silhouette import View
from worker.surroundings import backdrop_of, set_grey_world, set_hdri_world, set_lamps


def realize(
    scene: Scene,
    nodes_m: tuple[Points, ...],
    library: AssetLibrary,
    shelf: ImageShelf,
    *,
    traits: CategoryTraits,
    resolution: int,
    detail: CableDetail,
    economy: Economy,
) -> Backdrop | None:
    """Set the picture's scene to `scene`, with settled cables.

    Args:
        scene: what was drawn.
        nodes_m: the settled centrelines, nodes (N, 3), metres, one a cable.
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
    view = View(height_m=scene.camera.height_m, resolution=resolution)
    curves = [smooth(nodes, detail.points_per_segment) for nodes in nodes_m]
    pieces = pieces_of(scene, curves)
    add_cables(pieces, detail.sides, view, shelf, whole=not economy.cables_in_view)
    if scene.floor is None:
        set_unseen_floor(shelf)
    else:
        set_floor(scene.floor, library.surface(scene.floor.texture), shelf, view if economy.texture_window else None)
    set_lamps(scene.lamps)
    _set_camera(scene.camera)
    if scene.hdri_world is None:
        set_grey_world()
        return None
    light = None
    if traits.background is Background.HDRI and economy.backdrop and _has_round_aperture():
        light = backdrop_of(scene.hdri_world, scene.camera, resolution, library, shelf)
    is_seen = traits.background is Background.HDRI and light is None
    set_hdri_world(scene.hdri_world, library, shelf, only_lights=economy.upper_world and not is_seen)
    if light is None:
        return None
    return Backdrop(light, covered_by(pieces, view, lens_radius_m(scene.camera), detail.sides))


def _set_camera(camera: Camera) -> None:
    """Straight down through the published lens, whatever the template's is: the masks take it for granted."""
    camera_object = bpy.data.objects[names.CAMERA]
    camera_object.location = (0.0, 0.0, camera.height_m)
    camera_object.rotation_mode = "XYZ"
    camera_object.rotation_euler = (0.0, 0.0, 0.0)
    camera_object.scale = (1.0, 1.0, 1.0)
    data = camera_object.data
    data.type = "PERSP"
    data.lens, data.sensor_width, data.sensor_fit = FOCAL_LENGTH_MM, SENSOR_MM, "HORIZONTAL"
    data.shift_x = data.shift_y = 0.0
    data.dof.focus_distance = camera.height_m
    data.dof.aperture_fstop = camera.f_number


def _has_round_aperture() -> bool:
    """Whether the template's lens blurs with a disc, as the farm's own does."""
    dof = bpy.data.objects[names.CAMERA].data.dof
    return bool(dof.use_dof and dof.focus_object is None and dof.aperture_blades < 3 and dof.aperture_ratio == 1.0)
