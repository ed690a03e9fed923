"""Leaves, blades and twigs: the growing and fallen parts of a ground."""

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from assets.surfaces.kit.colour import mix, rgb, shade
from assets.surfaces.kit.grid import Field, Grid
from assets.surfaces.kit.noise import smoothstep
from assets.surfaces.kit.pile import Sprite, local_frame, smooth_noise, trimmed
from assets.surfaces.kit.strokes import polygon, polylines


def leaf(rng: np.random.Generator, grid: Grid, length_mm: float, code: str, lobes: int) -> Sprite:
    """Make a fallen leaf, lying at a random angle, curled and spotted.

    Args:
        rng: Source of the randomness.
        grid: Grid that sets the size of a texel.
        length_mm: Length from stalk to tip.
        code: Colour of the leaf, hexadecimal.
        lobes: Number of lobes of the outline along each side; 0 for a smooth edge.

    Returns:
        The leaf.
    """
    x, y, _ = local_frame(rng, grid, 0.56 * length_mm)
    x = x + 0.0025 * float(rng.normal(0, 1)) * y * y
    t = np.clip(x / length_mm + 0.5, 0, 1)
    half = 0.5 * length_mm * rng.uniform(0.42, 0.62)
    width = half * np.power(np.clip(np.sin(np.pi * np.power(t, 0.85)), 0, 1), 0.8)
    if lobes:
        width = width * (0.80 + 0.24 * np.cos(2 * np.pi * lobes * t + np.pi))
    else:
        width = width * (1 + 0.02 * np.sin(2 * np.pi * 26 * t))
    inside = np.where((x > -0.5 * length_mm) & (x < 0.5 * length_mm), width - np.abs(y), -1.0)
    stalk = 0.35 - np.abs(y)
    mask = np.clip(np.maximum(inside, np.where(x < -0.3 * length_mm, stalk, -1.0)) / grid.texel_mm + 0.5, 0, 1)
    rib = np.exp(-np.square(y / 0.35))
    spacing = length_mm / rng.uniform(9, 13)
    side = np.mod(x - 0.75 * np.abs(y), spacing) / spacing
    vein = np.exp(-np.square((side - 0.5) * spacing / 0.28))
    veins = np.maximum(rib, 0.6 * vein)
    mottle = smooth_noise(rng.normal(0, 1, x.shape), 1.6 / grid.texel_mm)
    blotch = smooth_noise(rng.normal(0, 1, x.shape), 5.0 / grid.texel_mm)
    curl = rng.uniform(0.15, 0.7) * np.square(y / half) * half * 0.5
    height = 0.4 + curl + 0.18 * blotch + 0.16 * vein * (rib < 0.5) + 0.3 * rib
    colour = np.broadcast_to(rgb(code), (*x.shape, 3)) * (1 + 0.06 * mottle + 0.10 * blotch)[..., None]
    colour = mix(colour.astype(np.float32), "3a2616", 0.55 * smoothstep(1.2, 2.0, blotch + 0.5 * mottle))
    colour = mix(colour, "c9ab78", (0.4 * veins).astype(np.float32))
    rim = smoothstep(0.0, 1.6, inside)
    colour = shade(colour, (0.8 + 0.2 * rim).astype(np.float32))
    return trimmed(Sprite(colour.astype(np.float32), height.astype(np.float32), mask.astype(np.float32)))


def blades(
    rng: np.random.Generator,
    grid: Grid,
    colour: npt.NDArray[np.uint8],
    height: npt.NDArray[np.uint8],
    count: int,
    length_mm: tuple[float, float],
    width_mm: float,
    codes: Sequence[str],
) -> None:
    """Draw blades of grass, the lowest first, on images in place.

    Args:
        rng: Source of the randomness.
        grid: The tile.
        colour: Colour image of the tile, shape (H, W, 3), sRGB, 0 to 255.
        height: Height image of the tile, shape (H, W), 0 to 255.
        count: Number of blades.
        length_mm: Lengths of the shortest and the longest blade.
        width_mm: Width of a blade at its foot.
        codes: Colours to choose from, hexadecimal.
    """
    palette = np.stack([rgb(code) for code in codes]) * 255.0
    for number in range(count):
        rise = number / count
        foot = rng.uniform(0, grid.size_mm, 2)
        heading, bend = rng.uniform(0, 2 * np.pi), rng.normal(0, 0.5)
        length = float(rng.uniform(*length_mm))
        angles = heading + bend * np.linspace(0, 1, 5)
        steps = np.stack([np.cos(angles), np.sin(angles)], axis=1) * length / 5
        spine = np.concatenate([foot[None], foot + np.cumsum(steps, axis=0)])
        normal = np.array([-np.sin(heading), np.cos(heading)])
        half = 0.5 * width_mm * float(rng.uniform(0.6, 1.3)) * np.array([0.8, 1.0, 0.9, 0.75, 0.45, 0.0])
        left, right = spine + normal * half[:, None], spine - normal * half[:, None]
        base = palette[int(rng.integers(len(palette)))] * (0.45 + 0.6 * rise) * rng.uniform(0.85, 1.15)
        level = 20 + 170 * rise
        polygon(colour, np.concatenate([left, right[::-1]]), np.clip(base, 0, 255).tolist(), grid)
        lit = np.clip(base * 1.22, 0, 255).tolist()
        polygon(colour, np.concatenate([left[1:], spine[:0:-1]]), lit, grid)
        polygon(height, np.concatenate([left, right[::-1]]), (level,), grid)
        polylines(height, spine[:-1], 0.3 * width_mm, (level + 40,), grid)


def twig_paths(rng: np.random.Generator, grid: Grid, count: int, length_mm: float) -> list[npt.NDArray[np.float64]]:
    """Crooked paths of twigs and roots, each of shape (n, 2), in millimetres."""
    paths = []
    for _ in range(count):
        turns = rng.uniform(0, 2 * np.pi) + np.cumsum(rng.normal(0, 0.28, 8))
        steps = np.stack([np.cos(turns), np.sin(turns)], axis=1) * length_mm * rng.uniform(0.3, 1.0) / 8
        paths.append(rng.uniform(0, grid.size_mm, 2) + np.cumsum(steps, axis=0))
    return paths


def as_image(colour: Field) -> npt.NDArray[np.uint8]:
    """Turn a colour, sRGB 0 to 1, into an image of 8 bits that the drawing functions accept."""
    return np.ascontiguousarray(np.rint(np.clip(colour, 0, 1) * 255).astype(np.uint8))
