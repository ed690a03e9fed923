"""The table, the JSON file and the plot of played scenarios."""

import json
import platform
from collections import Counter
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.patches import Rectangle
from rich import box
from rich.markup import escape
from rich.table import Table

from farm.machine import usable_cores
from tests.chaos.play import Outcome
from tests.chaos.schedule import Fault

mpl.use("Agg")
from matplotlib import pyplot as plt  # the backend must be chosen first

_COLUMNS = ("scenario", "jobs", "faults", "seconds", "begun again", "quarantined", "verdict")


def table(outcomes: Sequence[Outcome]) -> Table:
    """A table with a line for each scenario."""
    grid = Table(title="faults, and whether the farm held", box=box.SIMPLE_HEAD)
    for name in _COLUMNS:
        grid.add_column(name, justify="left" if name in {"scenario", "verdict"} else "right", no_wrap=True)
    for outcome in outcomes:
        grid.add_row(*_cells(outcome))
    played = [outcome for outcome in outcomes if outcome.skipped is None]
    grid.add_section()
    total = [
        "all",
        str(sum(outcome.jobs for outcome in played)),
        str(sum(len(outcome.struck) for outcome in played)),
        f"{sum(outcome.seconds for outcome in played):.0f}",
        str(sum(_again(outcome) for outcome in played)),
        str(sum(len(outcome.quarantined) for outcome in played)),
        f"{sum(outcome.held for outcome in played)} of {len(played)} held",
    ]
    grid.add_row(*total, style="bold")
    return grid


def _cells(outcome: Outcome) -> list[str]:
    if outcome.skipped is not None:
        return [outcome.scenario, str(outcome.jobs), "", "", "", "", "skipped"]
    return [
        outcome.scenario,
        str(outcome.jobs),
        str(len(outcome.struck)),
        f"{outcome.seconds:.0f}",
        str(_again(outcome)),
        str(len(outcome.quarantined)),
        "held" if outcome.held else "[red]FAILED[/]",
    ]


def _again(outcome: Outcome) -> int:
    """Starts beyond each job's first; if workers keep no journal of them, manifests beyond the first."""
    return outcome.written_again if outcome.starts is None else max(0, outcome.starts - outcome.jobs)


def remarks(outcomes: Sequence[Outcome]) -> list[str]:
    """Sentences on failures and their logs, on skipped faults and their reasons, and on other remarkable things."""
    lines = []
    for outcome in outcomes:
        if outcome.skipped is not None:
            lines.append(f"{outcome.scenario}: skipped: {escape(outcome.skipped)}")
        lines += [f"{outcome.scenario}: {escape(note)}" for note in outcome.notes]
        lines += [f"{outcome.scenario}: [red]{escape(finding)}[/]" for finding in outcome.findings]
        if outcome.left is not None:
            lines.append(f"{outcome.scenario}: its files and logs are in {outcome.left}")
    return lines


def write_json(path: Path, outcomes: Sequence[Outcome], seed: int, seconds: float) -> None:
    """Write all measurements.

    Args:
        path: path of the file.
        outcomes: outcomes of all scenarios.
        seed: seed that replays the faults.
        seconds: duration of the whole run.
    """
    content = {
        "seed": seed,
        "seconds": round(seconds, 1),
        "machine": {"cores": usable_cores(), "python": platform.python_version()},
        "jobs": sum(outcome.jobs for outcome in outcomes if outcome.skipped is None),
        "faults": sum(len(outcome.struck) for outcome in outcomes),
        "held": all(outcome.held for outcome in outcomes),
        "scenarios": [_as_json(outcome) for outcome in outcomes],
    }
    path.write_text(json.dumps(content, indent=1) + "\n")


def _as_json(outcome: Outcome) -> dict[str, Any]:
    return {
        "scenario": outcome.scenario,
        "verdict": "skipped" if outcome.skipped else "held" if outcome.held else "failed",
        "skipped": outcome.skipped,
        "jobs": outcome.jobs,
        "seconds": round(outcome.seconds, 2),
        "faults_scheduled": outcome.scheduled,
        "faults": Counter(struck.event.fault for struck in outcome.struck),
        "struck": [
            {**asdict(struck.event), "at_s": round(struck.at_s, 2), "done": struck.done} for struck in outcome.struck
        ],
        "starts": outcome.starts,
        "manifests_written_again": outcome.written_again,
        "restarts": outcome.restarts,
        "quarantined": outcome.quarantined,
        "findings": outcome.findings,
        "notes": outcome.notes,
    }


def write_plot(path: Path, outcomes: Sequence[Outcome]) -> None:
    """Draw the growth of each dataset and the moments of the faults; nothing if no scenario was played."""
    played = [outcome for outcome in outcomes if outcome.skipped is None]
    if not played:
        return
    columns = min(4, len(played))
    rows = -(-len(played) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(4 * columns, 2.4 * rows), squeeze=False, layout="constrained")
    colours = {fault: mpl.colormaps["tab20"](number) for number, fault in enumerate(Fault)}
    for place in axes.flat[len(played) :]:
        place.set_axis_off()
    for place, outcome in zip(axes.flat, played, strict=False):
        times = [moment for moment, _ in outcome.growth]
        place.step([*times, outcome.seconds], [*(done for _, done in outcome.growth), outcome.growth[-1][1]], "k-")
        for struck in outcome.struck:
            end_s = struck.at_s + max(struck.event.lasts_s, outcome.seconds / 150)
            place.axvspan(struck.at_s, end_s, color=colours[struck.event.fault], alpha=0.6, linewidth=0)
        place.set_title(outcome.scenario + ("" if outcome.held else ": FAILED"), fontsize=9)
        place.set_xlim(0, outcome.seconds)
        place.set_ylim(0, outcome.jobs)
        place.tick_params(labelsize=7)
    shown = [fault for fault in Fault if any(struck.event.fault == fault for each in played for struck in each.struck)]
    handles = [Rectangle((0, 0), 1, 1, color=colours[fault], alpha=0.6) for fault in shown]
    if shown:
        figure.legend(handles, shown, loc="outside lower center", ncols=7, fontsize=8)
    figure.supylabel("images done over seconds", fontsize=9)
    figure.savefig(path, dpi=110)
    plt.close(figure)
