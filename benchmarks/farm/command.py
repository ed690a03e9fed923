"""`python -m benchmarks farm`: images per hour of `farm run`, for each split of the cores between workers."""

import tempfile
from collections.abc import Sequence
from pathlib import Path

from benchmarks.farm.play import play
from benchmarks.farm.report import conclusions, throughput_table, write_json, write_plot
from benchmarks.farm.splits import Split
from benchmarks.terminal import bench_console
from farm.errors import SpecError


def run(out: Path, *, seed: int, images: int, splits: Sequence[Split]) -> int:
    """Measure, print the table, write `farm.json` and `farm.png` into `out`.

    Args:
        out: an existing folder.
        seed: seed of the dataset, the same for all splits.
        images: number of images of each run.
        splits: splits to measure, each by a run of its own.

    Raises:
        SpecError: if `images` is below 1.
        VerificationError: if a dataset is incomplete or differs from its manifests.
        FarmError: the error with which a run ended.
    """
    if images < 1:
        raise SpecError("give at least 1 of --images")
    console = bench_console()
    runs = []
    for split in splits:
        with (
            console.status(f"{split}: {images} images"),
            tempfile.TemporaryDirectory(prefix="cable-farm-") as folder,
        ):
            runs.append(play(split, images, seed, Path(folder), out / f"farm-{split}.log"))
    console.print(throughput_table(runs))
    for line in conclusions(runs):
        console.print(line, highlight=False)
    write_json(out / "farm.json", runs, seed)
    write_plot(out / "farm.png", runs)
    return 0
