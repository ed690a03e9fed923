"""The contenders of the comparison: the farm's simulators, and the published set-up."""

from collections.abc import Mapping
from enum import StrEnum

from farm.spec.simulation import Simulator
from worker.simulate.checks.measure import Gate
from worker.simulate.grants import grants_of


class Contender(StrEnum):
    """A way to let cables fall.

    `ROD` and `CLOTH` are the farm's simulators. `CLOTH_PUBLISHED` is the published set-up of eight cloth objects over
    100 frames, which no dataset can ask for: nothing warrants that it repeats.
    """

    ROD = "rod"
    CLOTH = "cloth"
    CLOTH_PUBLISHED = "cloth-published"

    @property
    def simulator(self) -> Simulator:
        """The farm's simulator whose settings and grants it has: its own, or the cloth for the published set-up."""
        return Simulator.CLOTH if self is Contender.CLOTH_PUBLISHED else Simulator(self.value)

    @property
    def grants(self) -> Mapping[Gate, float]:
        """The contender's targets that hold in place of the gates' own."""
        return grants_of(self.simulator)
