"""Measure gates 5 and 6 at a setting: a cantilever and a crossing of one cable, in segments as long as in a scene.

The cable is 2 mm thick, with a modulus of 10 MPa and a density of 1500 kg/m3, in the middle of the ranges that scenes
are drawn from. Its free length sets the slenderness: a slenderness of 1 is 55 mm, a dozen segments, and 1000 is half a
metre.
"""

import numpy as np

from benchmarks.physics import published_cloth as published
from benchmarks.physics.cloth_experiments import cloth_cantilever, cloth_crossing
from benchmarks.physics.contenders import Contender
from benchmarks.physics.gates import CantileverError, CrossingError, cantilever_error, crossing_error
from benchmarks.physics.ridge import RidgeCrossing
from benchmarks.physics.rows import Textbook
from benchmarks.physics.settings import Setting
from farm.errors import SceneError
from farm.scene.physics import GRAVITY_M_S2
from farm.spec.simulation import ClothFall, RodFall
from worker.simulate.cloth import material, scale
from worker.simulate.rod.model import Rod, Surroundings
from worker.simulate.rod.segments import longest_radii
from worker.simulate.rod.simulation import DivergedError, RodSimulation

SLENDERNESS = (1.0, 10.0, 100.0, 1000.0)
"""Slenderness of the cantilevers, without unit: from stiff to nearly limp."""

_RADIUS_M = 0.001
_MODULUS_PA = 1e7
_DENSITY_KG_M3 = 1500.0
_STIFFNESS_OVER_WEIGHT_M3 = _MODULUS_PA * _RADIUS_M**2 / (4 * _DENSITY_KG_M3 * GRAVITY_M_S2)

_LEAST_SEGMENTS = 4
"""Fewest segments of a cantilever: with fewer it has no shape to measure."""

_DAMPING_S = {1.0: 0.1, 10.0: 0.05, 100.0: 0.3, 1000.0: 3.0}
"""Internal damping, by slenderness, with which a cantilever rests soon. Its shape at rest does not depend on it."""
_REST_RMS_M_S, _REST_FASTEST_M_S, _REST_S, _REST_BY_S = 5e-6, 2e-5, 0.05, 60.0
"""Limits for a cantilever at rest: its root mean square and greatest speed, the seconds for which it stays below them,
and the seconds by which it must rest. At 4000 steps a second the most slender one trembles at 2e-6 m/s for ever."""

_CROSSING_DAMPING_S = 0.05
"""Internal damping of the cable over the ridge, seconds, with which it comes to rest soon."""
_CROSSING_S = 3.0
"""Simulated time of the crossing, seconds, in which the cable comes to rest."""
_AVERAGED_S = 0.2
"""Seconds over which reactions are averaged: they tremble from step to step, and their mean carries the cable."""
_HALF_LENGTHS = 2.2
"""Length of the cable on either side of a ridge, in lift-off lengths."""
_REFERENCE = RidgeCrossing(
    bending_stiffness_n_m2=_MODULUS_PA * np.pi * _RADIUS_M**4 / 4,
    weight_per_length_n_m=_DENSITY_KG_M3 * np.pi * _RADIUS_M**2 * GRAVITY_M_S2,
    lift_m=2 * _RADIUS_M,
)


def textbook(setting: Setting) -> Textbook:
    """Measure gates 5 and 6; a cloth's reaction to the ridge can't be read, and the published cloth has no crossing."""
    match setting.contender:
        case Contender.ROD:
            return _of_rods(setting.fall.rod)
        case Contender.CLOTH:
            return Textbook(_of_cloth(setting.fall.cloth, is_published=False), _cloth_lift_off(setting.fall.cloth))
        case Contender.CLOTH_PUBLISHED:
            return Textbook(_of_cloth(setting.fall.cloth, is_published=True))


def _of_rods(fall: RodFall) -> Textbook:
    cantilevers = tuple(_rod_cantilever(slenderness, fall) for slenderness in SLENDERNESS)
    try:
        crossing = _rod_crossing(fall)
    except (DivergedError, ValueError):
        crossing = CrossingError(np.inf, np.inf, np.inf)
    return Textbook(cantilevers, crossing.lift_off_error, crossing.reaction_error)


def _free_length_m(slenderness: float) -> float:
    return float((slenderness * _STIFFNESS_OVER_WEIGHT_M3) ** (1 / 3))


