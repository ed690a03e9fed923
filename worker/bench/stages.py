"""Seconds per stage and category, over real images that are written and verified."""

import json
import platform
import subprocess
import sys
import tempfile
import time
from collections import defaultdict
from collections.abc import Mapping
from pathlib import Path

import matplotlib as mpl
import numpy as np
from rich.progress import track
from rich.table import Table

from farm.category import Category
from farm.dataset import Destination, create_dataset
from farm.errors import VerificationError
from farm.verify import verify
from worker.bench.bench_dataset import bench_header, bench_jobs
from worker.bench.terminal import bench_console, blender_writes_to
from worker.studio import open_studio
from worker.upload import upload

mpl.use("Agg")
from matplotlib import pyplot as plt  # the backend must be chosen first

DEFAULT_IMAGES = 8
STAGES = ("randomize", "simulate", "check", "realize", "render", "mask", "write")

Seconds = Mapping[Category, Mapping[str, float]]


def run(out: Path, *, images: int | None, seed: int) -> int:
    """Measure, print the table, write `stages.json` and `stages.png` into `out`.

    Raises:
        FarmError: if an image can't be made, or the written dataset does not verify.
    """
    count = images or DEFAULT_IMAGES
    header = bench_header(count, seed)
    timings: dict[Category, list[Mapping[str, float]]] = defaultdict(list)
    console = bench_console()
    with tempfile.TemporaryDirectory(prefix="cable-farm-") as folder:
        dataset = create_dataset(Destination(folder, "bench"), header)
        log_file = out / "stages.log"
        start_s = _start_up_s()
        opening_s = time.perf_counter()
        with blender_writes_to(log_file):
            studio = open_studio(header, device="cpu", threads=0, assets=None)
        opening_s = time.perf_counter() - opening_s
        for job in track(bench_jobs(count), "images", console=console, transient=True):
            with blender_writes_to(log_file):
                manifest = upload(studio.make(job, header), job, dataset)
            timings[job.category].append(manifest.timings_s)
        verdict = verify(dataset)
    if verdict.findings:
        raise VerificationError(f"the benchmark's own images do not verify: {verdict.findings[0]}")
    seconds = {
        category: {stage: float(np.mean([t.get(stage, 0.0) for t in timings[category]])) for stage in STAGES}
        for category in Category
    }
    console.print(_table(seconds, count))
    console.print(f"once a process: start and load Blender {start_s:.2f} s, open the template {opening_s:.3f} s")
    _write(out, seconds, {"start": start_s, "open": opening_s}, count, seed)
    return 0


def _start_up_s() -> float:
    """Median seconds from the start of a process until Blender and the worker's stages are loaded in it."""
    command = [sys.executable, "-c", "import os, worker.studio; os._exit(0)"]
    seconds = []
    for _ in range(3):
        start = time.perf_counter()
        subprocess.run(command, check=True, capture_output=True)  # noqa: S603  # our own program
        seconds.append(time.perf_counter() - start)
    return float(np.median(seconds))


def _table(seconds: Seconds, count: int) -> Table:
    table = Table(title=f"mean seconds per image and stage, {count} images of each category, {platform.machine()} CPU")
    for name in ("category", *STAGES, "all"):
        table.add_column(name, justify="left" if name == "category" else "right")
    for category, stages in seconds.items():
        values = [*stages.values(), sum(stages.values())]
        table.add_row(category.value, *(f"{value:.3f}" for value in values))
    return table


def _write(out: Path, seconds: Seconds, once: Mapping[str, float], count: int, seed: int) -> None:
    content = {"images_per_category": count, "seed": seed, "seconds": seconds, "seconds_once_a_process": once}
    (out / "stages.json").write_text(json.dumps(content, indent=1) + "\n")
    figure, axes = plt.subplots(figsize=(9, 3.6), layout="constrained")
    left = np.zeros(len(seconds))
    for stage in STAGES:
        values = np.array([stages[stage] for stages in seconds.values()])
        axes.barh([category.value for category in seconds], values, left=left, label=stage)
        left += values
    axes.invert_yaxis()
    axes.set_xlabel("seconds an image")
    axes.legend(ncols=4, fontsize="small")
    figure.savefig(out / "stages.png", dpi=110)
    plt.close(figure)
