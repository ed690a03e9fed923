"""Results of the comparison of masks with renders: their bounds, the check against them, and the table."""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from rich.table import Table

from benchmarks.masks.agreement import Agreement
from farm.errors import VerificationError
from farm.spec.category import Category

WIDE_PX = 6.0
"""Width of the thinnest cable, pixels, from which a picture must meet the stricter bound on IoU."""
MAX_BOUNDARY_ERROR_PX = 1.0
"""Largest distance, pixels, between the edges of mask and reference."""
AIM_MS = 20.0
"""Aim for the CPU time of labelling, milliseconds. The report states it; nothing fails, as time depends on the
machine."""


class Width(StrEnum):
    """Class of the cables' width in the picture: the same error at the edge weighs more on a narrower cable."""

    NARROW = "4 px"
    WIDE = "≥ 6 px"


MIN_IOU = {Width.NARROW: 0.985, Width.WIDE: 0.995}
"""Least intersection over union with the reference, by width of the cables."""


@dataclass(frozen=True, slots=True)
class LabelledImage:
    """The result for one picture.

    Attributes:
        category: the picture's category.
        width_px: width of the thinnest cable on the floor.
        label_ms: CPU milliseconds that labelling takes, on one core.
        agreement: agreement of the mask with the reference.
    """

    category: Category
    width_px: float
    label_ms: float
    agreement: Agreement

    @property
    def width(self) -> Width:
        """The class that decides how well mask and reference must agree."""
        return Width.WIDE if self.width_px >= WIDE_PX else Width.NARROW

    @property
    def passes(self) -> bool:
        """Whether the mask is within both bounds."""
        error_px = max(self.agreement.edge_error_px, self.agreement.gap_error_px)
        return self.agreement.iou >= MIN_IOU[self.width] and error_px <= MAX_BOUNDARY_ERROR_PX


_COLUMNS = ("category", "width", "images", "IoU mean", "least", "edge px", "gap px", "in gaps", "area", "CPU ms", "max")


def check(found: list[LabelledImage]) -> None:
    """Check every mask.

    Raises:
        VerificationError: if a mask is out of bounds.
    """
    wrong = [image for image in found if not image.passes]
    if wrong:
        worst = min(wrong, key=lambda image: image.agreement.iou)
        raise VerificationError(
            f"{len(wrong)} of {len(found)} masks are wrong; {worst.width_px:.1f} px wide cables in {worst.category}: "
            f"IoU {worst.agreement.iou:.4f}, edge off by {worst.agreement.edge_error_px:.2f} px, in gaps by "
            f"{worst.agreement.gap_error_px} px; see masks.json"
        )


def table(found: list[LabelledImage], title: str) -> Table:
    """A table with a row for each category and class of width."""
    lines = Table(
        title=title,
        caption=f"pass: no boundary off by over {MAX_BOUNDARY_ERROR_PX:.0f} px, IoU at least "
        + ", ".join(f"{least} ({width})" for width, least in MIN_IOU.items()),
    )
    for name in _COLUMNS:
        lines.add_column(name, justify="left" if name == "category" else "right")
    lines.add_column("")
    for category in Category:
        for width in Width:
            row = [image for image in found if image.category is category and image.width is width]
            if row:
                lines.add_row(category.value, width.value, *_cells(row))
    return lines


def _cells(row: list[LabelledImage]) -> list[str]:
    agreements = [image.agreement for image in row]
    iou = [agreement.iou for agreement in agreements]
    times_ms = [image.label_ms for image in row]
    return [
        str(len(row)),
        f"{np.mean(iou):.4f}",
        f"{min(iou):.4f}",
        f"{max(agreement.edge_error_px for agreement in agreements):.2f}",
        f"{max(agreement.gap_error_px for agreement in agreements)}",
        f"{np.mean([agreement.gap_pixels for agreement in agreements]):.1f}",
        f"{np.mean([agreement.area_ratio for agreement in agreements]):.4f}",
        f"{np.median(times_ms):.1f}",
        f"{max(times_ms):.1f}",
        "pass" if all(image.passes for image in row) else "FAIL",
    ]


def times(found: list[LabelledImage]) -> str:
    """A sentence on the time that labelling took."""
    times_ms = [image.label_ms for image in found]
    verdict = "within" if max(times_ms) <= AIM_MS else "over"
    return (
        f"labelling: median {np.median(times_ms):.1f} ms of CPU, max {max(times_ms):.1f} ms, {verdict} {AIM_MS:.0f} ms"
    )
