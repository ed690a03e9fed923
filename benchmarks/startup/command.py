"""`python -m benchmarks startup`: the time from a worker's start to its first picture, step by step."""

import tempfile
from pathlib import Path

from rich.progress import track

from benchmarks.bench_dataset import bench_header
from benchmarks.startup.report import once_table, start_table, write_json, write_plot
from benchmarks.startup.starts import start_once
from benchmarks.terminal import bench_console
from farm.spec.category import Category
from farm.spec.job import Job

DEFAULT_STARTS = 5
"""Starts to measure unless the command line says otherwise."""

RESOLUTION = 128
"""Edge of the picture, pixels: small, so that costs of the start stand out from those of every picture."""

CATEGORY = Category.CLOSE_DISTRIBUTED
"""Category of the picture: the one that loads the most, a floor's textures and an HDRI."""


def run(out: Path, *, seed: int, starts: int | None) -> int:
    """Measure, print, write `startup.json` and `startup.png` into `out`.

    Args:
        out: existing folder for the results.
        seed: seed of the picture's dataset.
        starts: number of times that a worker is started.

    Raises:
        VerificationError: if a start made no picture.
        AssetError: if the built-in assets are not complete.
    """
    console = bench_console()
    header, job = bench_header(1, seed, resolution=RESOLUTION), Job(category=CATEGORY, index=0)
    with tempfile.TemporaryDirectory(prefix="cable-farm-") as name:
        folder = Path(name)
        # This start doesn't count: it fills the system's file cache, and compiles what isn't on disk yet.
        start_once(header, job, folder)
        rounds = range(starts or DEFAULT_STARTS)
        measured = [start_once(header, job, folder) for _ in track(rounds, "starts", console=console, transient=True)]
    console.print(start_table(measured, RESOLUTION))
    console.print(once_table(measured))
    last = measured[-1]
    console.print(
        f"compiled functions that Python calls: {last.read} read from disk, {last.compiled} compiled; {last.device}"
    )
    write_json(out / "startup.json", measured, seed=seed)
    write_plot(out / "startup.png", measured)
    return 0
