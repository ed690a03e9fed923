"""The scenes that all simulators play: drawn like a dataset's, then cut or extended to a number of cables."""

from benchmarks.bench_dataset import PUBLISHED
from farm import __version__
from farm.scene.cable import Cable
from farm.scene.scene import Scene
from farm.spec.category import Category
from farm.spec.header import BuiltinSurfaceRef, DatasetHeader, HdriRef, TemplateRef
from farm.spec.job import Job
from farm.spec.parse import parse_spec
from farm.spec.styles import merge_tables
from worker.sample.scene import sample_scene

CATEGORIES = (Category.FAR, Category.FAR_ALIGNED)
"""Categories whose scenes fall: one of each disposition, without clutter."""

DRAWN_CABLES = 8
"""The most cables that a scene is drawn with."""

MOST_CABLES = {"cable": {"count": [DRAWN_CABLES, DRAWN_CABLES]}}
"""The ranges of a spec whose scenes all have `DRAWN_CABLES` cables."""

SPACING_M = 0.004
"""Height of each further cable above the one before, metres, as in drawn scenes."""

_JOBS_APART = 100_000
"""Step from the index of a scene's own job to those of the jobs from which its further cables come."""


def bench_scenes(count: int, cables: int, seed: int) -> tuple[Scene, ...]:
    """Scenes of a number of cables, the categories taking turns.

    A scene with fewer cables has the first cables of the same scene with more.

    Args:
        count: number of scenes.
        cables: number of cables of each.
        seed: seed of the dataset that the scenes are drawn as.
    """
    header = _header(seed)
    kinds = len(CATEGORIES)
    return tuple(crowd(header, CATEGORIES[number % kinds], number // kinds, cables) for number in range(count))


def crowd(header: DatasetHeader, category: Category, index: int, cables: int) -> Scene:
    """The scene of a job's first attempt, with a given number of cables; see `bench_scenes`.

    Args:
        header: a header that draws `DRAWN_CABLES` cables.
        category: the scene's category.
        index: the job's index in it.
        cables: number of the scene's cables.
    """
    scene = sample_scene(header, Job(category=category, index=index), 0)
    drawn: list[Cable] = list(scene.cables)
    further = index
    while len(drawn) < cables:
        further += _JOBS_APART
        drawn += sample_scene(header, Job(category=category, index=further), 0).cables
    lowest = drawn[0].start_height_m
    stacked = [
        cable if level < DRAWN_CABLES else cable.model_copy(update={"start_height_m": lowest + SPACING_M * level})
        for level, cable in enumerate(drawn[:cables])
    ]
    return scene.model_copy(update={"cables": tuple(stacked)})


def _header(seed: int) -> DatasetHeader:
    """A header whose surface and HDRI needn't exist, since nothing is rendered."""
    nothing = "0" * 64
    description = {**PUBLISHED, "images": DRAWN_CABLES, "seed": seed}
    return DatasetHeader(
        farm_version=__version__,
        spec=parse_spec(merge_tables(description, {"ranges": MOST_CABLES}), source="benchmark"),
        template=TemplateRef(path=None, sha256=nothing),
        surfaces=(BuiltinSurfaceRef(name="none", recipe_version=1),),
        hdris=(HdriRef(name="none", path=None, sha256=nothing, dark=False),),
    )
