"""Gates 5 to 10, which a simulator must meet: the measurements on scenes laid out for the purpose."""

from dataclasses import dataclass, fields
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from benchmarks.physics.elastica import droop_ratio
from benchmarks.physics.ridge import RidgeCrossing, fit_lifted
from worker.curves import Points
from worker.simulate.checks.measure import Gate, measure
from worker.simulate.shapes import CableShapes

STRESS_RUNS = 500
"""Runs of the stress grid. No failure in this many bounds the true rate at 0.6 %, with 95 % confidence."""


@dataclass(frozen=True, slots=True)
class CantileverError:
    """The measurement of gate 5.

    Attributes:
        slenderness: slenderness w L^3 / EI of the free length.
        error: |H/W divided by the reference's - 1|.
    """

    slenderness: float
    error: float

    @property
    def gate(self) -> Gate:
        """The gate that bounds this slenderness."""
        return Gate.CANTILEVER if self.slenderness <= 100 else Gate.SLENDER_CANTILEVER


def cantilever_error(
    nodes_m: Points, *, bending_stiffness_n_m2: float, weight_per_length_n_m: float
) -> CantileverError:
    """Gate 5: a settled cantilever against the heavy elastica.

    Clamping the first two nodes fixes the slope of the edge between them, which is the slope at its middle; so the free
    length is (n - 1/2) l for n edges of length l. From the first node the error would be first order in 1/n.

    Args:
        nodes_m: (N, 3), N >= 3, from the clamp to the free end.
        bending_stiffness_n_m2: the cable's EI.
        weight_per_length_n_m: the cable's rho g A.

    Raises:
        ValueError: if the first edge isn't level within 1e-3, or the slenderness has no reference.
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
    """The measurement of gate 6.

    Attributes:
        lift_off_error: |fitted half length in the air divided by the reference's - 1|.
        reaction_error: |force of the ridge divided by the reference's - 1|.
        misfit: root mean square distance from the fitted shape, as a share of the lift; large if the fit means nothing.
    """

    lift_off_error: float
    reaction_error: float
    misfit: float


def crossing_error(
    nodes_m: Points, reactions_n: NDArray[np.float64], *, radius_m: float, reference: RidgeCrossing
) -> CrossingError:
    """Gate 6: a settled cable that lies across a rigid ridge against the beam on a floor.

    The height is fitted like the lift-off length, not imposed: gate 2 measures how far a cable is pressed into the
    ridge.

    Args:
        nodes_m: (N, 3), from end to end over one ridge; both ends lie on the floor, at height zero.
        reactions_n: (N,), upward force on each node from whatever it touches.
        radius_m: the cable's radius.
        reference: the crossing as it should be.

    Raises:
        ValueError: if fewer than four nodes are in the air.
    """
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(nodes_m[:, :2], axis=0), axis=1))])
    fit = fit_lifted(along, nodes_m[:, 2] - radius_m)
    # Between the ridge and half way to the touchdowns nothing but the ridge pushes.
    reaction = float(reactions_n[np.abs(along - fit.place_m) < fit.lift_off_m / 2].sum())
    return CrossingError(
        lift_off_error=abs(fit.lift_off_m / reference.lift_off_m - 1),
        reaction_error=abs(reaction / reference.ridge_reaction_n - 1),
        misfit=fit.misfit,
    )


def energy_rise(energies_j: NDArray[np.float64]) -> float:
    """Gate 7: the largest rise of the energy in one step, as a share of the start's; 0 if it never rises.

    Args:
        energies_j: sum of kinetic, bending, stretching and potential energy after each step, (steps + 1,), with the
            floor at height zero.

    Raises:
        ValueError: if the start has no energy.
    """
    if energies_j[0] == 0:
        raise ValueError("the start has no energy to compare with")
    return float(np.maximum(np.diff(energies_j), 0).max() / abs(energies_j[0]))


def observed_orders(errors: tuple[float, float, float]) -> tuple[float, float]:
    """Gate 8: the order of convergence in the time step, from the first two and from the last two errors.

    Args:
        errors: errors at time steps h, h/2 and h/4.

    Raises:
        ValueError: if an error isn't positive.
    """
    if not min(errors) > 0:
        raise ValueError("an order needs errors above zero")
    coarse, middle, fine = errors
    return float(np.log2(coarse / middle)), float(np.log2(middle / fine))


def largest_movement(one: CableShapes, other: CableShapes) -> float:
    """Gate 8: the largest distance between a node's places in two runs, in radii of its cable.

    Raises:
        ValueError: if the runs differ in the number of cables or nodes.
    """
    return max(
        float(np.linalg.norm(here - there, axis=1).max() / radius)
        for here, there, radius in zip(one.nodes_m, other.nodes_m, one.radii_m, strict=True)
    )


def same_bits(one: CableShapes, other: CableShapes) -> bool:
    """Gate 9: whether two runs agree to the last bit; 0 and -0 differ, and NaN equals NaN with the same bits."""
    return all(_bits(getattr(one, field.name)) == _bits(getattr(other, field.name)) for field in fields(CableShapes))


def _bits(value: object) -> object:
    if isinstance(value, tuple):
        return tuple(_bits(each) for each in value)
    array = np.asarray(value)
    return array.dtype.str, array.shape, array.tobytes()


class StressFault(Enum):
    """The reasons for which a run of the stress grid fails.

    Rods keep their length to rounding, so that of a sound run is on target, and not only within its bound.
    """

    NOT_FINITE = "not finite"
    ESCAPED = "escaped"
    PASSED_THROUGH = "passed through"
    STRETCHED = "stretched"
    PENETRATED = "penetrated"
    NOT_AT_REST = "not at rest"


def stress_fault(shapes: CableShapes, *, reach_m: float, passes: int | None = None) -> StressFault | None:
    """Gate 10: the reason why a run failed, the first in the order of `StressFault`; None if it didn't fail.

    Args:
        shapes: cables at the run's end, finite or not.
        reach_m: distance from the origin beyond which a cable has escaped.
        passes: number of times that a cable passed through one, as seen on the way; None to count them from the order
            of the start.
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
        StressFault.STRETCHED: not Gate.LENGTH.on_target(figures.length_error),
        StressFault.PENETRATED: Gate.CABLE_PENETRATION.is_broken_by(figures.cable_penetration)
        or Gate.FLOOR_PENETRATION.is_broken_by(figures.floor_penetration),
        StressFault.NOT_AT_REST: not Gate.SPEED_RMS.on_target(figures.speed_rms_mm_s)
        or not Gate.SPEED_MAX.on_target(figures.speed_max_mm_s),
    }
    return next((fault for fault, is_so in broken.items() if is_so), None)
