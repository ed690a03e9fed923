"""The fall of a drawn scene's cables as rods, until they rest; sticks are rods that do not bend."""

import numpy as np

from farm.errors import SceneError
from farm.scene.cable import Cable
from farm.scene.clutter import Stick, StickKind
from farm.scene.physics import GRAVITY_M_S2, Wind
from farm.scene.scene import Scene
from farm.spec.simulation import RodFall
from worker.simulate.rod.model import Array, Breeze, Rod, Surroundings
from worker.simulate.rod.simulation import DivergedError, RodSimulation
from worker.simulate.shapes import CableShapes, bent_rod

INTERNAL_DAMPING_S = 0.01
"""Time constant of the cables' internal damping: stranded ones swing hardly more than once."""

RESISTANCE = 0.01
"""Dry resistance of what touches, as a share of its weight: about that of rubber rolling on a hard floor."""

FINEST_RADII = 2.0
"""The shortest segments, in radii."""

REST_RMS_M_S = 0.5e-3
REST_FASTEST_M_S = 2.5e-3
"""Half of what gate 4 asks for."""

REST_S = 0.02
"""How long the cables must have been that slow."""

STICK_YOUNGS_MODULUS_PA = 2e9
"""A stick of 0.2 m and 3 mm radius sags by 3 micrometres between its ends: no cable bends it, and no eye sees more."""

STICK_DENSITY_KG_M3 = {
    StickKind.PEN: 1000.0,
    StickKind.PENCIL: 1000.0,
    StickKind.PIPE: 1500.0,
    StickKind.ROD: 2500.0,
    StickKind.SCREWDRIVER: 1500.0,
}
"""Of a full round section. A steel rod is heavier, but what no cable moves need not be as heavy as that."""


def drop_cables(scene: Scene, fall: RodFall) -> CableShapes:
    """Let the cables of `scene` fall.

    Raises:
        SceneError: if the solver diverges.
    """
    simulation = RodSimulation(rods_of(scene, fall), surroundings_of(scene), steps_per_s=fall.steps_per_s)
    try:
        simulation.settle(
            rms_m_s=REST_RMS_M_S, fastest_m_s=REST_FASTEST_M_S, quiet_s=REST_S, max_time_s=fall.max_time_s
        )
    except DivergedError as error:
        raise SceneError(f"the rod solver diverged {error}") from error
    cables = range(len(scene.cables))
    heights = [cable.start_height_m for cable in scene.cables]
    heights += [stick.start_height_m for stick in scene.sticks]
    return CableShapes(
        nodes_m=tuple(simulation.nodes_m(k) for k in cables),
        radii_m=np.array([cable.diameter_m / 2 for cable in scene.cables]),
        lengths_m=np.array([cable.length_m for cable in scene.cables]),
        speeds_m_s=tuple(np.linalg.norm(simulation.velocities_m_s(k), axis=1) for k in cables),
        start_order=tuple(int(k) for k in np.argsort(heights, kind="stable")),
        fall_s=simulation.time_s,
        steps=simulation.steps,
        sticks_m=tuple(simulation.nodes_m(len(cables) + k) for k in range(len(scene.sticks))),
        stick_radii_m=np.array([stick.diameter_m / 2 for stick in scene.sticks], dtype=np.float64),
    )


def rods_of(scene: Scene, fall: RodFall) -> list[Rod]:
    """The scene's cables where they start, without stress, and after them its sticks."""
    cables = [_rod(cable, fall.segment_radii) for cable in scene.cables]
    return cables + [_stiff_rod(stick, fall.segment_radii) for stick in scene.sticks]


def surroundings_of(scene: Scene) -> Surroundings:
    """The scene's floor, friction and wind; still air if its speed is 0."""
    highest = max(cable.start_height_m + cable.rise_m for cable in scene.cables)
    landing_s = float(np.sqrt(2 * highest / GRAVITY_M_S2))
    return Surroundings(
        friction_floor=scene.friction.floor,
        friction_rods=scene.friction.cable,
        damping_s=INTERNAL_DAMPING_S,
        resistance=RESISTANCE,
        breeze=_breeze(scene.wind, landing_s=landing_s) if scene.wind.speed_m_s > 0 else None,
    )


