"""`python -m benchmarks skips`: the things left out of a picture, and the seconds that each saves."""

import json
import time
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

import matplotlib as mpl
import numpy as np
from rich.progress import track
from rich.table import Table

from benchmarks.bench_dataset import bench_header
from benchmarks.physics.report import machine
from benchmarks.physics.scenes import MOST_CABLES
from benchmarks.render.stage_set import SettledScene, Stage, settle
from benchmarks.skips.savings import Saving, Trial
from benchmarks.skips.skips import Skip, Skips
from benchmarks.terminal import bench_console, blender_writes_to
from farm.errors import VerificationError
from farm.spec.category import Category

mpl.use("Agg")
from matplotlib import pyplot as plt  # the backend must be chosen first

DEFAULT_SCENES = 2
"""Scenes of each category."""

RESOLUTION = 512
"""Edge of a picture, pixels: the default of a dataset."""

_REPEATS = 2
"""Repeats of each way, in turns; the fastest counts, as nothing but other work on the machine makes one slower."""


def run(
    out: Path,
    *,
    seed: int,
    scenes: int | None,
    resolution: int = RESOLUTION,
    categories: tuple[Category, ...] = tuple(Category),
) -> int:
    """Measure, print the table, write `skips.json` and `skips.png` into `out`.

    Args:
        out: existing folder for the results.
        seed: seed of the dataset whose scenes are used.
        scenes: number of scenes of each category; None for `DEFAULT_SCENES`.
        resolution: pixels along an edge.
        categories: categories of the scenes.

    Raises:
        VerificationError: if leaving something out changed a picture that it must not change.
        FarmError: if a scene can't be made.
    """
    console, log_file = bench_console(), out / "skips.log"
    header, crowded = bench_header(1, seed), bench_header(1, seed, ranges=MOST_CABLES)
    with blender_writes_to(log_file):
        stage = Stage(header, resolution)
        settled = list(settle(header, categories, scenes or DEFAULT_SCENES))
    skips = list(Skips(stage, header, crowded).all())
    trials: dict[str, list[Trial]] = {skip.name: [] for skip in skips}
    for scene in track(settled, "scenes", console=console, transient=True):
        with blender_writes_to(log_file):
            for skip in skips:
                if scene.job.category in skip.categories:
                    trials[skip.name].append(_try(skip, scene))
    savings = [Saving(skip, tuple(trials[skip.name])) for skip in skips if trials[skip.name]]
    console.print(_table(savings))
    _write_json(out / "skips.json", savings, seed)
    _write_plot(out / "skips.png", savings)
    wrong = [saving.skip.name for saving in savings if saving.is_wrong]
    if wrong:
        raise VerificationError(f"leaving these out may not change a picture, and did: {', '.join(wrong)}")
    return 0


def _try(skip: Skip, scene: SettledScene) -> Trial:
    """Make a scene both ways in turns; a first time, which loads what is kept, doesn't count."""
    skip.prepare(scene, True)()
    seconds: dict[bool, list[float]] = {True: [], False: []}
    pictures = {}
    for _ in range(_REPEATS):
        for skipped in (False, True):
            action = skip.prepare(scene, skipped)
            start = time.perf_counter()
            pictures[skipped] = action()
            seconds[skipped].append(time.perf_counter() - start)
    with_it, without = pictures[False], pictures[True]
    same = None if with_it is None or without is None else np.array_equal(with_it, without)
    return Trial(scene.job.category, min(seconds[False]), min(seconds[True]), same)


def _table(savings: Sequence[Saving]) -> Table:
    table = Table(title="seconds a picture of the categories that do without", title_justify="left")
    for number, name in enumerate(("left out", "stages", "categories", "with", "without", "saved", "saved, mix")):
        table.add_column(name, justify="right" if number > 2 else "left")
    for saving in savings:
        cells = (saving.with_s, saving.without_s, saving.with_s - saving.without_s, saving.mix_s)
        few = f"{len(saving.skip.categories)} of {len(Category)}"
        table.add_row(saving.skip.name, saving.skip.stages, few, *(f"{seconds:.3f}" for seconds in cells))
    return table


def _write_json(path: Path, savings: Sequence[Saving], seed: int) -> None:
    content = {
        "machine": machine(),
        "seed": seed,
        "skips": [
            {
                "left_out": saving.skip.name,
                "stages": saving.skip.stages,
                "with_s": saving.with_s,
                "without_s": saving.without_s,
                "saved_published_mix_s": saving.mix_s,
                "trials": [asdict(trial) for trial in saving.trials],
            }
            for saving in savings
        ],
    }
    path.write_text(json.dumps(content, indent=1, allow_nan=False) + "\n")


def _write_plot(path: Path, savings: Sequence[Saving]) -> None:
    figure, axes = plt.subplots(figsize=(9, 5), layout="constrained")
    bars = axes.barh([saving.skip.name for saving in savings], [saving.mix_s for saving in savings])
    axes.bar_label(bars, fmt="%.3f", fontsize="small")
    axes.invert_yaxis()
    axes.set_xscale("symlog", linthresh=0.01)
    axes.set_xlabel("seconds saved a picture, published mix")
    figure.savefig(path, dpi=110)
    plt.close(figure)
