"""Images an hour from when each picture was finished; the start of each process is told apart from the rest."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from benchmarks.farm.splits import Split

PUBLISHED_IMAGES = 25_000
PUBLISHED_HOURS = 101.0
"""What these took with the published method, on a PC with an RTX 3070."""


@dataclass(frozen=True, slots=True)
class Finished:
    """One picture of a run.

    Attributes:
        after_s: seconds from the run's start until its manifest was written.
        opened: whether its process opened the template for it, so that it was its first.
    """

    after_s: float
    opened: bool


@dataclass(frozen=True, slots=True)
class Throughput:
    """One whole run of the farm.

    Attributes:
        finished: its pictures, in their order.
        wall_s: seconds of the command, from its start to its end.
        peak_mib: most memory of all its processes together, shared pages counted once; None where it can't be told.
    """

    split: Split
    finished: tuple[Finished, ...]
    wall_s: float
    peak_mib: float | None

    @property
    def first_s(self) -> tuple[float, ...]:
        """Seconds from the run's start to the first picture of each worker's first process."""
        return tuple(each.after_s for each in self.finished if each.opened)[: self.split.workers]

    @property
    def images_per_hour(self) -> float:
        """While all workers work: of the pictures after every worker's first. All of them, if there are none after."""
        start_s = max(self.first_s, default=0.0)
        later = [each.after_s for each in self.finished if each.after_s > start_s]
        if later and self.first_s:
            return 3600.0 * len(later) / (later[-1] - start_s)
        return self.overall_images_per_hour

    @property
    def overall_images_per_hour(self) -> float:
        """Of the whole run, its start and its end included."""
        return 3600.0 * len(self.finished) / self.wall_s

    def hours(self, images: int = PUBLISHED_IMAGES) -> float:
        """For so many images, the start-up included."""
        return max(self.first_s, default=0.0) / 3600.0 + images / self.images_per_hour


def best(runs: Sequence[Throughput]) -> Throughput:
    """The one with most images an hour."""
    return max(runs, key=lambda run: run.images_per_hour)


def factors(runs: Sequence[Throughput]) -> Mapping[Split, float]:
    """Images an hour over those of one worker with one thread; empty without that run."""
    base = next((run for run in runs if run.split == Split(1, 1)), None)
    return {run.split: run.images_per_hour / base.images_per_hour for run in runs} if base else {}
