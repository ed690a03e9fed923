"""The things that the farm leaves out, each with two ways to make a picture: without it, and with it after all."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import bpy
import cv2
import numpy as np
from numpy.typing import NDArray

from benchmarks.physics.scenes import DRAWN_CABLES, crowd
from benchmarks.render.stage_set import SettledScene, Stage
from blend import names
from farm.dataset.formats import PNG
from farm.scene.scene import Scene
from farm.spec.category import Background, Category, Light
from farm.spec.header import DatasetHeader
from farm.spec.job import Job
from farm.spec.rendering import Economy, PictureSettings
from worker.blender.asset_files import AssetLibrary
from worker.blender.floor import set_floor
from worker.blender.image_cache import ImageCache
from worker.sample.scene import sample_scene
from worker.simulate.rod.fall import rods_of, surroundings_of
from worker.simulate.rod.simulation import RodSimulation
from worker.simulate.simulate import simulate

Action = Callable[[], NDArray[np.uint8] | None]
"""The work that is timed; it returns the picture if it makes one."""

PUBLISHED_S = 4.0
"""Seconds that the 100 frames of the published fall last."""

BLENDER_COMPRESSION = 15
"""Blender's default compression of PNG files, in percent."""

_BREATH_M_S = 1e-9
"""Speed of a wind that is computed and moves nothing."""


@dataclass(frozen=True, slots=True)
class Skip:
    """A thing that the farm leaves out of a picture.

    Attributes:
        name: the thing, in words.
        stages: stages of the picture that are timed.
        categories: categories whose pictures do without it.
        same_picture: whether a picture with the thing must be the same to the byte as one without it.
        prepare: function that makes the action to time, from a settled scene and whether the thing is left out.
    """

    name: str
    stages: str
    categories: tuple[Category, ...]
    same_picture: bool
    prepare: Callable[[SettledScene, bool], Action]


FLOORS = tuple(category for category in Category if category.traits.background is Background.FLOOR)
FAR = tuple(category for category in Category if category.traits.background is Background.HDRI)
LAMPS = tuple(category for category in FLOORS if category.traits.light is not Light.DISTRIBUTED)
HDRI_FLOORS = tuple(category for category in FLOORS if category.traits.light is Light.DISTRIBUTED)
ALL = tuple(Category)

_ECONOMIES = {
    "cables_in_view": ("cables out of view", ALL, False),
    "texture_window": ("texels out of view, or finer than it shows", FLOORS, False),
    "keep_loaded": ("reading textures and HDRIs again", ALL, True),
    "backdrop": ("paths to what is behind the cables", FAR, False),
}


