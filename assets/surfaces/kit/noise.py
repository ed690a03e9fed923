"""Periodic random fields, made by shaping the spectrum of white noise, so that they tile without a seam."""

from typing import Any

import cv2
import numpy as np
import numpy.typing as npt

from assets.surfaces.kit.grid import Field, Grid

SMALLEST_WORKING_EDGE = 64
"""Smallest edge, in texels, at which a coarse field is drawn before it is enlarged; below it no time is saved."""


def fractal(
    rng: np.random.Generator,
    grid: Grid,
    coarse_mm: float,
    fine_mm: float = 0.0,
    *,
    gain: float = 0.5,
    stretch: tuple[float, float] = (1.0, 1.0),
) -> Field:
    """Draw fractal noise whose features range from coarse to fine.

    Args:
        rng: Source of the randomness.
        grid: The tile.
        coarse_mm: Wavelength of the largest features.
        fine_mm: Wavelength of the smallest features; 0 allows features as small as a texel.
        gain: Amplitude of each octave relative to the one before it: 1 is equally rough at every scale, 0.5
            is smooth like hills.
        stretch: Factors by which features are longer along x and along y.

    Returns:
        Shape (H, W), mean 0, standard deviation 1.
    """
    columns = _working_edge(grid, fine_mm * stretch[0])
    rows = _working_edge(grid, fine_mm * stretch[1])
    frequency = _squared_frequency(rows, columns, stretch) / np.float32(grid.size_mm**2)
    low = np.float32(coarse_mm**-2)
    amplitude = np.power(np.maximum(frequency, low), -0.5 * (1.0 - np.log2(gain)))
    amplitude *= np.where(frequency < low, np.square(frequency / low), np.float32(1.0))
    if fine_mm > 0:
        amplitude *= np.exp(-np.square(frequency * np.float32(fine_mm**2)))
    amplitude[0, 0] = 0.0
    white = rng.standard_normal((rows, columns), dtype=np.float32)
    spectrum = cv2.dft(white) * amplitude.astype(np.float32)
    field = np.asarray(cv2.dft(spectrum, flags=cv2.DFT_INVERSE | cv2.DFT_SCALE), np.float32)
    field = enlarge(field, grid.pixels)
    spread = float(field.std())
    return np.asarray((field - field.mean()) / (spread if spread > 0 else 1.0), np.float32)


def enlarge(field: Field, pixels: int) -> Field:
    """Enlarge a periodic field by whole factors with cubic interpolation, keeping it periodic.

    Args:
        field: Periodic field, shape (h, w); h and w divide `pixels`.
        pixels: Texels along an edge of the result.

    Returns:
        Shape (pixels, pixels).
    """
    rows, columns = field.shape
    if (rows, columns) == (pixels, pixels):
        return field
    margin = 4
    down, across = pixels // rows, pixels // columns
    padded = np.pad(field, margin, mode="wrap")
    wide = cv2.resize(padded, None, fx=across, fy=down, interpolation=cv2.INTER_CUBIC)
    cropped = wide[margin * down : margin * down + pixels, margin * across : margin * across + pixels]
    return np.ascontiguousarray(cropped, np.float32)


def blur(field: Field, sigma_mm: float, grid: Grid) -> Field:
    """Blur a periodic field with a Gaussian of the given standard deviation, wrapping round the edges."""
    sigma = sigma_mm / grid.texel_mm
    if sigma < 0.3:
        return field
    factor = 1
    while sigma / factor > 6 and grid.pixels % (factor * 2) == 0 and grid.pixels // (factor * 2) >= 32:
        factor *= 2
    edge = grid.pixels // factor
    small = cv2.resize(field, (edge, edge), interpolation=cv2.INTER_AREA) if factor > 1 else field
    margin = min(int(4 * sigma / factor) + 2, edge)
    padded = cv2.copyMakeBorder(small, margin, margin, margin, margin, cv2.BORDER_WRAP)
    soft = cv2.GaussianBlur(padded, (0, 0), sigma / factor)[margin:-margin, margin:-margin]
    return enlarge(np.ascontiguousarray(soft, np.float32), grid.pixels)


def sample(field: Field, x_mm: Field, y_mm: Field, grid: Grid) -> Field:
    """Read a periodic field at any positions, with linear interpolation.

    Args:
        field: Periodic field, shape (H, W) or (H, W, C).
        x_mm: Positions to the right in millimetres, any shape (h, w); outside the tile they wrap round.
        y_mm: Positions downwards in millimetres, shape of `x_mm`; outside the tile they wrap round.
        grid: The grid of `field`.

    Returns:
        Shape (h, w) or (h, w, C).
    """
    scale = np.float32(1.0 / grid.texel_mm)
    columns = np.mod(x_mm * scale - np.float32(0.5), np.float32(grid.pixels))
    rows = np.mod(y_mm * scale - np.float32(0.5), np.float32(grid.pixels))
    padded = cv2.copyMakeBorder(field, 0, 2, 0, 2, cv2.BORDER_WRAP)
    return np.asarray(cv2.remap(padded, columns, rows, cv2.INTER_LINEAR), np.float32)


def warp(field: Field, dx_mm: Field, dy_mm: Field, grid: Grid) -> Field:
    """Displace a periodic field: each texel takes the value found (dx_mm, dy_mm) away from it."""
    x, y = grid.coordinates()
    return sample(field, x + dx_mm, y + dy_mm, grid)


def smoothstep(low: float, high: float, field: npt.NDArray[np.floating[Any]]) -> Field:
    """Rise smoothly from 0 where the field is at or below `low` to 1 where it is at or above `high`."""
    t = np.clip((field - low) / (high - low), 0.0, 1.0).astype(np.float32)
    return t * t * (3 - 2 * t)


def coverage(field: Field, fraction: float, softness: float = 0.15) -> Field:
    """Mask the highest part of a field.

    Args:
        field: Any field of standard deviation near 1.
        fraction: Share of the area to cover, 0 to 1.
        softness: Width of the mask's edge in units of the field.

    Returns:
        Shape of `field`, 0 outside and 1 inside.
    """
    level = float(np.quantile(field[::4, ::4], 1.0 - fraction))
    return smoothstep(level - softness, level + softness, field)


def _working_edge(grid: Grid, fine_mm: float) -> int:
    edge = grid.pixels
    needed = 3.2 * grid.size_mm / fine_mm if fine_mm > 0 else float(edge)
    while edge % 2 == 0 and edge // 2 >= max(needed, SMALLEST_WORKING_EDGE):
        edge //= 2
    return edge


def _squared_frequency(rows: int, columns: int, stretch: tuple[float, float]) -> Field:
    """Squared frequency in cycles per tile, in the packed layout of a real transform (cv2.dft), times stretch."""
    across = _packed_axis(columns) * stretch[0]
    down = np.minimum(np.arange(rows), rows - np.arange(rows)) * stretch[1]
    squared = np.add.outer(down**2, across**2)
    edge_rows = (_packed_axis(rows) * stretch[1]) ** 2
    squared[:, 0] = edge_rows
    if columns % 2 == 0:
        squared[:, -1] = edge_rows + across[-1] ** 2
    return squared.astype(np.float32)


def _packed_axis(length: int) -> npt.NDArray[np.float64]:
    """List the frequencies of a packed real transform: 0, then each twice (its real and its imaginary part)."""
    return np.asarray((np.arange(length) + 1) // 2, np.float64)
