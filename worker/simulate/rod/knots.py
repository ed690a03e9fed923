"""Ties a knot in a cable and pulls it tight, before the cable falls.

A weightless rod without friction is pulled at both ends by T = EI / (2 R^2), the pull that a loose knot with a loop of
radius R balances (Audoly, Clauvelin and Neukirch 2007, "Elastic knots"). Its shape at rest depends on R and on the
length of the segments alone, both in radii of the cable, so all cables are pulled as one rod whose mass and stiffness
suit the solver. Its tails are no longer than the knot needs; the cable's own length is cut from it or added to it.
"""

from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from farm.errors import SceneError
from farm.scene.cable import Cable
from farm.scene.knot import KnotKind
from worker.curves import smooth
from worker.simulate.checks.knot_type import FIGURE_EIGHT, OVERHAND, determinant
from worker.simulate.rod.knot_start import loose_knot
from worker.simulate.rod.model import Array, Rod, Surroundings
from worker.simulate.rod.segments import segment_m
from worker.simulate.rod.simulation import DivergedError, RodSimulation

DETERMINANTS = MappingProxyType({KnotKind.OVERHAND: OVERHAND, KnotKind.FIGURE_EIGHT: FIGURE_EIGHT})
"""Determinant of each kind of knot."""

PULLED_RADIUS_M = 1e-3
"""Radius of the rod that is pulled, in metres: in the middle of the sizes for which the solver's tolerances are set."""

PULLED_MODULUS_PA = 5e7
"""Young's modulus of that rod, in pascals."""

PULLED_DENSITY_KG_M3 = 2800.0
"""Density of that rod, in kg/m3. A step then moves a push on about 15 radii of it, as on most cables: the knot comes to
rest fastest without a swing when it is light, and the solver needs more turns in a step when it is lighter yet."""

PULLED_DAMPING_S = 0.01
"""Time constant of that rod's internal damping, in seconds, which is about that of the knot's approach to rest."""

STEPS_PER_S = 1000.0
"""Time steps per second of the pull."""

TAIL_LOOPS = 1.5
"""Length of each tail at the start of the pull, in loop radii, beyond the curve of `loose_knot`. A tail's bend dies
down over 1.4 loop radii."""

CHECK_STEPS = 20
"""Time steps from one check whether the knot rests to the next."""

WINDOW_CHECKS = 4
"""Checks in a row whose mean is compared with that of as many before them: contacts without friction chatter for ever,
by up to half a radius, and a knot on its way may pause for three checks."""

REST_SHARE = 0.02
"""Movement of one end against the other from mean to mean, in loop radii, up to which the knot rests. The knot takes up
about eight loop radii of cable."""

REST_RADII = 0.15
"""The least such movement that counts, in radii of the cable."""

MOST_CHECKS = 60
"""Checks after which a knot that does not rest is given up."""

TOUCH_RADII = 2.5
"""Distance of the axes of two parts of the cable, in radii, up to which they belong to the knot."""

NEIGHBOUR_RADII = 12.0
"""Distance along the cable, in radii, within which two parts do not count as touching."""

LEAST_TAIL_RADII = 4.0
"""Least length of cable beyond the knot at either end, in radii: a shorter one slips out when the cable falls."""

MOST_TURN_COSINE = 0.25
"""Least cosine of the turn at a node from which the natural curvature, a tangent, is computed; few knots are so tight
for their segments."""

_LEAST_BULGE = 0.3
"""Distance of a knot's middle from the chord that tells to which side it bulges, as a share of its largest one."""

_SAMPLES = 3
"""Points of the smooth curve in a segment from which the kind of the knot is told."""


