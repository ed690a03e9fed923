"""The scenarios' farm with real Blender workers: tiny pictures, and its own texture, so that nothing need be baked."""

import importlib.util
from pathlib import Path

import cv2
import numpy as np

from farm.cli.installed_assets import InstalledAssets
from farm.local.workers import WORKER_COMMAND
from farm.spec.header import DatasetHeader
from farm.spec.make_header import make_header
from farm.spec.parse import describe
from farm.spec.quality import Preset
from tests.chaos.expected import Expected
from tests.chaos.farm_under_test import Plan
from tests.chaos.judge import Claims
from tests.chaos.scenarios import Scenario

_RESOLUTION = 96


def blender_is_there() -> bool:
    """Whether Blender can be imported; this doesn't import it."""
    return importlib.util.find_spec("bpy") is not None


def tiny_header(images: int, seed: int, folder: Path) -> DatasetHeader:
    """Make a header of a dataset of all categories.

    Args:
        images: number of images in all.
        seed: seed of the dataset.
        folder: folder that receives the texture.
    """
    folder.mkdir(parents=True, exist_ok=True)
    rng = np.random.default_rng(0)
    cv2.imwrite(str(folder / "speckle_1k_color.png"), rng.integers(60, 200, (64, 64, 3), dtype=np.uint8))
    cv2.imwrite(str(folder / "speckle_1k_roughness.png"), np.full((64, 64), 150, np.uint8))
    flags = {"images": images, "seed": seed, "resolution": _RESOLUTION, "quality": Preset.DRAFT}
    description = describe(None, flags, {"textures": (folder,), "builtin_textures": False, "environments": False})
    return make_header(description.spec, description.inputs, InstalledAssets())


def for_blender(scenario: Scenario, header: DatasetHeader, expected: Expected) -> tuple[Plan, Claims]:
    """The plan of the farm with Blender workers, and the claims on its end."""
    return Plan(scenario.name, header, WORKER_COMMAND, scenario.workers), Claims(expected)
