"""The table, the conclusions, the JSON file and the plot of the throughput benchmark."""

import json
from collections.abc import Iterator, Sequence
from pathlib import Path

import matplotlib as mpl
from rich.table import Table

from benchmarks.farm.rates import PUBLISHED_HOURS, PUBLISHED_IMAGES, Throughput, best, factors
from benchmarks.farm.splits import Split
from benchmarks.physics.report import machine

mpl.use("Agg")
from matplotlib import pyplot as plt  # the backend must be chosen first


def throughput_table(runs: Sequence[Throughput]) -> Table:
    """A table with one row per split."""
    names = ("workers x threads", "images", "first image s", "images/h", "s an image", "with start and end", "peak MiB")
    table = Table(title="`farm run`, published mix", title_justify="left")
    for number, name in enumerate((*names, "times 1x1", f"h for {PUBLISHED_IMAGES:,}")):
        table.add_column(name, justify="right" if number else "left", overflow="fold")
    over = factors(runs)
    for run in runs:
        table.add_row(
            str(run.split),
            str(len(run.finished)),
            ", ".join(f"{seconds:.1f}" for seconds in run.first_s),
            f"{run.images_per_hour:.0f}",
            f"{3600 / run.images_per_hour:.2f}",
            f"{run.overall_images_per_hour:.0f}",
            "-" if run.peak_mib is None else f"{run.peak_mib:.0f}",
            f"{over[run.split]:.2f}" if run.split in over else "-",
            f"{run.hours():.1f}",
        )
    return table


def conclusions(runs: Sequence[Throughput]) -> Iterator[str]:
    """Sentences on what a second process gains, which split is best, and how long the published dataset takes with it.

    Yields:
        One sentence at a time.
    """
    over = factors(runs)
    if Split(2, 1) in over:
        yield f"2 processes of one thread make {over[Split(2, 1)]:.2f} times as many images an hour as 1"
    fastest = best(runs)
    if len(runs) > 1:
        yield f"{fastest.split} wins: {fastest.images_per_hour:.0f} images an hour"
    yield (
        f"{PUBLISHED_IMAGES:,} images take {fastest.hours():.1f} h with {fastest.split}; published: "
        f"{PUBLISHED_HOURS:.0f} h on a PC with an RTX 3070"
    )


def write_json(path: Path, runs: Sequence[Throughput], seed: int) -> None:
    """Write every figure, and a description of the machine."""
    over = factors(runs)
    content = {
        "machine": machine(),
        "seed": seed,
        "published": {"images": PUBLISHED_IMAGES, "hours": PUBLISHED_HOURS},
        "best": str(best(runs).split),
        "runs": [
            {
                "workers": run.split.workers,
                "threads": run.split.threads,
                "images": len(run.finished),
                "first_image_s": run.first_s,
                "images_per_hour": run.images_per_hour,
                "images_per_hour_with_start_and_end": run.overall_images_per_hour,
                "times_one_worker_one_thread": over.get(run.split),
                "peak_memory_mib": run.peak_mib,
                "wall_s": run.wall_s,
                "hours_for_published_dataset": run.hours(),
                "finished_after_s": [each.after_s for each in run.finished],
            }
            for run in runs
        ],
    }
    path.write_text(json.dumps(content, indent=1, allow_nan=False) + "\n")


def write_plot(path: Path, runs: Sequence[Throughput]) -> None:
    """Draw the images finished over time, and the images per hour of each split."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(12, 4.2), layout="constrained", width_ratios=(1.5, 1))
    for run in runs:
        done = range(1, len(run.finished) + 1)
        left.step([each.after_s for each in run.finished], done, where="post", label=str(run.split))
    left.set_xlabel("seconds from the start of the command")
    left.set_ylabel("images finished")
    left.legend(title="workers x threads", fontsize="small")
    left.grid(visible=True, color="0.9")
    bars = right.bar([str(run.split) for run in runs], [run.images_per_hour for run in runs], color="C0")
    right.bar_label(bars, fmt="%.0f")
    right.set_xlabel("workers x threads")
    right.set_ylabel("images an hour, all workers working")
    figure.savefig(path, dpi=110)
    plt.close(figure)
