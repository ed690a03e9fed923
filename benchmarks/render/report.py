"""The tables, the JSON file, the plot and the calibration of the rendering benchmark."""

import json
import math
import os
import platform
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path

import matplotlib as mpl
import numpy as np
from rich import box
from rich.table import Table

from benchmarks.render.geometry import GeometryRow
from benchmarks.render.rows import Row, front
from benchmarks.render.variants import Group
from farm.spec.category import Background, Category, Light
from farm.spec.quality import REFERENCE, CalibratedSettings, Calibration, Preset, budget_of, cheapest

mpl.use("Agg")
from matplotlib import pyplot as plt  # the backend must be chosen first

_CALIBRATION_DIGITS = 4


def ladder_table(rows: Sequence[Row]) -> Table:
    """A table of seconds, FLIP and PSNR of the settings that a quality chooses from; each category's front is bold."""
    table = Table(title="seconds, mean FLIP, PSNR in dB", box=box.SIMPLE_HEAD, padding=0)
    table.add_column("setting", no_wrap=True)
    for category in Category:
        table.add_column(category.value.replace("_", " "), justify="right")
    fronts = {category: set(front(row for row in rows if row.category is category)) for category in Category}
    for name in dict.fromkeys(row.variant.name for row in rows):
        cells = {row.category: _cell(row, row in fronts[row.category]) for row in rows if row.variant.name == name}
        table.add_row(name, *(cells.get(category, "-") for category in Category))
    return table


def _cell(row: Row, bold: bool) -> str:
    text = f"{row.seconds:.2f} {row.flip:.3f} {row.psnr_db:.1f}"
    return f"[bold]{text}[/bold]" if bold else text


def turns_table(rows: Sequence[Row]) -> Table:
    """A table of each changed setting against the base: ratio of the seconds, and differences of FLIP and PSNR."""
    table = Table(title="one setting turned: seconds over the base's, FLIP and PSNR against it", box=box.SIMPLE_HEAD)
    table.add_column("setting", no_wrap=True)
    kinds = _kinds()
    for kind in kinds:
        table.add_column(kind, justify="right")
    base = {row.category: row for row in rows if row.variant.name == "base"}
    for name in dict.fromkeys(row.variant.name for row in rows if row.variant.name != "base"):
        those = {row.category: row for row in rows if row.variant.name == name}
        table.add_row(name, *(_turn(those, base, categories) for categories in kinds.values()))
    return table


_KIND_NAMES = {
    (Background.FLOOR, Light.CONCENTRATED): "lamp",
    (Background.FLOOR, Light.DISTRIBUTED): "HDRI over a floor",
    (Background.HDRI, Light.DISTRIBUTED): "far",
    (Background.HDRI, Light.CONCENTRATED): "lamp before an HDRI",
}


def _kinds() -> Mapping[str, Sequence[Category]]:
    """Categories that render alike, by what they have in common."""
    kinds: dict[str, list[Category]] = {}
    for category in Category:
        kinds.setdefault(_KIND_NAMES[category.traits.background, category.traits.light], []).append(category)
    return kinds


def _turn(rows: dict[Category, Row], base: dict[Category, Row], categories: Iterable[Category]) -> str:
    found = [(rows[category], base[category]) for category in categories if category in rows]
    if not found:
        return "-"
    factor = np.mean([row.seconds for row, _ in found]) / np.mean([other.seconds for _, other in found])
    flip = np.mean([row.flip - other.flip for row, other in found])
    decibels = np.mean([row.psnr_db - other.psnr_db for row, other in found])
    return f"{factor:.2f} x, {flip:+.4f}, {decibels:+.1f} dB"


def calibrate(rows: Sequence[Row]) -> Calibration:
    """The calibration from these rows: each category's front."""
    return Calibration(
        version=1,
        measured_on=f"{os.cpu_count()} cores, {platform.machine()}, no GPU",
        samples=REFERENCE.cycles.samples,
        scenes=min(len(row.shots) for row in rows),
        categories={
            category: tuple(
                CalibratedSettings(
                    settings=row.variant.settings,
                    seconds=round(row.seconds, _CALIBRATION_DIGITS),
                    flip=round(row.flip, _CALIBRATION_DIGITS),
                    psnr_db=round(row.psnr_db, 2),
                )
                for row in front(row for row in rows if row.category is category)
            )
            for category in Category
        },
    )


