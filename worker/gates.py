"""The ten gates that a simulator of cables must pass, as data, and how each is measured.

Gates 1 to 4 hold for every settled scene, whichever simulator made it. Gates 5 to 10 hold for a simulator: they are
measured on scenes laid out for the purpose, and compare with the reference solutions in `worker.physics`.
"""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from farm.fall import Simulator
from farm.manifest import SettleFigures
from worker.physics.contact import find_contacts, search_reach_m
from worker.physics.elastica import droop_ratio
from worker.physics.plan_view import find_crossings
from worker.physics.ridge import RidgeCrossing, fit_lifted
from worker.physics.spans import cut
from worker.shapes import CableShapes, Points

STRESS_RUNS = 500
"""No failure in so many runs bounds the true rate at 0.6 %, with 95 % confidence."""


@dataclass(frozen=True, slots=True)
class Limits:
    """What is asked of one figure.

    Attributes:
        number: of the gate, 1 to 10.
        unit: empty for a plain ratio or count.
        target: what the figure is to be at most.
        never: above this the result is not used; inf where nothing is so bad.
        cloth_target: instead of `target` for Blender's cloth, where it is granted more.
        least: what the figure is to be at least.
    """

    number: int
    name: str
    unit: str
    target: float
    never: float = np.inf
    cloth_target: float | None = None
    least: float = -np.inf


class Gate(Enum):
    """Every figure of the ten gates."""

    LENGTH = Limits(1, "length error", "", 0.001, never=0.01, cloth_target=0.005)
    CABLE_PENETRATION = Limits(2, "cable penetration over radius", "", 0.02, never=0.10)
    FLOOR_PENETRATION = Limits(2, "floor penetration over radius", "", 0.01, never=0.10)
    CABLE_PASS_THROUGH = Limits(3, "crossings of cables that passed through each other", "", 0, never=0)
    FLOOR_PASS_THROUGH = Limits(3, "cables that passed through the floor", "", 0, never=0)
    SPEED_RMS = Limits(4, "root mean square speed", "mm/s", 1.0, never=50.0)
    SPEED_MAX = Limits(4, "greatest speed", "mm/s", 5.0, never=50.0)
    CANTILEVER = Limits(5, "error of the cantilever's H/W up to 100", "", 0.01, never=0.10, cloth_target=0.05)
    SLENDER_CANTILEVER = Limits(5, "error of the cantilever's H/W above 100", "", 0.02, never=0.10)
    LIFT_OFF = Limits(6, "error of the lift-off length", "", 0.03, never=0.15)
    RIDGE_REACTION = Limits(6, "error of the ridge's reaction", "", 0.05, never=0.15)
    ENERGY_RISE = Limits(7, "energy rise in a step over the start's energy", "", 1e-6, never=1e-3)
    ORDER = Limits(8, "order in the time step", "", 1.1, least=0.9)
    STEP_HALVING = Limits(8, "movement of a node when the step is halved over radius", "", 0.5)
    REPEATS = Limits(9, "runs that differ from the first", "", 0, never=0)
    STRESS = Limits(10, "failed runs of the stress grid", "", 0, never=0)

    def on_target(self, figure: float, simulator: Simulator = Simulator.ROD) -> bool:
        """Whether the figure is what is aimed for; NaN is not."""
        limits = self.value
        is_cloth = simulator is not Simulator.ROD
        target = limits.cloth_target if is_cloth and limits.cloth_target is not None else limits.target
        return bool(limits.least <= figure <= target)

    def is_broken_by(self, figure: float) -> bool:
        """Whether a result with this figure must not be used; NaN breaks every gate."""
        return not figure <= self.value.never


def settled_figures(figures: SettleFigures) -> Mapping[Gate, float]:
    """The figure of each of gates 1 to 4."""
    return {
        Gate.LENGTH: figures.length_error,
        Gate.CABLE_PENETRATION: figures.cable_penetration,
        Gate.FLOOR_PENETRATION: figures.floor_penetration,
        Gate.CABLE_PASS_THROUGH: figures.pass_throughs,
        Gate.FLOOR_PASS_THROUGH: figures.floor_pass_throughs,
        Gate.SPEED_RMS: figures.speed_rms_mm_s,
        Gate.SPEED_MAX: figures.speed_max_mm_s,
    }