def _rod_cantilever(slenderness: float, fall: RodFall) -> CantileverError:
    """Measure gate 5 on a rod that is clamped at its first two nodes.

    It is free from the middle of the first segment on. The number of segments is rounded, and the modulus is adjusted
    to make up for it.
    """
    segment = longest_radii(fall.segment_radii) * _RADIUS_M
    segments = max(round(_free_length_m(slenderness) / segment + 0.5), _LEAST_SEGMENTS)
    length = (segments - 0.5) * segment
    nodes = np.zeros((segments + 1, 3))
    nodes[:, 0] = segment * np.arange(segments + 1)
    rod = Rod(
        nodes_m=nodes,
        radius_m=_RADIUS_M,
        youngs_modulus_pa=4 * _DENSITY_KG_M3 * GRAVITY_M_S2 * length**3 / (slenderness * _RADIUS_M**2),
        density_kg_m3=_DENSITY_KG_M3,
        pinned=np.arange(segments + 1) < 2,
    )
    surroundings = Surroundings(floor=False, damping_s=_DAMPING_S[slenderness])
    simulation = RodSimulation([rod], surroundings, steps_per_s=fall.steps_per_s)
    try:
        rests = simulation.settle(
            rms_m_s=_REST_RMS_M_S, fastest_m_s=_REST_FASTEST_M_S, quiet_s=_REST_S, max_time_s=_REST_BY_S
        )
    except DivergedError:
        rests = False
    if not rests:
        return CantileverError(slenderness, np.inf)
    found = cantilever_error(
        simulation.nodes_m(0),
        bending_stiffness_n_m2=rod.bending_stiffness_n_m2,
        weight_per_length_n_m=rod.mass_per_length_kg_m * GRAVITY_M_S2,
    )
    # The measured slenderness differs in its last digits, and those could choose the wrong gate.
    return CantileverError(slenderness, found.error)


def _rod_crossing(fall: RodFall) -> CrossingError:
    """Measure gate 6 on a cable released just above a ridge that stands between two of its nodes.

    There is no friction, since the reference has no tension.
    """
    segment = longest_radii(fall.segment_radii) * _RADIUS_M
    half = _HALF_LENGTHS * _REFERENCE.lift_off_m
    nodes = np.zeros((round(2 * half / segment) + 1, 3))
    nodes[:, 0] = np.linspace(-half, half, len(nodes))
    nodes[:, 2] = 3.05 * _RADIUS_M
    foot = np.zeros((9, 3))
    foot[:, 0], foot[:, 1], foot[:, 2] = 0.3 * segment, np.linspace(-4, 4, 9) * segment, _RADIUS_M
    cable = Rod(nodes, _RADIUS_M, _MODULUS_PA, _DENSITY_KG_M3)
    ridge = Rod(foot, _RADIUS_M, _MODULUS_PA, _DENSITY_KG_M3, pinned=np.ones(9, np.bool_))
    surroundings = Surroundings(friction_floor=0, friction_rods=0, damping_s=_CROSSING_DAMPING_S)
    simulation = RodSimulation([cable, ridge], surroundings, steps_per_s=fall.steps_per_s)
    averaged = round(_AVERAGED_S * fall.steps_per_s)
    simulation.advance(round(_CROSSING_S * fall.steps_per_s) - averaged)
    reactions = np.zeros(len(nodes))
    for _ in range(averaged):
        simulation.advance(1)
        reactions += simulation.floor_forces_n(0)[:, 2] / averaged
        on_ridge = int(np.abs(simulation.nodes_m(0)[:, 0] - foot[0, 0]).argmin())
        reactions[on_ridge] += simulation.contact_force_n(0, 1)[2] / averaged
    return crossing_error(simulation.nodes_m(0), reactions, radius_m=_RADIUS_M, reference=_REFERENCE)


def _of_cloth(fall: ClothFall, *, is_published: bool) -> tuple[CantileverError, ...]:
    """Measure gate 5 on a cloth.

    The published falls ignore a cable's modulus; here their planes get the stiffness that the slenderness asks for.
    """
    joined = material.SEGMENT_UNITS / scale.RADIUS_UNITS
    segment = (published.SEGMENT_UNITS / published.RADIUS_UNITS if is_published else joined) * _RADIUS_M
    errors = []
    for slenderness in SLENDERNESS:
        segments = max(round(_free_length_m(slenderness) / segment - 0.5), _LEAST_SEGMENTS)
        try:
            error = abs(cloth_cantilever(slenderness, segments=segments, settings=fall, published=is_published).error)
        except SceneError:
            error = np.inf
        errors.append(CantileverError(slenderness, error))
    return tuple(errors)


def _cloth_lift_off(fall: ClothFall) -> float:
    """Error of a cloth's lift-off length, relative to the stiffness asked for and not to the one that it can have."""
    segment = material.SEGMENT_UNITS / scale.RADIUS_UNITS * _RADIUS_M
    segments = round(2 * _HALF_LENGTHS * _REFERENCE.lift_off_m / segment)
    try:
        crossing = cloth_crossing(_STIFFNESS_OVER_WEIGHT_M3, segments=segments, settings=fall, radius_m=_RADIUS_M)
    except (SceneError, ValueError):
        return np.inf
    return abs(crossing.lift_off_m / _REFERENCE.lift_off_m - 1)
