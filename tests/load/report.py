"""The tables, JSON files and plots of the load benchmarks."""

import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path

import matplotlib as mpl
from rich.table import Table

from benchmarks.physics.report import machine
from tests.load.jobs import JobCost
from tests.load.reading import ReadingCost
from tests.load.submission import SubmissionCost

mpl.use("Agg")
from matplotlib import pyplot as plt  # the backend must be chosen first


def jobs_table(costs: Sequence[JobCost]) -> Table:
    """A table with one row per number of workers."""
    table = Table(title="jobs through the queue, stand-in renderer", title_justify="left")
    for name in (
        "workers",
        "jobs",
        "jobs/s",
        "CPU ms a job",
        "of it workers",
        "Redis",
        "coordinator",
        "idle: Redis ms/s",
    ):
        table.add_column(name, justify="right")
    for cost in costs:
        parts = (cost.workers_s, cost.redis_s, cost.coordinator_s)
        shares = [f"{1000 * seconds / cost.jobs:.2f}" for seconds in parts]
        idle = f"{1000 * cost.idle_redis_s:.1f}"
        table.add_row(str(cost.workers), str(cost.jobs), f"{cost.jobs_per_s:.0f}", f"{cost.cpu_ms:.2f}", *shares, idle)
    return table


def submission_table(costs: Sequence[SubmissionCost]) -> Table:
    """A table with one row per size."""
    table = Table(title="farm submit", title_justify="left")
    for name in ("images", "seconds", "CPU s", "peak MiB", "waiting", "Redis MiB"):
        table.add_column(name, justify="right")
    for cost in costs:
        table.add_row(
            f"{cost.images:,}",
            f"{cost.wall_s:.2f}",
            f"{cost.cpu_s:.2f}",
            f"{cost.peak_mib:.0f}",
            f"{cost.waiting:,}",
            f"{cost.redis_mib:.1f}",
        )
    return table


def reading_table(costs: Sequence[ReadingCost]) -> Table:
    """A table with one row per command and size."""
    table = Table(title="commands on a finished dataset", title_justify="left")
    for name in ("command", "images", "store's ms", "seconds", "CPU s", "peak MiB", "manifests read", "files read"):
        table.add_column(name, justify="left" if name == "command" else "right")
    for cost in costs:
        figures = (f"{cost.seconds:.1f}", f"{cost.cpu_s:.1f}", f"{cost.peak_mib:.0f}")
        counts = (f"{cost.reads_of_manifests:,}", f"{cost.reads:,}")
        table.add_row(cost.command, f"{cost.images:,}", f"{cost.latency_ms:g}", *figures, *counts)
    return table


def write_json(
    path: Path, costs: Sequence[JobCost] | Sequence[SubmissionCost] | Sequence[ReadingCost], seed: int
) -> None:
    """Write every figure, and a description of the machine."""
    path.write_text(
        json.dumps({"machine": machine(), "seed": seed, "costs": [asdict(cost) for cost in costs]}, indent=1)
    )


def plot_jobs(path: Path, costs: Sequence[JobCost]) -> None:
    """Draw throughput and overhead over the number of workers."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.5), layout="constrained")
    workers = [cost.workers for cost in costs]
    left.plot(workers, [cost.jobs_per_s for cost in costs], "o-")
    left.set(xlabel="workers", ylabel="jobs a second", ylim=(0, None), xticks=workers)
    bottom = [0.0] * len(costs)
    places = [str(number) for number in workers]
    for name in ("workers_s", "redis_s", "coordinator_s"):
        heights = [1000 * float(getattr(cost, name)) / cost.jobs for cost in costs]
        right.bar(places, heights, bottom=bottom, label=name.removesuffix("_s"))
        bottom = [low + height for low, height in zip(bottom, heights, strict=True)]
    right.set(xlabel="workers", ylabel="CPU ms a job")
    right.legend()
    figure.savefig(path, dpi=120)
    plt.close(figure)


def plot_submissions(path: Path, costs: Sequence[SubmissionCost]) -> None:
    """Draw seconds and memory over the size."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.5), layout="constrained")
    images = [cost.images for cost in costs]
    left.plot(images, [cost.wall_s for cost in costs], "o-")
    left.set(xlabel="images", ylabel="seconds", xscale="log", ylim=(0, None))
    right.plot(images, [cost.peak_mib for cost in costs], "o-", label="farm submit")
    right.plot(images, [cost.redis_mib for cost in costs], "s-", label="Redis")
    right.set(xlabel="images", ylabel="MiB", xscale="log", ylim=(0, None))
    right.legend()
    figure.savefig(path, dpi=120)
    plt.close(figure)
