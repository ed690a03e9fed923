"""Blender's camera, set to be the one that the masks are drawn for."""

import bpy
from mathutils import Matrix

from blend import names
from farm.scene.camera import FAR_CLIP_M, NEAR_CLIP_M, SENSOR_MM, Camera
from worker.camera.view import View


def set_camera(camera: Camera, view: View) -> None:
    """Place and aim the template's camera as drawn; distortion is left to the development.

    Args:
        camera: the camera as drawn.
        view: its geometry, at any resolution.
    """
    camera_object = bpy.data.objects[names.CAMERA]
    camera_object.location = view.position_m
    camera_object.rotation_mode = "XYZ"
    camera_object.rotation_euler = Matrix(view.rotation.tolist()).to_euler("XYZ")
    camera_object.scale = (1.0, 1.0, 1.0)
    data = camera_object.data
    data.type = "PERSP"
    data.lens, data.sensor_width, data.sensor_fit = camera.focal_length_mm, SENSOR_MM, "AUTO"
    data.shift_x = data.shift_y = 0.0
    # Blender's own default would cut off what lies within 0.1 m of the lens, and labels would still show it.
    data.clip_start, data.clip_end = NEAR_CLIP_M, FAR_CLIP_M
    data.dof.focus_distance = view.focus_m
    data.dof.aperture_fstop = camera.f_number


def has_round_aperture() -> bool:
    """Whether the template's lens blurs with a disc, as the farm's own does."""
    dof = bpy.data.objects[names.CAMERA].data.dof
    return bool(dof.use_dof and dof.focus_object is None and dof.aperture_blades < 3 and dof.aperture_ratio == 1.0)
