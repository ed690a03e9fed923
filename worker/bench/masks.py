"""Masks from geometry against white-on-black Cycles renders of the same scenes."""

import json
from collections import defaultdict
from dataclasses import asdict, dataclass
from pathlib import Path

import cv2
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
        edge_error_px: how far the mask's edge lies from the reference's half-way line where it is farthest, near one
            cable alone.
        gap_pixels: pixels between two cables, the gap between which is a pixel or two wide, that are farther off than
            `MAX_EDGE_ERROR_PX`: one of mask and reference closes the gap there.
        area_ratio: area of the mask over the reference's coverage.
    """

    iou: float
    edge_error_px: float
    gap_pixels: int
    area_ratio: float


def compare(instances: NDArray[np.uint16], coverage: NDArray[np.float64]) -> Agreement:
    """Compare instances (H, W), whose mask is what is not 0, with a reference's coverage (H, W), 0 to 1.

    A pixel's middle lies |c - 1/2| / |grad c| from the reference's half-way line. Where mask and reference differ, the
    mask's edge is at least that far off.
    """
    ours, theirs = instances > 0, coverage >= 0.5
    union = np.count_nonzero(ours | theirs)
    slope = np.hypot(*np.gradient(coverage))
    distance = np.abs(coverage - 0.5) / np.maximum(slope, 1e-6)
    errors = np.where(ours != theirs, distance, 0.0)
    between = _cables_nearby(instances) > 1
    return Agreement(
        iou=np.count_nonzero(ours & theirs) / union if union else 1.0,
        edge_error_px=float(errors[~between].max(initial=0.0)),
        gap_pixels=int(np.count_nonzero(errors[between] > MAX_EDGE_ERROR_PX)),
        area_ratio=float(ours.mean() / max(coverage.mean(), 1e-12)),
    )


def _cables_nearby(instances: NDArray[np.uint16]) -> NDArray[np.int64]:
    """How many cables are within two pixels of each pixel."""
    reach = np.ones((5, 5), np.uint8)
    nearby = [cv2.dilate((instances == number).astype(np.uint8), reach) for number in np.unique(instances) if number]
    return np.sum(nearby, axis=0, dtype=np.int64) if nearby else np.zeros(instances.shape, np.int64)


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
            found[job.category].append(compare(made.instances, render_coverage()))
    console.print(_table(found, count))
    content = {category: [asdict(agreement) for agreement in found[category]] for category in Category}
    (out / "masks.json").write_text(json.dumps(content, indent=1) + "\n")
    worst = min(agreement.iou for agreements in found.values() for agreement in agreements)
    off = max(agreement.edge_error_px for agreements in found.values() for agreement in agreements)
    if off > MAX_EDGE_ERROR_PX:
        raise VerificationError(f"a mask's edge is {off:.2f} px off its reference; see masks.json")
    if worst < MIN_IOU:
        raise VerificationError(f"a mask agrees with its reference only to an IoU of {worst:.3f}; see masks.json")
    return 0


def _table(found: dict[Category, list[Agreement]], count: int) -> Table:
    table = Table(title=f"masks against Cycles renders of {SAMPLES} samples, {count} images of each category")
    for name in ("category", "IoU mean", "IoU least", "worst edge error px", "pixels in gaps", "area ratio"):
        table.add_column(name, justify="left" if name == "category" else "right")
    for category, agreements in found.items():
        iou = [agreement.iou for agreement in agreements]
        table.add_row(
            category.value,
            f"{np.mean(iou):.4f}",
            f"{min(iou):.4f}",
            f"{max(agreement.edge_error_px for agreement in agreements):.2f}",
            f"{np.mean([agreement.gap_pixels for agreement in agreements]):.1f}",
            f"{np.mean([agreement.area_ratio for agreement in agreements]):.4f}",
        )
    return table