def tie(cable: Cable, segment_radii: float) -> Rod:
    """Tie the knot of a cable, pull it, and lay it level.

    Args:
        cable: cable with a knot.
        segment_radii: length of the segments of most rods, in radii.

    Returns:
        The cable as a rod at rest: the middle of its chord at x = y = 0, the chord along +x, its loop as level as it
        can lie, its lowest underside at z = 0, its natural curvature set.

    Raises:
        SceneError: if the cable is too short for its knot on one side of it, or the pulled knot does not come to rest
            or passes through itself.
    """
    knot = cable.knot
    if knot is None:
        raise ValueError("the cable has no knot")
    radius = cable.diameter_m / 2
    wanted = segment_m(radius, cable.youngs_modulus_pa, cable.density_kg_m3, segment_radii)
    segments = int(np.clip(round(cable.length_m / wanted), 8, 2000))
    length = cable.length_m / segments
    pulled = pull_knot(knot.kind, knot.loop_radius_m / radius, length / radius)
    before = round(knot.along * segments)
    nodes, tied = _cut(pulled, before, segments - before)
    nodes = _levelled(radius * nodes, tied)
    if knot.mirrored:
        nodes[:, 2] = -nodes[:, 2]
    nodes[:, 2] += radius - nodes[:, 2].min()
    return Rod(
        nodes_m=nodes,
        radius_m=radius,
        youngs_modulus_pa=cable.youngs_modulus_pa,
        density_kg_m3=cable.density_kg_m3,
        natural_curvature_per_m=knot.set_share * _curvature_about_vertical(nodes),
    )


def pull_knot(kind: KnotKind, loop_radii: float, segment_radii: float) -> Array:
    """Pull a knot until it rests.

    Args:
        kind: kind of the knot.
        loop_radii: radius R of its loop, to which a pull of EI / (2 R^2) tightens it, in radii of the cable.
        segment_radii: length of the segments, in radii of the cable.

    Returns:
        (N, 3) nodes in radii of the cable, N odd; the knot's middle is the middle node, and the pull is along x.

    Raises:
        SceneError: if the knot does not come to rest, or passes through itself.
    """
    simulation = pulled_rod(kind, loop_radii, segment_radii)
    still, chords = max(REST_SHARE * loop_radii, REST_RADII), []
    for _ in range(MOST_CHECKS):
        try:
            simulation.advance(CHECK_STEPS)
        except DivergedError as error:
            raise SceneError(f"the rod solver diverged {error} of the pull of a knot") from error
        nodes: Array = simulation.nodes_m(0) / PULLED_RADIUS_M
        chords.append(float(np.linalg.norm(nodes[-1] - nodes[0])))
        if len(chords) >= 2 * WINDOW_CHECKS:
            before, now = np.reshape(chords[-2 * WINDOW_CHECKS :], (2, WINDOW_CHECKS)).mean(axis=1)
            if abs(now - before) <= still:
                break
    else:
        raise SceneError(f"after {simulation.steps} time steps a pulled {kind} knot does not rest")
    if determinant(smooth(nodes, _SAMPLES)) != DETERMINANTS[kind]:
        raise SceneError(f"a pulled {kind} knot passed through itself: its loop of {loop_radii:.1f} radii is too tight")
    return nodes


