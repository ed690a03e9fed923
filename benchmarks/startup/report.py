"""The tables, the JSON file and the plot of measured starts."""

import json
import platform
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from statistics import median

import matplotlib as mpl
from rich import box
from rich.table import Table

from benchmarks.startup.starts import Seconds, Start

mpl.use("Agg")
from matplotlib import pyplot as plt  # the backend must be chosen first

MAIN, CHILD, FIRST = "main process", "child", "first picture"

_Part = Callable[[Start], Seconds]
_PHASES: Mapping[str, _Part] = {
    MAIN: lambda start: {"interpreter": start.interpreter_s, **_named("import", start.main)},
    CHILD: lambda start: {**_named("import", start.child), "open the template, find the device": start.open_s},
    FIRST: lambda start: start.first,
}


def _named(prefix: str, seconds: Seconds) -> Seconds:
    return {f"{prefix} {name}": value for name, value in seconds.items()}


def start_table(starts: Sequence[Start], resolution: int) -> Table:
    """A table of the steps until the first picture."""
    title = f"seconds from a worker's start to its first picture of {resolution} pixels, {len(starts)} starts"
    table = Table(title=title, box=box.SIMPLE_HEAD)
    for name in ("", "step", "median", "least"):
        table.add_column(name, justify="right" if name in {"median", "least"} else "left", no_wrap=True)
    for phase, part in _PHASES.items():
        of_phase = [part(start) for start in starts]
        table.add_row(phase, "", *_cells([sum(each.values()) for each in of_phase]), style="bold")
        for step in of_phase[0]:
            table.add_row("", step, *_cells([each.get(step, 0.0) for each in of_phase]))
    table.add_section()
    table.add_row("all", "", *_cells([start.until_first_picture_s for start in starts]), style="bold")
    return table


def once_table(starts: Sequence[Start]) -> Table:
    """A table of the stages of the first picture and of the same one again; a process pays the difference once."""
    table = Table(title="median seconds of a process's first picture, and of the same again", box=box.SIMPLE_HEAD)
    for name in ("stage", "first", "again", "once a process"):
        table.add_column(name, justify="left" if name == "stage" else "right")
    for stage in starts[0].first:
        first, again = _of_stage(starts, stage)
        table.add_row(stage, f"{first:.3f}", f"{again:.3f}", f"{first - again:+.3f}")
    return table


def _of_stage(starts: Sequence[Start], stage: str) -> tuple[float, float]:
    return median(start.first[stage] for start in starts), median(start.second[stage] for start in starts)


def _cells(values: Sequence[float]) -> tuple[str, str]:
    return f"{median(values):.3f}", f"{min(values):.3f}"


def write_json(file: Path, starts: Sequence[Start], *, seed: int) -> None:
    """Write every start."""
    content = {
        "seed": seed,
        "machine": platform.machine(),
        "median_s": median(start.until_first_picture_s for start in starts),
        "least_s": min(start.until_first_picture_s for start in starts),
        "starts": [asdict(start) for start in starts],
    }
    file.write_text(json.dumps(content, indent=1) + "\n")


def write_plot(file: Path, starts: Sequence[Start]) -> None:
    """Draw the median steps one after the other."""
    figure, axes = plt.subplots(figsize=(9, 6), layout="constrained")
    left, colours = 0.0, dict(zip(_PHASES, ("tab:blue", "tab:orange", "tab:green"), strict=True))
    for phase, part in _PHASES.items():
        of_phase = [part(start) for start in starts]
        for number, step in enumerate(of_phase[0]):
            seconds = median(each.get(step, 0.0) for each in of_phase)
            # Both processes import the farm's own modules, so a bar's name holds the phase, too.
            axes.barh(f"{phase}: {step}", seconds, left=left, color=colours[phase], label=None if number else phase)
            left += seconds
    axes.invert_yaxis()
    axes.set_xlabel("seconds from the worker's start")
    axes.legend()
    figure.savefig(file, dpi=110)
    plt.close(figure)
