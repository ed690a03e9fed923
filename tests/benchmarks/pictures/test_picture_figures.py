"""The figures of one picture, drawn by hand."""

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from benchmarks.pictures.picture_figures import background_edges, measure
from tests.benchmarks.pictures.drawn import SIZE, empty


def test_figures_of_a_drawn_picture() -> None:
    """One level cable of 16 px lies on a background half black, half white."""
    picture = np.zeros((SIZE, SIZE, 3), np.uint8)
    picture[:, SIZE // 2 :] = 255
    instances = empty()
    instances[120:136] = 1
    figures = measure(picture, np.where(instances > 0, 255, 0).astype(np.uint8), instances)
    assert figures.coverage == pytest.approx(16 / SIZE)
    assert figures.grey_level == pytest.approx(127.5)
    assert figures.grey_deviation == pytest.approx(127.5)
    assert figures.width_px == pytest.approx(16, abs=0.5)
    assert figures.crossings == 0
    assert figures.background_edges == pytest.approx(1 / SIZE, rel=0.1)


def test_cables_are_no_clutter() -> None:
    """Neither the outlines of cables nor patterns on them count as edges of the background."""
    grey, mask = np.full((SIZE, SIZE), 40, np.uint8), np.zeros((SIZE, SIZE), np.uint8)
    grey[100:140:2] = 200
    mask[100:140] = 255
    assert background_edges(grey, mask) == 0


def test_clutter_counts() -> None:
    """The same lines without a cable below them count."""
    grey = np.full((SIZE, SIZE), 40, np.uint8)
    grey[100:140:8] = 200
    assert background_edges(grey, np.zeros((SIZE, SIZE), np.uint8)) > 0.02


def test_sensor_noise_is_little_clutter() -> None:
    """Noise of five levels has almost no edges."""
    grey: NDArray[np.uint8] = np.random.default_rng(0).normal(120, 5, (SIZE, SIZE)).round().astype(np.uint8)
    assert background_edges(grey, np.zeros((SIZE, SIZE), np.uint8)) < 0.001


def test_a_picture_full_of_cables_has_no_background() -> None:
    """Without any background the share of edges is NaN and not 0."""
    assert math.isnan(background_edges(np.zeros((64, 64), np.uint8), np.full((64, 64), 255, np.uint8)))
