"""The growth of the standard picture's cost with its resolution and with the number of its cables."""

from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

import numpy as np

from benchmarks.bench_dataset import bench_header
from benchmarks.physics.scenes import MOST_CABLES, crowd
from benchmarks.render.stage_set import SettledScene, Stage
from benchmarks.whole.plan import Plan
from benchmarks.whole.rows import STAGES
from benchmarks.whole.writing import write_files
from farm.scene.scene import Scene
from farm.spec.category import Category
from farm.spec.header import DatasetHeader
from farm.spec.job import Job
from worker.sample.scene import sample_scene
from worker.simulate.settle import let_fall
from worker.simulate.simulate import simulate
from worker.stopwatch import Stopwatch


class Axis(StrEnum):
    """The quantity that grows."""

    RESOLUTION = "resolution"
    CABLES = "cables"


@dataclass(frozen=True, slots=True)
class Point:
    """The mean picture of some scenes of a category.

    Attributes:
        axis: quantity that grows.
        category: category of the scenes.
        value: value of the quantity: pixels along an edge, or number of cables.
        scenes: number of scenes.
        stages_s: mean seconds of each stage.
    """

    axis: Axis
    category: Category
    value: int
    scenes: int
    stages_s: Mapping[str, float]

    @property
    def seconds(self) -> float:
        """Mean seconds of all stages together."""
        return sum(self.stages_s.values())


def power(few: Point, many: Point) -> float:
    """The exponent with which the seconds grow from one point to the other."""
    return float(np.log(many.seconds / few.seconds) / np.log(many.value / few.value))


def measure_growth(
    plan: Plan, stage: Stage, folder: Path, on_picture: Callable[[], None] = lambda: None
) -> tuple[Point, ...]:
    """Make the same scenes at every resolution with the drawn number of cables, and with every number of cables.

    Textures are read before a scene's clock runs. No scene is rejected, as one with many cables might be.

    Args:
        plan: the points, and the number of scenes for each.
        stage: the open template, with the assets of any header of the benchmark.
        folder: destination of the pictures.
        on_picture: called after each picture.

    Raises:
        FarmError: if a picture can't be made.
    """
    drawn, crowded = bench_header(1, plan.seed), bench_header(1, plan.seed, ranges=MOST_CABLES)
    found: dict[tuple[Axis, Category, int], list[Mapping[str, float]]] = defaultdict(list)
    for index in range(plan.growth_images):
        for category in plan.growth_categories:
            job = Job(category=category, index=index)
            warm = _settle(drawn, job, None, Stopwatch())
            stage.set(warm, drawn.rendering[category].settings, resolution=min(plan.resolutions, default=64))
            stage.render()
            for axis, value in points(plan):
                cables, resolution = (value, plan.resolution) if axis is Axis.CABLES else (None, value)
                header = crowded if cables else drawn
                found[axis, category, value].append(_make(header, stage, job, cables, resolution, folder))
                on_picture()
    return tuple(Point(*key, len(timings), _means(timings)) for key, timings in sorted(found.items()))


def _means(timings: Sequence[Mapping[str, float]]) -> Mapping[str, float]:
    return {stage: float(np.mean([each[stage] for each in timings])) for stage in STAGES}


def points(plan: Plan) -> Iterator[tuple[Axis, int]]:
    """The axis and the value of each point of a category."""
    yield from ((Axis.RESOLUTION, value) for value in plan.resolutions)
    yield from ((Axis.CABLES, value) for value in plan.counts)


def _settle(header: DatasetHeader, job: Job, cables: int | None, watch: Stopwatch) -> SettledScene:
    def draw(attempt: int) -> Scene:
        return sample_scene(header, job, attempt) if cables is None else crowd(header, job.category, job.index, cables)

    fall = let_fall(0, draw, lambda scene: simulate(scene, header.spec.simulator, header.spec.fall), watch)
    return SettledScene(job, fall.scene, fall.shapes)


def _make(
    header: DatasetHeader, stage: Stage, job: Job, cables: int | None, resolution: int, folder: Path
) -> Mapping[str, float]:
    watch, settings = Stopwatch(), header.rendering[job.category].settings
    settled = _settle(header, job, cables, watch)
    with watch.stage("realize"):
        stage.set(settled, settings, resolution=resolution)
    with watch.stage("render"):
        image = stage.render()
    with watch.stage("mask"):
        labels = stage.label()
    with watch.stage("write"):
        write_files(folder, image=image, **labels)
    return watch.stages_s
