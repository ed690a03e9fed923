"""Bare stone: split slate, veined marble, banded travertine, speckled granite, chips of terrazzo."""

from collections.abc import Sequence

import numpy as np

from assets.surfaces.kit.cells import edge_distance, scatter, voronoi, warp_labels
from assets.surfaces.kit.colour import mix, ramp, rgb, shade, tint_each
from assets.surfaces.kit.grid import Field, Grid
from assets.surfaces.kit.marks import specks
from assets.surfaces.kit.noise import coverage, fractal, smoothstep, warp


def cleft(field: Field, layers: float) -> tuple[Field, Field]:
    """Split a field into the flat layers and sharp ledges of riven stone.

    Args:
        field: Smooth relief of standard deviation 1.
        layers: Number of layers between the field's values -2 and 2.

    Returns:
        Relief in units of the field, with flats, mean near 0; and the faces of the ledges, 0 to 1; each shape (H, W).
    """
    scaled = field * np.float32(layers / 4.0)
    whole = np.floor(scaled)
    part = scaled - whole
    step = smoothstep(0.86, 1.0, part)
    height = (whole + step + 0.22 * part) / np.float32(layers / 4.0)
    ledge = smoothstep(0.84, 0.9, part) * (1 - smoothstep(0.97, 1.0, part))
    return np.asarray(height - height.mean(), np.float32), ledge


def marble_face(
    rng: np.random.Generator, grid: Grid, stops: Sequence[tuple[float, str]], vein: str, strength: float
) -> tuple[Field, Field]:
    """Draw marble: cloudy ground crossed by folded veins of several widths.

    Args:
        rng: Source of the randomness.
        grid: The tile.
        stops: Colour ramp of the ground: values 0 to 1, and hexadecimal colours.
        vein: Colour of the veins, hexadecimal.
        strength: Opacity of the strongest vein.

    Returns:
        Colour, shape (H, W, 3), and the veins, 0 to 1, shape (H, W).
    """
    dx, dy = (22 * fractal(rng, grid, 150, 4, gain=0.52) for _ in range(2))
    cloud = warp(fractal(rng, grid, 110, 0.8, gain=0.62), dx, dy, grid)
    veins = grid.zeros()
    for coarse, width, weight in ((230, 0.06, 1.0), (120, 0.04, 0.7), (50, 0.05, 0.3)):
        field = warp(fractal(rng, grid, coarse, 1.0, gain=0.5, stretch=(1.6, 0.8)), dx, dy, grid)
        thick = width * (0.4 + 1.6 * smoothstep(-0.5, 2.0, fractal(rng, grid, 90, 4)))
        present = smoothstep(-0.3, 1.0, fractal(rng, grid, 130, 10))
        line = np.exp(-np.abs(field) / thick) * present * weight
        veins = np.maximum(veins, line.astype(np.float32))
    colour = ramp(0.5 + 0.19 * cloud, stops)
    colour = shade(colour, 1 + 0.012 * fractal(rng, grid, 1.5, 0.0, gain=0.9))
    return mix(colour, vein, strength * veins), veins


def travertine_face(rng: np.random.Generator, grid: Grid) -> tuple[Field, Field, Field]:
    """Draw honed travertine; returns colour (H, W, 3), height in millimetres and roughness, each (H, W)."""
    bend = 12 * fractal(rng, grid, 200, 10, gain=0.5, stretch=(1.5, 1.0))
    still = grid.zeros()
    bands = warp(fractal(rng, grid, 45, 1.2, gain=0.68, stretch=(7.0, 1.0)), still, bend, grid)
    cloud = fractal(rng, grid, 40, 0.5, gain=0.7)
    colour = ramp(
        0.5 + 0.17 * bands + 0.07 * cloud, ((0.0, "a98a63"), (0.4, "c9b08a"), (0.75, "d9c6a6"), (1.0, "e6dac3"))
    )
    porous = warp(fractal(rng, grid, 8, 0.9, gain=0.85, stretch=(2.6, 0.9)), still, bend, grid)
    holes = coverage(porous + 0.55 * bands, 0.045, 0.16)
    colour = mix(colour, "6b5236", 0.75 * holes)
    height = -0.7 * holes + 0.006 * cloud
    return colour, np.asarray(height, np.float32), np.asarray(0.42 + 0.4 * holes + 0.03 * cloud, np.float32)


