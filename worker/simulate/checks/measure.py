"""The ten gates that a simulator of cables must pass, as data, and the measurement of gates 1 to 4.

Gates 1 to 4 hold for every settled scene, whichever simulator made it. Gates 5 to 10 hold for a simulator:
`benchmarks.physics.gates` measures them on scenes laid out for the purpose and compares them with reference solutions.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from types import MappingProxyType

import numpy as np

from farm.dataset.manifest import SettleFigures
from worker.simulate.checks.contact import find_contacts, search_reach_m
from worker.simulate.checks.plan_view import find_crossings
from worker.simulate.checks.spans import cut
from worker.simulate.shapes import CableShapes


@dataclass(frozen=True, slots=True)
class Limits:
    """The limits of one figure.

    Attributes:
        number: the gate's number, 1 to 10.
        name: the figure in words.
        unit: the figure's unit; empty for a plain ratio or count.
        target: largest figure that is on target.
        never: largest figure with which a result may be used; inf if any may.
        least: smallest figure that is on target.
    """

    number: int
    name: str
    unit: str
    target: float
    never: float = np.inf
    least: float = -np.inf


NO_GRANTS: Mapping["Gate", float] = MappingProxyType({})
"""No grants: all of the gates' own targets hold."""


class Gate(Enum):
    """Every figure of the ten gates."""

    LENGTH = Limits(1, "length error", "", 0.001, never=0.01)
    CABLE_PENETRATION = Limits(2, "cable penetration over radius", "", 0.02, never=0.10)
    FLOOR_PENETRATION = Limits(2, "floor penetration over radius", "", 0.01, never=0.10)
    CABLE_PASS_THROUGH = Limits(3, "crossings of cables that passed through each other", "", 0, never=0)
    FLOOR_PASS_THROUGH = Limits(3, "cables that passed through the floor", "", 0, never=0)
    SPEED_RMS = Limits(4, "root mean square speed", "mm/s", 1.0, never=50.0)
    SPEED_MAX = Limits(4, "greatest speed", "mm/s", 5.0, never=50.0)
    CANTILEVER = Limits(5, "error of the cantilever's H/W up to 100", "", 0.01, never=0.10)
    SLENDER_CANTILEVER = Limits(5, "error of the cantilever's H/W above 100", "", 0.02, never=0.10)
    LIFT_OFF = Limits(6, "error of the lift-off length", "", 0.03, never=0.15)
    RIDGE_REACTION = Limits(6, "error of the ridge's reaction", "", 0.05, never=0.15)
    ENERGY_RISE = Limits(7, "energy rise in a step over the start's energy", "", 1e-6, never=1e-3)
    ORDER = Limits(8, "order in the time step", "", 1.1, least=0.9)
    STEP_HALVING = Limits(8, "movement of a node when the step is halved over radius", "", 0.5)
    REPEATS = Limits(9, "runs that differ from the first", "", 0, never=0)
    STRESS = Limits(10, "failed runs of the stress grid", "", 0, never=0)

    def on_target(self, figure: float, grants: Mapping["Gate", float] = NO_GRANTS) -> bool:
        """Whether the figure is on target; NaN is not.

        Args:
            figure: the measured figure.
            grants: targets that hold in place of the gates' own, as a simulator states them.
        """
        return bool(self.value.least <= figure <= grants.get(self, self.value.target))

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
    """Measure gates 1 to 4 of settled cables, and the other figures that decide whether a picture is sound.

    Penetration, air and crossings are those of the smooth centrelines that are rendered, with the true radii.

    A simulator that watches for passages tells how many there were. Then a crossing whose order is not that of the
    start heights only tells that a cable has slipped round another's end, has come to lie across one that it did not
    cross before, or was woven at the start. For any other simulator such a crossing counts as a passage unless it is
    close to an end: its cables start at stacked heights, and lie in that order wherever they have crossed all the
    time. It can't tell whether a cable went through itself: nothing says which strand was to be on top.

    Sticks count as cables do where rods cut, carry or cross each other or the floor; lengths, speeds and air are the
    cables' own. Pegs count where they cut into cables or carry them.

    Args:
        shapes: settled cables whose places and speeds are all finite.
    """
    spans = cut((*shapes.nodes_m, *shapes.sticks_m, *shapes.pegs_m))
    radii = np.concatenate([shapes.radii_m, shapes.stick_radii_m, shapes.peg_radii_m])
    fallen = len(radii) - len(shapes.pegs_m)
    near = spans.near_in_plan(search_reach_m(radii))
    contacts = find_contacts(spans, near, radii)
    crossings = find_crossings(spans, near)
    # A peg stands upright, so that nothing crosses it in plan view.
    ordered = np.maximum(crossings.one, crossings.other) < fallen
    flipped = crossings.flipped((*shapes.start_order, *range(fallen, len(radii)))) & ordered
    # No cable slips round the end of a stick, which lies below it from the start.
    near_end = crossings.near_end(radii) & (np.maximum(crossings.one, crossings.other) < len(shapes.radii_m))
    slips = flipped if shapes.passages is not None else flipped & near_end
    passages = shapes.passages if shapes.passages is not None else int(np.count_nonzero(flipped & ~near_end))
    above_floor = spans.cable_of_sample < fallen
    floor_depth = np.maximum(1 - (spans.samples_m[:, 2] / radii[spans.cable_of_sample])[above_floor], 0)
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
        pass_throughs=passages,
        end_slips=int(np.count_nonzero(slips)),
        floor_pass_throughs=int(np.count_nonzero(spans.lowest_m[:fallen] < 0)),
        self_crossings=int(np.count_nonzero(crossings.own)),
        speed_rms_mm_s=float(np.sqrt(np.mean(speeds**2))),
        speed_max_mm_s=float(speeds.max()),
        support_gap=float(gaps.max()),
    )


def _length_error(shapes: CableShapes) -> float:
    lengths = [float(np.linalg.norm(np.diff(nodes, axis=0), axis=1).sum()) for nodes in shapes.nodes_m]
    return float(np.max(np.abs(np.array(lengths) / shapes.lengths_m - 1)))
