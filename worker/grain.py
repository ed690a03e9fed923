"""Irregular fields: random numbers on a coarse grid, drawn out smoothly. Numpy and OpenCV."""

import cv2
import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float32]


def smooth_noise(rng: np.random.Generator, rows: int, columns: int, grain: tuple[float, float]) -> Field:
    """A field (rows, columns) of mean 0 and deviation 1, about.

    Args:
        rng: draws the coarse grid, whose size follows from the others.
        rows: of the field.
        columns: of the field.
        grain: pixels, down and across, between independent numbers.
    """
    high, wide = (max(2, int(np.ceil(edge / step)) + 3) for edge, step in zip((rows, columns), grain, strict=True))
    coarse = rng.standard_normal((high, wide)).astype(np.float32)
    down, across = (np.float32(max(step, 1e-6)) for step in grain)
    # Cubic interpolation between independent numbers leaves 0.85 of their deviation.
    place = np.array([[1 / across, 0, 1.0], [0, 1 / down, 1.0]], np.float32)
    flags = cv2.INTER_CUBIC | cv2.WARP_INVERSE_MAP
    fine = cv2.warpAffine(coarse, place, (columns, rows), flags=flags, borderMode=cv2.BORDER_REFLECT_101)
    field: Field = (fine / np.float32(0.85)).astype(np.float32, copy=False)
    return field


def rough_noise(rng: np.random.Generator, rows: int, columns: int, grain: float, octaves: int) -> Field:
    """A sum of noises, each twice as fine and 0.55 times as strong as the one before; deviation 1, about."""
    field = np.zeros((rows, columns), np.float32)
    weight, total = 1.0, 0.0
    for octave in range(octaves):
        fine = grain / 2**octave
        field += np.float32(weight) * smooth_noise(rng, rows, columns, (fine, fine))
        total += weight**2
        weight *= 0.55
    field /= np.float32(np.sqrt(total))
    return field


def smooth_step(field: Field, low: float, high: float) -> Field:
    """0 below `low`, 1 above `high`, and an S between them."""
    share = np.clip((field - np.float32(low)) * np.float32(1 / (high - low)), 0, 1)
    step: Field = share * share * (3 - 2 * share)
    return step
