"""The plot: time against error of every setting, and the growth of the rods' cost with their number."""

from collections.abc import Sequence
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.lines import Line2D

from benchmarks.physics.contenders import Contender
from benchmarks.physics.rows import Row, is_rod_default
from benchmarks.physics.settings import COMPARED_COUNT, COUNTS

mpl.use("Agg")
from matplotlib import pyplot as plt  # the backend must be chosen first
from matplotlib.axes import Axes

_MARKS = {Contender.ROD: "o", Contender.CLOTH: "s", Contender.CLOTH_PUBLISHED: "^"}
_LABELS = {Contender.ROD: (60, 36), Contender.CLOTH: (45, 42), Contender.CLOTH_PUBLISHED: (0, -36)}
"""Offset of a default's label from its mark, in points, to where no other marks are."""

_COLOURS = dict(zip(COUNTS, mpl.colormaps["viridis"](np.linspace(0.9, 0.0, len(COUNTS))), strict=True))
_BEYOND = 1e4
"""Largest error that is drawn, relative to its target; larger and infinite ones are drawn here."""


def write_plot(path: Path, rows: Sequence[Row]) -> None:
    """Draw both panels."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(14, 5.6), layout="constrained", width_ratios=(1.5, 1))
    _draw_settings(left, [row for row in rows if row.cables in COUNTS])
    _draw_growth(right, [row for row in rows if is_rod_default(row)])
    figure.savefig(path, dpi=110)
    plt.close(figure)


def _draw_settings(axes: Axes, rows: Sequence[Row]) -> None:
    for row in rows:
        default = row.setting.is_default
        axes.plot(
            row.cpu_s,
            min(row.error, _BEYOND),
            _MARKS[row.setting.contender],
            color=_COLOURS[row.cables],
            markeredgecolor="black" if default else "white",
            markeredgewidth=1.6 if default else 0.5,
            markersize=9 if default else 7,
            zorder=3 if default else 2,
        )
        if default and row.cables == COMPARED_COUNT:
            axes.annotate(
                f"{row.setting.contender}\n{row.setting.name}",
                (row.cpu_s, min(row.error, _BEYOND)),
                xytext=_LABELS[row.setting.contender],
                textcoords="offset points",
                ha="center",
                va="center",
                fontsize="small",
                arrowprops={"arrowstyle": "-", "color": "0.5", "linewidth": 0.8, "shrinkB": 6},
            )
    axes.axhline(1.0, color="0.4", linewidth=1, linestyle="--")
    axes.text(0.005, 1.0, "target", transform=axes.get_yaxis_transform(), va="bottom", fontsize="small", color="0.4")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.margins(x=0.14, y=0.1)
    axes.set_xlabel("CPU seconds of a fall, mean over the scenes, one core")
    axes.set_ylabel("worst error over target: length, penetration, cantilever")
    axes.set_title("every setting; the farm's defaults are ringed", fontsize="medium")
    axes.grid(visible=True, which="major", color="0.9")
    axes.set_axisbelow(True)
    axes.legend(handles=_legend(rows), fontsize="small", loc="best")


def _legend(rows: Sequence[Row]) -> list[Line2D]:
    contenders = [each for each in _MARKS if any(row.setting.contender is each for row in rows)]
    shapes = [Line2D([], [], marker=_MARKS[each], color="0.5", linestyle="", label=each.value) for each in contenders]
    counts = [count for count in COUNTS if any(row.cables == count for row in rows)]
    names = [f"{count} cable{'s' if count > 1 else ''}" for count in counts]
    colours = [
        Line2D([], [], marker="o", color=_COLOURS[count], linestyle="", label=name)
        for count, name in zip(counts, names, strict=True)
    ]
    return shapes + colours


def _draw_growth(axes: Axes, rows: Sequence[Row]) -> None:
    counts = np.array([row.cables for row in rows], dtype=np.float64)
    costs = np.array([row.cost for row in rows])
    axes.plot(counts, costs, "o-", color="C0", label="a simulated second")
    axes.plot(counts, [row.cpu_s for row in rows], "o-", color="C1", label="a whole fall")
    middle = int(np.argmin(np.abs(counts - COMPARED_COUNT)))
    for slope, style in ((1, ":"), (2, "--")):
        line = costs[middle] * (counts / counts[middle]) ** slope
        axes.plot(counts, line, style, color="0.5", linewidth=1.2, label=f"slope {slope}")
    axes.set_xscale("log", base=2)
    axes.set_yscale("log")
    axes.set_xticks(counts, [f"{count:g}" for count in counts])
    axes.set_xlabel("cables")
    axes.set_ylabel("CPU seconds, one core")
    axes.set_title("rods at their default: cost against number of cables", fontsize="medium")
    axes.grid(visible=True, which="major", color="0.9")
    axes.set_axisbelow(True)
    axes.legend(fontsize="small", loc="upper left")
