"""How others set Cycles: Blender as it starts, and BlenderProc."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import bpy

from benchmarks.render.stage_set import SettledScene, Stage
from blend import names
from farm.spec.quality import REFERENCE
from farm.spec.rendering import Denoiser, PictureSettings, Prefilter


@dataclass(frozen=True, slots=True)
class Rendering:
    """Settings of a picture, and those that the farm leaves nobody to choose.

    Attributes:
        settings: the settings that the farm has.
        more: further properties of Cycles by name, set after all others.
    """

    settings: PictureSettings
    more: Mapping[str, Any]


def set_picture(stage: Stage, settled: SettledScene, rendering: Rendering) -> None:
    """Build a scene and set how it renders."""
    stage.set(settled, rendering.settings)
    cycles = bpy.data.scenes[names.PICTURE_SCENE].cycles
    for name, value in rendering.more.items():
        setattr(cycles, name, value)


_AUTOMATIC = {"adaptive_min_samples": 0, "sampling_pattern": "AUTOMATIC"}
"""Cycles takes 64 samples before it looks at the noise, and blue noise."""

BLENDER = Rendering(
    PictureSettings(
        cycles=REFERENCE.cycles.model_copy(
            update={
                "samples": 4096,
                "adaptive_threshold": 0.01,
                "denoiser": Denoiser.HIGH,
                "prefilter": Prefilter.ACCURATE,
                "light_tree": True,
            }
        ),
        economy=REFERENCE.economy,
    ),
    more={**_AUTOMATIC, "transparent_max_bounces": 8},
)
"""Blender 4.5 as it starts, with nothing left out of the scene. Cables are modelled as in standard pictures."""

BLENDERPROC = Rendering(
    PictureSettings(
        cycles=BLENDER.settings.cycles.model_copy(
            update={"samples": 1024, "bounces": 3, "diffuse_bounces": 3, "glossy_bounces": 0}
        ),
        economy=REFERENCE.economy,
    ),
    more={**_AUTOMATIC, "transparent_max_bounces": 8, "transmission_bounces": 0, "volume_bounces": 0},
)
"""What BlenderProc sets where a script says nothing, on all cores; the rest is Blender's.

Its denoiser is Blender's Denoise node, with the same Open Image Denoise at the same quality as that of Cycles.
"""
