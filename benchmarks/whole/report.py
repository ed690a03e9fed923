"""The tables and the JSON file of the whole-image benchmark."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from rich.table import Table

from benchmarks.physics.report import machine
from benchmarks.whole.growth import Axis, Point, power
from benchmarks.whole.plan import Plan
from benchmarks.whole.rows import STAGES, Ratio, Row, mix, ratio
from farm.spec.category import Category

_RENDER = ("render",)


@dataclass(frozen=True, slots=True)
class Findings:
    """The results of a run.

    Attributes:
        plan: the plan of the run.
        standard: the farm's own pictures.
        slow: the other ways, on some of the same scenes.
        growth: points of the growth with resolution and with cables.
        start_s: seconds until Blender is loaded, once per process.
        open_s: seconds to open the template, once per process.
        peak_mib: peak resident memory of the process that made the standard pictures, MiB.
    """

    plan: Plan
    standard: Row
    slow: tuple[Row, ...]
    growth: tuple[Point, ...]
    start_s: float
    open_s: float
    peak_mib: float

    @property
    def rows(self) -> tuple[Row, ...]:
        """The standard way, then the others."""
        return (self.standard, *self.slow)

    def ratios(self) -> tuple[Ratio, ...]:
        """Each way relative to the standard: over all its stages, then over rendering alone if it has more stages."""
        found = []
        for row in self.slow:
            found += [ratio(row, self.standard)]
            found += [ratio(row, self.standard, _RENDER)] if row.stages != _RENDER else []
        return tuple(found)


def ratio_table(found: Findings) -> Table:
    """A table of the other ways' time relative to the standard, on the same scenes in the published mix."""
    names = ("way", "stages", "scenes", "s", "standard s", "times")
    table = _table("seconds an image over those of standard, the same scenes, published mix", *names)
    for each in found.ratios():
        seconds = (f"{each.slow_s:.2f}", f"{each.standard_s:.2f}")
        table.add_row(each.way, _stages(each), str(each.scenes), *seconds, f"[bold]{each.value:.1f}")
    return table


def ratio_by_category_table(found: Findings) -> Table:
    """A table of the other ways' relative time by category."""
    ratios = found.ratios()
    table = _table("the same by category", "category", *(f"{each.way}\n{_stages(each)}" for each in ratios))
    for category in Category:
        times = [each.by_category.get(category) for each in ratios]
        if any(times):
            table.add_row(category, *("-" if value is None else f"{value:.1f}" for value in times))
    return table


def _stages(compared: Ratio) -> str:
    return "all" if compared.stages == STAGES else " + ".join(compared.stages)


def stage_table(row: Row) -> Table:
    """A table of mean seconds of each stage, by category and in the published mix."""
    shots = len(row.shots)
    table = _table(f"{row.way}: mean seconds an image, {shots} images", "category", *row.stages, "all")
    columns = [row.means_s([stage]) for stage in row.stages] + [row.means_s(row.stages)]
    for category in row.categories:
        table.add_row(category, *(f"{column[category]:.3f}" for column in columns))
    mixed = [row.mix_s([stage]) for stage in row.stages] + [row.mix_s(row.stages)]
    table.add_row("[bold]published mix", *(f"[bold]{seconds:.3f}" for seconds in mixed))
    return table


def error_table(rows: Sequence[Row]) -> Table | None:
    """A table of mean errors against the references; None without references."""
    categories = [category for category in Category if any(row.errors(category) for row in rows)]
    if not categories:
        return None
    names = ("way", "category", "scenes", "FLIP mean", "PSNR dB mean")
    table = _table("errors against references", *names)
    for row in rows:
        for category in categories:
            errors = row.errors(category)
            if errors:
                flip, psnr = mean_errors(row, category)
                table.add_row(row.way, category, str(len(errors)), f"{flip:.4f}", f"{psnr:.2f}")
    for row in same_scenes(rows):
        flips, psnrs = ({category: mean_errors(row, category)[k] for category in row.categories} for k in (0, 1))
        table.add_row(
            row.way, "published mix, same scenes", str(len(row.shots)), f"{mix(flips):.4f}", f"{mix(psnrs):.2f}"
        )
    return table


def same_scenes(rows: Sequence[Row]) -> tuple[Row, ...]:
    """The ways that have errors, each reduced to the scenes that all of them have; empty if they share no scene."""
    known = [row.on(frozenset(shot.job for shot in row.shots if shot.errors)) for row in rows]
    compared = [row for row in known if row.shots]
    if not compared:
        return ()
    shared = frozenset.intersection(*(row.jobs for row in compared))
    return tuple(row.on(shared) for row in compared) if shared else ()


def mean_errors(row: Row, category: Category) -> tuple[float, float]:
    """Mean FLIP and mean PSNR in dB of the category's pictures that have a reference."""
    errors = row.errors(category)
    return float(np.mean([each.flip for each in errors])), float(np.mean([each.psnr_db for each in errors]))


def growth_table(points: Sequence[Point], axis: Axis) -> Table:
    """A table of seconds by resolution or number of cables, with the exponent of the growth from row to row."""
    those = [point for point in points if point.axis is axis]
    title = f"standard: mean seconds an image by {axis}, {those[0].scenes} scenes a category"
    table = _table(title, "category", axis, *STAGES, "all", "power")
    for before, point in zip([None, *those], those, strict=False):
        follows = before is not None and before.category is point.category
        table.add_row(
            point.category,
            str(point.value),
            *(f"{point.stages_s[stage]:.3f}" for stage in STAGES),
            f"{point.seconds:.3f}",
            f"{power(before, point):.2f}" if before is not None and follows else "",
        )
    return table


def tables(found: Findings) -> list[Table]:
    """All tables, the ratios first."""
    errors = error_table(found.rows)
    return [
        *([ratio_table(found), ratio_by_category_table(found)] if found.slow else []),
        *(stage_table(row) for row in found.rows),
        *([errors] if errors else []),
        *(growth_table(found.growth, axis) for axis in Axis if any(point.axis is axis for point in found.growth)),
    ]


def write_json(path: Path, found: Findings) -> None:
    """Write every figure, and a description of the machine."""
    content = {
        "machine": machine(),
        "plan": asdict(found.plan),
        "ratios": [asdict(each) | {"times": each.value} for each in found.ratios()],
        "ways": {row.way: _plain(row) for row in found.rows},
        "seconds_once_a_process": {"start": found.start_s, "open": found.open_s},
        "peak_memory_mib": found.peak_mib,
        "growth": [asdict(point) | {"seconds": point.seconds} for point in found.growth],
    }
    path.write_text(json.dumps(content, indent=1, allow_nan=False) + "\n")


def _plain(row: Row) -> Mapping[str, object]:
    errors = {category: mean_errors(row, category) for category in row.categories if row.errors(category)}
    return {
        "seconds": {
            category: {stage: row.means_s([stage])[category] for stage in row.stages} for category in row.categories
        },
        "published_mix_s": {stage: row.mix_s([stage]) for stage in row.stages} | {"all": row.mix_s(row.stages)},
        "errors": {category: {"flip": flip, "psnr_db": psnr} for category, (flip, psnr) in errors.items()},
        "images": [
            {"job": shot.job.id, "seconds": shot.stages_s, "errors": asdict(shot.errors) if shot.errors else None}
            for shot in row.shots
        ],
    }


def _table(title: str, *columns: str) -> Table:
    table = Table(title=title, title_justify="left")
    for number, name in enumerate(columns):
        table.add_column(name, justify="right" if number else "left", no_wrap=not number)
    return table
