"""Random streams: every draw of a job comes from the dataset's seed, the job's identity and the stage's name.

Spawn keys of `numpy.random.SeedSequence` separate the streams, so a parameter added to one stage leaves the
draws of the others as they were, and a redrawn scene (the next sub-seed) shares nothing with the one before.
"""

from collections.abc import Callable
from enum import IntEnum

import numpy as np

from farm.spec.category import Category


class Stage(IntEnum):
    """A stage that draws; the numbers are part of every seed and must never change."""

    CABLES = 0
    PLACEMENT = 1
    WIND = 2
    CABLE_MATERIAL = 3
    FLOOR = 4
    LIGHT = 5
    WORLD = 6
    CAMERA = 7
    RENDER = 8
    WEAR = 9
    CLUTTER = 10
    DEVELOPMENT = 11
    LOOK = 12
    PLATE = 13


def seed_sequence(
    dataset_seed: int, category: Category, index: int, attempt: int, stage: Stage
) -> np.random.SeedSequence:
    """The seed of one stage of one attempt at one job. All integers >= 0; 0 is a seed like any other."""
    return np.random.SeedSequence(dataset_seed, spawn_key=(category.code, index, attempt, int(stage)))


def generator(dataset_seed: int, category: Category, index: int, attempt: int, stage: Stage) -> np.random.Generator:
    """A generator over `seed_sequence`; PCG64 by name, as numpy's default may change."""
    return np.random.Generator(np.random.PCG64(seed_sequence(dataset_seed, category, index, attempt, stage)))


Streams = Callable[[Stage], np.random.Generator]
"""A fresh generator of a stage: asking twice for one stage gives the same numbers twice."""
