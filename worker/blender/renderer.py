"""An open template that makes picture after picture: the real maker, one a process."""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.metadata import version

import bpy
import cv2
import numpy as np

from blend.build import TEMPLATE
from blend.contract import open_template
from blend.devices import choose_device
from farm.dataset.manifest import RejectedAttempt, RenderSettings, SettleFigures
from farm.errors import SceneError, SpecError
from farm.scene.scene import Scene
from farm.spec.category import Category
from farm.spec.dataset_spec import DatasetSpec, Engine
from farm.spec.header import DatasetHeader, FileRef
from farm.spec.job import Job
from farm.spec.quality import ChosenSettings
from farm.spec.rendering import PictureSettings
from farm.worker_settings import RendererSettings
from worker.backdrop.matte import Backdrop
from worker.blender import eevee
from worker.blender.asset_files import AssetLibrary, checked
from worker.blender.build_scene import build_scene
from worker.blender.image_cache import ImageCache
from worker.blender.render import configure_cycles, configure_eevee, configure_picture, render_scene
from worker.label.label import label_scene
from worker.sample.scene import sample_scene
from worker.service.picture import Picture
from worker.simulate.checks.accept import find_fault
from worker.simulate.checks.measure import measure
from worker.simulate.shapes import CableShapes
from worker.simulate.simulate import simulate


def open_renderer(header: DatasetHeader, settings: RendererSettings) -> "BlenderRenderer":
    """Open the dataset's template in this process and make it ready.

    Args:
        header: names the template and the assets.
        settings: device, threads, and folder of the baked surfaces.

    Raises:
        TemplateError: if the template can't be opened, lacks something, or has changed since the dataset's start.
        AssetError: if the template's file can't be read.
        MachineError: if there is no such device.
    """
    return BlenderRenderer(header, settings)


class BlenderRenderer:
    """A Blender with the template open."""

    def __init__(self, header: DatasetHeader, settings: RendererSettings) -> None:
        """See `open_renderer`."""
        start = time.perf_counter()
        path = header.template.path or str(TEMPLATE)
        open_template(checked(FileRef(path=path, sha256=header.template.sha256)))
        # Undo steps and autosaves are of no use here and cost time and memory.
        bpy.context.preferences.edit.use_global_undo = False
        bpy.context.preferences.filepaths.use_auto_save_temporary_files = False
        self._device = choose_device(settings.device)
        self._threads = settings.threads
        cv2.setNumThreads(settings.threads or -1)
        self._library = AssetLibrary(header, settings.assets)
        self._image_cache = ImageCache()
        self._fingerprint = header.spec_sha256
        self._open_s = time.perf_counter() - start

    def make(self, job: Job, header: DatasetHeader) -> Picture:
        """Make one picture; see `worker.service.picture.Renderer`.

        Raises:
            SpecError: if the header does not say how the category is rendered.
            SceneError: if no drawn scene passed the checks.
            AssetError: if a texture or HDRI can't be had.
            RenderError: if Blender gives no picture.
        """
        if header.spec_sha256 != self._fingerprint:
            raise ValueError("this studio was opened for another dataset")
        # Opening is paid once, by the first picture of the process.
        timings = {"open": self._open_s, "randomize": 0.0, "simulate": 0.0, "check": 0.0}
        self._open_s = 0.0
        spec, chosen = header.spec, _chosen_settings(header, job.category)
        scene, shapes, settled, rejected = self._settle(job, header, timings)
        with _timed(timings, "realize"):
            behind = self._realize(job, spec, chosen.settings, scene, shapes)
            rendering = self._configure(spec, chosen, scene)
        with _timed(timings, "render"):
            image = render_scene(scene, behind)
        with _timed(timings, "mask"):
            labels = label_scene(scene, shapes, chosen.settings.detail, spec.resolution)
        return Picture(
            image=image,
            mask=labels.mask,
            instances=labels.instances,
            scene=scene,
            settled=settled,
            rejected=rejected,
            render=rendering,
            timings_s=timings,
            versions=_versions(),
        )

    def _realize(
        self, job: Job, spec: DatasetSpec, settings: PictureSettings, scene: Scene, shapes: CableShapes
    ) -> Backdrop | None:
        """Set the scene; returns what is behind it, if the renderer is to leave that out."""
        return build_scene(
            scene,
            shapes,
            self._library,
            self._image_cache,
            traits=job.category.traits,
            resolution=spec.resolution,
            detail=settings.detail,
            economy=settings.economy,
        )

    def _configure(self, spec: DatasetSpec, chosen: ChosenSettings, scene: Scene) -> RenderSettings:
        """Set how the scene renders; returns it for the manifest."""
        picture = configure_picture(spec.resolution, self._threads)
        if spec.engine is Engine.EEVEE:
            samples = eevee.samples_of(spec.quality)
            configure_eevee(picture, samples)
            return RenderSettings(engine="eevee", device="opengl", resolution=spec.resolution, samples=samples)
        configure_cycles(picture, chosen.settings, self._device, scene.render_seed)
        return RenderSettings(
            engine="cycles",
            device=self._device,
            resolution=spec.resolution,
            samples=chosen.settings.cycles.samples,
            settings=chosen.settings,
            # The calibration's pictures are not developed.
            expected_flip=chosen.expected_flip if scene.development is None else None,
        )

    @staticmethod
    def _settle(
        job: Job, header: DatasetHeader, timings: dict[str, float]
    ) -> tuple[Scene, CableShapes, SettleFigures, tuple[RejectedAttempt, ...]]:
        rejected: list[RejectedAttempt] = []
        for attempt in range(header.spec.fall.max_attempts):
            with _timed(timings, "randomize"):
                scene = sample_scene(header, job, attempt)
            try:
                with _timed(timings, "simulate"):
                    shapes = simulate(scene, header.spec.simulator, header.spec.fall)
            except SceneError as error:
                rejected.append(RejectedAttempt(attempt=attempt, reason=str(error)))
                continue
            with _timed(timings, "check"):
                settled = measure(shapes)
            fault = find_fault(settled)
            if fault is None:
                return scene, shapes, settled, tuple(rejected)
            rejected.append(RejectedAttempt(attempt=attempt, reason=fault))
        raise SceneError(
            f"{job.id}: none of {len(rejected)} drawn scenes passed the checks; the last: {rejected[-1].reason}"
        )


def _chosen_settings(header: DatasetHeader, category: Category) -> ChosenSettings:
    if header.spec.engine is Engine.EEVEE:
        return eevee.CHOSEN
    if category not in header.rendering:
        raise SpecError(f"dataset.json does not say how {category} is rendered; submit a new dataset")
    return header.rendering[category]


@contextmanager
def _timed(timings: dict[str, float], stage: str) -> Iterator[None]:
    """Add the seconds spent inside to a stage; they are told in the manifest and decide nothing."""
    start = time.perf_counter()
    try:
        yield
    finally:
        timings[stage] = timings.get(stage, 0.0) + time.perf_counter() - start


def _versions() -> dict[str, str]:
    return {
        "farm": version("cable-farm"),
        "blender": bpy.app.version_string,
        "numpy": np.__version__,
        "scipy": version("scipy"),
        "numba": version("numba"),
        "opencv": version("opencv-contrib-python-headless"),
    }
