"""The plot: each network's IoU on every test set, its loss, and its masks of a few test pictures."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import matplotlib as mpl
import numpy as np
from numpy.typing import NDArray

from benchmarks.training.examples import Examples
from benchmarks.training.outcome import Lesson

mpl.use("Agg")
from matplotlib import pyplot as plt  # the backend must be chosen first
from matplotlib.axes import Axes
from matplotlib.figure import SubFigure

_SHOWN = 3
"""Pictures of each test set that are drawn."""

_HIT, _FALSE_ALARM, _MISS = (255, 255, 255), (230, 60, 40), (60, 120, 255)


def write_plot(path: Path, lessons: Sequence[Lesson], tests: Mapping[str, Examples]) -> None:
    """Draw the plot.

    Args:
        path: path of the PNG file to write.
        lessons: the trained networks.
        tests: the test sets by name.
    """
    columns = len(tests) * (2 + len(lessons))
    figure = plt.figure(figsize=(1.6 * columns, 4.2 + 1.75 * _SHOWN), layout="constrained")
    figures, pictures = figure.subfigures(2, 1, squeeze=False, height_ratios=(4.2, 1.75 * _SHOWN))[:, 0]
    left, right = figures.subplots(1, 2, width_ratios=(1.6, 1))
    _draw_scores(left, lessons, tests)
    _draw_losses(right, lessons)
    for part, (name, examples) in zip(pictures.subfigures(1, len(tests), squeeze=False)[0], tests.items(), strict=True):
        _draw_pictures(part, name, examples, lessons)
    figure.savefig(path, dpi=90)
    plt.close(figure)


def _draw_scores(axes: Axes, lessons: Sequence[Lesson], tests: Mapping[str, Examples]) -> None:
    width = 0.8 / len(lessons)
    for number, lesson in enumerate(lessons):
        found = [lesson.scores(name, examples) for name, examples in tests.items()]
        places = np.arange(len(tests)) + width * (number + 0.5) - 0.4
        errors = np.nan_to_num([each.iou_error for each in found])
        bars = axes.bar(places, [each.mean_iou for each in found], 0.9 * width, yerr=errors, capsize=3)
        labels = [f"IoU {each.mean_iou:.3f}\nDice {each.mean_dice:.3f}" for each in found]
        axes.bar_label(bars, labels, padding=2, fontsize="small")
        bars.set_label(f"trained on {lesson.name}")
    axes.set_xticks(range(len(tests)), [f"tested on {name}" for name in tests])
    axes.set_ylim(0, 1)
    axes.set_ylabel("mean IoU of a picture, and its standard error")
    axes.legend(fontsize="small", loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=len(lessons), frameon=False)


def _draw_losses(axes: Axes, lessons: Sequence[Lesson]) -> None:
    for lesson in lessons:
        axes.plot(range(1, len(lesson.losses) + 1), lesson.losses, label=f"on {lesson.name}")
    axes.set_xlabel("epoch")
    axes.set_ylabel("training loss")
    axes.set_ylim(bottom=0)
    axes.grid(visible=True, color="0.9")
    axes.legend(fontsize="small")


def _draw_pictures(part: SubFigure, name: str, examples: Examples, lessons: Sequence[Lesson]) -> None:
    """Draw pictures spread evenly over the set, which is ordered by category."""
    part.suptitle(f"{name}: white hit, red false alarm, blue miss", fontsize="medium")
    chosen = np.linspace(0, len(examples) - 1, min(_SHOWN, len(examples))).round().astype(int)
    panels = part.subplots(len(chosen), 2 + len(lessons), squeeze=False)
    for number, (row, index) in enumerate(zip(panels, chosen, strict=True)):
        true = examples.masks[index]
        shown = [("picture", examples.pictures[index]), ("mask", overlay(true, true))]
        shown += [(f"trained on\n{lesson.name}", overlay(lesson.masks[name][index], true)) for lesson in lessons]
        for axes, (title, picture) in zip(row, shown, strict=True):
            axes.imshow(picture)
            axes.set_axis_off()
            if number == 0:
                axes.set_title(title, fontsize="small")


def overlay(seen: NDArray[np.bool_], true: NDArray[np.bool_]) -> NDArray[np.uint8]:
    """A picture (H, W, 3) that compares two masks (H, W): hits are white, false alarms red, misses blue."""
    picture = np.zeros((*true.shape, 3), np.uint8)
    picture[seen & true] = _HIT
    picture[seen & ~true] = _FALSE_ALARM
    picture[~seen & true] = _MISS
    return picture
