"""`python -m benchmarks farm`: images an hour of `farm run`, for each way of sharing out the cores."""

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
        out: a folder that is there.
        seed: of the dataset, the same for all splits.
        images: of each run.
        splits: one run each.

    Raises:
        SpecError: if there is no image to make.
        VerificationError: if a dataset is not complete and as its manifests tell.
        FarmError: that with which a run ended.
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
