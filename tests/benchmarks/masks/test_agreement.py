"""Comparing masks with references, on edges whose position is known."""

import numpy as np
import pytest
from numpy.typing import NDArray

from benchmarks.masks.agreement import compare


def coverage_of_bar(left: float, right: float) -> NDArray[np.float64]:
    """Coverage of each pixel by a vertical bar, softened over three pixels as a render's is."""
    fine = np.zeros(64 * 32)
    fine[round(left * 32) : round(right * 32)] = 1.0
    soft = np.convolve(fine.reshape(64, 32).mean(axis=1), [0.25, 0.5, 0.25], mode="same")
    return np.tile(soft, (64, 1))


def instances_of_bar(left: int, right: int) -> NDArray[np.uint16]:
    """One cable that fills whole columns."""
    instances = np.zeros((64, 64), np.uint16)
    instances[:, left:right] = 1
    return instances


def test_equal_masks_agree() -> None:
    """Equal masks have an IoU of 1 and no error."""
    agreement = compare(instances_of_bar(20, 30), coverage_of_bar(20.0, 30.0))
    assert (agreement.iou, agreement.edge_error_px, agreement.gap_pixels) == (1.0, 0.0, 0)


@pytest.mark.parametrize("shift", [1, 2])
def test_a_shifted_mask_is_found(shift: int) -> None:
    """A shift shows as an edge error half a pixel smaller, the distance of the farthest wrong pixel's middle."""
    agreement = compare(instances_of_bar(20 + shift, 30 + shift), coverage_of_bar(20.0, 30.0))
    assert agreement.edge_error_px >= 0.9 * (shift - 0.5)
    assert agreement.iou == pytest.approx((10 - shift) / (10 + shift))


def test_a_closed_gap_is_told_apart() -> None:
    """A gap of one pixel that the mask leaves and the reference fills counts as a gap, not as an edge."""
    instances = instances_of_bar(20, 25)
    instances[:, 26:30] = 2
    agreement = compare(instances, coverage_of_bar(20.0, 30.0))
    assert agreement.edge_error_px == 0.0
    assert (agreement.gap_pixels, agreement.gap_error_px) == (64, 1)


def test_a_wider_gap_counts_its_width() -> None:
    """Two pixels that the mask leaves and the reference fills are an error of two pixels."""
    instances = instances_of_bar(20, 25)
    instances[:, 27:31] = 2
    assert compare(instances, coverage_of_bar(20.0, 31.0)).gap_error_px == 2
