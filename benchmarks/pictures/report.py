"""The tables and the JSON file of the pictures' figures."""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from rich.table import Table

from benchmarks.physics.report import machine
from benchmarks.pictures.promises import Promise
from benchmarks.pictures.reference import PHOTOGRAPHS, PUBLISHED, Range
from benchmarks.pictures.survey import FIGURES, Distribution, MeasuredPicture, Summary
from farm.spec.category import Category

Summaries = Mapping[Category | None, Summary]

_HEADS = {
    "coverage": "coverage, %",
    "grey_level": "grey level",
    "grey_deviation": "deviation",
    "width_px": "width, px",
    "crossings": "crossings",
    "background_edges": "edges, %",
}
_IN_PERCENT = frozenset({"coverage", "background_edges"})


def words(group: Category | None) -> str:
    """A group's name in a table or a plot."""
    return "all" if group is None else group.removesuffix("_light").replace("_", " ")


def head(figure: str) -> str:
    """A figure's name and unit in a table or a plot."""
    return _HEADS[figure]


def scaled(figure: str, value: float) -> float:
    """A figure's value in the unit that its name in the table states."""
    return 100.0 * value if figure in _IN_PERCENT else value


def figures_table(name: str, summaries: Summaries) -> Table:
    """A table with one row per group of pictures: mean, standard deviation, and 5th, 50th and 95th percentile."""
    title = f"{name}: mean ± standard deviation; 5th, 50th, 95th percentile"
    table = Table(title=title, title_justify="left", show_lines=True)
    table.add_column("category")
    table.add_column("n", justify="right")
    for figure in FIGURES:
        table.add_column(head(figure), justify="right", no_wrap=True)
    for group, summary in summaries.items():
        cells = (_cell(figure, summary.figures[figure]) for figure in FIGURES)
        table.add_row(words(group), str(summary.pictures), *cells)
    for label, ranges in (("published examples", PUBLISHED), ("photographs", PHOTOGRAPHS)):
        table.add_row(label, "", *(_range(figure, ranges.get(figure)) for figure in FIGURES), style="dim")
    return table


def spread_table(summaries: Mapping[str, Summaries]) -> Table:
    """A table of the spread of colours and the seconds, with one row per group of pictures of each dataset."""
    table = Table(title="spread of colours, and time", title_justify="left")
    for number, title in enumerate(("dataset", "category", "n", "entropy, bits", "Hellinger distance", "s an image")):
        table.add_column(title, justify="right" if number > 1 else "left")
    for name, groups in summaries.items():
        for group, summary in groups.items():
            figures = (summary.entropy_bits, summary.hellinger, summary.seconds)
            cells = ("-" if math.isnan(value) else f"{value:.2f}" for value in figures)
            table.add_row("" if group else name, words(group), str(summary.pictures), *cells)
        table.add_section()
    return table


def coverage_table(coverage: Mapping[Category, Distribution]) -> Table:
    """A table with one row per category: the coverage of its labelled scenes, and the standard error of the mean."""
    table = Table(title="published: coverage of labelled scenes, %", title_justify="left")
    for number, title in enumerate(("category", "n", "mean ± standard error", "standard deviation")):
        table.add_column(title, justify="right" if number else "left")
    for category, found in coverage.items():
        mean, error = 100 * found.mean, 100 * found.deviation / math.sqrt(found.pictures)
        deviation = f"{100 * found.deviation:.2f}"
        table.add_row(words(category), str(found.pictures), f"{mean:.2f} ± {error:.2f}", deviation)
    return table


def promises_table(promises: Sequence[Promise]) -> Table:
    """A table with one row per promise."""
    table = Table(title="what the styles promise", title_justify="left")
    for title in ("style", "of", "asked", "found", ""):
        table.add_column(title)
    for promise in promises:
        verdict = "[green]PASS[/]" if promise.kept else "[bold red]MISS[/]"
        table.add_row(promise.style, promise.what, promise.asked, promise.found, verdict)
    return table


def write_json(
    path: Path,
    seed: int,
    measured: Mapping[str, Sequence[MeasuredPicture]],
    summaries: Mapping[str, Summaries],
    coverage: Mapping[Category, Distribution],
    promises: Sequence[Promise],
) -> None:
    """Write the figures of all groups and pictures, the coverage of labelled scenes, the promises and the machine."""
    content = {
        "machine": machine(),
        "seed": seed,
        "published_examples": {figure: asdict(known) for figure, known in PUBLISHED.items()},
        "photographs": {figure: asdict(known) for figure, known in PHOTOGRAPHS.items()},
        "labelled_coverage": {str(category): asdict(found) for category, found in coverage.items()},
        "promises": [asdict(promise) for promise in promises],
        "datasets": {
            name: {
                "groups": {words(group): asdict(summary) for group, summary in summaries[name].items()},
                "pictures": [
                    {"id": picture.job_id, "seconds": picture.seconds, **asdict(picture.figures)}
                    for picture in pictures
                ],
            }
            for name, pictures in measured.items()
        },
    }
    path.write_text(json.dumps(_without_nan(content), indent=1, allow_nan=False) + "\n")


def _cell(figure: str, found: Distribution) -> str:
    mean, deviation, *percentiles = (
        _number(scaled(figure, value)) for value in (found.mean, found.deviation, found.p5, found.p50, found.p95)
    )
    return f"{mean} ± {deviation}\n{' '.join(percentiles)}"


def _number(value: float) -> str:
    """A number with about three significant digits, and at most three after the point; "-" for NaN."""
    if math.isnan(value) or not value:
        return "-" if math.isnan(value) else "0"
    return f"{value:.0f}" if abs(value) >= 100 else f"{value:.1f}" if abs(value) >= 1 else f"{value:.3f}"


def _range(figure: str, known: Range | None) -> str:
    if known is None:
        return "-"
    low, high = scaled(figure, known.low), scaled(figure, known.high)
    return f"{low:g}" if low == high else f"{low:g} to {high:g}"


def _without_nan(content: Any) -> Any:
    """The same content with None in place of NaN, which JSON doesn't have."""
    if isinstance(content, dict):
        return {key: _without_nan(value) for key, value in content.items()}
    if isinstance(content, (list, tuple)):
        return [_without_nan(value) for value in content]
    return None if isinstance(content, float) and math.isnan(content) else content