def segment_m(radius_m: float, youngs_modulus_pa: float, density_kg_m3: float, segment_radii: float) -> float:
    """How long segments are: so many radii, or half the length over which a rod bends under its weight if that is less.

    That length is (EI / rho g A)^(1/3). It is below eight radii only for rods much softer than any cable.
    """
    bending_m = (youngs_modulus_pa * radius_m**2 / (4 * density_kg_m3 * GRAVITY_M_S2)) ** (1 / 3)
    return float(min(segment_radii * radius_m, max(bending_m / 2, FINEST_RADII * radius_m)))


def _rod(cable: Cable, segment_radii: float) -> Rod:
    radius = cable.diameter_m / 2
    length = segment_m(radius, cable.youngs_modulus_pa, cable.density_kg_m3, segment_radii)
    segments = int(np.clip(round(cable.length_m / length), 8, 2000))
    level = bent_rod(cable.length_m, cable.bends_per_m, segments + 1)
    turn = np.radians(cable.rotation_deg)
    cosine, sine = np.cos(turn), np.sin(turn)
    nodes = np.empty((len(level), 3))
    nodes[:, 0] = cable.x_m + cosine * level[:, 0] - sine * level[:, 1]
    nodes[:, 1] = cable.y_m + sine * level[:, 0] + cosine * level[:, 1]
    nodes[:, 2] = radius + cable.start_height_m + np.linspace(0.0, cable.rise_m, len(level))
    return Rod(
        nodes_m=nodes,
        radius_m=radius,
        youngs_modulus_pa=cable.youngs_modulus_pa,
        density_kg_m3=cable.density_kg_m3,
        natural_curvature_per_m=curvature_at_rest(nodes),
    )


def _stiff_rod(stick: Stick, segment_radii: float) -> Rod:
    """A stick as a straight rod; level, as it starts."""
    radius = stick.diameter_m / 2
    segments = int(np.clip(round(stick.length_m / (segment_radii * radius)), 8, 2000))
    along = np.linspace(-0.5, 0.5, segments + 1) * stick.length_m
    turn = np.radians(stick.rotation_deg)
    height = np.full_like(along, radius + stick.start_height_m)
    return Rod(
        nodes_m=np.stack([stick.x_m + np.cos(turn) * along, stick.y_m + np.sin(turn) * along, height], axis=1),
        radius_m=radius,
        youngs_modulus_pa=STICK_YOUNGS_MODULUS_PA,
        density_kg_m3=STICK_DENSITY_KG_M3[stick.kind],
    )


def curvature_at_rest(nodes: Array) -> Array:
    """The natural curvature, (N,) 1/m, at which level nodes (N, 3) at equal distances are without stress."""
    edges = np.diff(nodes[:, :2], axis=0)
    cross = edges[:-1, 0] * edges[1:, 1] - edges[:-1, 1] * edges[1:, 0]
    dot = np.einsum("ij,ij->i", edges[:-1], edges[1:])
    curvature = np.zeros(len(nodes))
    curvature[1:-1] = cross / dot / np.linalg.norm(edges[0])
    return curvature


def _breeze(wind: Wind, landing_s: float) -> Breeze:
    """Wind that blows until the highest cable has fallen: it pushes the cables while they fall, not for ever."""
    bearing, tilt = np.radians(wind.bearing_deg), np.radians(wind.tilt_deg)
    direction = np.array([-np.sin(tilt) * np.cos(bearing), -np.sin(tilt) * np.sin(bearing), np.cos(tilt)])
    gusts = [(gust.share, 2 * np.pi / gust.period_s, np.radians(gust.phase_deg)) for gust in wind.gusts]
    return Breeze(
        velocity_m_s=wind.speed_m_s * direction,
        gusts=np.array(gusts, dtype=np.float64).reshape(-1, 3),
        until_s=landing_s,
    )
