"""IoU and Dice against values worked out by hand."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from benchmarks.training.scores import Agreement, agreement, scores


def mask(*rows: str) -> NDArray[np.bool_]:
    """A mask drawn with dots and hashes."""
    return np.array([[place == "#" for place in row] for row in rows])


def test_pixels_are_counted_by_hand() -> None:
    """The masks have two hits, one false alarm and three misses."""
    found = agreement(mask("##.#", "...."), mask("##..", "###."))
    assert found == Agreement(hits=2, false_alarms=1, misses=3)
    assert found.iou == pytest.approx(2 / 6)
    assert found.dice == pytest.approx(4 / 8)


def test_the_same_mask_is_perfect_and_another_is_worth_nothing() -> None:
    """Equal masks score 1, disjoint ones 0."""
    one, other = mask("##.."), mask("..##")
    assert (agreement(one, one).iou, agreement(one, one).dice) == (1, 1)
    assert (agreement(one, other).iou, agreement(one, other).dice) == (0, 0)


def test_rightly_seeing_nothing_is_perfect() -> None:
    """Two empty masks score 1, without a division by zero."""
    nothing = mask("....")
    assert (agreement(nothing, nothing).iou, agreement(nothing, nothing).dice) == (1, 1)


def test_means_over_pictures_and_over_pixels_differ() -> None:
    """A small picture counts as much as a large one in the mean, and less over all pixels."""
    found = scores([Agreement(90, 0, 0), Agreement(0, 5, 5)])
    assert found.pictures == 2
    assert found.mean_iou == found.mean_dice == pytest.approx(0.5)
    assert found.pixel_iou == pytest.approx(0.9)
    assert found.pixel_dice == pytest.approx(180 / 190)
    assert found.iou_error == pytest.approx(0.5)


def test_one_picture_has_no_error_of_its_mean() -> None:
    """The error of one picture's mean is NaN and not 0."""
    assert math.isnan(scores([Agreement(1, 1, 1)]).iou_error)
