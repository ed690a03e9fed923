"""Smooth random fields: over a rectangle, and closed around a cable. Numpy and OpenCV."""

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


_MARGIN = 2
"""Cells beyond the edges that a cubic reaches for."""

_NORMED = 1.35
"""A cubic through independent values varies less than they do."""


def field(rng: np.random.Generator, shape: tuple[int, int], cell: tuple[float, float]) -> Field:
    """Random values that vary over a cell's size, of mean about 0 and standard deviation about 1.

    Args:
        rng: is drawn from.
        shape: rows, around the cable, and columns, along it.
        cell: rows and columns over which it varies; the rows are taken to the next number that divides the picture's.
    """
    rows, columns = shape
    around = _divisor(rows, rows / max(cell[0], 1.0))
    down, (fine_down, fine_right) = rows // around, _steps(rows // around, max(1, round(cell[1])))
    right = fine_right * max(1, round(cell[1] / fine_right))
    cells = -(-columns // right) + 2 * _MARGIN
    values = rng.standard_normal((around, cells), dtype=np.float32)
    if down == right == 1:
        return values[:, _MARGIN : _MARGIN + columns]
    # Rows wrap around, so that the field closes.
    closed = values[np.arange(-_MARGIN, around + _MARGIN) % around]
    # A cubic through the cells, then straight lines through its points, which takes a fifth of the time.
    finer = cv2.resize(closed, (cells * fine_right, len(closed) * fine_down), interpolation=cv2.INTER_CUBIC)
    large = cv2.resize(finer, (cells * right, len(closed) * down), interpolation=cv2.INTER_LINEAR)
    inner = large[_MARGIN * down : _MARGIN * down + rows, _MARGIN * right : _MARGIN * right + columns]
    normed: Field = inner * np.float32(_NORMED)
    return normed


def _steps(down: int, right: int) -> tuple[int, int]:
    """Points that a cubic puts in a cell: at most four each way, and down a number that divides the cell's rows."""
    return max(step for step in (1, 2, 3, 4) if down % step == 0), min(4, right)


def fractal(rng: np.random.Generator, shape: tuple[int, int], cell: tuple[float, float], octaves: int = 3) -> Field:
    """Fields of halving cells and halving weight, of standard deviation about 1."""
    total = np.zeros(shape, np.float32)
    for octave in range(octaves):
        total += field(rng, shape, (cell[0] / 2**octave, cell[1] / 2**octave)) * np.float32(0.55**octave)
    return total * np.float32(1.0 / np.sqrt(sum(0.55 ** (2 * octave) for octave in range(octaves))))


def patches(values: Field, share: float, softness: float) -> Field:
    """How much, 0 to 1, each place belongs to the `share` of all that is highest; edges are `softness` wide."""
    if share <= 0.0:
        return np.zeros_like(values)
    edge = np.quantile(values[::3, ::3], 1.0 - min(share, 1.0))
    return np.clip((values - np.float32(edge)) / np.float32(softness) + np.float32(0.5), 0.0, 1.0)


def _divisor(rows: int, wanted: float) -> int:
    """The divisor of `rows` that is nearest to what is wanted, in proportion."""
    divisors = np.array([k for k in range(1, rows + 1) if rows % k == 0])
    return int(divisors[np.argmin(np.abs(np.log(divisors / max(wanted, 1.0))))])
