"""Two textbook problems played by Blender's cloth: a cantilever, and a cable over a ridge."""

import time
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np
from scipy.optimize import brentq

from benchmarks.physics import published_cloth as planes
from benchmarks.physics.elastica import LEAST_SLENDERNESS, MOST_SLENDERNESS, droop_ratio
from benchmarks.physics.ridge import fit_lifted
from blend.fall import add_cables, add_floor
from farm.errors import SceneError
from farm.spec.simulation import ClothFall
from worker.curves import Points
from worker.simulate.cloth.fall import FLOOR_SINK, set_material
from worker.simulate.cloth.material import SEGMENT_UNITS, SOLVER_GRAVITY, STRIP_WIDTH, achieved_stiffness, material_for
from worker.simulate.cloth.scale import RADIUS_UNITS
from worker.simulate.cloth.stage import modifier, read_vertices, set_frames, temporary_scene
from worker.simulate.cloth.strip import centreline, zigzag, zigzag_faces

VERTEX_MASS = 0.4
"""Mass of a vertex: the middle of the published range. A strip at rest does not depend on it."""

_FRAMES = 3000
"""Maximum frames; after them a strip is measured even if it still moves."""

_REST = 2e-6
"""Movement in a frame over the strip's length, below which the strip hangs still."""

_REST_FRAMES = 20
"""Frames in a row in which a strip must hang still to count as resting."""

_DRY_FRAMES = 30
"""Frames at the start in which rest does not count, as nothing has gathered speed yet."""

_AIR_DAMPING = 1.0
"""Blender's setting of the air's resistance, with which a strip rests soon."""

_HEIGHT = 200.0
"""Height of the cantilever over the origin, in units: no floor is near."""


@dataclass(frozen=True, slots=True)
class Deflection:
    """A settled cantilever.

    Attributes:
        gamma: slenderness rho g A L^3 / (E I) as asked for.
        gamma_set: slenderness as set, which is more where the solver can't be as stiff as asked for.
        droop: H/W as measured, from the clamp to the tip.
        gamma_effective: the slenderness at which the heavy elastica droops as much.
        seconds: time that the computer took.
    """

    gamma: float
    gamma_set: float
    droop: float
    gamma_effective: float
    seconds: float

    @property
    def error(self) -> float:
        """Relative error of H/W against the heavy elastica of `gamma`."""
        return self.droop / droop_ratio(self.gamma) - 1


@dataclass(frozen=True, slots=True)
class Crossing:
    """A cable at rest over a ridge.

    Attributes:
        lift_off_m: half the length in the air, fitted to the whole shape.
        theory_m: (72 EI d / w)^(1/4) for the lift d that was measured.
        lift_m: d, by which the ridge lifts the centreline.
        misfit: root mean square distance from the fitted shape, over the lift.
        seconds: time that the computer took.
    """

    lift_off_m: float
    theory_m: float
    lift_m: float
    misfit: float
    seconds: float


def cloth_cantilever(gamma: float, *, segments: int, settings: ClothFall, published: bool = False) -> Deflection:
    """Let a strip that is clamped at one end sag under its weight.

    Args:
        gamma: slenderness rho g A L^3 / (E I) to aim at.
        segments: number of segments of the free length, at least 4; the stiffness for a given `gamma` grows with its
            third power.
        settings: quality of the solver; its frames and collisions don't matter here.
        published: whether to use the published set-up's plane of quads instead of the joined set-up's zigzag. The plane
            has Blender's own stretching, so soft sideways that it may turn on edge and sag more than asked for.

    Raises:
        SceneError: if the solver diverges.
    """
    start = time.perf_counter()
    with temporary_scene() as scene:
        if published:
            cable, gamma_set, clamp = _pinned_plane(scene, gamma, segments)
        else:
            cable, gamma_set, clamp = _pinned_zigzag(scene, gamma, segments, settings)
        cable.location.z = _HEIGHT
        cloth = modifier(cable, "CLOTH")
        cloth.settings.air_damping = _AIR_DAMPING
        cloth.settings.quality = settings.quality
        cloth.collision_settings.use_collision = cloth.collision_settings.use_self_collision = False
        vertices = _step_until_still(scene, cable)
    line = vertices.reshape(-1, 2, 3).mean(axis=1) if published else centreline(vertices)
    tip = 1.5 * line[-1] - 0.5 * line[-2]
    droop = float(-tip[2] / np.hypot(tip[0] - clamp, tip[1]))
    return Deflection(gamma, gamma_set, droop, _slenderness(droop), time.perf_counter() - start)


