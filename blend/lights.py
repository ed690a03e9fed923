"""The two lamps of a concentrated light and the camera."""

from typing import Any

import bpy

from blend import names
from farm.scene.camera import FOCAL_LENGTH_MM, SENSOR_MM


def add_lamps(scene: Any) -> None:
    """Add the point and the area light, both off until a picture uses one."""
    point = _add_lamp(scene, names.POINT_LAMP, "POINT")
    point.location = (5.0, 0.0, 5.5)
    point.data.energy = 1000.0
    area = _add_lamp(scene, names.AREA_LAMP, "AREA")
    area.location = (6.0, 0.0, 5.0)
    area.data.energy = 1000.0
    area.data.size = 1.0
    # It keeps facing the cables wherever its x is drawn.
    target = area.constraints.new("DAMPED_TRACK")
    target.target = bpy.data.objects[names.FLOOR]
    target.track_axis = "TRACK_NEGATIVE_Z"


def _add_lamp(scene: Any, name: str, kind: str) -> Any:
    lamp = bpy.data.objects.new(name, bpy.data.lights.new(name, kind))
    lamp.hide_render = True
    scene.collection.objects.link(lamp)
    return lamp


def add_camera(scene: Any) -> None:
    """Add the camera: straight down, 50 mm lens on a 36 mm sensor, focused on the floor."""
    camera = bpy.data.objects.new(names.CAMERA, bpy.data.cameras.new(names.CAMERA))
    camera.location = (0.0, 0.0, 0.20)
    camera.rotation_euler = (0.0, 0.0, 0.0)
    data = camera.data
    data.lens, data.sensor_width, data.sensor_fit = FOCAL_LENGTH_MM, SENSOR_MM, "HORIZONTAL"
    data.clip_start, data.clip_end = 0.005, 100.0
    data.dof.use_dof = True
    data.dof.focus_distance = 0.20
    data.dof.aperture_fstop = 8.0
    scene.collection.objects.link(camera)
    scene.camera = camera