class Skips:
    """All things that are left out of the benchmark's scenes.

    Args:
        stage: the open renderer.
        header: header of the scenes.
        crowded: the same header with as many cables in each scene as can be drawn.
    """

    def __init__(self, stage: Stage, header: DatasetHeader, crowded: DatasetHeader) -> None:
        self._stage, self._header, self._crowded = stage, header, crowded
        self._library, self._image_cache = AssetLibrary(header, None), ImageCache()

    def all(self) -> Iterator[Skip]:
        """Everything that is left out, in the order of a picture's stages."""
        yield Skip("cables that are not shown", "simulate", ALL, False, self._unshown_cables)
        yield Skip("the fall after the cables rest", "simulate", ALL, False, self._rest)
        yield Skip("wind where it is still", "simulate", ALL, False, self._wind)
        for field, (name, categories, same) in _ECONOMIES.items():
            yield Skip(name, "realize, render", categories, same, self._economy(field))
        yield Skip("a floor's textures in far pictures", "realize, render", FAR, False, self._floor)
        yield Skip("the HDRI under a lamp", "realize, render", LAMPS, True, self._hdri)
        yield Skip("an HDRI's lower half and finest texels", "realize, render", HDRI_FLOORS, False, self._world)
        yield Skip("compression of Blender's file", "realize, render", LAMPS, True, self._blender_file)
        yield Skip("undo steps", "realize, render", ALL, True, self._undo)
        yield Skip("zlib's level 6", "write", ALL, False, self._zlib)

    def _settings(self, settled: SettledScene) -> PictureSettings:
        return self._header.rendering[settled.job.category].settings

    def _unshown_cables(self, settled: SettledScene, skipped: bool) -> Action:
        job = settled.job
        return self._fall(settled.scene if skipped else crowd(self._crowded, job.category, job.index, DRAWN_CABLES))

    def _rest(self, settled: SettledScene, skipped: bool) -> Action:
        if skipped:
            return self._fall(settled.scene)
        fall = self._header.spec.fall.rod

        def play() -> None:
            rods, surroundings = rods_of(settled.scene, fall), surroundings_of(settled.scene)
            simulation = RodSimulation(rods, surroundings, steps_per_s=fall.steps_per_s)
            simulation.advance(round(PUBLISHED_S * fall.steps_per_s))

        return play

    def _wind(self, settled: SettledScene, skipped: bool) -> Action:
        wind = settled.scene.wind.model_copy(update={"speed_m_s": 0.0 if skipped else _BREATH_M_S})
        return self._fall(settled.scene.model_copy(update={"wind": wind}))

    def _fall(self, scene: Scene) -> Action:
        def play() -> None:
            simulate(scene, self._header.spec.simulator, self._header.spec.fall)

        return play

    def _economy(self, field: str) -> Callable[[SettledScene, bool], Action]:
        def prepare(settled: SettledScene, skipped: bool) -> Action:
            economy = Economy().model_copy(update={field: skipped})
            settings = self._settings(settled).model_copy(update={"economy": economy})
            return lambda: self._picture(settled, settings)

        return prepare

    def _floor(self, settled: SettledScene, skipped: bool) -> Action:
        job = Job(category=FLOORS[0], index=settled.job.index)
        floor = sample_scene(self._header, job, 0).floor

        def make() -> NDArray[np.uint8]:
            self._stage.set(settled, self._settings(settled))
            if not skipped and floor is not None:
                set_floor(floor, self._library.surface(floor.texture), self._image_cache, None)
                bpy.data.objects[names.FLOOR].visible_camera = False
            return self._stage.render()

        return make

    def _hdri(self, settled: SettledScene, skipped: bool) -> Action:
        hdri = next(hdri.name for hdri in self._header.hdris if hdri.backdrop)

        def make() -> NDArray[np.uint8]:
            self._stage.set(settled, self._settings(settled))
            if not skipped:
                self._image_cache.forget()
                image = self._image_cache.panorama(self._library.hdri(hdri))
                bpy.data.worlds[names.WORLD].node_tree.nodes[names.WORLD_IMAGE].image = image
            return self._stage.render()

        return make

    def _world(self, settled: SettledScene, skipped: bool) -> Action:
        settings = self._settings(settled)
        if not skipped:
            # A finer HDRI needs Cycles' own importance map, or small bright suns show as white specks in the picture.
            cycles = settings.cycles.model_copy(update={"world_map_px": 0})
            economy = settings.economy.model_copy(update={"upper_world": False})
            settings = settings.model_copy(update={"cycles": cycles, "economy": economy})
        return lambda: self._picture(settled, settings)

    def _blender_file(self, settled: SettledScene, skipped: bool) -> Action:
        def make() -> NDArray[np.uint8]:
            self._stage.set(settled, self._settings(settled))
            image = bpy.data.scenes[names.PICTURE_SCENE].render.image_settings
            image.compression = 0 if skipped else BLENDER_COMPRESSION
            return self._stage.render()

        return make

    def _undo(self, settled: SettledScene, skipped: bool) -> Action:
        def make() -> NDArray[np.uint8]:
            bpy.context.preferences.edit.use_global_undo = not skipped
            try:
                return self._picture(settled, self._settings(settled))
            finally:
                bpy.context.preferences.edit.use_global_undo = False

        return make

    def _zlib(self, settled: SettledScene, skipped: bool) -> Action:
        picture = self._picture(settled, self._settings(settled))

        def encode() -> None:
            if skipped:
                PNG.encode(picture)
            else:
                cv2.imencode(".png", picture[:, :, ::-1], [cv2.IMWRITE_PNG_COMPRESSION, 6])

        return encode

    def _picture(self, settled: SettledScene, settings: PictureSettings) -> NDArray[np.uint8]:
        self._stage.set(settled, settings)
        return self._stage.render()
