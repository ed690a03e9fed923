"""Single values drawn from a range."""

import numpy as np

from farm.model import Rgb


def uniform(rng: np.random.Generator, bounds: tuple[float, float]) -> float:
    """Draw evenly from low to high."""
    return float(rng.uniform(*bounds))


def log_uniform(rng: np.random.Generator, bounds: tuple[float, float]) -> float:
    """Draw evenly in the logarithm; both ends above 0."""
    low, high = bounds
    return float(np.clip(np.exp(rng.uniform(np.log(low), np.log(high))), low, high))


def level(rng: np.random.Generator, bounds: tuple[int, int]) -> int:
    """Draw a whole number, both ends included."""
    return int(rng.integers(bounds[0], bounds[1], endpoint=True))


def rgb(rng: np.random.Generator, bounds: tuple[int, int]) -> Rgb:
    """Draw three levels."""
    return (level(rng, bounds), level(rng, bounds), level(rng, bounds))


def chance(rng: np.random.Generator, share: float) -> bool:
    """Draw whether something with this share is so."""
    return bool(rng.random() < share)


def pattern_seed(rng: np.random.Generator) -> int:
    """Draw the seed of something irregular."""
    return int(rng.integers(2**62))
