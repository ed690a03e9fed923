"""The renderer: an open template in this process that makes one picture after another.

A picture's steps are methods (settle, build, render, label), so that a benchmark or test of one step calls the
code that makes pictures.
"""

import time
from collections.abc import Iterable
from importlib.metadata import version
from typing import Any

import bpy
import cv2
import numpy as np
from numpy.typing import NDArray

from blend.build import TEMPLATE
from blend.contract import open_template
from blend.devices import choose_device
from farm.dataset.manifest import RejectedAttempt, RenderSettings
from farm.dataset.outputs import IMAGE, OUTPUTS, Output, outputs_of
from farm.errors import SpecError
from farm.run.worker_settings import RendererSettings
from farm.scene.scene import Scene
from farm.spec.category import Category
from farm.spec.dataset_spec import DatasetSpec, Engine
from farm.spec.header import DatasetHeader, FileRef
from farm.spec.job import Job
from farm.spec.quality import ChosenSettings, Quality
from farm.spec.rendering import Economy, PictureSettings
from worker.blender import eevee
from worker.blender.asset_files import AssetLibrary, checked
from worker.blender.build_scene import BuiltScene, build_scene
from worker.blender.image_cache import ImageCache
from worker.blender.render import configure_cycles, configure_eevee, configure_picture, render_scene
from worker.geometry import SettledGeometry
from worker.label.makers import make_labels
from worker.sample.scene import sample_scene
from worker.service.picture import Picture
from worker.simulate.settle import MeasuredFall, settle
from worker.simulate.simulate import simulate
from worker.stopwatch import Stopwatch


def open_renderer(header: DatasetHeader, settings: RendererSettings) -> "BlenderRenderer":
    """Open the dataset's template in this process and make it ready.

    Args:
        header: the dataset's header, which names the template and the assets.
        settings: device, threads, and folder of the baked surfaces.

    Raises:
        TemplateError: if the template can't be opened, lacks something, or has changed since the dataset's start.
        AssetError: if the template's file can't be read.
        MachineError: if there is no such device.
    """
    return BlenderRenderer(header, AssetLibrary(header, settings.assets), settings)


