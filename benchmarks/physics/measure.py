"""Play scenes at a setting, and time the fall alone."""

import time
from collections.abc import Sequence

import numpy as np

from benchmarks.physics import published_cloth
from benchmarks.physics.contenders import Contender
from benchmarks.physics.rows import Played
from benchmarks.physics.settings import Setting
from farm.errors import SceneError
from farm.scene.scene import Scene
from worker.simulate.checks.measure import measure
from worker.simulate.shapes import CableShapes
from worker.simulate.simulate import simulate


def play(setting: Setting, scenes: Sequence[Scene]) -> tuple[Played, ...]:
    """Let the cables of the scenes fall, one scene after the other."""
    return tuple(_play(setting, scene) for scene in scenes)


def warm_up(settings: Sequence[Setting], scene: Scene) -> None:
    """Let a scene fall by each contender, so that none loads or compiles anything when it is timed."""
    for contender in dict.fromkeys(setting.contender for setting in settings):
        if contender is not Contender.CLOTH_PUBLISHED:  # the other cloth loads all that it needs
            _play(next(setting for setting in settings if setting.contender is contender), scene)


def _play(setting: Setting, scene: Scene) -> Played:
    start = time.process_time()
    try:
        shapes = _let_fall(scene, setting)
    except SceneError as error:
        return Played(time.process_time() - start, 0.0, 0, None, str(error))
    cpu_s = time.process_time() - start
    if not _is_finite(shapes):
        return Played(cpu_s, shapes.fall_s, shapes.steps, None, "the cables' places or speeds are not finite")
    return Played(cpu_s, shapes.fall_s, shapes.steps, measure(shapes))


def _let_fall(scene: Scene, setting: Setting) -> CableShapes:
    if setting.contender is Contender.CLOTH_PUBLISHED:
        return published_cloth.drop_cables(scene, setting.fall.cloth)
    return simulate(scene, setting.contender.simulator, setting.fall)


def _is_finite(shapes: CableShapes) -> bool:
    return all(bool(np.isfinite(each).all()) for each in (*shapes.nodes_m, *shapes.speeds_m_s))