def measure(shapes: CableShapes) -> SettleFigures:
    """Gates 1 to 4 of settled cables, and what else decides whether a picture is sound.

    Penetration, air and crossings are those of the smooth centrelines that are rendered, with the true radii. Cables
    start at stacked heights, so the order of a pair at every crossing is that of their start; another order means that
    one went through the other or, close to an end, that it may have slipped round it. Whether a cable went through
    itself can't be seen from where it rests: nothing says which strand was to be on top. See `worker.physics.passes`.

    Sticks count as cables do where rods cut, carry or cross each other or the floor; lengths, speeds and air are the
    cables' own.

    Args:
        shapes: finite; see `stress_fault` where they may not be.
    """
    spans = cut((*shapes.nodes_m, *shapes.sticks_m))
    radii = np.concatenate([shapes.radii_m, shapes.stick_radii_m])
    near = spans.near_in_plan(search_reach_m(radii))
    contacts = find_contacts(spans, near, radii)
    crossings = find_crossings(spans, near)
    flipped = crossings.flipped(shapes.start_order)
    # No cable slips round the end of a stick, which lies below it from the start.
    near_end = crossings.near_end(radii) & (np.maximum(crossings.one, crossings.other) < len(shapes.radii_m))
    floor_depth = np.maximum(1 - spans.samples_m[:, 2] / radii[spans.cable_of_sample], 0)
    gaps = (np.minimum(spans.lowest_m - radii, contacts.clearance_m) / radii)[: len(shapes.radii_m)]
    speeds = np.concatenate(shapes.speeds_m_s) * 1000
    return SettleFigures(
        fall_s=shapes.fall_s,
        steps=shapes.steps,
        length_error=_length_error(shapes),
        cable_penetration=float(np.percentile(contacts.depth, 99.9)),
        cable_penetration_max=float(contacts.depth.max()),
        floor_penetration=float(np.percentile(floor_depth, 99.9)),
        floor_penetration_max=float(floor_depth.max()),
        pass_throughs=int(np.count_nonzero(flipped & ~near_end)),
        end_slips=int(np.count_nonzero(flipped & near_end)),
        floor_pass_throughs=int(np.count_nonzero(spans.lowest_m < 0)),
        self_crossings=int(np.count_nonzero(crossings.own)),
        speed_rms_mm_s=float(np.sqrt(np.mean(speeds**2))),
        speed_max_mm_s=float(speeds.max()),
        support_gap=float(gaps.max()),
    )


def _length_error(shapes: CableShapes) -> float:
    lengths = [float(np.linalg.norm(np.diff(nodes, axis=0), axis=1).sum()) for nodes in shapes.nodes_m]
    return float(np.max(np.abs(np.array(lengths) / shapes.lengths_m - 1)))


@dataclass(frozen=True, slots=True)
class CantileverError:
    """Gate 5: |H/W over the reference - 1|, and the free length's slenderness w L^3 / EI."""

    slenderness: float
    error: float

    @property
    def gate(self) -> Gate:
        """Which row of the gate it is measured by."""
        return Gate.CANTILEVER if self.slenderness <= 100 else Gate.SLENDER_CANTILEVER


def cantilever_error(
    nodes_m: Points, *, bending_stiffness_n_m2: float, weight_per_length_n_m: float
) -> CantileverError:
    """Gate 5: a settled cantilever against the heavy elastica.

    Clamping the first two nodes fixes the slope of the edge between them, which is the slope at its middle; so the free
    length is (n - 1/2) l for n edges of length l. From the first node the error would be first order in 1/n.

    Args:
        nodes_m: (N, 3), N >= 3, from the clamp to the free end.
        bending_stiffness_n_m2: EI.
        weight_per_length_n_m: rho g A.

    Raises:
        ValueError: if the first edge is not level within 1e-3, or the slenderness has no reference.
    """
    edges = np.diff(nodes_m, axis=0)
    if abs(edges[0, 2]) > 1e-3 * np.linalg.norm(edges[0]):
        raise ValueError("the clamped edge is not level")
    free_length = float(np.linalg.norm(edges, axis=1).mean()) * (len(edges) - 0.5)
    slenderness = weight_per_length_n_m * free_length**3 / bending_stiffness_n_m2
    tip = nodes_m[-1] - (nodes_m[0] + nodes_m[1]) / 2
    droop = float(-tip[2] / np.hypot(tip[0], tip[1]))
    return CantileverError(slenderness, abs(droop / droop_ratio(slenderness) - 1))


@dataclass(frozen=True, slots=True)
class CrossingError:
    """Gate 6.

    Attributes:
        lift_off_error: |fitted half length in the air over the reference's - 1|.
        reaction_error: |force of the ridge over the reference's - 1|.
        misfit: root mean square distance from the fitted shape, over the lift; large where the fit means nothing.
    """

    lift_off_error: float
    reaction_error: float
    misfit: float


