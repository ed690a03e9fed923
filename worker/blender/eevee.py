"""Eevee's settings, and its stand-in for the lamp: a spot light whose shadows are fine enough for cables."""

from collections.abc import Mapping
from typing import Any, Final

import bpy
import numpy as np
from mathutils import Vector

from blend import names
from farm.spec.quality import ChosenSettings, Preset, Quality
from farm.spec.rendering import CyclesSettings, Economy, PictureSettings

_SAMPLES: Final[Mapping[Quality, int]] = {Preset.DRAFT: 8, Preset.STANDARD: 16, Preset.REFERENCE: 128}
"""Samples a pixel of each preset."""

CHOSEN: Final = ChosenSettings(
    settings=PictureSettings(cycles=CyclesSettings(samples=1), economy=Economy(upper_world=False, backdrop=False)),
    expected_flip=None,
)
"""Settings by which cables and textures are built for Eevee; the settings of Cycles among them are not used."""

_NAME = f"{names.POINT_LAMP}.eevee"
"""Name of the spot light that stands for the picture's lamp."""

_DISTANCE_M = 2.0
"""Distance of the spot light from the origin. At the published distances a 2 mm cable throws no shadow, at 3 m it does;
and 2 m are enough to light the view evenly."""

_LIT_RADIUS_M = 0.4
"""Half the width of the floor that the spot light reaches: the view, and what may throw shadows into it."""

_AREA_TO_POINT = 4.0
"""Power of a point light that shines along one axis as an area light of power 1 does: P / pi per steradian along its
axis against P / (4 pi)."""


def samples_of(quality: Quality) -> int:
    """Samples a pixel of a preset. A quality as a number is not calibrated for Eevee, and the spec refuses it."""
    return _SAMPLES[quality]


def light_with_a_spot(scene: Any) -> None:
    """Let a near, narrow spot light stand for the picture's lamp, if it has one.

    Eevee's shadow maps lose a cable under a lamp 7 m away. The stand-in has the lamp's direction, its angular size and
    its irradiance at the origin.
    """
    before = bpy.data.objects.get(_NAME)
    if before is not None:
        bpy.data.lights.remove(before.data)
    for name in (names.POINT_LAMP, names.AREA_LAMP):
        lamp = bpy.data.objects[name]
        if not lamp.hide_render:
            lamp.hide_render = True
            _add_spot(scene, lamp)


def _add_spot(scene: Any, lamp: Any) -> None:
    is_area = lamp.data.type == "AREA"
    nearer = _DISTANCE_M / lamp.location.length
    data = bpy.data.lights.new(_NAME, "SPOT")
    data.color = lamp.data.color
    data.energy = lamp.data.energy * nearer**2 * (_AREA_TO_POINT if is_area else 1.0)
    data.shadow_soft_size = nearer * (lamp.data.size / 2 if is_area else lamp.data.shadow_soft_size)
    data.spot_size = 2 * float(np.arctan(_LIT_RADIUS_M / _DISTANCE_M))
    data.spot_blend = 0.0
    data.shadow_maximum_resolution = 0.0001
    # Each sample takes another point of the lamp. The alternative, marching through one shadow map, steps over cables.
    data.use_shadow_jitter = True
    data.shadow_jitter_overblur = 0.0
    spot = bpy.data.objects.new(_NAME, data)
    spot.location = nearer * lamp.location
    spot.rotation_euler = (-Vector(lamp.location)).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(spot)
