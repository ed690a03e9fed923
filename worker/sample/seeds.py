"""Random streams: the dataset's seed, the job, the attempt and the stage decide every random value.

Spawn keys of `numpy.random.SeedSequence` separate the streams: a parameter added to one stage leaves the values of
the others as they are, and the scene of the next attempt shares nothing with the one before.
"""

from collections.abc import Callable
from enum import IntEnum

import numpy as np

from farm.spec.category import Category


class Stage(IntEnum):
    """A stage of the sampling. The numbers are part of every seed and must never change."""

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
    BACKGROUND = 14
    TANGLE = 15


def seed_sequence(
    dataset_seed: int, category: Category, index: int, attempt: int, stage: Stage
) -> np.random.SeedSequence:
    """Build the seed of one stage of one attempt at one job.

    Args:
        dataset_seed: seed of the dataset, 0 or more; 0 is a seed like any other.
        category: category of the job.
        index: index of the job, 0 or more.
        attempt: number of the attempt, from 0.
        stage: stage of the sampling.
    """
    return np.random.SeedSequence(dataset_seed, spawn_key=(category.code, index, attempt, int(stage)))


def generator(dataset_seed: int, category: Category, index: int, attempt: int, stage: Stage) -> np.random.Generator:
    """Make a generator from `seed_sequence`, a PCG64, as numpy's default generator may change."""
    return np.random.Generator(np.random.PCG64(seed_sequence(dataset_seed, category, index, attempt, stage)))


Streams = Callable[[Stage], np.random.Generator]
"""Function that makes a new random generator of a stage; two generators of the same stage give the same numbers."""