def crossing_error(
    nodes_m: Points, reactions_n: NDArray[np.float64], *, radius_m: float, reference: RidgeCrossing
) -> CrossingError:
    """Gate 6: a settled cable that lies across a rigid ridge against the beam on a floor.

    The height is fitted like the lift-off length, not imposed: a cable pressed into the ridge is gate 2's affair.

    Args:
        nodes_m: (N, 3), from end to end over one ridge; both ends lie on the floor, at height zero.
        reactions_n: (N,), upward force on each node from whatever it touches.
        radius_m: of the cable.
        reference: the crossing as it should be.

    Raises:
        ValueError: if fewer than four nodes are in the air.
    """
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(nodes_m[:, :2], axis=0), axis=1))])
    fit = fit_lifted(along, nodes_m[:, 2] - radius_m)
    # Between the ridge and half way to the touchdowns nothing else pushes.
    reaction = float(reactions_n[np.abs(along - fit.place_m) < fit.lift_off_m / 2].sum())
    return CrossingError(
        lift_off_error=abs(fit.lift_off_m / reference.lift_off_m - 1),
        reaction_error=abs(reaction / reference.ridge_reaction_n - 1),
        misfit=fit.misfit,
    )


def energy_rise(energies_j: NDArray[np.float64]) -> float:
    """Gate 7: greatest rise in one step over the start's energy; 0 if it never rises.

    Args:
        energies_j: (steps + 1,), kinetic, bending, stretching and height's energy together, the floor at zero.

    Raises:
        ValueError: if the start has no energy.
    """
    if energies_j[0] == 0:
        raise ValueError("the start has no energy to compare with")
    return float(np.maximum(np.diff(energies_j), 0).max() / abs(energies_j[0]))


def observed_orders(errors: tuple[float, float, float]) -> tuple[float, float]:
    """Gate 8: the order in the time step from errors at h, h/2 and h/4: from the first two, and from the last two.

    Raises:
        ValueError: if an error is not positive.
    """
    if not min(errors) > 0:
        raise ValueError("an order needs errors above zero")
    coarse, middle, fine = errors
    return float(np.log2(coarse / middle)), float(np.log2(middle / fine))


def largest_movement(one: CableShapes, other: CableShapes) -> float:
    """Gate 8: greatest distance between a node and itself in another run, over its cable's radius.

    Raises:
        ValueError: if the runs have not the same numbers of cables and nodes.
    """
    return max(
        float(np.linalg.norm(here - there, axis=1).max() / radius)
        for here, there, radius in zip(one.nodes_m, other.nodes_m, one.radii_m, strict=True)
    )


def same_bits(one: CableShapes, other: CableShapes) -> bool:
    """Gate 9: whether two runs agree to the last bit; 0 and -0 do not, NaN with the same bits does."""
    return all(_bits(getattr(one, field.name)) == _bits(getattr(other, field.name)) for field in fields(CableShapes))


def _bits(value: object) -> object:
    if isinstance(value, tuple):
        return tuple(_bits(each) for each in value)
    array = np.asarray(value)
    return array.dtype.str, array.shape, array.tobytes()


class StressFault(Enum):
    """How a run of the stress grid fails."""

    NOT_FINITE = "not finite"
    ESCAPED = "escaped"
    PASSED_THROUGH = "passed through"
    STRETCHED = "stretched"
    NOT_AT_REST = "not at rest"


def stress_fault(shapes: CableShapes, *, reach_m: float, passes: int | None = None) -> StressFault | None:
    """Gate 10: why a run failed, the first reason in the order of `StressFault`; None if it did not.

    Args:
        shapes: of the run's end, finite or not.
        reach_m: farther than this from the origin, in any direction, a cable has escaped.
        passes: how often a cable passed through one, as seen on the way; None: count them from the order of the start.
    """
    nodes, speeds = np.concatenate(shapes.nodes_m), np.concatenate(shapes.speeds_m_s)
    if not (np.isfinite(nodes).all() and np.isfinite(speeds).all()):
        return StressFault.NOT_FINITE
    if np.linalg.norm(nodes, axis=1).max() > reach_m:
        return StressFault.ESCAPED
    figures = measure(shapes)
    passes = figures.pass_throughs if passes is None else passes
    broken = {
        StressFault.PASSED_THROUGH: passes + figures.floor_pass_throughs > 0,
        StressFault.STRETCHED: Gate.LENGTH.is_broken_by(figures.length_error),
        StressFault.NOT_AT_REST: not Gate.SPEED_RMS.on_target(figures.speed_rms_mm_s)
        or not Gate.SPEED_MAX.on_target(figures.speed_max_mm_s),
    }
    return next((fault for fault, is_so in broken.items() if is_so), None)
