"""Plaster: trowelled, sprayed and peeling."""

import numpy as np

from assets.surfaces.kit.cells import mask_distance
from assets.surfaces.kit.colour import mix, ramp, shade
from assets.surfaces.kit.grid import Grid
from assets.surfaces.kit.maps import SurfaceMaps, finish, hollows
from assets.surfaces.kit.marks import cracks, specks, stains
from assets.surfaces.kit.noise import coverage, fractal, smoothstep, warp
from assets.surfaces.recipe import SurfaceFamily, SurfaceRecipe


def plaster_white(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """White plaster with the ridges of the trowel and a few hairline cracks."""
    dx, dy = (18 * fractal(rng, grid, 120, 12, gain=0.5) for _ in range(2))
    sweep = warp(fractal(rng, grid, 45, 0.8, gain=0.62, stretch=(3.0, 0.8)), dx, dy, grid)
    sand = fractal(rng, grid, 3.0, 0.0, gain=0.85)
    ridge = np.exp(-np.abs(warp(fractal(rng, grid, 60, 3, gain=0.45), dx, dy, grid)) / 0.05)
    hair = cracks(rng, grid, 100, 0.3, 0.3)
    colour = ramp(0.5 + 0.13 * sweep + 0.04 * sand, ((0.0, "c1bbaf"), (0.6, "d5d0c6"), (1.0, "e2ded6")))
    colour = mix(colour, "b3a891", 0.2 * smoothstep(0.2, 2.2, fractal(rng, grid, 140, 3, gain=0.6)))
    colour = mix(colour, "847b6c", 0.5 * hair)
    height = 0.12 * sweep + 0.022 * sand + 0.10 * ridge - 0.2 * hair
    return finish(grid, colour, 0.82 + 0.03 * sweep, np.asarray(height, np.float32))


def plaster_peeling(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Cream and ochre limewash flaking off brown mortar, layer by layer."""
    sand = fractal(rng, grid, 7.0, 0.0, gain=0.82)
    rough_mortar = fractal(rng, grid, 30, 0.4, gain=0.68)
    mortar = ramp(0.5 + 0.12 * sand + 0.16 * rough_mortar, ((0.0, "755433"), (0.5, "9c7549"), (1.0, "bd996c")))
    mortar = mix(mortar, "d0b893", 0.4 * specks(rng, grid, 0.03, 0.9))
    height = 0.12 * sand + 0.2 * rough_mortar
    colour = mortar
    shared = fractal(rng, grid, 130, 0.7, gain=0.6)
    mask = grid.zeros()
    for stops, kept, thick in (
        (((0.0, "a98038"), (0.5, "c9a04e"), (1.0, "dcc079")), 0.70, 0.7),
        (((0.0, "c2b391"), (0.5, "d8ccae"), (1.0, "e7dfca")), 0.58, 0.5),
    ):
        own = 0.85 * shared + 0.5 * fractal(rng, grid, 60, 0.7, gain=0.6)
        level = float(np.quantile(own[::4, ::4], 1 - kept))
        present = own > level
        inset = mask_distance(present, grid, 12.0)
        mask = smoothstep(0.0, 0.35, inset)
        cloud = fractal(rng, grid, 70, 0.6, gain=0.68)
        coat = ramp(0.5 + 0.17 * cloud, stops)
        lift = np.asarray(np.exp(-inset / 2.4), np.float32) * smoothstep(-0.4, 1.2, fractal(rng, grid, 45, 4))
        coat = shade(coat, np.asarray(1 + 0.05 * lift, np.float32))
        below = 1 - smoothstep(0.0, 1.6, mask_distance(~present, grid, 6.0))
        colour = mix(shade(colour, np.asarray(1 - 0.4 * below * (1 - mask), np.float32)), coat, mask)
        skin = thick + 0.06 * cloud + 0.7 * lift + 0.25 * height
        height = height + skin * mask
    hair = cracks(rng, grid, 38, 0.45, 0.45) * smoothstep(0.0, 0.3, mask)
    colour = mix(colour, "5b4930", 0.65 * hair)
    body, rim = stains(rng, grid, 120, 0.2)
    colour = mix(colour, "a08252", 0.2 * body + 0.15 * rim)
    height = np.asarray(height - 0.3 * hair, np.float32)
    return finish(grid, colour, 0.86 + 0.03 * sand, height)


def stucco(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Sprayed stucco, warm grey: flattened blobs over a sandy ground."""
    blob = fractal(rng, grid, 16, 2.5, gain=0.6)
    flat = np.minimum(smoothstep(-0.1, 1.0, blob), 0.8) / 0.8
    sand = fractal(rng, grid, 4.0, 0.0, gain=0.85)
    height = np.asarray(1.1 * flat + 0.12 * sand * (1 - 0.6 * flat) + 0.1 * blob, np.float32)
    tone = 0.5 + 0.05 * sand + 0.1 * fractal(rng, grid, 110, 2, gain=0.62)
    colour = ramp(tone, ((0.0, "a1907c"), (0.5, "c0b09a"), (1.0, "d6c9b5")))
    colour = mix(colour, "6f6252", 0.5 * hollows(height, 2.5, 0.9, grid))
    dirt = coverage(fractal(rng, grid, 80, 1, gain=0.65), 0.18, 0.9)
    colour = mix(colour, "84766a", 0.3 * dirt)
    return finish(grid, colour, 0.88 - 0.08 * flat, height)


RECIPES = tuple(
    SurfaceRecipe(name, SurfaceFamily.PLASTER, 0.4, draw, published=True, light=name == "plaster_white")
    for name, draw in (
        ("plaster_white", plaster_white),
        ("plaster_peeling", plaster_peeling),
        ("stucco", stucco),
    )
)
