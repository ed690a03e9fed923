"""Lets the cables of a sampled scene fall as rods until they rest; sticks are rods that hardly bend."""

from dataclasses import replace

import numpy as np

from farm.errors import SceneError
from farm.scene.cable import Cable
from farm.scene.clutter import Peg, Stick, StickKind
from farm.scene.physics import GRAVITY_M_S2, Wind
from farm.scene.scene import Scene
from farm.spec.simulation import RodFall
from worker.simulate.rod.knots import tie
from worker.simulate.rod.model import Array, Breeze, Rod, Surroundings
from worker.simulate.rod.segments import FINEST_RADII, MOST_TURN_RAD, largest_turn_rad, longest_radii, segment_m
from worker.simulate.rod.simulation import DivergedError, RodSimulation, TooManyStepsError
from worker.simulate.shapes import CableShapes, height_at, start_nodes

INTERNAL_DAMPING_S = 0.01
"""Time constant of the cables' internal damping, in seconds: stranded cables hardly swing more than once."""

RESISTANCE = 0.01
"""Dry resistance of a rod that touches something, as a share of its weight: about that of rubber rolling on a hard
floor."""

REST_RMS_M_S = 0.5e-3
"""Root mean square speed below which the cables rest, in m/s: half of what gate 4 allows."""

REST_FASTEST_M_S = 2.5e-3
"""Speed of the fastest node below which the cables rest, in m/s: half of what gate 4 allows."""

REST_S = 0.04
"""Time over which these speeds are means, in seconds. Contacts chatter within single steps by up to a hundredth of a
radius, which moves nothing."""

LIGHTEST_SHARE = 1 / 16
"""Least inertia of a rod's length over that of the heaviest rod in the scene. A rod that weighs less moves as if it had
that much: impulses between rods of very different mass are found slowly. Where rods rest, inertia plays no part."""

MOST_STEPS_OVER_PLAN = 4.0
"""Most time steps of a fall, as a multiple of those that `max_time_s` has without halvings. Cables at rest need none of
the headroom: of 540 falls of both styles, the one with the most made 1.005 times that number, as it never rested."""

STICK_YOUNGS_MODULUS_PA = 2e9
"""Young's modulus of sticks, in pascals: a stick of 0.2 m and 3 mm radius sags by 3 micrometres between its ends, so
cables do not visibly bend it."""

STICK_DENSITY_KG_M3 = {
    StickKind.PEN: 1000.0,
    StickKind.PENCIL: 1000.0,
    StickKind.PIPE: 1500.0,
    StickKind.ROD: 2500.0,
    StickKind.SCREWDRIVER: 1500.0,
}
"""Density of each kind of stick with a full round section, in kg/m3. Steel is heavier than 2,500, but cables do not
move a lighter rod either."""


def drop_cables(scene: Scene, fall: RodFall) -> CableShapes:
    """Let the cables and sticks of a scene fall until they rest or the time is over.

    Args:
        scene: sampled scene.
        fall: settings of the solver.

    Returns:
        The shapes of the cables and sticks at the end.

    Raises:
        SceneError: if the solver diverges, or makes more steps than any sound fall takes.
    """
    rods = rods_of(scene, fall)
    simulation = RodSimulation(rods, surroundings_of(scene), steps_per_s=fall.steps_per_s)
    try:
        rested = simulation.settle(
            rms_m_s=REST_RMS_M_S,
            fastest_m_s=REST_FASTEST_M_S,
            quiet_s=REST_S,
            max_time_s=fall.max_time_s,
            max_steps=most_steps(simulation, fall),
        )
    except DivergedError as error:
        raise SceneError(f"the rod solver diverged {error}") from error
    except TooManyStepsError as error:
        raise SceneError(f"the rod solver gave up {error} of the fall: the cables move too fast for it") from error
    cables = range(len(scene.cables))
    sticks = range(len(cables), len(cables) + len(scene.sticks))
    pegs = range(sticks.stop, len(rods))
    heights = [cable.start_height_m for cable in scene.cables]
    heights += [stick.start_height_m for stick in scene.sticks]
    return CableShapes(
        nodes_m=tuple(simulation.nodes_m(k) for k in cables),
        radii_m=np.array([cable.diameter_m / 2 for cable in scene.cables]),
        lengths_m=np.array([cable.length_m for cable in scene.cables]),
        speeds_m_s=tuple(np.linalg.norm(simulation.drift_m_s(k), axis=1) for k in cables),
        start_order=tuple(int(k) for k in np.argsort(heights, kind="stable")),
        fall_s=simulation.time_s,
        steps=simulation.steps,
        sticks_m=tuple(simulation.nodes_m(k) for k in sticks),
        stick_radii_m=np.array([stick.diameter_m / 2 for stick in scene.sticks], dtype=np.float64),
        rested=rested,
        # No step in which rods would pass through each other is made.
        passages=0,
        pegs_m=tuple(simulation.nodes_m(k) for k in pegs),
        peg_radii_m=np.array([peg.diameter_m / 2 for peg in scene.pegs], dtype=np.float64),
    )


def most_steps(simulation: RodSimulation, fall: RodFall) -> int:
    """Compute the number of time steps at which a fall is given up."""
    return int(np.ceil(MOST_STEPS_OVER_PLAN * simulation.coarsest_steps_per_s * max(fall.max_time_s, 1.0)))


