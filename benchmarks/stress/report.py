"""The tables of the extremes, and the JSON file and the plot of the whole stress test."""

import json
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import asdict
from enum import Enum
from pathlib import Path
from typing import Literal

import matplotlib as mpl
import numpy as np
from rich.table import Table

from benchmarks.physics.gates import StressFault
from benchmarks.stress.drawn import DrawnResult
from benchmarks.stress.drawn_report import draw_depths, draw_seconds
from benchmarks.stress.play import Result
from benchmarks.stress.scenes import AXES, Axis, Case, Scale, Start

mpl.use("Agg")
from matplotlib import pyplot as plt  # the backend must be chosen first
from matplotlib.axes import Axes

_PARTS = 4
_PLANES = (("radius", "modulus"), ("wind", "drop"), ("steps", "density"))
_MARKS = dict(zip(StressFault, "vsxPDo", strict=True))


def replay_command(case: Case, out: Path) -> str:
    """The command that plays this one scene again."""
    return f"python -m benchmarks stress --out {out} --seed {case.seed} --runs {case.runs} --only {case.number}"


def failures(results: Iterable[Result], out: Path) -> list[str]:
    """A line for each run that failed: the reason, and the command that plays it again."""
    return [
        f"{result.fault.value} ({result.detail}), {result.case.start.value}: {replay_command(result.case, out)}"
        for result in results
        if result.fault
    ]


def axis_table(results: Sequence[Result]) -> Table:
    """A table of failures and runs in each quarter of each axis."""
    table = _table("failures of runs in each quarter of each axis", "axis", "from", "1st", "2nd", "3rd", "4th", "to")
    for axis in AXES:
        values = np.array([getattr(result.case, axis.name) for result in results])
        inner = [axis.at(part / _PARTS) for part in range(1, _PARTS)]
        part = np.searchsorted(inner, values, side="right")
        failed = np.array([result.fault is not None for result in results])
        cells = [f"{np.count_nonzero(failed[part == n])}/{np.count_nonzero(part == n)}" for n in range(_PARTS)]
        table.add_row(f"{axis.name} {axis.unit}", f"{axis.low:g}", *cells, f"{max(axis.high, *values):g}")
    return table


def kind_table(results: Sequence[Result]) -> Table:
    """A table of runs and faults by start, placement and mixture."""
    table = _table("faults by kind of scene", "scenes", "runs", *(fault.value for fault in StressFault))
    rows = {start.value: [each for each in results if each.case.start is start] for start in Start}
    rows["aligned"] = [each for each in results if each.case.aligned]
    rows["mixed"] = [each for each in results if each.case.mixed]
    rows["all"] = list(results)
    for name, those in rows.items():
        count = Counter(result.fault for result in those)
        table.add_row(name, str(len(those)), *(str(count[fault]) for fault in StressFault))
    return table


def gate_table(results: Sequence[Result]) -> Table:
    """A table of gates 1 to 4: the worst figure, and the numbers of runs off target and beyond the bound.

    Runs that were cut off are left out, as their cables still move.
    """
    table = _table(
        "gates 1 to 4 over all runs that ended", "figure", "worst", "in run", "off target", "beyond the bound"
    )
    measured = [result for result in results if result.figures and not result.cut]
    for gate in measured[0].gates if measured else ():
        figures = [result.gates[gate] for result in measured]
        worst = int(np.argmax(figures))
        off = sum(not gate.on_target(figure) for figure in figures)
        beyond = sum(gate.is_broken_by(figure) for figure in figures)
        name = f"{gate.value.name} {gate.value.unit}"
        table.add_row(name, f"{figures[worst]:.3g}", str(measured[worst].case.number), str(off), str(beyond))
    return table


def slowest_table(results: Sequence[Result], count: int = 5) -> Table:
    """A table of the runs that took longest."""
    columns = ("run", "CPU s", "steps", "simulated s", "cables", "radius m", "wind m/s")
    table = _table("the slowest runs", "start", *columns)
    for result in sorted(results, key=lambda each: -each.cpu_s)[:count]:
        case = result.case
        cells = (case.number, f"{result.cpu_s:.1f}", result.steps, f"{result.fall_s:.2f}", case.cables)
        table.add_row(case.start.value, *map(str, cells), f"{case.radius:.2g}", f"{case.wind:.2g}")
    return table


