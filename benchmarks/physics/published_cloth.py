"""The published set-up, for comparison: eight cloth objects that collide with each other for 100 frames.

Each cable is a long narrow plane, finely subdivided, with the modifiers Cloth, Solidify, Subdivision Surface and
Collision. All eight fall, whatever number is shown, and the fall doesn't stop at rest. Settings that the publication
doesn't give are Blender's own.

The publication gives no size either. In metres, a cable of 2 mm is thinner than the solver's collision distances can
follow, and falls through the floor. Here a radius is `RADIUS_UNITS` units, so for that cable a unit is a centimetre;
gravity is 9.81 units, so the fall is the true one slowed down (`worker.simulate.cloth.scale`). With smaller cables,
they sink deeper into each other; with larger ones, 100 frames are too short for them to land. Each object depends on
the colliders of all others; Blender breaks these circles in an order of its own and reports them on standard output, so
nothing guarantees that runs agree.
"""

from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from blend.fall import add_floor, add_wind
from farm.errors import SceneError
from farm.scene.cable import Cable
from farm.scene.scene import Scene
from farm.spec.simulation import ClothFall
from worker.curves import Points
from worker.simulate.cloth.fall import set_wind, start_line
from worker.simulate.cloth.scale import FallScale
from worker.simulate.cloth.stage import modifier, read_vertices, set_frames, temporary_scene
from worker.simulate.cloth.strip import ladder, ladder_faces
from worker.simulate.shapes import CableShapes

CABLES = 8
"""Cables that fall, however many the scene shows."""

FRAMES = 100
"""Frames of the fall, whether the cables rest or not."""

DEFAULT_QUALITY = 5
"""Blender's own setting of the solver's quality."""

RADIUS_UNITS = 0.1
"""A cable's radius in units; the text above says why."""

SEGMENT_UNITS = 0.4
"""Length of a face of a plane, in units."""

CABLE_DISTANCE = 0.05
"""Distance in units that a plane keeps to another cable's surface or the floor; the collider there keeps as much again.
Together they are a radius, the half of the cable that the solver does not see."""

_GOLDEN_ANGLE_DEG = 137.5
"""Turn between two repetitions of a cable: no two of eight come to lie in one direction."""


@dataclass(frozen=True, slots=True)
class _Planes:
    """The falling objects, and the line along which each one starts, in units."""

    objects: list[Any]
    lines: list[Points]


def drop_cables(scene: Scene, fall: ClothFall) -> CableShapes:
    """Let eight cables fall for 100 frames and return those that the scene shows.

    The cables beyond the scene's own repeat them, turned about the vertical and stacked above. Only the quality of
    `fall` counts, and only if it isn't the farm's default: in that case Blender's own default counts.

    Raises:
        SceneError: if the solver diverges.
    """
    radii = np.array([cable.diameter_m / 2 for cable in scene.cables])
    scale = FallScale(unit_m=float(radii.max()) / RADIUS_UNITS)
    unstated = fall.quality == ClothFall.model_fields["quality"].default
    quality = DEFAULT_QUALITY if unstated else fall.quality
    with temporary_scene() as stage:
        planes = _add_planes(stage, all_eight(scene.cables), scale, scene.vertex_mass, quality)
        floor = add_floor(stage)
        floor.collision.thickness_outer = CABLE_DISTANCE
        set_wind(add_wind(stage), scene.wind, 1.0)
        shown = _Planes(planes.objects[: len(radii)], planes.lines[: len(radii)])
        lines, speeds = _run(stage, shown, scale)
    return CableShapes(
        nodes_m=tuple(line * scale.unit_m for line in lines),
        radii_m=radii,
        lengths_m=np.array(
            [np.linalg.norm(np.diff(line, axis=0), axis=1).sum() * scale.unit_m for line in shown.lines]
        ),
        speeds_m_s=tuple(speeds),
        start_order=tuple(int(k) for k in np.argsort([cable.start_height_m for cable in scene.cables])),
        fall_s=FRAMES * scale.frame_s,
        steps=FRAMES,
    )


def all_eight(shown: tuple[Cable, ...]) -> list[Cable]:
    """The cables of a scene, and repetitions of them up to eight, each turned and placed above all before it."""
    cables = list(shown)
    while len(cables) < CABLES:
        model = cables[len(cables) - len(shown)]
        top = max(cable.start_height_m for cable in cables)
        cables.append(
            model.model_copy(
                update={
                    "rotation_deg": model.rotation_deg + _GOLDEN_ANGLE_DEG,
                    "start_height_m": top + 2 * max(cable.diameter_m for cable in cables),
                }
            )
        )
    return cables


def _add_planes(stage: Any, cables: list[Cable], scale: FallScale, vertex_mass: float, quality: int) -> _Planes:
    planes = _Planes([], [])
    for cable in cables:
        radius = cable.diameter_m / 2 / scale.unit_m
        line = start_line(cable, scale, SEGMENT_UNITS)
        plane = add_plane(stage, line, 2 * radius)
        cloth = modifier(plane, "CLOTH")
        cloth.settings.mass = vertex_mass
        cloth.settings.quality = quality
        cloth.collision_settings.distance_min = CABLE_DISTANCE
        set_frames(stage, cloth, FRAMES)
        solidify = plane.modifiers.new("Solidify", "SOLIDIFY")
        solidify.thickness, solidify.offset = 2 * radius, 0.0
        round_off = plane.modifiers.new("Subdivision", "SUBSURF")
        round_off.levels = round_off.render_levels = 1
        plane.modifiers.new("Collision", "COLLISION")
        plane.collision.thickness_outer = CABLE_DISTANCE
        planes.objects.append(plane)
        planes.lines.append(line)
    return planes


def add_plane(stage: Any, line: Points, width: float) -> Any:
    """Add a plane of quads along a level line (N, 3) with a Cloth modifier at Blender's settings; return it."""
    mesh = bpy.data.meshes.new("plane")
    mesh.from_pydata(ladder(line, width).tolist(), [], ladder_faces(len(line)))
    plane = bpy.data.objects.new("plane", mesh)
    stage.collection.objects.link(plane)
    plane.modifiers.new("Cloth", "CLOTH")
    return plane


def _run(stage: Any, planes: _Planes, scale: FallScale) -> tuple[list[Points], list[NDArray[np.float64]]]:
    before: list[Points] = []
    lines = planes.lines
    # A skipped frame would multiply the time step, so every frame is visited in turn.
    for frame in range(1, FRAMES + 1):
        stage.frame_set(frame)
        before = lines
        lines = [_centreline(stage, plane, len(line)) for plane, line in zip(planes.objects, planes.lines, strict=True)]
        if not all(np.isfinite(line).all() for line in lines):
            raise SceneError(f"the cloth diverged at frame {frame}")
    speeds = [
        np.linalg.norm(line - earlier, axis=1) * scale.unit_m / scale.frame_s
        for line, earlier in zip(lines, before, strict=True)
    ]
    return lines, speeds


def _centreline(stage: Any, plane: Any, nodes: int) -> Points:
    """The middles of the cross-sections of a plane.

    Each section has two corners and their two copies, and these vertices come first after subdivision. Subdivision
    draws the two end faces in, so each end node is placed one segment beyond its neighbour instead.
    """
    corners = read_vertices(stage, plane)[: 4 * nodes]
    line: Points = corners.reshape(2, nodes, 2, 3).mean(axis=(0, 2))
    line[0] = 2 * line[1] - line[2]
    line[-1] = 2 * line[-2] - line[-3]
    return line
