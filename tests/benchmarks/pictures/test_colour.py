"""The spread of colours, against values worked out by hand."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from benchmarks.pictures.colour import LEVELS, colour_histogram, entropy_bits, mean_hellinger


def plain(*colour: int) -> NDArray[np.uint8]:
    """A picture of one colour."""
    return np.full((4, 4, 3), colour, np.uint8)


def test_a_histogram_shares_out_all_pixels() -> None:
    """Half of the pixels are in the first box and half in the last."""
    picture = np.vstack([plain(0, 0, 0), plain(255, 255, 255)])
    histogram = colour_histogram(picture)
    assert histogram[0] == histogram[-1] == 0.5
    assert histogram.sum() == pytest.approx(1)


def test_channels_are_not_mixed_up() -> None:
    """Red, green and blue pixels fall into three boxes."""
    boxes = {int(colour_histogram(plain(*colour)).argmax()) for colour in ((255, 0, 0), (0, 255, 0), (0, 0, 255))}
    assert boxes == {7 * LEVELS**2, 7 * LEVELS, 7}


def test_entropy_is_of_all_pictures_together() -> None:
    """Pictures of one colour have no entropy; four pictures of one colour each have two bits."""
    assert entropy_bits([colour_histogram(plain(9, 9, 9))]) == 0
    four = [colour_histogram(plain(level, level, level)) for level in (0, 70, 140, 210)]
    assert entropy_bits(four) == pytest.approx(2)


def test_distance_of_the_same_and_of_other_colours() -> None:
    """The distance is 0 or 1; if half of the colours are shared, it is the root of one half."""
    black, white = colour_histogram(plain(0, 0, 0)), colour_histogram(plain(255, 255, 255))
    assert mean_hellinger([black, black]) == pytest.approx(0)
    assert mean_hellinger([black, white]) == pytest.approx(1)
    both = colour_histogram(np.vstack([plain(0, 0, 0), plain(255, 255, 255)]))
    assert mean_hellinger([black, both]) == pytest.approx(math.sqrt(1 - math.sqrt(0.5)))
    assert mean_hellinger([black, black, white]) == pytest.approx(2 / 3)


def test_too_few_pictures_have_no_spread() -> None:
    """Without pictures there is no entropy, and with one no distance."""
    assert math.isnan(entropy_bits([]))
    assert math.isnan(mean_hellinger([colour_histogram(plain(1, 2, 3))]))