class BlenderRenderer:
    """Blender with a dataset's template open.

    There is one for a process: opening another replaces the template.
    """

    def __init__(self, header: DatasetHeader, library: AssetLibrary, settings: RendererSettings) -> None:
        """Open the template; see `open_renderer`."""
        start = time.perf_counter()
        path = header.template.path or str(TEMPLATE)
        open_template(checked(FileRef(path=path, sha256=header.template.sha256)))
        # Undo steps and autosaves are of no use here and cost time and memory.
        bpy.context.preferences.edit.use_global_undo = False
        bpy.context.preferences.filepaths.use_auto_save_temporary_files = False
        self._device = choose_device(settings.device)
        self._threads = settings.threads
        cv2.setNumThreads(settings.threads or -1)
        self._library = library
        self._image_cache = ImageCache()
        self._header = header
        self._open_s = time.perf_counter() - start

    def make(self, job: Job, header: DatasetHeader) -> Picture:
        """Make one picture; see `worker.service.picture.Renderer`.

        Raises:
            SpecError: if the header does not say how the category is rendered.
            SceneError: if no drawn scene passes the checks.
            AssetError: if a texture or HDRI can't be had.
            RenderError: if Blender gives no picture.
        """
        if header != self._header:
            raise ValueError("this renderer was opened for another dataset")
        watch = Stopwatch()  # its stages have the names that manifests hold
        # Opening is paid once, by the first picture of the process.
        watch.stages_s["open"], self._open_s = self._open_s, 0.0
        spec, chosen = header.spec, _chosen_settings(header, job.category)
        fall, rejected = self.settle(job, header, watch)
        geometry = SettledGeometry(fall.scene, fall.shapes, chosen.settings.detail, spec.resolution)
        with watch.stage("realize"):
            built = self.build(geometry, chosen.settings.economy)
            rendering = self._configure(spec, chosen, fall.scene)
        with watch.stage("render"):
            image = self.render(built)
        with watch.stage("mask"):
            labels = self.label(geometry, outputs_of(spec))
        return Picture(
            files={IMAGE.role: image, **labels},
            scene=fall.scene,
            settled=fall.figures,
            rejected=rejected,
            render=rendering,
            timings_s=watch.stages_s,
            versions=_versions(),
        )

    def settle(
        self, job: Job, header: DatasetHeader, watch: Stopwatch
    ) -> tuple[MeasuredFall, tuple[RejectedAttempt, ...]]:
        """Draw scenes of a job and let them fall until one may be shipped; see `worker.simulate.settle.settle`.

        Raises:
            SceneError: if no drawn scene passes the checks.
        """
        return settle(
            job,
            lambda attempt: sample_scene(header, job, attempt),
            lambda scene: simulate(scene, header.spec.simulator, header.spec.fall),
            header.spec.fall.max_attempts,
            watch,
        )

    def build(self, geometry: SettledGeometry, economy: Economy) -> BuiltScene:
        """Set the template's picture to a settled scene; see `worker.blender.build_scene.build_scene`.

        Raises:
            AssetError: if a texture or HDRI can't be had.
        """
        return build_scene(geometry, self._library, self._image_cache, economy)

    def use_cycles(self, settings: PictureSettings, resolution: int, seed: int) -> None:
        """Let the next renders be Cycles'.

        Args:
            settings: all of its settings.
            resolution: pixels along an edge.
            seed: number that starts the sampling pattern.
        """
        configure_cycles(configure_picture(resolution, self._threads), settings, self._device, seed)

    def use_eevee(self, quality: Quality, resolution: int) -> None:
        """Let the next renders be Eevee's."""
        configure_eevee(configure_picture(resolution, self._threads), eevee.samples_of(quality))

    def render(self, built: BuiltScene) -> NDArray[np.uint8]:
        """Render a scene that `build` has set, by the engine that was chosen after it: (H, W, 3) sRGB.

        Raises:
            RenderError: if Blender gives no picture.
        """
        return render_scene(built)

    def label(self, geometry: SettledGeometry, outputs: Iterable[Output] = OUTPUTS) -> dict[str, Any]:
        """Make a settled scene's labels; see `worker.label.makers.make_labels`."""
        return make_labels(geometry, outputs)

    def _configure(self, spec: DatasetSpec, chosen: ChosenSettings, scene: Scene) -> RenderSettings:
        """Set how the scene renders; returns it for the manifest."""
        if spec.engine is Engine.EEVEE:
            self.use_eevee(spec.quality, spec.resolution)
            samples = eevee.samples_of(spec.quality)
            return RenderSettings(engine="eevee", device="opengl", resolution=spec.resolution, samples=samples)
        self.use_cycles(chosen.settings, spec.resolution, scene.render_seed)
        return RenderSettings(
            engine="cycles",
            device=self._device,
            resolution=spec.resolution,
            samples=chosen.settings.cycles.samples,
            settings=chosen.settings,
            # The calibration's pictures are not developed.
            expected_flip=chosen.expected_flip if scene.development is None else None,
        )


def _chosen_settings(header: DatasetHeader, category: Category) -> ChosenSettings:
    if header.spec.engine is Engine.EEVEE:
        return eevee.CHOSEN
    if category not in header.rendering:
        raise SpecError(f"dataset.json does not say how {category} is rendered; submit a new dataset")
    return header.rendering[category]


def _versions() -> dict[str, str]:
    return {
        "farm": version("cable-farm"),
        "blender": bpy.app.version_string,
        "numpy": np.__version__,
        "scipy": version("scipy"),
        "numba": version("numba"),
        "opencv": version("opencv-contrib-python-headless"),
    }
