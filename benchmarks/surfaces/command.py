"""`python -m benchmarks surfaces`: CPU seconds of rendering each floor surface, relative to a plain one."""

import json
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

import cv2
import matplotlib as mpl
import numpy as np
from rich.progress import track
from rich.table import Table

from benchmarks.bench_dataset import bench_header
from benchmarks.physics.report import machine
from benchmarks.render.stage_set import SettledScene, Stage, settle
from benchmarks.surfaces.costs import MOST, SurfaceCost, too_costly
from benchmarks.terminal import bench_console, blender_writes_to
from farm.cli.installed_assets import InstalledAssets
from farm.scene.floor import JointFill, Wear
from farm.spec.category import Category
from farm.spec.header import DatasetHeader
from farm.spec.quality import Preset, settings_for
from farm.spec.styles import Style

mpl.use("Agg")
from matplotlib import pyplot as plt  # the backend must be chosen first

RESOLUTION = 512
"""Edge of a picture, pixels: the default of a dataset."""

CATEGORY = Category.CLOSE_CONCENTRATED
"""Category of the scenes: a floor close up, under a lamp."""

DEFAULT_SCENES = 1
"""Scenes that each surface is tried on, once as new and once with wear."""

_WEAR = Wear(
    brightness=1.0,
    tint=(1.0, 1.0, 1.0),
    saturation=1.0,
    contrast=1.0,
    stains=0.1,
    scratches=6.0,
    dust=0.2,
    mirrored=False,
    pattern_seed=0,
    joints=JointFill(albedo=(0.2, 0.18, 0.15), cover=0.8, spread_m=0.0003),
)
"""All kinds of wear at once, each at the middle of its range in the style `wide`."""

_REPEATS = 2
"""Repeats of each render, in turns with that of the plain surface; the cheapest counts."""

_MORE_REPEATS = 6
"""Repeats of a render that seems too costly: other work on the machine makes one dearer, never cheaper."""

_PLAIN_LEVEL = 150
"""Grey level of the plain surface."""


def run(out: Path, *, seed: int, scenes: int | None, only: Sequence[str] = ()) -> int:
    """Measure, print the table, write `surfaces.json` after each surface, and `surfaces.png` into `out`.

    CPU time is measured and not wall time, since other work on the machine affects it less.

    Args:
        out: existing folder for the results.
        seed: seed of the dataset whose scenes are used.
        scenes: number of scenes that each surface is tried on; None for `DEFAULT_SCENES`.
        only: names of the surfaces to try; all if empty.

    Raises:
        FarmError: if a scene can't be made.
    """
    console, log_file = bench_console(), out / "surfaces.log"
    with tempfile.TemporaryDirectory(prefix="cable-farm-") as folder:
        header = _header_with_plain(bench_header(1, seed), Path(folder))
        with blender_writes_to(log_file):
            stage = Stage(header, RESOLUTION)
            settled = [
                _with_floor(scene, wear=wear)
                for scene in settle(header, (CATEGORY,), scenes or DEFAULT_SCENES)
                for wear in (None, _WEAR)
            ]
        names = [surface.name for surface in header.surfaces[:-1] if not only or surface.name in only]
        costs: list[SurfaceCost] = []
        for name in track(names, "surfaces", console=console, transient=True):
            with blender_writes_to(log_file):
                plain = header.surfaces[-1].name
                cost = _measure(stage, settled, name, plain, _REPEATS)
                again = cost.ratio > MOST
                costs.append(_measure(stage, settled, name, plain, _MORE_REPEATS) if again else cost)
            _write_json(out / "surfaces.json", costs, seed)
    console.print(_table(costs))
    over = too_costly(costs)
    median = float(np.median([cost.ratio for cost in costs]))
    console.print(f"median {median:.3f} of a plain surface; {len(over)} of {len(costs)} above {MOST:.2f}")
    _write_plot(out / "surfaces.png", costs)
    return 0


