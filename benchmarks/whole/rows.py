"""Seconds of each picture's stages, means by category and in the published mix, and ratios on the same scenes."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from benchmarks.render.errors import Errors
from farm.spec.category import Category
from farm.spec.job import Job

STAGES = ("randomize", "simulate", "check", "realize", "render", "mask", "write")
"""Stages of a picture in the order of results, by the names that manifests give them; `realize` builds the scene."""


class Way(StrEnum):
    """A way of making the picture of a scene."""

    STANDARD = "standard"
    PUBLISHED = "published"
    BLENDER = "Blender's defaults"
    BLENDERPROC = "BlenderProc's defaults"


@dataclass(frozen=True, slots=True)
class Shot:
    """One picture.

    Attributes:
        job: job of the picture.
        stages_s: seconds of each stage that the way has.
        errors: errors against the scene's reference; None without a reference.
    """

    job: Job
    stages_s: Mapping[str, float]
    errors: Errors | None = None


@dataclass(frozen=True, slots=True)
class Row:
    """A way, and its pictures."""

    way: Way
    shots: tuple[Shot, ...]

    @property
    def stages(self) -> tuple[str, ...]:
        """The stages that the way has, in their order."""
        return tuple(stage for stage in STAGES if any(stage in shot.stages_s for shot in self.shots))

    @property
    def categories(self) -> tuple[Category, ...]:
        """The categories that have a picture."""
        return tuple(category for category in Category if any(shot.job.category is category for shot in self.shots))

    def means_s(self, stages: Sequence[str]) -> Mapping[Category, float]:
        """Mean seconds of some stages together, by category."""
        return {
            category: float(
                np.mean(
                    [
                        sum(shot.stages_s.get(stage, 0.0) for stage in stages)
                        for shot in self.shots
                        if shot.job.category is category
                    ]
                )
            )
            for category in self.categories
        }

    def mix_s(self, stages: Sequence[str]) -> float:
        """Mean seconds of some stages together, in the published mix of categories."""
        return mix(self.means_s(stages))

    def errors(self, category: Category) -> tuple[Errors, ...]:
        """The errors of the category's pictures that have a reference."""
        those = [shot.errors for shot in self.shots if shot.job.category is category]
        return tuple(each for each in those if each is not None)

    def on(self, jobs: frozenset[Job]) -> "Row":
        """The same way, with the pictures of some jobs alone."""
        return Row(self.way, tuple(shot for shot in self.shots if shot.job in jobs))

    @property
    def jobs(self) -> frozenset[Job]:
        """The jobs of the pictures."""
        return frozenset(shot.job for shot in self.shots)


def mix(values: Mapping[Category, float]) -> float:
    """The mean over categories, each with its share of the published dataset.

    Raises:
        ValueError: if there is no category.
    """
    weights = sum(category.traits.weight for category in values)
    if not weights:
        raise ValueError("a mean needs at least one category")
    return sum(category.traits.weight * value for category, value in values.items()) / weights


@dataclass(frozen=True, slots=True)
class Ratio:
    """Seconds of a way, relative to those of the standard pictures of the same scenes.

    Attributes:
        slow_s: seconds an image in the published mix.
        standard_s: the same of the standard, over the same scenes and stages.
        by_category: ratio in each category.
    """

    way: Way
    stages: tuple[str, ...]
    scenes: int
    slow_s: float
    standard_s: float
    by_category: Mapping[Category, float]

    @property
    def value(self) -> float:
        """Time of the way, relative to the standard."""
        return self.slow_s / self.standard_s


def ratio(slow: Row, standard: Row, stages: Sequence[str] | None = None) -> Ratio:
    """Compare a way with the standard, by default over all stages that it has.

    Raises:
        ValueError: if they share no scene.
    """
    counted = tuple(stages or slow.stages)
    jobs = slow.jobs & standard.jobs
    if not jobs:
        raise ValueError(f"{slow.way} and {standard.way} share no scene")
    slow, standard = slow.on(jobs), standard.on(jobs)
    ours, theirs = standard.means_s(counted), slow.means_s(counted)
    return Ratio(
        way=slow.way,
        stages=counted,
        scenes=len(jobs),
        slow_s=mix(theirs),
        standard_s=mix(ours),
        by_category={category: theirs[category] / ours[category] for category in theirs},
    )
