"""The rods of a stress scene at its start, and the forces that act on them."""

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from benchmarks.stress.scenes import MIN_LENGTH_RADII, SEGMENT_RADII, Case, Start
from farm.scene.physics import GRAVITY_M_S2
from worker.simulate.rod.fall import INTERNAL_DAMPING_S, RESISTANCE, curvature_at_rest
from worker.simulate.rod.model import Array, Breeze, Rod, Surroundings
from worker.simulate.rod.segments import segment_m
from worker.simulate.shapes import bent_rod

SPACING_RADII = 3.0
"""Distance of stacked cables, in the widest radius, as in drawn scenes."""

BEND_KNOTS = 7
"""Points from end to end at which a cable's curvature is drawn."""

UPRIGHT_TURN_RAD = 0.05
"""Angle by which an upright cable bends from end to end."""

THROW_M_S = (2.0, 8.0)
"""Range of the speed of a thrown cable."""

WIND_TILT_DEG = 6.0
"""Greatest angle of the wind to the floor."""

_AIR_KG_M3, _DRAG = 1.2, 1.1
"""Density of the air, and the coefficient of drag of a cylinder across the wind."""


@dataclass(frozen=True, slots=True)
class Setting:
    """A scene that is ready to fall.

    Attributes:
        rods: the cables where they start.
        surroundings: forces and surfaces that act on the rods.
        velocities_m_s: (rods, 3), velocity of each rod at the start.
        reach_m: distance from the origin beyond which a rod has been flung away.
        max_time_s: time by which the rods must rest.
        parting_s: time until which passages do not count. Above 0 only where the start puts axes into each other, and
            no side is the right one: ten times sqrt(r/g), and 20 steps, are enough to part them.
    """

    rods: list[Rod]
    surroundings: Surroundings
    velocities_m_s: Array
    reach_m: float
    max_time_s: float
    parting_s: float


def set_up(case: Case) -> Setting:
    """Make a scene from its case and its own random numbers."""
    rng = case.generator()
    rods = [_level_rod(case, rng, common) for common in [rng.uniform(-1, 1, BEND_KNOTS)] for _ in range(case.cables)]
    bearing = rng.uniform(0, 2 * np.pi)
    rods = [_placed(rod, case, rng, bearing) for rod in rods]
    rods = _heights(rods, case, rng)
    velocities = _throws(case, rng)
    breeze = _breeze(case, rng, max(float(rod.nodes_m[:, 2].max()) for rod in rods))
    surroundings = Surroundings(
        friction_floor=case.friction_floor,
        friction_rods=case.friction_cable,
        damping_s=INTERNAL_DAMPING_S,
        resistance=RESISTANCE,
        breeze=breeze,
    )
    reach, time = _bounds(case, rods, velocities, breeze)
    widest = max(rod.radius_m for rod in rods)
    parting = 10 * float(np.sqrt(widest / GRAVITY_M_S2)) + 20 / case.steps
    is_undecided = case.start in {Start.ONE_HEIGHT, Start.COINCIDENT}
    return Setting(rods, surroundings, velocities, reach, time, parting if is_undecided else 0.0)


def _level_rod(case: Case, rng: np.random.Generator, common: Array) -> Rod:
    """A level rod of the scene's length around the origin, without stress."""
    radius, modulus, density = case.radius, case.modulus, case.density
    if case.mixed:
        radius = float(np.clip(radius * 2 ** rng.uniform(-1, 1), 0.000_25, 0.010))
        modulus = float(np.clip(modulus * 10 ** rng.uniform(-1, 1), 1e5, 1e10))
        density = float(np.clip(density * 10 ** rng.uniform(-0.5, 0.5), 100.0, 20_000.0))
    length = max(case.length * case.radius, MIN_LENGTH_RADII * radius / 2)
    bends = case.turn / length * (0.7 * common + 0.3 * rng.uniform(-1, 1, BEND_KNOTS))
    if not case.aligned:
        bends = case.turn / length * rng.uniform(-1, 1, BEND_KNOTS)
    segments = max(round(length / segment_m(radius, modulus, density, SEGMENT_RADII)), 6)
    nodes = np.zeros((segments + 1, 3))
    nodes[:, :2] = bent_rod(length, tuple(bends.tolist()), segments + 1)
    return Rod(nodes, radius, modulus, density, natural_curvature_per_m=curvature_at_rest(nodes))


