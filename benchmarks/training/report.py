"""The table and the JSON file of the pictures' worth for training."""

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from importlib.metadata import version
from pathlib import Path

from rich.table import Table

from benchmarks.physics.report import machine
from benchmarks.training.examples import EDGE_PX, Examples
from benchmarks.training.outcome import Lesson
from benchmarks.training.plan import Plan


def lessons_table(lessons: Sequence[Lesson], tests: Mapping[str, Examples]) -> Table:
    """A table with one row per network and one column per test set."""
    title = "IoU ± its standard error / Dice, mean over pictures; below, over all pixels"
    table = Table(title=title, title_justify="left", show_lines=True)
    table.add_column("trained on")
    table.add_column("pictures", justify="right")
    table.add_column("minutes", justify="right")
    for name, examples in tests.items():
        table.add_column(f"tested on {name} ({len(examples)})", justify="right", no_wrap=True)
    for lesson in lessons:
        cells = []
        for name, examples in tests.items():
            found = lesson.scores(name, examples)
            error = "" if math.isnan(found.iou_error) else f" ± {found.iou_error:.3f}"
            mean = f"{found.mean_iou:.3f}{error} / {found.mean_dice:.3f}"
            cells.append(f"{mean}\n{found.pixel_iou:.3f} / {found.pixel_dice:.3f}")
        table.add_row(lesson.name, str(lesson.pictures), f"{lesson.seconds / 60:.1f}", *cells)
    return table


def write_json(path: Path, plan: Plan, lessons: Sequence[Lesson], tests: Mapping[str, Examples]) -> None:
    """Write every score, the loss of every epoch, and a description of the machine."""
    content = {
        "machine": machine(),
        "torch": version("torch"),
        "seed": plan.seed,
        "epochs": plan.epochs,
        "edge_px": EDGE_PX,
        "networks": [
            {
                "trained_on": lesson.name,
                "pictures": lesson.pictures,
                "seconds": lesson.seconds,
                "losses": list(lesson.losses),
                "tested_on": {
                    name: {
                        key: None if math.isnan(value) else value
                        for key, value in asdict(lesson.scores(name, examples)).items()
                    }
                    for name, examples in tests.items()
                },
            }
            for lesson in lessons
        ],
    }
    path.write_text(json.dumps(content, indent=1, allow_nan=False) + "\n")
