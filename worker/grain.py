"""Irregular fields: random numbers on a coarse grid, drawn out smoothly. Numpy and OpenCV."""

import cv2
import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float32]

_ENOUGH_PX = 8
"""Pixels between independent numbers, when there need be no more."""


def smooth_noise(rng: np.random.Generator, rows: int, columns: int, grain: tuple[float, float]) -> Field:
    """A field (rows, columns) of mean 0 and deviation 1, about.

    Args:
        rng: draws the coarse grid, whose size follows from the others.
        rows: of the field.
        columns: of the field.
        grain: pixels, down and across, between independent numbers.
    """
    # What is smooth over many pixels is found at fewer, and drawn out once more.
    fewer = [max(1, int(step / _ENOUGH_PX)) for step in grain]
    high, wide = (max(1, -(-edge // less)) for edge, less in zip((rows, columns), fewer, strict=True))
    down, across = (step / less for step, less in zip(grain, fewer, strict=True))
    coarse = rng.standard_normal((int(high / down) + 4, int(wide / across) + 4)).astype(np.float32)
    # Resizing finds its weights exactly; OpenCV's warps round places to a 32nd of a cell, which shows as steps.
    size = (max(1, round(coarse.shape[1] * across)), max(1, round(coarse.shape[0] * down)))
    top, left = int(1.5 * down), int(1.5 * across)
    part = cv2.resize(coarse, size, interpolation=cv2.INTER_CUBIC)[top : top + high, left : left + wide]
    if part.shape != (rows, columns):
        part = cv2.resize(part, (columns, rows), interpolation=cv2.INTER_CUBIC)
    # Cubic interpolation between independent numbers leaves 0.85 of their deviation.
    return (part * np.float32(1 / 0.85)).astype(np.float32, copy=False)


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
