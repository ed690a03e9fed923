"""Round lamps that face the cables: made for a picture, and removed before the next."""

import math
from collections.abc import Sequence
from typing import Any

import bpy
from mathutils import Vector

from blend import names
from farm.scene.light import StudioLamp
from worker.blender.remove import remove_blocks
from worker.camera.black_body import black_body

_PREFIX = "studio_lamp."


def add_studio_lamps(lamps: Sequence[StudioLamp]) -> None:
    """Add a picture's studio lamps, after removing those of the picture before."""
    remove_blocks(_PREFIX)
    for number, lamp in enumerate(lamps, start=1):
        _add(lamp, f"{_PREFIX}{number}")


def _add(lamp: StudioLamp, name: str) -> None:
    data = bpy.data.lights.new(name, "AREA")
    data.shape, data.size = "DISK", lamp.size_m
    data.energy = power_w(lamp)
    data.color = black_body(lamp.temperature_k)
    lamp_object: Any = bpy.data.objects.new(data.name, data)
    bearing, elevation = math.radians(lamp.bearing_deg), math.radians(lamp.elevation_deg)
    towards = Vector(
        (math.cos(elevation) * math.cos(bearing), math.cos(elevation) * math.sin(bearing), math.sin(elevation))
    )
    lamp_object.location = lamp.distance_m * towards
    lamp_object.rotation_mode = "XYZ"
    lamp_object.rotation_euler = towards.to_track_quat("Z", "Y").to_euler()
    # It may stand between the camera and the cables.
    lamp_object.visible_camera = False
    bpy.data.scenes[names.PICTURE_SCENE].collection.objects.link(lamp_object)


def power_w(lamp: StudioLamp) -> float:
    """Blender's power for a lamp's irradiance.

    A disc of radius r and power P has the radiance L = P / (pi A) = P / (pi^2 r^2). On its axis at distance d it gives
    the irradiance E = pi L r^2 / (r^2 + d^2), so that P = pi E (r^2 + d^2).
    """
    return math.pi * lamp.irradiance_w_m2 * ((lamp.size_m / 2) ** 2 + lamp.distance_m**2)