def cloth_crossing(stiffness: float, *, segments: int, settings: ClothFall, radius_m: float = 0.001) -> Crossing:
    """Let a straight cable of the joined set-up fall across a rigid ridge as high as a cable of its own radius.

    Args:
        stiffness: EI / w in m^3; E r^2 / (4 rho g) for a round cable.
        segments: number of the strip's segments.
        settings: quality of the solver.
        radius_m: the cable's radius.

    Raises:
        SceneError: if the solver diverges.
        ValueError: if the cable lies flat.
    """
    start = time.perf_counter()
    unit_m = radius_m / RADIUS_UNITS
    material = material_for([stiffness / unit_m**3], VERTEX_MASS, settings)
    path = np.zeros((segments + 1, 3))
    path[:, 0] = SEGMENT_UNITS * (np.arange(segments + 1) - segments / 2)
    path[:, 2] = 4 * RADIUS_UNITS
    with temporary_scene() as scene:
        cable = add_cables(scene)
        _fill(cable, path)
        set_material(cable, (slice(0, segments + 1),), material)
        cloth = modifier(cable, "CLOTH")
        cloth.settings.quality = settings.quality
        cloth.collision_settings.collision_quality = settings.collision_quality
        cloth.collision_settings.use_self_collision = False
        outer = RADIUS_UNITS - cloth.collision_settings.distance_min + FLOOR_SINK
        add_floor(scene).collision.thickness_outer = outer
        _add_ridge(scene, 2 * RADIUS_UNITS, outer)
        line = centreline(_step_until_still(scene, cable))
    floor = float(np.median(np.sort(line[:, 2])[: segments // 4]))
    fit = fit_lifted(line[:, 0], line[:, 2] - floor)
    achieved = achieved_stiffness(material.bending[0], VERTEX_MASS)
    return Crossing(
        lift_off_m=fit.lift_off_m * unit_m,
        theory_m=float((72 * achieved * fit.lift_m) ** 0.25) * unit_m,
        lift_m=fit.lift_m * unit_m,
        misfit=fit.misfit,
        seconds=time.perf_counter() - start,
    )


def _fill(cable: Any, path: Points) -> None:
    cable.data.clear_geometry()
    cable.data.from_pydata(zigzag(path, STRIP_WIDTH).tolist(), [], zigzag_faces(len(path), 0))


def _pinned_zigzag(scene: Any, gamma: float, segments: int, settings: ClothFall) -> tuple[Any, float, float]:
    """Add a level strip whose first triangle is held.

    The first fold is half way along the second segment and stands for that whole segment, so the clamp is at its start.

    Returns:
        The strip, the slenderness that it can have, and the clamp's position along x.
    """
    length = (segments + 0.5) * SEGMENT_UNITS
    material = material_for([length**3 / gamma], VERTEX_MASS, settings)
    path = np.zeros((segments + 2, 3))
    path[:, 0] = SEGMENT_UNITS * np.arange(segments + 2)
    cable = add_cables(scene)
    _fill(cable, path)
    set_material(cable, (slice(0, segments + 2),), material)
    pin = cable.vertex_groups.new(name="pin")
    pin.add([0, 1, 2], 1.0, "REPLACE")
    modifier(cable, "CLOTH").settings.vertex_group_mass = pin.name
    return cable, length**3 / achieved_stiffness(material.bending[0], VERTEX_MASS), SEGMENT_UNITS


def _pinned_plane(scene: Any, gamma: float, segments: int) -> tuple[Any, float, float]:
    """Add a level plane of quads whose first quad is held.

    With bending stiffness b, each fold across the plane pushes the rungs beside it by half of 0.1 b times the width
    times the angle, which makes EI = b width length^2 / 20. The first fold is at the second rung and stands for half a
    segment on either side.

    Returns:
        The plane, its slenderness, and the clamp's position along x.
    """
    width = 2 * planes.RADIUS_UNITS
    segment = planes.SEGMENT_UNITS
    path = np.zeros((segments + 2, 3))
    path[:, 0] = segment * np.arange(segments + 2)
    plane = planes.add_plane(scene, path, width)
    settings = modifier(plane, "CLOTH").settings
    settings.mass = VERTEX_MASS
    length = (segments + 1.0) * segment
    weight = 2 * VERTEX_MASS * SOLVER_GRAVITY / segment
    settings.bending_stiffness = 20 * weight * length**3 / (gamma * width * segment**2)
    pin = plane.vertex_groups.new(name="pin")
    pin.add([0, 1, 2, 3], 1.0, "REPLACE")
    settings.vertex_group_mass = pin.name
    return plane, gamma, 0.5 * segment


def _add_ridge(scene: Any, height: float, outer: float) -> None:
    """Add a straight edge across the cable, with the floor's collision distance, so that it lifts it by `height`."""
    mesh = bpy.data.meshes.new("ridge")
    wide, foot = 5.0, 0.02
    mesh.from_pydata(
        [(-foot, -wide, 0), (0, -wide, height), (foot, -wide, 0), (-foot, wide, 0), (0, wide, height), (foot, wide, 0)],
        [],
        [(0, 1, 4, 3), (1, 2, 5, 4)],
    )
    ridge = bpy.data.objects.new("ridge", mesh)
    scene.collection.objects.link(ridge)
    ridge.modifiers.new("Collision", "COLLISION")
    ridge.collision.thickness_outer = outer


def _step_until_still(scene: Any, cable: Any) -> Points:
    set_frames(scene, modifier(cable, "CLOTH"), _FRAMES)
    scene.frame_set(1)
    previous = read_vertices(scene, cable)
    size = float(np.ptp(previous, axis=0).max())
    quiet = 0
    for frame in range(2, _FRAMES + 1):
        scene.frame_set(frame)
        vertices = read_vertices(scene, cable)
        if not np.isfinite(vertices).all() or np.abs(vertices).max() > 100 * size:
            raise SceneError(f"the cloth diverged at frame {frame}")
        still = float(np.abs(vertices - previous).max()) < _REST * size
        previous = vertices
        quiet = quiet + 1 if still and frame > _DRY_FRAMES else 0
        if quiet >= _REST_FRAMES:
            break
    return previous


def _slenderness(droop: float) -> float:
    """The slenderness at which the heavy elastica droops by H/W, limited to the range of the reference."""
    low, high = LEAST_SLENDERNESS, MOST_SLENDERNESS
    if not droop_ratio(low) < droop < droop_ratio(high):
        return low if 0 <= droop <= droop_ratio(low) else high

    def excess(log_slenderness: float) -> float:
        # The exponential of a bound's logarithm may lie beyond it by a rounding error.
        return droop_ratio(float(np.clip(np.exp(log_slenderness), low, high))) - droop

    return float(np.exp(brentq(excess, np.log(low), np.log(high), xtol=1e-4)))