def _placed(rod: Rod, case: Case, rng: np.random.Generator, bearing: float) -> Rod:
    """Turn and shift a rod in the plane, by shares of its length like those of drawn scenes."""
    length = rod.segment_length_m * (len(rod.nodes_m) - 1)
    spread = 0.03 if case.aligned else 0.08
    shift = rng.uniform(-spread, spread, 2) * length
    free = rng.uniform(0, np.pi)
    turn = bearing + np.radians(10) * rng.uniform(-1, 1) if case.aligned else free
    cosine, sine = np.cos(turn), np.sin(turn)
    return _moved(rod, rod.nodes_m @ np.array([[cosine, sine, 0], [-sine, cosine, 0], [0, 0, 1]]) + [*shift, 0])


def _moved(rod: Rod, nodes_m: Array) -> Rod:
    return replace(rod, nodes_m=np.ascontiguousarray(nodes_m))


def _heights(rods: list[Rod], case: Case, rng: np.random.Generator) -> list[Rod]:
    """Lift the rods to the places that the kind of start gives them."""
    widest = max(rod.radius_m for rod in rods)
    lowest = widest + case.drop
    order = rng.permutation(len(rods))
    match case.start:
        case Start.UPRIGHT:
            return _upright(rods, widest, case.drop)
        case Start.AT_FLOOR | Start.IN_FLOOR:
            steps = [rods[0].radius_m, *(low.radius_m + high.radius_m for low, high in pairwise(rods))]
            lying = [_lifted(rod, float(z)) for rod, z in zip(rods, np.cumsum(steps), strict=True)]
            return lying if case.start is Start.AT_FLOOR else _tilted(lying, widest)
        case Start.COINCIDENT:
            return [_lifted(rods[k - k % 2], lowest + k // 2 * SPACING_RADII * widest) for k in range(len(rods))]
        case Start.OVERLAPPING:
            spacing = 0.5 * widest
        case Start.ONE_HEIGHT:
            spacing = 0.0
        case Start.STACKED | Start.THROWN:
            spacing = SPACING_RADII * widest
    return [_lifted(rod, lowest + level * spacing) for rod, level in zip(rods, order, strict=True)]


def _lifted(rod: Rod, height_m: float) -> Rod:
    return _moved(rod, rod.nodes_m + np.array([0.0, 0.0, height_m]))


def _upright(rods: list[Rod], widest: float, drop: float) -> list[Rod]:
    """Stand the rods on a square grid, each bent a little to its own side, since straight ones would balance."""
    columns = int(np.ceil(np.sqrt(len(rods))))
    standing = []
    for k, rod in enumerate(rods):
        segments = len(rod.nodes_m) - 1
        length = rod.segment_length_m * segments
        bent = bent_rod(length, (UPRIGHT_TURN_RAD / length,) * 2, segments + 1)
        side = 2.4 * k
        out, up = bent[:, 1] - bent[0, 1], bent[:, 0] - bent[:, 0].min()
        place = (2 * SPACING_RADII + 2) * widest * np.array([k % columns, k // columns])
        x, y = place[0] + out * np.cos(side), place[1] + out * np.sin(side)
        nodes = np.stack([x, y, up + rod.radius_m + drop], axis=1)
        standing.append(replace(rod, nodes_m=nodes, natural_curvature_per_m=None))
    return standing


def _tilted(rods: list[Rod], widest: float) -> list[Rod]:
    """Turn all rods together about the y axis until the first one's lowest place is two radii lower than it lay."""
    farthest = -float(rods[0].nodes_m[:, 0].min())
    sine = min(2 * widest / max(farthest, 2 * widest), 0.9)
    cosine = float(np.sqrt(1 - sine * sine))
    turn = np.array([[cosine, 0, sine], [0, 1, 0], [-sine, 0, cosine]])
    return [replace(_moved(rod, rod.nodes_m @ turn), natural_curvature_per_m=None) for rod in rods]


def _throws(case: Case, rng: np.random.Generator) -> Array:
    directions = rng.normal(size=(case.cables, 3))
    speeds = rng.uniform(*THROW_M_S, size=(case.cables, 1))
    thrown: Array = directions / np.linalg.norm(directions, axis=1, keepdims=True) * speeds
    return thrown if case.start is Start.THROWN else np.zeros_like(thrown)


def _breeze(case: Case, rng: np.random.Generator, highest_m: float) -> Breeze | None:
    """A wind with three gusts that blows until the highest rod would have fallen; None without wind."""
    bearing, tilt = rng.uniform(0, 2 * np.pi), np.radians(rng.uniform(-WIND_TILT_DEG, WIND_TILT_DEG))
    gusts = np.stack(
        [rng.uniform(0, 0.5, 3), 2 * np.pi / rng.uniform(0.02, 0.5, 3), rng.uniform(0, 2 * np.pi, 3)], axis=1
    )
    if case.wind == 0:
        return None
    direction = np.array([np.cos(tilt) * np.cos(bearing), np.cos(tilt) * np.sin(bearing), np.sin(tilt)])
    return Breeze(case.wind * direction, gusts, until_s=float(np.sqrt(2 * highest_m / GRAVITY_M_S2)))


def _slide_s(speed_m_s: float, terminal_m_s: float, braking_m_s2: float) -> float:
    """Longest time that a sliding rod can take to stop, seconds."""
    slide_s = speed_m_s / braking_m_s2
    if speed_m_s > terminal_m_s:
        slide_s = min(slide_s, terminal_m_s / GRAVITY_M_S2 + terminal_m_s / braking_m_s2)
    return float(slide_s)


def _bounds(case: Case, rods: list[Rod], velocities: Array, breeze: Breeze | None) -> tuple[float, float]:
    """Upper bounds on the distance that a rod can reach, metres, and on the time until all rest, seconds.

    - A rod falls from its height, plus the height to which the throw and the wind can lift it, no slower than at its
      terminal speed if there is air. Standing on its end, it takes several times sqrt(L/g) to topple.
    - It moves sideways at the speed from the throw and the wind, plus the speed that a fall can turn sideways. Then it
      slides on the floor or on others, braked by friction, by the dry resistance of contacts and, while it is faster
      than its terminal speed, by drag, which takes that speed divided by g.
    - A cable that bridges others swings. A beam lifted by d off a floor leaves it over a half-length (72 EI d/w)^1/4,
      so the period of its slowest mode is 2.4 sqrt(d/g), whatever its stiffness and weight. With internal damping tau
      the swing decays at a rate of omega^2 tau / 2; from 3 m/s to rest it takes ln(6000) = 8.7 time constants. The
      pile is at most as high as all cables on top of each other.

    Stick and slip between many cables takes longer, so the sum is doubled.
    """
    throw = float(np.linalg.norm(velocities, axis=1).max())
    gust = 1 + float(breeze.gusts[:, 0].sum()) if breeze else 1.0
    blow_s = breeze.until_s + 0.1 if breeze else 0.0
    highest = max(float(rod.nodes_m[:, 2].max()) for rod in rods)
    extent = max(float(np.linalg.norm(rod.nodes_m, axis=1).max()) for rod in rods)
    longest = max(rod.segment_length_m * len(rod.nodes_m) for rod in rods)
    reach = time = 0.0
    for rod in rods:
        terminal = np.inf
        if breeze:
            weight = rod.mass_per_length_kg_m * GRAVITY_M_S2
            terminal = float(np.sqrt(weight / (_AIR_KG_M3 / 2 * _DRAG * 2 * rod.radius_m)))
        gained = min(case.wind * gust, GRAVITY_M_S2 * (case.wind * gust / terminal) ** 2 * blow_s)
        top = highest + throw**2 / (2 * GRAVITY_M_S2) + np.sin(np.radians(WIND_TILT_DEG)) * gained * blow_s
        air_s = throw / GRAVITY_M_S2 + np.sqrt(2 * top / GRAVITY_M_S2) + top / terminal
        aside = gained + throw + np.sqrt(2 * GRAVITY_M_S2 * highest)
        resisted = RESISTANCE * GRAVITY_M_S2
        far_s = _slide_s(aside, terminal, case.friction_floor * GRAVITY_M_S2 + resisted)
        long_s = _slide_s(aside, terminal, min(case.friction_floor, case.friction_cable) * GRAVITY_M_S2 + resisted)
        reach = max(reach, extent + longest + aside * (air_s + far_s))
        time = max(time, air_s + long_s)
    if case.start is Start.UPRIGHT:
        time += 5 * float(np.sqrt(longest / GRAVITY_M_S2))
    pile = sum(2 * rod.radius_m for rod in rods)
    period = 2.4 * float(np.sqrt(pile / GRAVITY_M_S2))
    decay_s = 2 / ((2 * np.pi / period) ** 2 * INTERNAL_DAMPING_S)
    return reach, 2 * (time + 8.7 * decay_s + 10 * period)