def granite_face(rng: np.random.Generator, grid: Grid, minerals: Sequence[tuple[str, float]], grain_mm: float) -> Field:
    """Draw polished granite: interlocking crystals of several minerals.

    Args:
        rng: Source of the randomness.
        grid: The tile.
        minerals: Colour and share of each mineral; the shares sum to 1.
        grain_mm: Mean size of a crystal.

    Returns:
        Colour, shape (H, W, 3).
    """
    codes = np.stack([rgb(code) for code, _ in minerals])
    shares = [share for _, share in minerals]
    colour = grid.zeros()[..., None]
    for level, size in enumerate((grain_mm, 0.45 * grain_mm)):
        labels = voronoi(scatter(rng, grid, size, 1.0), grid)
        dx, dy = (0.14 * size * fractal(rng, grid, 1.2 * size, 0.5 * size, gain=0.5) for _ in range(2))
        labels = warp_labels(labels, dx, dy, grid)
        which = rng.choice(len(codes), int(labels.max()) + 1, p=shares)
        crystals = codes[which][labels] * tint_each(rng, labels, 0.09, 0.02)
        border = smoothstep(0.0, 0.22 * size, edge_distance(labels, grid, 4.0))
        crystals = shade(crystals, 0.9 + 0.1 * border)
        fine = coverage(fractal(rng, grid, 5 * grain_mm, grain_mm, gain=0.8), 0.4, 0.2) if level else 1.0
        colour = mix(colour, crystals, fine) if level else crystals
    return shade(colour, 1 + 0.03 * fractal(rng, grid, 0.8, 0.0, gain=0.95))


def terrazzo_face(
    rng: np.random.Generator,
    grid: Grid,
    binder: Sequence[tuple[float, str]],
    chips: Sequence[tuple[str, float]],
    share: float,
) -> tuple[Field, Field]:
    """Draw ground terrazzo: angular chips of three sizes in a cement binder.

    Args:
        rng: Source of the randomness.
        grid: The tile.
        binder: Colour ramp of the binder: values 0 to 1, and hexadecimal colours.
        chips: Colour and share of each kind of chip; the shares sum to 1.
        share: Share of the cells that hold a chip.

    Returns:
        Colour, shape (H, W, 3), and the mask of the chips, 0 to 1, shape (H, W).
    """
    sand = fractal(rng, grid, 1.2, 0.0, gain=0.9)
    colour = ramp(0.5 + 0.13 * sand + 0.1 * fractal(rng, grid, 60, 1, gain=0.65), binder)
    colour = mix(colour, "4b453e", 0.3 * specks(rng, grid, 0.02, 0.4))
    codes = np.stack([rgb(code) for code, _ in chips])
    taken = grid.zeros()
    vein = fractal(rng, grid, 7, 0.3, gain=0.75)
    for size in (12.5, 6.2, 3.1):
        labels = voronoi(scatter(rng, grid, size, 1.0), grid)
        dx, dy = (0.035 * size * fractal(rng, grid, 0.6 * size, 1.2, gain=0.5) for _ in range(2))
        labels = warp_labels(labels, dx, dy, grid)
        count = int(labels.max()) + 1
        inset = (rng.uniform(0.03, 0.26, count) * size).astype(np.float32)[labels]
        present = (rng.random(count) < share).astype(np.float32)[labels]
        mask = smoothstep(-0.12, 0.16, edge_distance(labels, grid, 20.0) - inset) * present
        mask *= 1 - smoothstep(0.0, 0.4, taken)
        which = rng.choice(len(codes), count, p=[part for _, part in chips])
        stone = codes[which][labels] * tint_each(rng, labels, 0.07, 0.02)
        colour = mix(colour, shade(stone, 1 + 0.04 * vein), mask)
        taken = np.maximum(taken, mask)
    return colour, taken