def pulled_rod(kind: KnotKind, loop_radii: float, segment_radii: float, friction: float = 0.0) -> RodSimulation:
    """Lay a loose knot, and pull at its ends; see `pull_knot` for the arguments.

    Args:
        kind: kind of the knot.
        loop_radii: radius R of its loop, in radii of the rod.
        segment_radii: length of the segments, in radii of the rod.
        friction: Coulomb's coefficient of friction of the rod with itself.
    """
    nodes = PULLED_RADIUS_M * loose_knot(kind, loop_radii, segment_radii, TAIL_LOOPS * loop_radii)
    pull, pinned = np.zeros_like(nodes), np.zeros(len(nodes), np.bool_)
    rod = Rod(nodes, PULLED_RADIUS_M, PULLED_MODULUS_PA, PULLED_DENSITY_KG_M3, pinned=pinned, pull_n=pull)
    # Nothing else would stop the knot's drift; at rest the pin bears nothing.
    pinned[len(nodes) // 2] = True
    pull[-1, 0] = rod.bending_stiffness_n_m2 / (2 * (loop_radii * PULLED_RADIUS_M) ** 2)
    pull[0, 0] = -pull[-1, 0]
    surroundings = Surroundings(
        gravity_m_s2=(0.0, 0.0, 0.0), floor=False, friction_rods=friction, damping_s=PULLED_DAMPING_S
    )
    return RodSimulation([rod], surroundings, steps_per_s=STEPS_PER_S)


def _cut(nodes: Array, before: int, after: int) -> tuple[Array, NDArray[np.bool_]]:
    """Cut a pulled cable, or go straight on, so that it has given numbers of segments before and after its middle node.

    Returns:
        (before + after + 1, 3) nodes, and which of them belong to the knot.
    """
    middle, tied = len(nodes) // 2, _tied(nodes)
    first, last = np.flatnonzero(tied)[[0, -1]]
    length = float(np.linalg.norm(nodes[1] - nodes[0]))
    spare = np.ceil(LEAST_TAIL_RADII / length)
    if before < middle - first + spare or after < last - middle + spare:
        needed = (middle - first + spare, last - middle + spare)
        raise SceneError(
            f"the cable is too short for its knot, which takes {needed[0]:.0f} segments before its middle and "
            f"{needed[1]:.0f} after it, and has {before} and {after}"
        )
    longer = max(before, after) - middle
    if longer > 0:
        away = np.arange(1, longer + 1)[:, None] * np.array([length, 0.0, 0.0])
        nodes = np.concatenate([nodes[0] - away[::-1], nodes, nodes[-1] + away])
        tied = np.pad(tied, longer)
        middle += longer
    part = slice(middle - before, middle + after + 1)
    return nodes[part].copy(), tied[part]


def _tied(nodes: Array) -> NDArray[np.bool_]:
    """Tell which nodes (N, 3), in radii, lie between the first and the last that touch another part of the cable."""
    length = float(np.linalg.norm(nodes[1] - nodes[0]))
    apart = np.linalg.norm(nodes[:, None] - nodes[None], axis=2)
    places = np.arange(len(nodes))
    far = np.abs(places[:, None] - places[None]) * length > NEIGHBOUR_RADII
    # Nodes of two crossing parts may miss each other by half a segment.
    touching = np.flatnonzero((far & (apart < TOUCH_RADII + length / 2)).any(axis=1))
    tied: NDArray[np.bool_] = (places >= touching[0]) & (places <= touching[-1])
    return tied


def _levelled(nodes: Array, tied: NDArray[np.bool_]) -> Array:
    """Turn a cable so that its chord is along +x from -x, and the tied part spreads least along z.

    The middle of the chord is the origin; the tied part bulges to +y.
    """
    nodes = nodes - (nodes[0] + nodes[-1]) / 2
    along = nodes[-1] / np.linalg.norm(nodes[-1])
    across = nodes[tied] - np.outer(nodes[tied] @ along, along)
    wide = np.linalg.eigh(np.cov(across.T))[1][:, -1]
    wide -= (wide @ along) * along
    wide /= np.linalg.norm(wide)
    # A figure-eight knot bulges as much to either side; then its second half decides.
    bulge = across[len(across) // 2] @ wide
    if abs(bulge) < _LEAST_BULGE * np.abs(across @ wide).max():
        bulge = across[len(across) // 2 :].mean(axis=0) @ wide
    wide *= np.sign(bulge)
    turned: Array = nodes @ np.stack([along, wide, np.cross(along, wide)], axis=1)
    return turned


def _curvature_about_vertical(nodes: Array) -> Array:
    """Compute the present curvature (N,) about the vertical, in 1/m, as `Rod.natural_curvature_per_m` defines it."""
    edges = np.diff(nodes, axis=0)
    length = float(np.linalg.norm(edges[0]))
    turn = edges[:-1, 0] * edges[1:, 1] - edges[:-1, 1] * edges[1:, 0]
    cosine = np.einsum("ij,ij->i", edges[:-1], edges[1:]) / length**2
    curvature = np.zeros(len(nodes))
    curvature[1:-1] = turn / length**3 / np.maximum(cosine, MOST_TURN_COSINE)
    return curvature
