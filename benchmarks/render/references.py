"""Pictures almost free of noise, with nothing left out, to compare others with; rendered once and kept."""

import hashlib
from pathlib import Path

import bpy
import cv2
import numpy as np
import pydantic_core
from numpy.typing import NDArray

from benchmarks.render.stage_set import SettledScene, Stage
from farm.dataset.formats import PNG
from farm.errors import AssetError
from farm.machine import cache_folder
from farm.spec.header import DatasetHeader
from farm.spec.make_header import template_ref
from farm.spec.quality import REFERENCE

VERSION = 1
"""Version of the references. A change of how the farm shows scenes raises it, so that they are rendered again."""

SHARE = 0.5
"""Share of a picture's edge that its reference covers, about the middle, where cables are: a quarter of the time."""

SEED = 0x5EED
"""Seed of the references' sampling, which no scene has: they share no noise with what is compared."""


class References:
    """A folder of reference pictures, each named by everything that decides it."""

    def __init__(self, header: DatasetHeader, stage: Stage, resolution: int, folder: Path | None = None) -> None:
        """Prepare; nothing is read or rendered yet.

        Args:
            header: header of the scenes' dataset.
            stage: the open template.
            resolution: edge of a whole picture, pixels.
            folder: folder of the references; None for the farm's cache.
        """
        self._header, self._stage, self._resolution = header, stage, resolution
        self._folder = folder or cache_folder() / "references"

    def path(self, settled: SettledScene) -> Path:
        """The path of a scene's reference, whether or not it exists."""
        digest = hashlib.sha256()
        floor, world = settled.scene.floor, settled.scene.hdri_world
        content = {
            "scene": settled.scene,
            "version": VERSION,
            "samples": REFERENCE.cycles.samples,
            "resolution": self._resolution,
            "share": SHARE,
            "template": template_ref(None),
            "surfaces": [surface for surface in self._header.surfaces if floor and surface.name == floor.texture],
            "hdris": [hdri for hdri in self._header.hdris if world and hdri.name == world.hdri],
            "blender": bpy.app.version_string,
        }
        digest.update(pydantic_core.to_json(content))
        for nodes in settled.shapes.nodes_m:
            digest.update(np.ascontiguousarray(nodes).tobytes())
        return self._folder / f"{settled.job.id}-{digest.hexdigest()[:16]}.png"

    def picture(self, settled: SettledScene) -> NDArray[np.uint8]:
        """The middle of a scene's reference, (H, W, 3), rendered now if it doesn't exist yet.

        Raises:
            AssetError: if the file isn't a picture.
        """
        path = self.path(settled)
        if not path.exists():
            self._stage.set(settled, REFERENCE, seed=SEED, share=SHARE)
            path.parent.mkdir(parents=True, exist_ok=True)
            partial = path.with_suffix(".partial")
            partial.write_bytes(PNG.encode(self._stage.render()))
            partial.replace(path)
        pixels = cv2.imread(str(path), cv2.IMREAD_COLOR)
        if pixels is None:
            raise AssetError(f"{path}: can't be read as a picture; delete it, and it is rendered again")
        return np.ascontiguousarray(pixels[:, :, ::-1]).astype(np.uint8, copy=False)


def middle(picture: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """The part of a picture (H, W, 3) that its reference covers."""
    rows, columns = picture.shape[:2]
    top, left = round(rows * (1 - SHARE) / 2), round(columns * (1 - SHARE) / 2)
    return np.ascontiguousarray(picture[top : rows - top, left : columns - left])
