"""The check and the table of the masks' figures."""

import io

import pytest
from rich.console import Console

from benchmarks.masks.agreement import Agreement
from benchmarks.masks.results import LabelledImage, Width, check, table
from farm.errors import VerificationError
from farm.spec.category import Category


def image(
    width_px: float = 7.0, iou: float = 0.998, edge_px: float = 0.1, gap_px: int = 1, label_ms: float = 9.0
) -> LabelledImage:
    """A picture whose mask is right unless told otherwise."""
    agreement = Agreement(iou=iou, edge_error_px=edge_px, gap_error_px=gap_px, gap_pixels=3, area_ratio=1.0)
    return LabelledImage(category=Category.FAR, width_px=width_px, label_ms=label_ms, agreement=agreement)


def test_right_masks_pass() -> None:
    """Right masks of narrow and of wide cables pass."""
    check([image(), image(width_px=4.3, iou=0.986)])


@pytest.mark.parametrize(
    "wrong",
    [
        image(iou=0.994),
        image(width_px=4.3, iou=0.984),
        image(edge_px=1.01),
        image(gap_px=2),
    ],
    ids=["wide", "narrow", "edge", "gap"],
)
def test_a_wrong_mask_fails(wrong: LabelledImage) -> None:
    """One wrong mask among right ones fails the check."""
    with pytest.raises(VerificationError, match="1 of 3"):
        check([image(), wrong, image()])


def test_slow_labels_pass() -> None:
    """Slow labelling passes, as time depends on the machine."""
    check([image(label_ms=5000.0)])


def test_the_table_has_a_row_for_each_class_of_width() -> None:
    """A narrow picture and two wide ones, one of them wrong, give two rows."""
    written = io.StringIO()
    Console(width=130, file=written).print(table([image(), image(iou=0.9), image(width_px=4.3)], "title"))
    narrow, wide = [line for line in written.getvalue().splitlines() if Category.FAR in line]
    assert Width.NARROW in narrow
    assert "pass" in narrow
    assert Width.WIDE in wide
    assert "FAIL" in wide
