"""A scene of Blender's that exists only while cloth moves in it, and how cloth is stepped and read."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bpy
import numpy as np

from worker.curves import Points
from worker.simulate.cloth.scale import GRAVITY


@contextmanager
def temporary_scene() -> Iterator[Any]:
    """Make an empty scene with gravity; at the end, remove it and every object and mesh that was added to it."""
    scene = bpy.data.scenes.new("temporary")
    scene.use_gravity = True
    scene.gravity = (0.0, 0.0, -GRAVITY)
    try:
        yield scene
    finally:
        objects = list(scene.collection.objects)
        meshes = [each.data for each in objects if each.data is not None]
        bpy.data.scenes.remove(scene)
        bpy.data.batch_remove([*objects, *meshes])


def modifier(thing: Any, kind: str) -> Any:
    """The first modifier of a kind, such as "CLOTH", of an object that has one."""
    return next(each for each in thing.modifiers if each.type == kind)


def set_frames(scene: Any, cloth: Any, frames: int) -> None:
    """Let the scene and the cache of a Cloth modifier in it run from frame 1 to `frames`."""
    cloth.point_cache.frame_start = 1
    cloth.point_cache.frame_end = frames
    scene.frame_end = frames


def read_vertices(scene: Any, thing: Any) -> Points:
    """Vertices (N, 3) of an object as evaluated at the scene's frame, in its own coordinates."""
    mesh = thing.evaluated_get(scene.view_layers[0].depsgraph).data
    flat = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", flat)
    return flat.reshape(-1, 3).astype(np.float64)
