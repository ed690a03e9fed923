"""The fall: cables dropped as strips of cloth in one joined, self-colliding mesh, until they rest."""

import itertools
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from blend.fall import SELF_DISTANCE, FallObjects, add_fall
from farm.errors import SceneError
from farm.scene.cable import Cable
from farm.scene.physics import Friction, Wind
from farm.scene.scene import Scene
from farm.spec.simulation import ClothFall
from worker.curves import Points
from worker.simulate.checks.accept import MAX_SPEED_MM_S, MAX_SPEED_RMS_MM_S
from worker.simulate.cloth.material import SEGMENT_UNITS, STRIP_WIDTH, StripMaterial, strip_material
from worker.simulate.cloth.scale import RADIUS_UNITS, FallScale
from worker.simulate.cloth.stage import modifier, read_vertices, set_frames, temporary_scene
from worker.simulate.cloth.strip import centreline, zigzag, zigzag_faces
from worker.simulate.shapes import CableShapes, start_nodes

FLOOR_SINK = 0.0115
"""Depth in units to which a loaded strip sinks into the floor's collision layer, measured at crossings of two cables: a
cable alone rests this much above the floor, a loaded one on it."""

WIND_GAIN = 2.0
"""Factor on the published strength of the wind at this scale: the strongest wind shifts cables by millimetres, yet
friction holds them once they lie (at twice the gain they slide along the floor for ever)."""

REST_FRAMES = 3
"""Frames in a row in which all cables must be slower than `worker.simulate.checks.accept` asks for, to count as
resting."""

_MOST_FRICTION = 80.0
"""Blender's greatest setting of friction, in hundredths of Coulomb's coefficient."""

_BENDING_GROUP = "bending"
_STRETCHING_GROUP = "stretching"


@dataclass(frozen=True, slots=True)
class _Strips:
    """The joined mesh, in the fall's units, and the vertices of each cable."""

    vertices: Points
    faces: list[tuple[int, int, int]]
    slices: tuple[slice, ...]


def drop_cables(scene: Scene, fall: ClothFall) -> CableShapes:
    """Let the cables of `scene` fall, in a scene of Blender's that exists only while they do.

    Args:
        scene: the drawn scene.
        fall: the cloth's settings.

    Raises:
        SceneError: if the solver diverges.
    """
    radii = np.array([cable.diameter_m / 2 for cable in scene.cables])
    scale = FallScale.for_radius(float(radii.max()))
    strips = _join([zigzag(start_line(cable, scale, SEGMENT_UNITS), STRIP_WIDTH) for cable in scene.cables])
    with temporary_scene() as fall_scene:
        objects = add_fall(fall_scene)
        _prepare(fall_scene, objects, strips, scene, fall)
        set_material(objects.cables, strips.slices, strip_material(scene, scale, fall))
        vertices, speeds, frames, rested = _step_until_rest(fall_scene, objects.cables, strips, fall, scale)
    return CableShapes(
        nodes_m=tuple(centreline(vertices[part]) * scale.unit_m for part in strips.slices),
        radii_m=radii,
        lengths_m=np.array([_length(centreline(strips.vertices[part])) * scale.unit_m for part in strips.slices]),
        speeds_m_s=tuple(speeds[part] for part in strips.slices),
        start_order=tuple(int(k) for k in np.argsort([cable.start_height_m for cable in scene.cables])),
        fall_s=frames * scale.frame_s,
        steps=frames,
        rested=rested,
    )


def _length(path: Points) -> float:
    return float(np.linalg.norm(np.diff(path, axis=0), axis=1).sum())


def start_line(cable: Cable, scale: FallScale, segment: float) -> Points:
    """Make the line (N, 3) as which a cable starts, in the fall's units, in segments of about the length `segment`."""
    segments = max(8, round(cable.length_m / (segment * scale.unit_m)))
    return start_nodes(cable, segments + 1) / scale.unit_m


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


