"""The fixed scenes that the rendering benchmarks share, settled once, and the open template that shows them."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from blend import names
from farm.errors import RenderError
from farm.run.worker_settings import DeviceChoice, RendererSettings
from farm.scene.picture_size import PictureSize
from farm.scene.scene import Scene
from farm.spec.category import Category
from farm.spec.header import DatasetHeader
from farm.spec.job import Job
from farm.spec.rendering import CableDetail, PictureSettings
from worker.blender.build_scene import BuiltScene
from worker.blender.renderer import open_renderer
from worker.geometry import SettledGeometry
from worker.sample.scene import sample_scene
from worker.simulate.shapes import CableShapes
from worker.simulate.simulate import simulate


@dataclass(frozen=True, slots=True)
class SettledScene:
    """A scene of a job's first attempt, with its cables at rest."""

    job: Job
    scene: Scene
    shapes: CableShapes

    def geometry(self, detail: CableDetail, resolution: int) -> SettledGeometry:
        """Its geometry in a picture of some detail and resolution."""
        return SettledGeometry(self.scene, self.shapes, detail, PictureSize.square(resolution))


def settle(header: DatasetHeader, categories: tuple[Category, ...], count: int) -> Iterator[SettledScene]:
    """Let the cables of `count` scenes of each category fall, the categories taking turns."""
    for index in range(count):
        for category in categories:
            job = Job(category=category, index=index)
            scene = sample_scene(header, job, 0)
            yield SettledScene(job, scene, simulate(scene, header.spec.simulator, header.spec.fall))


class Stage:
    """The farm's renderer on the CPU, with one scene at a time built in it."""

    def __init__(self, header: DatasetHeader, resolution: int) -> None:
        """Open the template that a header names, with the header's assets, in this process."""
        self._renderer = open_renderer(header, RendererSettings(device=DeviceChoice.CPU))
        self._resolution = resolution
        self._set: tuple[SettledGeometry, BuiltScene] | None = None

    def set(
        self,
        settled: SettledScene,
        settings: PictureSettings,
        *,
        seed: int | None = None,
        resolution: int | None = None,
        share: float = 1.0,
    ) -> None:
        """Build a scene and set how it renders.

        Args:
            settled: the scene.
            settings: all settings of the picture.
            seed: number that starts the sampling pattern; None for the scene's own.
            resolution: pixels along an edge; None for the stage's.
            share: share of the picture's edge that is rendered, about its middle.
        """
        resolution = resolution or self._resolution
        geometry = settled.geometry(settings.detail, resolution)
        self._set = geometry, self._renderer.build(geometry, settings.economy)
        self._renderer.use_cycles(
            settings, PictureSize.square(resolution), settled.scene.render_seed if seed is None else seed
        )
        render = bpy.data.scenes[names.PICTURE_SCENE].render
        render.use_border = render.use_crop_to_border = share < 1.0
        render.border_min_x = render.border_min_y = 0.5 - share / 2
        render.border_max_x = render.border_max_y = 0.5 + share / 2

    def render(self) -> NDArray[np.uint8]:
        """The picture (H, W, 3) as set.

        Raises:
            RenderError: if nothing is set, or Blender gives no picture.
        """
        _, built = self._what_is_set()
        return self._renderer.render(built)

    def label(self) -> dict[str, Any]:
        """The labels of the scene as set, by role.

        Raises:
            RenderError: if nothing is set.
        """
        geometry, _ = self._what_is_set()
        return self._renderer.label(geometry)

    def _what_is_set(self) -> tuple[SettledGeometry, BuiltScene]:
        if self._set is None:
            raise RenderError("no scene is set")
        return self._set
