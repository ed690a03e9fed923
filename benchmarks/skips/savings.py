"""Seconds with and without something, and the seconds that leaving it out saves in the published mix."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from benchmarks.skips.skips import Skip
from farm.spec.category import Category


@dataclass(frozen=True, slots=True)
class Trial:
    """One scene, made both ways.

    Attributes:
        category: category of the scene.
        with_s: seconds with the thing that the farm leaves out.
        without_s: seconds without it, as the farm makes pictures.
        same: whether both pictures are the same to the byte; None if no picture is made.
    """

    category: Category
    with_s: float
    without_s: float
    same: bool | None


@dataclass(frozen=True, slots=True)
class Saving:
    """A skip, tried on scenes of all of its categories."""

    skip: Skip
    trials: tuple[Trial, ...]

    @property
    def with_s(self) -> float:
        """Mean seconds of a picture with the thing, over the skip's categories in the shares of the published mix."""
        return self._mean([trial.with_s for trial in self.trials])

    @property
    def without_s(self) -> float:
        """Mean seconds of a picture without it, over the same categories."""
        return self._mean([trial.without_s for trial in self.trials])

    @property
    def mix_s(self) -> float:
        """Mean seconds saved per picture of the published mix."""
        share = sum(category.traits.weight for category in self.skip.categories)
        return (self.with_s - self.without_s) * share / sum(category.traits.weight for category in Category)

    @property
    def is_wrong(self) -> bool:
        """Whether leaving it out changed a picture that it must not change."""
        return self.skip.same_picture and any(trial.same is False for trial in self.trials)

    def _mean(self, seconds: Sequence[float]) -> float:
        weights = [trial.category.traits.weight for trial in self.trials]
        return float(np.average(seconds, weights=weights))
