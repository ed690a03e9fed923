"""The fall: cables dropped as strips of cloth in one joined, self-colliding mesh, until they rest."""

import itertools
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from blend import names
from blend.fall import SELF_DISTANCE
from farm.errors import SceneError
from farm.fall import ClothFall
from farm.scene import Cable, Scene, Wind
from worker.check import MAX_SPEED_MM_S, MAX_SPEED_RMS_MM_S
from worker.cloth.scale import GRAVITY, RADIUS_UNITS, FallScale
from worker.cloth.strip import centreline, zigzag, zigzag_faces
from worker.shapes import CableShapes, Points, bent_rod

SEGMENT_RADII = 5.0
"""Length of a strip's segment over the cable's radius."""

STRIP_WIDTH = 0.08
"""Width of a strip, in the fall's units; narrower than the cable, so that it turns over like a round one."""

FLOOR_SINK = 0.006
"""How far a loaded strip sinks into the floor's collision layer, in units, as measured at crossings of two cables: a
cable alone rests so much above the floor, a loaded one on it."""

WIND_GAIN = 2.0
"""From the published strength to this scale's: the strongest wind shifts cables by millimetres, yet friction holds
them once they lie (at twice the gain they slide along the floor for ever)."""

REST_FRAMES = 3
"""Cables rest when they are slower than `worker.check` asks for, over so many frames."""


@dataclass(frozen=True, slots=True)
class _Strips:
    """The joined mesh, in the fall's units, and which vertices belong to which cable."""

    vertices: Points
    faces: list[tuple[int, int, int]]
    slices: tuple[slice, ...]


def drop_cables(scene: Scene, fall: ClothFall) -> CableShapes:
    """Let the cables of `scene` fall in the open template's scene of the fall.

    Raises:
        SceneError: if the solver diverges.
    """
    radii = np.array([cable.diameter_m / 2 for cable in scene.cables])
    scale = FallScale.for_radius(float(radii.max()))
    strips = _join([_strip(cable, scale) for cable in scene.cables])
    fall_scene = bpy.data.scenes[names.FALL_SCENE]
    _prepare(fall_scene, strips, scene, fall)
    vertices, speeds, frames = _step_until_rest(fall_scene, strips, fall, scale)
    return CableShapes(
        nodes_m=tuple(centreline(vertices[part]) * scale.unit_m for part in strips.slices),
        radii_m=radii,
        lengths_m=np.array([_length(centreline(strips.vertices[part])) * scale.unit_m for part in strips.slices]),
        speeds_m_s=tuple(speeds[part] for part in strips.slices),
        start_order=tuple(int(k) for k in np.argsort([cable.start_height_m for cable in scene.cables])),
        fall_s=frames * scale.frame_s,
        steps=frames,
    )


def _length(path: Points) -> float:
    return float(np.linalg.norm(np.diff(path, axis=0), axis=1).sum())


def _strip(cable: Cable, scale: FallScale) -> Points:
    radius_m = cable.diameter_m / 2
    segments = int(np.clip(round(cable.length_m / (SEGMENT_RADII * radius_m)), 8, 400))
    level = bent_rod(cable.length_m, cable.bends_per_m, segments + 1)
    turn = np.radians(cable.rotation_deg)
    cosine, sine = np.cos(turn), np.sin(turn)
    path = np.empty((len(level), 3))
    path[:, 0] = cable.x_m + cosine * level[:, 0] - sine * level[:, 1]
    path[:, 1] = cable.y_m + sine * level[:, 0] + cosine * level[:, 1]
    path[:, 2] = radius_m + cable.start_height_m
    return zigzag(path / scale.unit_m, STRIP_WIDTH)


def _join(strips: list[Points]) -> _Strips:
    starts = np.concatenate([[0], np.cumsum([len(strip) for strip in strips])])
    return _Strips(
        vertices=np.concatenate(strips),
        faces=[
            face
            for strip, start in zip(strips, starts[:-1], strict=True)
            for face in zigzag_faces(len(strip), int(start))
        ],
        slices=tuple(slice(int(a), int(b)) for a, b in itertools.pairwise(starts)),
    )


def _prepare(fall_scene: Any, strips: _Strips, scene: Scene, fall: ClothFall) -> None:
    cables = bpy.data.objects[names.FALL_CABLES]
    cables.data.clear_geometry()
    cables.data.from_pydata(strips.vertices.tolist(), [], strips.faces)
    cloth = next(modifier for modifier in cables.modifiers if modifier.type == "CLOTH")
    cloth.settings.quality = fall.quality
    cloth.settings.mass = scene.vertex_mass
    cloth.settings.effector_weights.wind = 1.0 if scene.wind.strength > 0 else 0.0
    fall_scene.use_gravity = True
    fall_scene.gravity = (0.0, 0.0, -GRAVITY)
    collision = cloth.collision_settings
    collision.collision_quality = fall.collision_quality
    collision.use_self_collision = len(strips.slices) > 1
    collision.self_distance_min = SELF_DISTANCE
    floor = bpy.data.objects[names.FALL_FLOOR]
    floor.collision.thickness_outer = RADIUS_UNITS - collision.distance_min + FLOOR_SINK
    cloth.point_cache.frame_start = 1
    cloth.point_cache.frame_end = fall.max_frames
    fall_scene.frame_end = fall.max_frames
    _set_wind(bpy.data.objects[names.FALL_WIND], scene.wind)


def _set_wind(wind_object: Any, wind: Wind) -> None:
    """Stand the field off to a side, blowing towards the cables; its axis is its local z."""
    bearing = np.radians(wind.bearing_deg)
    wind_object.location = (wind.distance * np.cos(bearing), wind.distance * np.sin(bearing), wind.height)
    wind_object.rotation_euler = (0.0, -np.radians(wind.tilt_deg), bearing)
    wind_object.field.strength = WIND_GAIN * wind.strength
    wind_object.field.flow = WIND_GAIN * wind.flow


def _step_until_rest(
    fall_scene: Any, strips: _Strips, fall: ClothFall, scale: FallScale
) -> tuple[Points, NDArray[np.float64], int]:
    previous = strips.vertices
    quiet = 0
    speeds = np.zeros(len(previous))
    # A skipped frame would multiply the time step, so every one is visited in turn.
    for frame in range(1, fall.max_frames + 1):
        fall_scene.frame_set(frame)
        vertices = _evaluated_vertices(fall_scene)
        if not np.isfinite(vertices).all():
            raise SceneError(f"the cloth diverged at frame {frame}")
        speeds = np.linalg.norm(vertices - previous, axis=1) * scale.unit_m / scale.frame_s
        previous = vertices
        still = 1000 * np.sqrt(np.mean(speeds**2)) <= MAX_SPEED_RMS_MM_S and 1000 * speeds.max() <= MAX_SPEED_MM_S
        quiet = quiet + 1 if still and frame > REST_FRAMES else 0
        if quiet >= REST_FRAMES:
            break
    return previous, speeds, frame


def _evaluated_vertices(fall_scene: Any) -> Points:
    depsgraph = fall_scene.view_layers[0].depsgraph
    mesh = bpy.data.objects[names.FALL_CABLES].evaluated_get(depsgraph).data
    flat = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", flat)
    return flat.reshape(-1, 3).astype(np.float64)