def rods_of(scene: Scene, fall: RodFall) -> list[Rod]:
    """Make the rods of a scene at the start: its cables, after them its sticks, and after these its pegs.

    Cables are without stress, but for what weaves them up and down or pulls a knot.
    """
    cables = [_rod(cable, fall.segment_radii) for cable in scene.cables]
    sticks = [_stiff_rod(stick, fall.segment_radii) for stick in scene.sticks]
    rods = cables + sticks
    least = LIGHTEST_SHARE * max(rod.mass_per_length_kg_m for rod in rods)
    falling = [replace(rod, inertia=max(least / rod.mass_per_length_kg_m, 1.0)) for rod in rods]
    return falling + [_fixed_rod(peg) for peg in scene.pegs]


def surroundings_of(scene: Scene) -> Surroundings:
    """Make the floor, friction and wind of a scene; a wind of speed 0 becomes still air without drag."""
    starts = [cable.start_height_m + float(_rises_m(cable).max()) for cable in scene.cables]
    highest = max(starts or [stick.start_height_m for stick in scene.sticks])
    landing_s = float(np.sqrt(2 * highest / GRAVITY_M_S2))
    return Surroundings(
        friction_floor=scene.friction.floor,
        friction_rods=scene.friction.cable,
        damping_s=INTERNAL_DAMPING_S,
        resistance=RESISTANCE,
        breeze=_breeze(scene.wind, landing_s=landing_s) if scene.wind.speed_m_s > 0 else None,
    )


def _rises_m(cable: Cable) -> Array:
    """Compute the heights (N,) of a cable above its start, at places along it, in metres."""
    return height_at(cable, np.linspace(0.0, cable.length_m, max(2, 2 * len(cable.heights_m))))


def _rod(cable: Cable, segment_radii: float) -> Rod:
    if cable.knot is not None:
        return _placed(tie(cable, segment_radii), cable)
    radius = cable.diameter_m / 2
    longest = longest_radii(segment_radii)
    length = segment_m(radius, cable.youngs_modulus_pa, cable.density_kg_m3, longest)
    nodes = start_nodes(cable, _segments(cable, length) + 1)
    turn = largest_turn_rad(nodes)
    if turn > MOST_TURN_RAD:
        nodes = start_nodes(cable, _segments(cable, max(length * MOST_TURN_RAD / turn, FINEST_RADII * radius)) + 1)
    return Rod(
        nodes_m=nodes,
        radius_m=radius,
        youngs_modulus_pa=cable.youngs_modulus_pa,
        density_kg_m3=cable.density_kg_m3,
        natural_curvature_per_m=curvature_at_rest(nodes),
    )


def _segments(cable: Cable, length_m: float) -> int:
    """Count the segments of about a length, in metres, that make up a cable."""
    return int(np.clip(round(cable.length_m / length_m), 8, 2000))


def _placed(knotted: Rod, cable: Cable) -> Rod:
    """Turn, shift and lift a knotted rod, which is tied about the origin, to its cable's place."""
    turn = np.radians(cable.rotation_deg)
    cosine, sine = np.cos(turn), np.sin(turn)
    rotation = np.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])
    return replace(knotted, nodes_m=knotted.nodes_m @ rotation + [cable.x_m, cable.y_m, cable.start_height_m])


def _fixed_rod(peg: Peg) -> Rod:
    """Make an upright rod of a peg, which reaches below the floor so that its rounded end is out of the way."""
    radius = peg.diameter_m / 2
    height = np.linspace(-radius, peg.height_m, max(4, round((peg.height_m + radius) / (2 * radius)) + 1))
    nodes = np.stack([np.full_like(height, peg.x_m), np.full_like(height, peg.y_m), height], axis=1)
    return Rod(
        nodes_m=nodes,
        radius_m=radius,
        youngs_modulus_pa=STICK_YOUNGS_MODULUS_PA,
        density_kg_m3=STICK_DENSITY_KG_M3[StickKind.ROD],
        pinned=np.ones(len(nodes), np.bool_),
    )


def _stiff_rod(stick: Stick, segment_radii: float) -> Rod:
    """Make a straight, level rod of a stick."""
    radius = stick.diameter_m / 2
    segments = int(np.clip(round(stick.length_m / (longest_radii(segment_radii) * radius)), 8, 2000))
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
    """Compute the natural curvature (N,), in 1/m, with which nodes (N, 3) at equal distances are free of stress."""
    edges = np.diff(nodes[:, :2], axis=0)
    length = np.hypot(np.linalg.norm(edges[0]), nodes[1, 2] - nodes[0, 2])
    cross = edges[:-1, 0] * edges[1:, 1] - edges[:-1, 1] * edges[1:, 0]
    dot = np.einsum("ij,ij->i", edges[:-1], edges[1:])
    curvature = np.zeros(len(nodes))
    curvature[1:-1] = cross / dot / length
    return curvature


def _breeze(wind: Wind, landing_s: float) -> Breeze:
    """Make a wind that dies down after `landing_s` seconds, when the highest cable has fallen: then cables can rest."""
    bearing, tilt = np.radians(wind.bearing_deg), np.radians(wind.tilt_deg)
    direction = np.array([-np.sin(tilt) * np.cos(bearing), -np.sin(tilt) * np.sin(bearing), np.cos(tilt)])
    gusts = [(gust.share, 2 * np.pi / gust.period_s, np.radians(gust.phase_deg)) for gust in wind.gusts]
    return Breeze(
        velocity_m_s=wind.speed_m_s * direction,
        gusts=np.array(gusts, dtype=np.float64).reshape(-1, 3),
        until_s=landing_s,
    )
