"""Other programs' settings of Cycles: Blender's own defaults, and BlenderProc's."""

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
    """Settings of a picture, including those that the farm doesn't let a user choose.

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
"""Properties with which Cycles chooses itself: 64 samples before adaptive sampling may stop, and blue noise."""

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
"""Defaults of Blender 4.5, with nothing left out of the scene. Cables are modelled as in standard pictures."""

BLENDERPROC = Rendering(
    PictureSettings(
        cycles=BLENDER.settings.cycles.model_copy(
            update={"samples": 1024, "bounces": 3, "diffuse_bounces": 3, "glossy_bounces": 0}
        ),
        economy=REFERENCE.economy,
    ),
    more={**_AUTOMATIC, "transparent_max_bounces": 8, "transmission_bounces": 0, "volume_bounces": 0},
)
"""Defaults of BlenderProc, on all cores; what it leaves alone is Blender's default.

BlenderProc denoises with Blender's Denoise node, which uses the same Open Image Denoise at the same quality as Cycles.
"""
