"""The fixed scenes that the rendering benchmarks share, settled once, and the open template that shows them."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from blend.build import TEMPLATE
from blend.contract import open_template
from farm.errors import RenderError
from farm.scene.scene import Scene
from farm.spec.category import Category
from farm.spec.header import DatasetHeader
from farm.spec.job import Job
from farm.spec.rendering import PictureSettings
from worker.backdrop.matte import Backdrop
from worker.blender.asset_files import AssetLibrary
from worker.blender.build_scene import build_scene
from worker.blender.image_cache import ImageCache
from worker.blender.render import configure_cycles, configure_picture, render_scene
from worker.sample.scene import sample_scene
from worker.simulate.shapes import CableShapes
from worker.simulate.simulate import simulate


@dataclass(frozen=True, slots=True)
class SettledScene:
    """A scene of a job's first attempt, with its cables at rest."""

    job: Job
    scene: Scene
    shapes: CableShapes


def settle(header: DatasetHeader, categories: tuple[Category, ...], count: int) -> Iterator[SettledScene]:
    """Let the cables of `count` scenes of each category fall, the categories taking turns."""
    for index in range(count):
        for category in categories:
            job = Job(category=category, index=index)
            scene = sample_scene(header, job, 0)
            yield SettledScene(job, scene, simulate(scene, header.spec.simulator, header.spec.fall))


class Stage:
    """The farm's template, open, with the assets that a header names."""

    def __init__(self, header: DatasetHeader, resolution: int) -> None:
        """Open the template in this process.

        Args:
            header: header that names the assets.
            resolution: edge of a picture, pixels, unless `set` says otherwise.
        """
        open_template(TEMPLATE)
        self._library = AssetLibrary(header, None)
        self._image_cache = ImageCache()
        self._resolution = resolution
        self._behind: Backdrop | None = None
        self._scene: Scene | None = None

    def set(
        self,
        settled: SettledScene,
        settings: PictureSettings,
        *,
        threads: int = 0,
        seed: int | None = None,
        resolution: int | None = None,
        share: float = 1.0,
    ) -> None:
        """Build a scene and configure its render on the CPU.

        Args:
            settled: the scene.
            settings: settings of the picture.
            threads: number of threads; 0 for all cores.
            seed: seed of the sampling; None for the scene's own.
            resolution: edge of the picture, pixels; None for the stage's own.
            share: share of the picture's edge to render, around its middle.
        """
        resolution = resolution or self._resolution
        self._scene = settled.scene
        self._behind = build_scene(
            settled.scene,
            settled.shapes,
            self._library,
            self._image_cache,
            traits=settled.job.category.traits,
            resolution=resolution,
            detail=settings.detail,
            economy=settings.economy,
        )
        scene = configure_picture(resolution, threads)
        configure_cycles(scene, settings, "cpu", settled.scene.render_seed if seed is None else seed)
        render = scene.render
        render.use_border = render.use_crop_to_border = share < 1.0
        render.border_min_x = render.border_min_y = 0.5 - share / 2
        render.border_max_x = render.border_max_y = 0.5 + share / 2

    def render(self) -> NDArray[np.uint8]:
        """Render the scene that was set, and return the picture, (H, W, 3).

        Raises:
            RenderError: if no scene was set.
        """
        if self._scene is None:
            raise RenderError("nothing is set to be rendered")
        return render_scene(self._scene, self._behind)
