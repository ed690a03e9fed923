"""The plot of the whole-image benchmark: every way's stages, and the growth of the standard picture's cost."""

from collections.abc import Sequence
from pathlib import Path

import matplotlib as mpl
import numpy as np

from benchmarks.whole.growth import Axis, Point
from benchmarks.whole.report import Findings
from benchmarks.whole.rows import STAGES, Row

mpl.use("Agg")
from matplotlib import pyplot as plt  # the backend must be chosen first
from matplotlib.axes import Axes


def write_plot(path: Path, found: Findings) -> None:
    """Draw the standard's stages by category, all ways in the published mix, and the growth."""
    figure, ((top_left, top_right), (left, right)) = plt.subplots(2, 2, figsize=(14, 9), layout="constrained")
    _draw_stages(top_left, found.standard)
    _draw_ways(top_right, found.rows)
    for axes, axis in ((left, Axis.RESOLUTION), (right, Axis.CABLES)):
        _draw_growth(axes, [point for point in found.growth if point.axis is axis], axis)
    figure.savefig(path, dpi=110)
    plt.close(figure)


def _draw_stages(axes: Axes, row: Row) -> None:
    names = [category.value for category in row.categories]
    left = np.zeros(len(names))
    for stage in row.stages:
        values = np.array(list(row.means_s([stage]).values()))
        axes.barh(names, values, left=left, label=stage)
        left += values
    axes.invert_yaxis()
    axes.set_xlabel("seconds an image")
    axes.set_title(f"{row.way}, by category", fontsize="medium")
    axes.legend(ncols=2, fontsize="small")


def _draw_ways(axes: Axes, rows: Sequence[Row]) -> None:
    """Draw every way's stages; each stage has its own bar, since bars can't be stacked on a logarithmic scale."""
    stages = [stage for stage in STAGES if any(row.mix_s([stage]) >= _LEAST_S for row in rows if stage in row.stages)]
    height = 0.8 / max(1, len(stages))
    for number, stage in enumerate(stages):
        places = [place + number * height for place, row in enumerate(rows) if stage in row.stages]
        values = [row.mix_s([stage]) for row in rows if stage in row.stages]
        axes.barh(places, values, height=height, label=stage, color=f"C{STAGES.index(stage)}")
    axes.set_yticks([place + 0.4 - height / 2 for place in range(len(rows))], [row.way.value for row in rows])
    axes.invert_yaxis()
    axes.set_xscale("log")
    axes.set_xlabel("seconds an image, published mix")
    axes.set_title("every way, by stage", fontsize="medium")
    axes.grid(visible=True, axis="x", color="0.9")
    axes.set_axisbelow(True)
    axes.legend(fontsize="small", loc="lower right")


_LEAST_S = 0.001
"""Least seconds of a stage that is drawn."""


def _draw_growth(axes: Axes, points: Sequence[Point], axis: Axis) -> None:
    if not points:
        axes.set_axis_off()
        return
    for number, category in enumerate(dict.fromkeys(point.category for point in points)):
        those = [point for point in points if point.category is category]
        values = [point.value for point in those]
        axes.plot(values, [point.seconds for point in those], "o-", color=f"C{number}", label=f"{category}, all")
        for stage, style in (("render", "--"), ("simulate", ":")):
            seconds = [point.stages_s[stage] for point in those]
            axes.plot(values, seconds, style, color=f"C{number}", label=f"{category}, {stage}")
    values = sorted({point.value for point in points})
    axes.set_xscale("log", base=2)
    axes.set_yscale("log")
    axes.set_xticks(values, [str(value) for value in values])
    axes.set_xlabel("pixels along an edge" if axis is Axis.RESOLUTION else "cables")
    axes.set_ylabel("seconds an image")
    axes.set_title(f"standard: cost by {axis}", fontsize="medium")
    axes.grid(visible=True, color="0.9")
    axes.set_axisbelow(True)
    axes.legend(fontsize="small")
