"""Images per hour, from the moments at which pictures were finished; start-up is kept apart from the steady rate."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from benchmarks.farm.splits import Split

PUBLISHED_IMAGES = 25_000
"""Images of the published dataset."""
PUBLISHED_HOURS = 101.0
"""Hours that the published method took for the published dataset, on a PC with an RTX 3070."""


@dataclass(frozen=True, slots=True)
class Finished:
    """One picture of a run.

    Attributes:
        after_s: seconds from the run's start until the picture's manifest was written.
        opened: whether it was the first picture of its process, which opened the template for it.
    """

    after_s: float
    opened: bool


@dataclass(frozen=True, slots=True)
class Throughput:
    """One whole run of the farm.

    Attributes:
        split: numbers of workers and threads.
        finished: the pictures, the earliest first.
        wall_s: seconds from the command's start to its end.
        peak_mib: peak memory of all processes together, with shared pages counted once; None if the system doesn't
            measure it.
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
        """Images per hour while all workers work, from the pictures after every worker's first.

        If there are no such pictures, the rate of the whole run.
        """
        start_s = max(self.first_s, default=0.0)
        later = [each.after_s for each in self.finished if each.after_s > start_s]
        if later and self.first_s:
            return 3600.0 * len(later) / (later[-1] - start_s)
        return self.overall_images_per_hour

    @property
    def overall_images_per_hour(self) -> float:
        """Images per hour of the whole run, its start and its end included."""
        return 3600.0 * len(self.finished) / self.wall_s

    def hours(self, images: int = PUBLISHED_IMAGES) -> float:
        """Hours that a number of images would take, start-up included."""
        return max(self.first_s, default=0.0) / 3600.0 + images / self.images_per_hour


def best(runs: Sequence[Throughput]) -> Throughput:
    """The run with the most images per hour."""
    return max(runs, key=lambda run: run.images_per_hour)


def factors(runs: Sequence[Throughput]) -> Mapping[Split, float]:
    """Images per hour of each run, relative to one worker with one thread; empty without that run."""
    base = next((run for run in runs if run.split == Split(1, 1)), None)
    return {run.split: run.images_per_hour / base.images_per_hour for run in runs} if base else {}