def _header_with_plain(header: DatasetHeader, folder: Path) -> DatasetHeader:
    """A header with all of our surfaces and, as the last one, a surface of one grey."""
    cv2.imwrite(str(folder / "plain_colour.png"), np.full((64, 64, 3), _PLAIN_LEVEL, np.uint8))
    assets = InstalledAssets()
    surfaces = (*assets.builtin_surfaces(Style.WIDE), *assets.surfaces_in(folder))
    return header.model_copy(update={"surfaces": surfaces})


def _measure(stage: Stage, settled: Sequence[SettledScene], name: str, plain: str, repeats: int) -> SurfaceCost:
    cost, settings = SurfaceCost(name, (), (), (), ()), settings_for(Preset.STANDARD, CATEGORY).settings
    for scene in settled:
        render: dict[str, list[float]] = {name: [], plain: []}
        build: dict[str, list[float]] = {name: [], plain: []}
        for _ in range(repeats):
            for texture in (name, plain):
                shown = _with_floor(scene, texture=texture)
                build[texture].append(_cpu_s(partial(stage.set, shown, settings)))
                render[texture].append(_cpu_s(stage.render))
        cost = replace(
            cost,
            render_s=(*cost.render_s, min(render[name])),
            plain_render_s=(*cost.plain_render_s, min(render[plain])),
            build_s=(*cost.build_s, min(build[name])),
            plain_build_s=(*cost.plain_build_s, min(build[plain])),
        )
    return cost


def _with_floor(settled: SettledScene, **changed: object) -> SettledScene:
    """The same scene with some fields of its floor changed."""
    floor = settled.scene.floor
    assert floor is not None, "the category has floors"  # noqa: S101
    return replace(settled, scene=settled.scene.model_copy(update={"floor": floor.model_copy(update=changed)}))


def _cpu_s(action: Callable[[], object]) -> float:
    start = time.process_time()
    action()
    return time.process_time() - start


def _table(costs: Sequence[SurfaceCost]) -> Table:
    table = Table(title="CPU seconds of rendering, beside a plain surface", title_justify="left")
    for name in ("surface", "seconds", "plain", "ratio", "with setting the scene"):
        table.add_column(name, justify="left" if name == "surface" else "right")
    for cost in sorted(costs, key=lambda cost: -cost.ratio):
        seconds = (float(np.mean(cost.render_s)), float(np.mean(cost.plain_render_s)), cost.ratio, cost.whole_ratio)
        table.add_row(cost.name, *(f"{value:.3f}" for value in seconds))
    return table


def _write_json(path: Path, costs: Sequence[SurfaceCost], seed: int) -> None:
    rows = [
        {
            "surface": cost.name,
            "ratio": cost.ratio,
            "whole_ratio": cost.whole_ratio,
            "render_s": list(cost.render_s),
            "plain_render_s": list(cost.plain_render_s),
        }
        for cost in costs
    ]
    content = {"machine": machine(), "seed": seed, "limit": MOST, "surfaces": rows}
    path.write_text(json.dumps(content, indent=1, allow_nan=False) + "\n")


def _write_plot(path: Path, costs: Sequence[SurfaceCost]) -> None:
    ordered = sorted(costs, key=lambda cost: cost.ratio)
    figure, axes = plt.subplots(figsize=(8, 0.16 * len(costs) + 1.2), layout="constrained")
    axes.barh([cost.name for cost in ordered], [cost.ratio for cost in ordered])
    axes.axvline(1.0, color="black", linewidth=0.8)
    axes.axvline(MOST, color="red", linewidth=0.8)
    axes.tick_params(axis="y", labelsize=6)
    axes.set_xlim(0.5, max(1.2, ordered[-1].ratio + 0.05))
    axes.set_xlabel("CPU time of rendering over that of a plain surface")
    figure.savefig(path, dpi=110)
    plt.close(figure)
