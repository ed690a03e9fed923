"""Samples a single value from a range."""

import numpy as np

from farm.model import Rgb


def uniform(rng: np.random.Generator, bounds: tuple[float, float]) -> float:
    """Sample a number evenly from the low to the high end of `bounds`."""
    return float(rng.uniform(*bounds))


def log_uniform(rng: np.random.Generator, bounds: tuple[float, float]) -> float:
    """Sample a number whose logarithm is even between those of the two ends; both ends are above 0."""
    low, high = bounds
    return float(np.clip(np.exp(rng.uniform(np.log(low), np.log(high))), low, high))


def level(rng: np.random.Generator, bounds: tuple[int, int]) -> int:
    """Sample a whole number evenly, both ends included."""
    return int(rng.integers(bounds[0], bounds[1], endpoint=True))


def rgb(rng: np.random.Generator, bounds: tuple[int, int]) -> Rgb:
    """Sample three levels evenly, both ends included."""
    return (level(rng, bounds), level(rng, bounds), level(rng, bounds))


def chance(rng: np.random.Generator, share: float) -> bool:
    """Return True with a probability of `share`, 0 to 1."""
    return bool(rng.random() < share)


def pattern_seed(rng: np.random.Generator) -> int:
    """Sample the seed of an irregular pattern, 0 or more and below 2**62."""
    return int(rng.integers(2**62))
