"""Traces of use that many floors share: scratches, dirt, specks, stains and cracks."""

import cv2
import numpy as np

from assets.surfaces.kit.cells import edge_distance, scatter, voronoi, warp_labels
from assets.surfaces.kit.grid import Field, Grid
from assets.surfaces.kit.noise import coverage, fractal, smoothstep
from assets.surfaces.kit.strokes import as_field, curve, polylines


def scratches(rng: np.random.Generator, grid: Grid, count: int, width_mm: float) -> Field:
    """Draw fine scratches of every length and strength, broken where the tool skipped; 0 to 1, shape (H, W)."""
    image = np.zeros((grid.pixels, grid.pixels), np.uint8)
    for _ in range(count):
        start = rng.uniform(0, grid.size_mm, 2)
        length = float(rng.lognormal(3.2, 0.7))
        path = curve(rng, start.tolist(), min(length, 0.45 * grid.size_mm), 0.25)
        layer = float(rng.uniform(70, 255))
        polylines(image, path, width_mm * float(rng.uniform(0.5, 1.4)), (layer,), grid)
    soft = cv2.GaussianBlur(
        cv2.copyMakeBorder(image, 4, 4, 4, 4, cv2.BORDER_WRAP), (0, 0), max(0.3, 0.3 * width_mm / grid.texel_mm)
    )[4:-4, 4:-4]
    broken = smoothstep(-1.0, 0.6, fractal(rng, grid, 12, 0.6, gain=0.8))
    return np.asarray(as_field(np.asarray(soft, np.uint8)) * broken, np.float32)


def dust(rng: np.random.Generator, grid: Grid, where: Field) -> Field:
    """Patchy dirt, 0 to 1, shape (H, W): it lies where `where` (0 to 1) allows, thicker and thinner at random."""
    patches = smoothstep(-1.2, 1.4, fractal(rng, grid, 60, 0.8, gain=0.7))
    return np.asarray(where * patches, np.float32)


def specks(rng: np.random.Generator, grid: Grid, share: float, size_mm: float) -> Field:
    """Draw small separate specks of about `size_mm`, covering `share` of the area; 0 to 1, shape (H, W)."""
    field = fractal(rng, grid, 8 * size_mm, 1.1 * size_mm, gain=0.85)
    clumps = fractal(rng, grid, 70, 10)
    return coverage(field + 0.28 * clumps, share, 0.25)


def stains(rng: np.random.Generator, grid: Grid, size_mm: float, share: float) -> tuple[Field, Field]:
    """Draw dried puddles: a body and the darker rim left at its border; each 0 to 1, shape (H, W)."""
    field = fractal(rng, grid, size_mm, 0.8, gain=0.47) + 0.05 * fractal(rng, grid, 9, 0.6, gain=0.75)
    level = float(np.quantile(field[::4, ::4], 1.0 - share))
    inside = field - level
    # A puddle dries unevenly: parts of its border are crisp, parts fade away.
    fade = 0.04 + 0.5 * smoothstep(-0.8, 1.0, fractal(rng, grid, 0.8 * size_mm, 8))
    body = np.clip(inside / fade, 0, 1) * (0.75 + 0.25 * smoothstep(-1, 1, fractal(rng, grid, 30, 0.6, gain=0.7)))
    rim = np.exp(-np.square((inside - 0.03) / 0.04)) * np.clip(0.08 / fade, 0, 1)
    return np.asarray(body, np.float32), np.asarray(rim, np.float32)


def cracks(rng: np.random.Generator, grid: Grid, spacing_mm: float, width_mm: float, keep: float) -> Field:
    """Draw a network of cracks along the wandering borders of large cells.

    Args:
        rng: Source of the randomness.
        grid: The tile.
        spacing_mm: Mean distance between cracks.
        width_mm: Width where a crack gapes.
        keep: Share of the area in which the network's cracks are open.

    Returns:
        0 sound to 1 open, shape (H, W).
    """
    labels = voronoi(scatter(rng, grid, spacing_mm, 1.0), grid)
    wander, kink = 0.08 * spacing_mm, 0.008 * spacing_mm
    dx, dy = (
        wander * fractal(rng, grid, 1.3 * spacing_mm, 0.2 * spacing_mm, gain=0.5)
        + kink * fractal(rng, grid, 0.2 * spacing_mm, 0.8, gain=0.55)
        for _ in range(2)
    )
    distance = edge_distance(warp_labels(labels, dx, dy, grid), grid, 6.0)
    open_share = fractal(rng, grid, 1.3 * spacing_mm, 6.0)
    level = float(np.quantile(open_share, 1.0 - keep))
    gape = np.clip((open_share - level) / 0.5, 0, 1) * (0.7 + 0.3 * fractal(rng, grid, 14, 2.0, gain=0.6))
    half = np.maximum(0.5 * width_mm * gape, 1e-3)
    return np.asarray(np.clip(1.5 - distance / half, 0, 1) * (gape > 0.05), np.float32)