def verdicts(calibration: Calibration) -> Iterator[str]:
    """Sentences on the settings that each preset chooses in each category, or on the error by which it is missed."""
    for preset in (Preset.DRAFT, Preset.STANDARD):
        seconds, weights = 0.0, 0
        for category, rows in calibration.categories.items():
            budget = budget_of(preset, category)
            chosen = cheapest(rows, budget)
            if chosen is None:
                best = min(rows, key=lambda row: row.flip)
                yield f"{preset}, {category}: missed, the least FLIP is {best.flip:.3f} at {best.psnr_db:.1f} dB"
                continue
            cycles = chosen.settings.cycles
            yield (
                f"{preset}, {category}: {cycles.samples} spp, {chosen.seconds:.2f} s, "
                f"FLIP {chosen.flip:.3f} (at most {budget.flip:g}), {chosen.psnr_db:.1f} dB"
            )
            seconds += category.traits.weight * chosen.seconds
            weights += category.traits.weight
        if weights == sum(category.traits.weight for category in Category):
            yield f"{preset}: {seconds / weights:.2f} s over the published mix, building and rendering"


def write_json(path: Path, rows: Sequence[Row], shapes: Sequence[GeometryRow], *, seed: int) -> None:
    """Write all rows with all their shots."""
    content = {
        "seed": seed,
        "machine": {"cores": os.cpu_count(), "architecture": platform.machine()},
        "reference_samples": REFERENCE.cycles.samples,
        "geometry": [asdict(row) for row in shapes],
        "rows": [
            {
                "variant": row.variant.name,
                "group": row.variant.group,
                "category": row.category,
                "settings": row.variant.settings.model_dump(mode="json"),
                "seconds": row.seconds,
                "flip": row.flip,
                "psnr_db": row.psnr_db,
                "shots": [
                    {
                        "scene": shot.scene,
                        "realize_s": shot.build_s,
                        "render_s": shot.render_s,
                        "flip": shot.errors.flip,
                        "psnr_db": shot.errors.psnr_db,
                    }
                    for shot in row.shots
                ],
            }
            for row in rows
        ],
    }
    path.write_text(json.dumps(content, indent=1) + "\n")


_PANELS_A_LINE = 3
_SECONDS = (0.25, 0.5, 1.0, 2.0, 4.0, 8.0)
_FLIPS = (0.01, 0.02, 0.03, 0.05, 0.1)


def write_plot(path: Path, rows: Sequence[Row]) -> None:
    """Draw FLIP over seconds, a panel a category, with the front as a line and the budget of `standard`."""
    lines = math.ceil(len(Category) / _PANELS_A_LINE)
    figure, panels = plt.subplots(
        lines, _PANELS_A_LINE, figsize=(14, 3.75 * lines), layout="constrained", sharex=True, sharey=True
    )
    for axes in panels.flat[len(Category) :]:
        axes.set_axis_off()
    for axes, category in zip(panels.flat, Category, strict=False):
        those = [row for row in rows if row.category is category]
        for group, mark in ((Group.SAMPLES, "o"), (Group.UNGUIDED, "^"), (Group.PLAIN, "x"), (Group.ADAPTIVE, "s")):
            found = [row for row in those if row.variant.group is group]
            axes.loglog([row.seconds for row in found], [row.flip for row in found], mark, label=group, markersize=5)
        line = front(those)
        axes.loglog([row.seconds for row in line], [row.flip for row in line], "-", color="0.6", zorder=1)
        for row in line:
            samples = str(row.variant.settings.cycles.samples)
            axes.annotate(samples, (row.seconds, row.flip), xytext=(4, 4), textcoords="offset points", fontsize=7)
        axes.axhline(budget_of(Preset.STANDARD, category).flip, color="0.4", linestyle="--", linewidth=1)
        axes.set_title(category.value.replace("_", " "), fontsize="medium")
        axes.set_xticks(_SECONDS, [f"{seconds:g}" for seconds in _SECONDS])
        axes.set_yticks(_FLIPS, [f"{flip:g}" for flip in _FLIPS])
        axes.minorticks_off()
        axes.grid(visible=True, color="0.92")
        axes.set_xlabel("seconds, building and rendering")
        axes.set_ylabel("mean FLIP")
    panels.flat[0].legend(title="numbers: samples a pixel", fontsize="small")
    figure.savefig(path, dpi=110)
    plt.close(figure)
