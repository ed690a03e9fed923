"""Concrete and asphalt."""

import numpy as np

from assets.surfaces.kit.colour import mix, ramp, shade
from assets.surfaces.kit.grid import Field, Grid
from assets.surfaces.kit.maps import SurfaceMaps, finish, hollows
from assets.surfaces.kit.marks import cracks, scratches, specks, stains
from assets.surfaces.kit.noise import coverage, fractal, smoothstep
from assets.surfaces.kit.pile import Pile, pebble
from assets.surfaces.recipe import SurfaceFamily, SurfaceRecipe

GREYS = ((0.0, "6b6a67"), (0.35, "8d8b87"), (0.7, "a8a6a1"), (1.0, "c4c1bb"))
"""Colour ramp of concrete, from damp and dark at 0 to dry and pale at 1, hexadecimal sRGB."""


def concrete_smooth(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Power-floated concrete with trowel marks and faint clouds."""
    tone = 0.56 + 0.12 * _clouds(rng, grid) + 0.02 * fractal(rng, grid, 1.2, 0.0, gain=0.95)
    trowel = fractal(rng, grid, 60, 1.2, gain=0.62, stretch=(3.2, 0.7))
    holes = specks(rng, grid, 0.004, 0.8)
    colour = shade(ramp(tone, GREYS), 1 + 0.018 * trowel)
    colour = mix(colour, "4f4d49", 0.7 * holes)
    marks = scratches(rng, grid, 35, 0.25)
    colour = mix(colour, "cfccc6", 0.14 * marks)
    hair = cracks(rng, grid, 130, 0.35, 0.3)
    colour = mix(colour, "4b4945", 0.6 * hair)
    height = 0.03 * trowel - 0.5 * holes - 0.15 * hair - 0.01 * marks
    rough = 0.5 + 0.05 * trowel + 0.3 * holes
    return finish(grid, colour, rough, np.asarray(height, np.float32))


def concrete_rough(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Coarse cast concrete: sandy, with air holes of every size and aggregate showing."""
    sand = fractal(rng, grid, 8.0, 0.0, gain=0.85)
    broad = fractal(rng, grid, 70, 0.6, gain=0.65)
    zones = smoothstep(-0.8, 1.2, fractal(rng, grid, 130, 5, gain=0.6))
    large = coverage(fractal(rng, grid, 14, 1.8, gain=0.7) + 0.5 * zones, 0.018, 0.12)
    small = coverage(fractal(rng, grid, 5, 0.6, gain=0.8) + 0.7 * zones, 0.05, 0.2)
    tone = 0.47 + 0.13 * broad + 0.10 * sand
    colour = ramp(tone, GREYS)
    bits = coverage(fractal(rng, grid, 7, 1.0, gain=0.8), 0.06, 0.2)
    colour = mix(colour, "b8a992", 0.3 * bits)
    height = 0.11 * sand + 0.2 * broad - 1.3 * large - 0.5 * small
    colour = shade(colour, 1 - 0.6 * large - 0.42 * small)
    return finish(grid, colour, 0.86 + 0.03 * sand, np.asarray(height, np.float32))


def concrete_cracked(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Old slab with a network of cracks, spalls and dirt in them."""
    sand = fractal(rng, grid, 6.0, 0.0, gain=0.85)
    clouds = _clouds(rng, grid)
    wide = cracks(rng, grid, 120, 1.8, 0.6)
    thin = cracks(rng, grid, 42, 0.5, 0.4)
    spall = coverage(fractal(rng, grid, 55, 0.8, gain=0.6), 0.045, 0.06)
    tone = 0.5 + 0.14 * clouds + 0.07 * sand
    colour = ramp(tone, GREYS)
    inner = ramp(0.5 + 0.2 * sand, ((0.0, "6e675d"), (1.0, "a2988a")))
    colour = mix(colour, inner, 0.85 * spall)
    height = 0.06 * sand + 0.08 * clouds - 2.0 * wide - 0.5 * thin - 0.9 * spall * (1 + 0.25 * sand)
    height = np.asarray(height, np.float32)
    colour = mix(colour, "57504a", 0.45 * hollows(height, 3.5, 0.5, grid))
    colour = mix(colour, "1d1b19", np.clip(0.9 * wide + 0.65 * thin, 0, 0.93))
    return finish(grid, colour, 0.8 + 0.04 * sand, height)


def concrete_stained(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Workshop floor with oil, rust, dried puddles and splashes of paint."""
    base = 0.5 + 0.13 * _clouds(rng, grid) + 0.05 * fractal(rng, grid, 6, 0.0, gain=0.85)
    colour = ramp(base, GREYS)
    rough = 0.66 + 0.05 * fractal(rng, grid, 40, 1, gain=0.6)
    for size, share, code, body_weight, rim_weight, gloss in (
        (170, 0.22, "6a6257", 0.35, 0.3, -0.06),
        (90, 0.10, "2f2c2a", 0.6, 0.1, -0.28),
        (60, 0.05, "8a5733", 0.45, 0.45, 0.08),
        (120, 0.12, "c6c2ba", 0.22, 0.4, 0.1),
    ):
        body, rim = stains(rng, grid, size, share)
        colour = mix(colour, code, np.clip(body_weight * body + rim_weight * rim, 0, 0.9))
        rough = rough + gloss * body
    drops = coverage(fractal(rng, grid, 26, 3.0, gain=0.8), 0.006, 0.05)
    colour = mix(colour, "d8d4c9", 0.85 * drops)
    holes = specks(rng, grid, 0.006, 0.8)
    colour = mix(colour, "3b3733", 0.65 * holes)
    marks = scratches(rng, grid, 70, 0.35)
    colour = mix(colour, "c9c5bd", 0.2 * marks)
    height = 0.05 * fractal(rng, grid, 30, 0.3, gain=0.7) - 0.6 * holes + 0.06 * drops - 0.03 * marks
    return finish(grid, colour, np.asarray(rough, np.float32), np.asarray(height, np.float32))


def asphalt(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Worn asphalt: grey chippings in black bitumen."""
    tar = fractal(rng, grid, 5, 0.0, gain=0.8)
    ground = ramp(0.5 + 0.2 * tar, ((0.0, "262627"), (1.0, "47464a")))
    pile = Pile(grid, ground, 0.4 * tar)
    tones = ("6d6b69", "7d7a75", "5a595b", "8b857b", "686460", "9b978f")
    for radius, count in ((3.6, 1500), (2.2, 4200), (1.3, 6500)):
        stones = [pebble(rng, grid, radius * rng.uniform(0.8, 1.2), tones[i % 6], 0.8) for i in range(24)]
        pile.strew(rng, stones, count, brightness=0.1, hue=0.02, sink=0.1)
    # The roller and the traffic have pressed and worn the stones to one level.
    level = np.minimum(pile.height_mm, 0.35 * pile.height_mm + 0.9)
    sunk = 1 - smoothstep(-0.2, 0.5, level + 0.25 * fractal(rng, grid, 40, 1, gain=0.6))
    colour = mix(pile.colour, ground, 0.85 * sunk)
    colour = mix(colour, "7a7368", 0.18 * smoothstep(-0.5, 2, fractal(rng, grid, 110, 1, gain=0.65)))
    return finish(grid, colour, 0.82 + 0.08 * sunk, np.asarray(level, np.float32))


def _clouds(rng: np.random.Generator, grid: Grid) -> Field:
    """Large patches overlaid with ever finer ones, standard deviation about 1."""
    return np.asarray(
        0.8 * fractal(rng, grid, 160, 4, gain=0.6) + 0.6 * fractal(rng, grid, 30, 0.6, gain=0.7), np.float32
    )


RECIPES = tuple(
    SurfaceRecipe(name, SurfaceFamily.CONCRETE, 0.4, draw, published=True)
    for name, draw in (
        ("concrete_smooth", concrete_smooth),
        ("concrete_rough", concrete_rough),
        ("concrete_cracked", concrete_cracked),
        ("concrete_stained", concrete_stained),
        ("asphalt", asphalt),
    )
)