def _prepare(fall_scene: Any, objects: FallObjects, strips: _Strips, scene: Scene, fall: ClothFall) -> None:
    cables, floor = objects.cables, objects.floor
    cables.data.clear_geometry()
    cables.data.from_pydata(strips.vertices.tolist(), [], strips.faces)
    cloth = modifier(cables, "CLOTH")
    cloth.settings.quality = fall.quality
    cloth.settings.effector_weights.wind = 1.0 if scene.wind.strength > 0 else 0.0
    collision = cloth.collision_settings
    collision.collision_quality = fall.collision_quality
    collision.use_self_collision = len(strips.slices) > 1
    collision.self_distance_min = SELF_DISTANCE
    _set_friction(collision, floor, scene.friction)
    floor.collision.thickness_outer = RADIUS_UNITS - collision.distance_min + FLOOR_SINK
    set_frames(fall_scene, cloth, fall.max_frames)
    set_wind(objects.wind, scene.wind, WIND_GAIN)


def _set_friction(collision: Any, floor: Any, friction: Friction) -> None:
    """Set both coefficients of friction, as far as Blender's settings go."""
    floor.collision.cloth_friction = collision.friction = min(100 * friction.floor, _MOST_FRICTION)
    collision.self_friction = min(100 * friction.cable, _MOST_FRICTION)


def set_material(cables: Any, slices: tuple[slice, ...], material: StripMaterial) -> None:
    """Give each strip of the object `cables` its material: vertex groups carry each strip's share of the largest one.

    Args:
        cables: the object, with a Cloth modifier.
        slices: each strip's vertices.
        material: the settings, one of each kind for every strip.
    """
    settings = modifier(cables, "CLOTH").settings
    settings.mass = material.vertex_mass
    settings.bending_model = "ANGULAR"
    settings.bending_damping = material.bending_damping
    settings.bending_stiffness = settings.tension_stiffness = settings.compression_stiffness = 0.0
    settings.bending_stiffness_max = max(material.bending)
    settings.tension_stiffness_max = settings.compression_stiffness_max = max(material.stretching)
    settings.vertex_group_bending = _weigh(cables, _BENDING_GROUP, slices, material.bending)
    settings.vertex_group_structural_stiffness = _weigh(cables, _STRETCHING_GROUP, slices, material.stretching)


def _weigh(cables: Any, name: str, slices: tuple[slice, ...], values: tuple[float, ...]) -> str:
    group = cables.vertex_groups.get(name) or cables.vertex_groups.new(name=name)
    for part, value in zip(slices, values, strict=True):
        group.add(range(part.start, part.stop), value / max(values), "REPLACE")
    return str(group.name)


def set_wind(wind_object: Any, wind: Wind, gain: float) -> None:
    """Stand the field off to a side, blowing towards the cables along its local z.

    Args:
        wind_object: the force field.
        wind: the drawn wind.
        gain: factor on its strength.
    """
    bearing = np.radians(wind.bearing_deg)
    wind_object.location = (wind.distance * np.cos(bearing), wind.distance * np.sin(bearing), wind.height)
    wind_object.rotation_euler = (0.0, -np.radians(wind.tilt_deg), bearing)
    wind_object.field.strength = gain * wind.strength
    wind_object.field.flow = gain * wind.flow


def _step_until_rest(
    fall_scene: Any, cables: Any, strips: _Strips, fall: ClothFall, scale: FallScale
) -> tuple[Points, NDArray[np.float64], int, bool]:
    previous = strips.vertices
    quiet = 0
    speeds = np.zeros(len(previous))
    # A skipped frame would multiply the time step, so every one is visited in turn.
    for frame in range(1, fall.max_frames + 1):
        fall_scene.frame_set(frame)
        vertices = read_vertices(fall_scene, cables)
        if not np.isfinite(vertices).all():
            raise SceneError(f"the cloth diverged at frame {frame}")
        speeds = np.linalg.norm(vertices - previous, axis=1) * scale.unit_m / scale.frame_s
        previous = vertices
        still = 1000 * np.sqrt(np.mean(speeds**2)) <= MAX_SPEED_RMS_MM_S and 1000 * speeds.max() <= MAX_SPEED_MM_S
        quiet = quiet + 1 if still and frame > REST_FRAMES else 0
        if quiet >= REST_FRAMES:
            break
    return previous, speeds, frame, quiet >= REST_FRAMES
