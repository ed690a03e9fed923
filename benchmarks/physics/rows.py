"""The measurements at one setting on one number of cables, and comparisons of settings."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from benchmarks.physics.contenders import Contender
from benchmarks.physics.gates import CantileverError
from benchmarks.physics.settings import Setting
from farm.dataset.manifest import SettleFigures
from farm.errors import VerificationError
from worker.simulate.checks.measure import Gate, settled_figures

SCENE_GATES = (
    Gate.LENGTH,
    Gate.CABLE_PENETRATION,
    Gate.FLOOR_PENETRATION,
    Gate.CABLE_PASS_THROUGH,
    Gate.FLOOR_PASS_THROUGH,
    Gate.SPEED_RMS,
    Gate.SPEED_MAX,
)
"""Gates 1 to 4, which are measured on each scene."""

ERROR_GATES = (Gate.LENGTH, Gate.CABLE_PENETRATION, Gate.FLOOR_PENETRATION)
"""Gates that make up a scene's error; the others are counts, or say whether a fall had ended."""


@dataclass(frozen=True, slots=True)
class Played:
    """The measurements of one fall.

    Attributes:
        cpu_s: processor seconds of the whole process for the fall alone.
        fall_s: simulated seconds.
        steps: time steps of the rod solver, or frames of the cloth.
        figures: measured figures; None if the fall did not end in finite places.
        fault: the reason why there are no figures; empty if there are.
    """

    cpu_s: float
    fall_s: float
    steps: int
    figures: SettleFigures | None
    fault: str = ""

    @property
    def gates(self) -> Mapping[Gate, float]:
        """The figure of each of gates 1 to 4; infinite if nothing could be measured."""
        return settled_figures(self.figures) if self.figures else dict.fromkeys(SCENE_GATES, np.inf)


@dataclass(frozen=True, slots=True)
class Textbook:
    """Gates 5 and 6 at one setting; they don't depend on a scene.

    Attributes:
        cantilevers: error of each cantilever, infinite where it diverged or did not come to rest.
        lift_off_error: error of the lift-off length; None where it is not measured.
        reaction_error: error of the ridge's reaction; None where it is not measured.
    """

    cantilevers: tuple[CantileverError, ...]
    lift_off_error: float | None = None
    reaction_error: float | None = None

    @property
    def gates(self) -> Sequence[tuple[Gate, float]]:
        """Every figure with its gate."""
        crossing = ((Gate.LIFT_OFF, self.lift_off_error), (Gate.RIDGE_REACTION, self.reaction_error))
        found = [(each.gate, each.error) for each in self.cantilevers]
        return found + [(gate, figure) for gate, figure in crossing if figure is not None]

    @property
    def error(self) -> float:
        """Error of the worst cantilever, relative to its target."""
        return max((over_target(each.gate, each.error) for each in self.cantilevers), default=0.0)


@dataclass(frozen=True, slots=True)
class Row:
    """The measurements at one setting on one number of cables."""

    setting: Setting
    cables: int
    falls: tuple[Played, ...]
    textbook: Textbook

    @property
    def cpu_s(self) -> float:
        """Processor seconds of a fall, mean over the scenes."""
        return float(np.mean([fall.cpu_s for fall in self.falls]))

    @property
    def cpu_max_s(self) -> float:
        """Processor seconds of the slowest fall."""
        return max(fall.cpu_s for fall in self.falls)

    @property
    def fall_s(self) -> float:
        """Simulated seconds of a fall, mean over the scenes."""
        return float(np.mean([fall.fall_s for fall in self.falls]))

    @property
    def cost(self) -> float:
        """CPU seconds for a simulated second; 0 if nothing fell."""
        fallen = sum(fall.fall_s for fall in self.falls)
        return sum(fall.cpu_s for fall in self.falls) / fallen if fallen else 0.0

    @property
    def worst(self) -> Mapping[Gate, float]:
        """The worst figure of each of gates 1 to 4 over the scenes."""
        return {gate: float(np.max([fall.gates[gate] for fall in self.falls])) for gate in SCENE_GATES}

    @property
    def error(self) -> float:
        """The worst figure of gates 1, 2 and 5, relative to the rods' target."""
        worst = self.worst
        return max(self.textbook.error, *(over_target(gate, worst[gate]) for gate in ERROR_GATES))

    @property
    def off_target(self) -> int:
        """Number of scenes that miss one of the rods' targets in gates 1 to 4, whatever the simulator."""
        return sum(any(not gate.on_target(x) for gate, x in fall.gates.items()) for fall in self.falls)

    @property
    def broken(self) -> int:
        """Number of scenes with a figure that gates 1 to 4 never allow."""
        return sum(any(gate.is_broken_by(x) for gate, x in fall.gates.items()) for fall in self.falls)

    def meets(self, contender: Contender) -> bool:
        """Whether every scene and cantilever meets every target that `contender` has in gates 1 to 5."""
        granted = contender.grants
        scenes = (gate.on_target(x, granted) for fall in self.falls for gate, x in fall.gates.items())
        return all(scenes) and all(each.gate.on_target(each.error, granted) for each in self.textbook.cantilevers)

    @property
    def breaches(self) -> list[str]:
        """The figures of gates 1 to 6 that are never allowed, in words."""
        figures = [*self.textbook.gates, *((gate, x) for fall in self.falls for gate, x in fall.gates.items())]
        found = [f"{gate.value.name} {x:.3g} {gate.value.unit}".strip() for gate, x in figures if gate.is_broken_by(x)]
        return [fall.fault for fall in self.falls if fall.fault] + found


def over_target(gate: Gate, figure: float) -> float:
    """A figure relative to the rods' target; infinite if the figure isn't a finite number."""
    return abs(figure) / gate.value.target if np.isfinite(figure) else np.inf


def best(rows: Iterable[Row], targets: Contender) -> Row | None:
    """The fastest of the rows that meet all targets of one contender, None if none does."""
    return min((row for row in rows if row.meets(targets)), key=lambda row: row.cpu_s, default=None)


def closest(rows: Iterable[Row]) -> Row:
    """The row with the least error; among equal ones the fastest."""
    return min(rows, key=lambda row: (row.error, row.cpu_s))


def time_ratio(slow: Row, fast: Row) -> float:
    """CPU time of one row relative to another's, on the first scenes of each, which both played."""
    both = min(len(slow.falls), len(fast.falls))
    return sum(fall.cpu_s for fall in slow.falls[:both]) / sum(fall.cpu_s for fall in fast.falls[:both])


def growth(few: Row, many: Row) -> float:
    """The exponent with which the cost of a simulated second grows with the number of cables."""
    return float(np.log(many.cost / few.cost) / np.log(many.cables / few.cables))


def is_rod_default(row: Row) -> bool:
    """Whether the row is that of the rod solver's default."""
    return row.setting.contender is Contender.ROD and row.setting.is_default


def verify_default(rows: Iterable[Row]) -> None:
    """Check the rods at their default; the other settings are measured only to show what they cost.

    Raises:
        VerificationError: if a gate never allows one of the figures, or a fall has none.
    """
    for row in rows:
        if is_rod_default(row) and row.breaches:
            raise VerificationError(f"the rod solver's default, {row.cables} cables: {row.breaches[0]}")