def summary(results: Sequence[Result]) -> str:
    """A few sentences on what the tables leave out."""
    undone, slips = (sum(getattr(each, name) for each in results) for name in ("undone", "end_slips"))
    deepest = max(
        (each.figures.cable_penetration_max for each in results if each.figures and not each.cut), default=0.0
    )
    sunk = sum(each.sunk_nodes > 0 for each in results)
    failed = sum(each.fault is not None for each in results)
    return (
        f"{failed} of {len(results)} runs failed. On the way {undone} passages were undone and {slips} slipped round "
        f"an end; in {sunk} runs a centreline dipped below the floor. Deepest place at the end: {deepest:.3g} radii. "
        f"{sum(each.cut for each in results)} runs were cut off before they rested."
    )


def write_json(path: Path, extremes: Sequence[Result], drawn: Sequence[DrawnResult]) -> None:
    """Write every scene and its result."""
    content = {
        name: [asdict(result) | _figures(result) for result in results]
        for name, results in (("extremes", extremes), ("drawn", drawn))
    }
    path.write_text(json.dumps(content, indent=1, default=_plain) + "\n")


def write_plot(path: Path, extremes: Sequence[Result], drawn: Sequence[DrawnResult]) -> None:
    """Draw the extremes over pairs of axes, with marks for their faults, and the drawn scenes' depths and seconds."""
    figure = plt.figure(figsize=(15, 10), layout="constrained")
    halves = figure.subfigures(2, 1, squeeze=False)
    above, below = halves[0, 0], halves[1, 0]
    if extremes:
        planes = above.subplots(1, len(_PLANES))
        for plane, names in zip(planes, _PLANES, strict=True):
            _draw_plane(plane, names, extremes)
        above.legend(*planes[0].get_legend_handles_labels(), loc="outside lower center", ncols=len(_MARKS) + 1)
        failed = sum(result.fault is not None for result in extremes)
        above.suptitle(f"{len(extremes)} extremes of the rod solver, {failed} failed")
    if drawn:
        depth, seconds = below.subplots(1, 2)
        draw_depths(depth, drawn)
        draw_seconds(seconds, drawn)
        failed = sum(result.fault is not None for result in drawn)
        again = sum(result.again is not None for result in drawn)
        below.suptitle(f"{len(drawn)} drawn scenes, {failed} failed, {again} drawn again")
    figure.savefig(path, dpi=110)
    plt.close(figure)


def _draw_plane(plane: Axes, names: tuple[str, str], results: Sequence[Result]) -> None:
    axes = {axis.name: axis for axis in AXES}
    places = np.array([[getattr(result.case, name) for name in names] for result in results])
    sound = np.array([result.fault is None for result in results])
    plane.plot(*places[sound].T, ".", color="0.7", markersize=4, label="sound")
    for fault, mark in _MARKS.items():
        those = np.array([result.fault is fault for result in results])
        if those.any():
            plane.plot(*places[those].T, mark, markersize=7, label=fault.value)
    across, up = (axes[name] for name in names)
    plane.set_xscale(_plot_scale(across))
    plane.set_yscale(_plot_scale(up))
    plane.set_xlabel(f"{across.name}, {across.unit}")
    plane.set_ylabel(f"{up.name}, {up.unit}")


def _plot_scale(axis: Axis) -> Literal["log", "linear"]:
    return "log" if axis.scale is Scale.LOGARITHMIC else "linear"


def _table(title: str, *columns: str) -> Table:
    table = Table(title=title)
    for number, name in enumerate(columns):
        table.add_column(name, justify="right" if number else "left")
    return table


def _figures(result: Result | DrawnResult) -> dict[str, object]:
    return {"figures": result.figures.model_dump() if result.figures else None}


def _plain(value: object) -> object:
    if isinstance(value, Enum):
        return value.value
    raise TypeError(f"{type(value).__name__} has no place in the JSON")
