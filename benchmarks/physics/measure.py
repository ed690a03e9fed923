"""Play scenes at a setting, and time the fall alone."""

import time
from collections.abc import Sequence

import numpy as np

from benchmarks.physics.rows import Played
from benchmarks.physics.settings import Setting
from farm.errors import SceneError
from farm.scene.scene import Scene
from farm.spec.simulation import Simulator
from worker.simulate.checks.measure import measure
from worker.simulate.shapes import CableShapes
from worker.simulate.simulate import simulate


def play(setting: Setting, scenes: Sequence[Scene]) -> tuple[Played, ...]:
    """Let the cables of the scenes fall, one scene after the other."""
    return tuple(_play(setting, scene) for scene in scenes)


def warm_up(settings: Sequence[Setting], scene: Scene) -> None:
    """Play a scene with each simulator, so that none loads or compiles anything while it is timed."""
    for simulator in dict.fromkeys(setting.simulator for setting in settings):
        if simulator is not Simulator.CLOTH_PUBLISHED:  # all of it is loaded by the other cloth
            _play(next(setting for setting in settings if setting.simulator is simulator), scene)


def _play(setting: Setting, scene: Scene) -> Played:
    start = time.process_time()
    try:
        shapes = simulate(scene, setting.simulator, setting.fall)
    except SceneError as error:
        return Played(time.process_time() - start, 0.0, 0, None, str(error))
    cpu_s = time.process_time() - start
    if not _is_finite(shapes):
        return Played(cpu_s, shapes.fall_s, shapes.steps, None, "the cables' places or speeds are not finite")
    return Played(cpu_s, shapes.fall_s, shapes.steps, measure(shapes))


def _is_finite(shapes: CableShapes) -> bool:
    return all(bool(np.isfinite(each).all()) for each in (*shapes.nodes_m, *shapes.speeds_m_s))
