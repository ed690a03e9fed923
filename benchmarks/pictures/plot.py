"""The plot: the distribution of each figure by style and category, beside published examples and photographs."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl

from benchmarks.pictures.colour import Histogram, entropy_bits, mean_hellinger
from benchmarks.pictures.reference import PHOTOGRAPHS, PUBLISHED, WIDE
from benchmarks.pictures.report import head, scaled, words
from benchmarks.pictures.survey import FIGURES, MeasuredPicture, groups, values_of
from farm.spec.category import Category

mpl.use("Agg")
from matplotlib import pyplot as plt  # the backend must be chosen first
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

_Spread = Callable[[Sequence[Histogram]], float]

_PUBLISHED_LOOK: Mapping[str, Any] = {"facecolor": "gold", "edgecolor": "goldenrod", "alpha": 0.35}
_PHOTOGRAPHS_LOOK: Mapping[str, Any] = {"facecolor": "none", "edgecolor": "0.4", "hatch": "//", "linewidth": 1.0}
_PROMISE_LOOK: Mapping[str, Any] = {"color": "crimson", "linestyle": "--", "linewidth": 1.2}

_GROUPS = (None, *Category)
_TAKEN = 0.8
"""Share of a group's width that its boxes take; the rest separates the groups."""

_ROOT_SCALED = frozenset({"crossings", "background_edges"})
"""Figures drawn on a square-root scale, since they have many small values and a few large ones."""


def write_plot(path: Path, measured: Mapping[str, Sequence[MeasuredPicture]]) -> None:
    """Draw a panel for each figure, and two for the colours.

    Args:
        path: path of the PNG file to write.
        measured: measured pictures by the name of their dataset.
    """
    figure, panels = plt.subplots(4, 2, figsize=(15, 17), layout="constrained")
    flat = list(panels.flat)
    for axes, name in zip(flat, FIGURES, strict=False):
        _draw_boxes(axes, name, measured)
    spreads = (
        ("entropy of the colours, bits of at most 9", entropy_bits),
        ("mean Hellinger distance of two pictures' colours", mean_hellinger),
    )
    for axes, (label, spread) in zip(flat[len(FIGURES) :], spreads, strict=True):
        _draw_bars(axes, label, [_by_group(pictures, spread) for pictures in measured.values()])
    for axes in flat:
        axes.set_xticks(range(len(_GROUPS)), [words(group).replace(" ", "\n") for group in _GROUPS], fontsize="small")
        axes.grid(visible=True, axis="y", color="0.9")
        axes.set_axisbelow(True)
    figure.legend(handles=_legend(list(measured)), loc="outside upper center", ncols=3 + len(measured))
    figure.savefig(path, dpi=80)
    plt.close(figure)


def _draw_boxes(axes: Axes, figure: str, measured: Mapping[str, Sequence[MeasuredPicture]]) -> None:
    for ranges, look in ((PUBLISHED, _PUBLISHED_LOOK), (PHOTOGRAPHS, _PHOTOGRAPHS_LOOK)):
        if known := ranges.get(figure):
            axes.axhspan(scaled(figure, known.low), scaled(figure, known.high), **look)
    if promised := WIDE.get(figure):
        for end in (promised.low, promised.high):
            axes.axhline(scaled(figure, end), **_PROMISE_LOOK)
    for number, pictures in enumerate(measured.values()):
        by_group = groups(pictures)
        boxes = axes.boxplot(
            [[scaled(figure, value) for value in values_of(by_group.get(group, []), figure)] for group in _GROUPS],
            positions=_places(number, len(measured)),
            widths=0.85 * _TAKEN / len(measured),
            whis=(5, 95),
            showmeans=True,
            meanprops={"marker": "D", "markersize": 4, "markerfacecolor": "white", "markeredgecolor": "black"},
            medianprops={"color": "black"},
            flierprops={"marker": ".", "markersize": 3, "markeredgecolor": f"C{number}"},
            patch_artist=True,
        )
        for box in boxes["boxes"]:
            box.set_facecolor(f"C{number}")
    if figure in _ROOT_SCALED:
        axes.set_yscale("function", functions=(lambda value: abs(value) ** 0.5, lambda value: value**2))
    axes.set_ylabel(head(figure))
    axes.set_ylim(bottom=0)


def _draw_bars(axes: Axes, label: str, datasets: Sequence[Sequence[float]]) -> None:
    for number, values in enumerate(datasets):
        bars = axes.bar(_places(number, len(datasets)), values, width=0.85 * _TAKEN / len(datasets), color=f"C{number}")
        axes.bar_label(bars, fmt="%.2f", fontsize="x-small")
    axes.set_ylabel(label)


def _by_group(pictures: Sequence[MeasuredPicture], spread: _Spread) -> list[float]:
    by_group = groups(pictures)
    return [spread([picture.colours for picture in by_group.get(group, [])]) for group in _GROUPS]


def _places(number: int, datasets: int) -> list[float]:
    """Positions of a dataset's boxes: side by side with the others', around the middle of each group."""
    aside = _TAKEN * ((number + 0.5) / datasets - 0.5)
    return [group + aside for group in range(len(_GROUPS))]


def _legend(names: Sequence[str]) -> list[Artist]:
    known = [Patch(label="published examples", **_PUBLISHED_LOOK), Patch(label="photographs", **_PHOTOGRAPHS_LOOK)]
    promised = Line2D([], [], label="what `wide` promises to cover", **_PROMISE_LOOK)
    return [*(Patch(facecolor=f"C{number}", label=name) for number, name in enumerate(names)), *known, promised]
