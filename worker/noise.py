"""Random fields that vary smoothly. Numpy and OpenCV.

There are two kinds, which draw and scale their coarse grids differently, so that one can't stand for the other without
changing pictures. `smooth_noise` and `rough_noise` cover a rectangle: a sheet, a floor. `wrapped_noise` and
`rough_wrapped_noise` close around a cable: their first row follows on their last, which takes a whole number of cells
around.
"""

import cv2
import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float32]

_ENOUGH_PX = 8
"""Pixels between independent numbers that show a smooth field well; a coarser one is drawn smaller and enlarged."""


def smooth_noise(rng: np.random.Generator, rows: int, columns: int, grain: tuple[float, float]) -> Field:
    """Noise over a rectangle: mean about 0, standard deviation about 1.

    Args:
        rng: draws the coarse grid, whose size follows from the other arguments.
        rows: rows of the result.
        columns: columns of the result.
        grain: pixels, down and across, between independent numbers.

    Returns:
        Shape (rows, columns).
    """
    # What is smooth over many pixels is computed for fewer, then enlarged.
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
    """Noise over a rectangle in several sizes at once: mean about 0, standard deviation about 1.

    Args:
        rng: draws the fields.
        rows: rows of the result.
        columns: columns of the result.
        grain: pixels between independent numbers of the coarsest field.
        octaves: number of fields that are added up, each twice as fine and 0.55 times as strong as the one before.

    Returns:
        Shape (rows, columns).
    """
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
    """0 where the field is below `low`, 1 where it is above `high`, and a cubic S between them."""
    share = np.clip((field - np.float32(low)) * np.float32(1 / (high - low)), 0, 1)
    step: Field = share * share * (3 - 2 * share)
    return step


_MARGIN = 2
"""Cells beyond each edge that a cubic reads."""

_NORMED = 1.35
"""Factor that restores the deviation of independent values after a cubic through them, which varies less."""


def wrapped_noise(rng: np.random.Generator, shape: tuple[int, int], cell: tuple[float, float]) -> Field:
    """Noise around a cable: mean about 0, standard deviation about 1, and no seam between the last row and the first.

    Args:
        rng: draws the cells' values.
        shape: rows, around the cable, and columns, along it.
        cell: rows and columns between independent values; the rows are rounded so that they divide `shape[0]`.

    Returns:
        Shape `shape`.
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
    # A cubic through the cells, then straight lines through its points: that takes a fifth of the time of one cubic.
    finer = cv2.resize(closed, (cells * fine_right, len(closed) * fine_down), interpolation=cv2.INTER_CUBIC)
    large = cv2.resize(finer, (cells * right, len(closed) * down), interpolation=cv2.INTER_LINEAR)
    inner = large[_MARGIN * down : _MARGIN * down + rows, _MARGIN * right : _MARGIN * right + columns]
    normed: Field = inner * np.float32(_NORMED)
    return normed


def _steps(down: int, right: int) -> tuple[int, int]:
    """Points of the cubic in a cell, down and across: at most four, and down a number that divides the cell's rows."""
    return max(step for step in (1, 2, 3, 4) if down % step == 0), min(4, right)


def rough_wrapped_noise(
    rng: np.random.Generator, shape: tuple[int, int], cell: tuple[float, float], octaves: int = 3
) -> Field:
    """Noise around a cable in several sizes at once: mean about 0, standard deviation about 1.

    Args:
        rng: draws the fields.
        shape: rows, around the cable, and columns, along it.
        cell: rows and columns between independent values of the coarsest field.
        octaves: number of fields that are added up, each twice as fine and 0.55 times as strong as the one before.

    Returns:
        Shape `shape`.
    """
    total = np.zeros(shape, np.float32)
    for octave in range(octaves):
        total += wrapped_noise(rng, shape, (cell[0] / 2**octave, cell[1] / 2**octave)) * np.float32(0.55**octave)
    return total * np.float32(1.0 / np.sqrt(sum(0.55 ** (2 * octave) for octave in range(octaves))))


def highest_share(values: Field, share: float, softness: float) -> Field:
    """Mark the patches where a field is highest.

    Args:
        values: the field, (H, W).
        share: share of all places that lie in patches, 0 to 1.
        softness: width of the patches' edges, in units of `values`.

    Returns:
        Degree to which each place belongs to a patch, (H, W), 0 to 1.
    """
    if share <= 0.0:
        return np.zeros_like(values)
    edge = np.quantile(values[::3, ::3], 1.0 - min(share, 1.0))
    return np.clip((values - np.float32(edge)) / np.float32(softness) + np.float32(0.5), 0.0, 1.0)


def _divisor(rows: int, wanted: float) -> int:
    """The divisor of `rows` whose ratio to the wanted number is nearest to 1."""
    divisors = np.array([k for k in range(1, rows + 1) if rows % k == 0])
    return int(divisors[np.argmin(np.abs(np.log(divisors / max(wanted, 1.0))))])
