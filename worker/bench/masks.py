"""Masks from geometry against white-on-black Cycles renders of the same scenes."""

import json
from collections import defaultdict
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from rich.progress import track
from rich.table import Table

from farm.category import Category
from farm.errors import VerificationError
from worker.bench.bench_dataset import bench_header, bench_jobs
from worker.bench.mask_reference import SAMPLES, render_coverage
from worker.bench.terminal import bench_console, blender_writes_to
from worker.studio import open_studio

DEFAULT_IMAGES = 2
MIN_IOU = 0.95
"""Below this a mask is plainly not of the picture: half a pixel off all along a 4 px cable."""

MAX_EDGE_ERROR_PX = 0.5


@dataclass(frozen=True, slots=True)
class Agreement:
    """How a mask agrees with a reference.

    Attributes:
        iou: intersection over union with the reference, thresholded at a half.
        edge_error_px: 99th percentile, over the pixels on the reference's half-way line, of how far the mask's edge
            lies from it; 0 where both put the pixel on the same side.
        edge_error_max_px: the worst.
        area_ratio: area of the mask over the reference's coverage.
    """

    iou: float
    edge_error_px: float
    edge_error_max_px: float
    area_ratio: float


def compare(mask: NDArray[np.uint8], coverage: NDArray[np.float64]) -> Agreement:
    """Compare a binary mask (H, W) of 0 and 255 with a reference's coverage (H, W), 0 to 1.

    A pixel's middle lies |c - 1/2| / |grad c| from the reference's half-way line. Where mask and reference differ, the
    mask's edge is at least that far off.
    """
    ours, theirs = mask > 0, coverage >= 0.5
    union = np.count_nonzero(ours | theirs)
    slope = np.hypot(*np.gradient(coverage))
    distance = np.abs(coverage - 0.5) / np.maximum(slope, 1e-6)
    errors = np.where(ours != theirs, distance, 0.0)[_edge(theirs) | (ours != theirs)]
    return Agreement(
        iou=np.count_nonzero(ours & theirs) / union if union else 1.0,
        edge_error_px=float(np.percentile(errors, 99)) if errors.size else 0.0,
        edge_error_max_px=float(errors.max(initial=0.0)),
        area_ratio=float(ours.mean() / max(coverage.mean(), 1e-12)),
    )


def _edge(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Pixels with a neighbour on the other side."""
    padded = np.pad(mask, 1, mode="edge")
    middle = padded[1:-1, 1:-1]
    differs = [padded[:-2, 1:-1], padded[2:, 1:-1], padded[1:-1, :-2], padded[1:-1, 2:]]
    edge: NDArray[np.bool_] = np.any([middle != neighbour for neighbour in differs], axis=0)
    return edge


def run(out: Path, *, images: int | None, seed: int) -> int:
    """Compare, print the table, write `masks.json` into `out`.

    Raises:
        VerificationError: if a mask is not of its picture.
        FarmError: if an image can't be made.
    """
    count = images or DEFAULT_IMAGES
    header = bench_header(count, seed, quality="draft")
    found: dict[Category, list[Agreement]] = defaultdict(list)
    console = bench_console()
    log_file = out / "masks.log"
    with blender_writes_to(log_file):
        studio = open_studio(header, device="cpu", threads=0, assets=None)
    for job in track(bench_jobs(count), "images", console=console, transient=True):
        with blender_writes_to(log_file):
            made = studio.make(job, header)
            found[job.category].append(compare(made.mask, render_coverage()))
    console.print(_table(found, count))
    content = {category: [asdict(agreement) for agreement in found[category]] for category in Category}
    (out / "masks.json").write_text(json.dumps(content, indent=1) + "\n")
    worst = min(agreement.iou for agreements in found.values() for agreement in agreements)
    off = max(agreement.edge_error_px for agreements in found.values() for agreement in agreements)
    if off > MAX_EDGE_ERROR_PX:
        raise VerificationError(f"a mask's edge is {off:.2f} px off its reference at the 99th percentile")
    if worst < MIN_IOU:
        raise VerificationError(f"a mask agrees with its reference only to an IoU of {worst:.3f}; see masks.json")
    return 0


def _table(found: dict[Category, list[Agreement]], count: int) -> Table:
    table = Table(title=f"masks against Cycles renders of {SAMPLES} samples, {count} images of each category")
    for name in ("category", "IoU mean", "IoU min", "edge error p99 px", "edge error max px", "area ratio"):
        table.add_column(name, justify="left" if name == "category" else "right")
    for category, agreements in found.items():
        iou = [agreement.iou for agreement in agreements]
        table.add_row(
            category.value,
            f"{np.mean(iou):.4f}",
            f"{min(iou):.4f}",
            f"{max(agreement.edge_error_px for agreement in agreements):.2f}",
            f"{max(agreement.edge_error_max_px for agreement in agreements):.2f}",
            f"{np.mean([agreement.area_ratio for agreement in agreements]):.4f}",
        )
    return table
