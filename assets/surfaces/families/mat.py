"""Mats for the workbench: the cutting mat with its grid, anti-static rubber, foam and honeycomb."""

import numpy as np

from assets.surfaces.kit.cells import edge_distance, scatter, voronoi
from assets.surfaces.kit.colour import mix, ramp, shade
from assets.surfaces.kit.grid import Field, Grid
from assets.surfaces.kit.lettering import stamp, text_patch
from assets.surfaces.kit.maps import SurfaceMaps, finish
from assets.surfaces.kit.marks import scratches, specks, stains
from assets.surfaces.kit.noise import coverage, fractal, smoothstep
from assets.surfaces.kit.shapes import filled, repeated
from assets.surfaces.kit.strokes import Image, as_field, polylines
from assets.surfaces.recipe import SurfaceFamily, SurfaceRecipe

CUT_BEND_MM = 0.3
"""Standard deviation of a knife cut's bow, millimetres: even a cut along a ruler isn't perfectly straight."""


def cutting_mat(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Dark green cutting mat: lines every 10 and 50 mm, numbers of centimetres along some, knife cuts and glue."""
    pebble = fractal(rng, grid, 1.6, 0.5, gain=0.8)
    cloud = fractal(rng, grid, 120, 1.5, gain=0.62)
    colour = ramp(0.5 + 0.14 * cloud + 0.06 * pebble, ((0.0, "1d4a3c"), (0.5, "275a49"), (1.0, "356b58")))
    print_wear = smoothstep(-1.9, 0.2, fractal(rng, grid, 60, 0.7, gain=0.7) + 0.35 * pebble)
    ink = np.maximum(_ruling(grid), as_field(_numbers(grid))) * (0.35 + 0.65 * print_wear)
    colour = mix(colour, "c9cf9d", np.asarray(0.8 * ink, np.float32))
    worn = smoothstep(0.0, 2.2, fractal(rng, grid, 110, 0.8, gain=0.66))
    colour = mix(colour, "6f8a7b", 0.22 * worn)
    cuts = _cuts(rng, grid, 150)
    # A cut shows pale where the blade has turned up its lips, and dark where it still gapes.
    open_cut = cuts * smoothstep(0.3, 1.2, fractal(rng, grid, 50, 2, gain=0.6))
    colour = mix(mix(colour, "8fa596", 0.5 * cuts), "12261f", 0.6 * open_cut)
    glue, rim = stains(rng, grid, 45, 0.012)
    colour = mix(colour, "a9b3a0", 0.22 * glue + 0.3 * rim)
    colour = mix(colour, "c8c6bb", 0.6 * specks(rng, grid, 0.0012, 0.5))
    rough = 0.62 + 0.04 * cloud - 0.12 * glue + 0.08 * cuts
    height = 0.025 * pebble - 0.06 * cuts + 0.03 * glue
    return finish(grid, colour, np.asarray(rough, np.float32), np.asarray(height, np.float32))


def antistatic_mat_blue(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Light blue anti-static bench mat, finely embossed, with burns of a soldering iron and stains of flux."""
    return _rubber(rng, grid, ((0.0, "5f8bb4"), (0.5, "729dc3"), (1.0, "86aed0")), "c7d8e6", "35506b")


def antistatic_mat_green(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Green anti-static bench mat, finely embossed, with burns of a soldering iron and stains of flux."""
    return _rubber(rng, grid, ((0.0, "3f8a6c"), (0.5, "4f9c7d"), (1.0, "63ae90")), "b9d9c9", "26503f")


def foam_mat(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Grey egg-crate foam: rounded peaks 25 mm apart, open pores, dark valleys with dust in them."""
    x, y = grid.coordinates()
    dx, dy = (0.8 * fractal(rng, grid, 60, 12, gain=0.5) for _ in range(2))
    turn = np.float32(2 * np.pi * 16 / grid.size_mm)
    wave = 0.5 * (np.cos(turn * (x + dx)) * np.cos(turn * (y + dy)) + 1)
    peak = np.asarray(np.power(wave, 0.8), np.float32)
    coarse = fractal(rng, grid, 2.2, 0.7, gain=0.85)
    fine = fractal(rng, grid, 1.0, 0.0, gain=0.9)
    pores = smoothstep(0.5, 1.6, coarse + 0.4 * fine)
    cloud = fractal(rng, grid, 100, 2, gain=0.62)
    tone = 0.12 + 0.78 * smoothstep(0.0, 0.8, peak) + 0.07 * cloud - 0.42 * pores + 0.1 * fine
    colour = ramp(np.asarray(tone, np.float32), ((0.0, "2b2c2e"), (0.5, "5d5f62"), (1.0, "85878a")))
    rubbed = smoothstep(0.75, 1.0, peak) * smoothstep(-0.8, 1.4, fractal(rng, grid, 70, 1, gain=0.65))
    colour = mix(colour, "a3a39f", 0.3 * rubbed)
    lint = specks(rng, grid, 0.002, 0.7)
    colour = mix(colour, "c9c4b8", 0.65 * lint)
    torn = coverage(fractal(rng, grid, 22, 0.9, gain=0.68), 0.004, 0.05)
    colour = shade(colour, 1 - 0.35 * torn)
    height = 6.5 * peak + 0.1 * coarse + 0.05 * fine - 0.25 * pores - 0.6 * torn
    return finish(grid, colour, 0.94, np.asarray(height, np.float32))


def honeycomb_mat(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Grey plastic honeycomb: six-sided cells 16 mm wide, ribs of 2.4 mm, dust and shade inside."""
    inset = _hexagons(grid, 25, 28) - 1.2
    rib = 1 - smoothstep(-0.25, 0.25, inset)
    crown = np.sqrt(np.clip(1 - np.square(np.clip(inset + 1.2, 0, 1.2) / 1.25), 0, 1))
    grainy = fractal(rng, grid, 1.8, 0.3, gain=0.85)
    cloud = fractal(rng, grid, 110, 1, gain=0.64)
    colour = ramp(0.5 + 0.14 * cloud + 0.05 * grainy, ((0.0, "8b8e90"), (0.5, "9ea1a2"), (1.0, "b0b2b2")))
    marks = scratches(rng, grid, 120, 0.3)
    colour = mix(colour, "cfd0cf", 0.4 * marks)
    scuffed = smoothstep(0.2, 2.0, fractal(rng, grid, 60, 0.8, gain=0.7))
    colour = mix(colour, "6f6b65", 0.25 * scuffed)
    depth = smoothstep(0.0, 5.5, inset)
    floor = ramp(0.35 + 0.4 * depth + 0.06 * grainy, ((0.0, "26282a"), (0.5, "43464a"), (1.0, "5d6063")))
    litter = coverage(fractal(rng, grid, 7, 0.6, gain=0.85) + 0.5 * fractal(rng, grid, 90, 8), 0.05, 0.25)
    floor = mix(floor, "8c8576", np.asarray(0.5 * litter * depth, np.float32))
    colour = mix(floor, colour, rib)
    height = rib * (1.6 * crown + 0.01 * grainy - 0.02 * marks) + (1 - rib) * 0.06 * litter
    rough = 0.75 + rib * (0.08 * scuffed + 0.1 * marks - 0.27)
    return finish(grid, colour, np.asarray(rough, np.float32), np.asarray(height, np.float32))


def _rubber(
    rng: np.random.Generator, grid: Grid, stops: tuple[tuple[float, str], ...], pale: str, dark: str
) -> SurfaceMaps:
    """Embossed rubber: finely pebbled, polished by sleeves, scratched pale, stained by flux and burnt in spots."""
    labels = voronoi(scatter(rng, grid, 1.25, 0.9), grid)
    pebble = smoothstep(0.0, 0.45, edge_distance(labels, grid, 2.0))
    cloud = fractal(rng, grid, 130, 1.2, gain=0.62)
    fine = fractal(rng, grid, 1.0, 0.0, gain=0.9)
    colour = ramp(0.5 + 0.12 * cloud + 0.04 * fine + 0.2 * (pebble - 0.6), stops)
    grey = smoothstep(-0.2, 2.2, fractal(rng, grid, 90, 0.8, gain=0.68))
    colour = mix(colour, "7b7a74", 0.16 * grey)
    marks = scratches(rng, grid, 90, 0.25)
    knocks = scratches(rng, grid, 16, 0.9)
    colour = mix(mix(colour, pale, 0.45 * marks), dark, 0.35 * knocks)
    flux, rim = stains(rng, grid, 50, 0.02)
    colour = mix(colour, "8a7b52", 0.2 * flux + 0.3 * rim)
    heat = fractal(rng, grid, 34, 0.9, gain=0.6)
    burn = coverage(heat, 0.0004, 0.12)
    scorch = coverage(heat, 0.0012, 0.5)
    colour = mix(mix(colour, "6e5a3c", 0.45 * scorch), "30261d", 0.75 * burn)
    solder = coverage(fractal(rng, grid, 26, 0.9, gain=0.65), 0.0006, 0.04)
    colour = mix(colour, "b9babb", 0.9 * solder)
    polished = smoothstep(-0.4, 1.6, fractal(rng, grid, 120, 5, gain=0.55))
    rough = 0.56 - 0.1 * polished + 0.1 * marks - 0.15 * flux + 0.2 * burn
    height = 0.1 * pebble * (1 - 0.35 * polished) - 0.02 * marks - 0.2 * burn + 0.2 * solder + 0.02 * flux
    return finish(grid, colour, np.asarray(rough, np.float32), np.asarray(height, np.float32), np.asarray(0.9 * solder))


def _hexagons(grid: Grid, columns: int, rows: int) -> Field:
    """Distance from each texel to the border of its six-sided cell, in millimetres.

    The cells lie in staggered rows, so that the tile's edges meet only if the number of rows is even.
    """
    x, y = grid.coordinates()
    across, down = grid.size_mm / columns, grid.size_mm / rows
    nearest = np.full_like(x, np.inf)
    second = np.full_like(x, np.inf)
    for row in (-1, 0, 1):
        own_row = np.floor(y / np.float32(down)) + row
        u = repeated(x, across, 0.5 * across * np.mod(own_row, 2))
        v = y - (own_row + 0.5) * np.float32(down)
        for step in (-across, 0.0, across):
            distance = np.hypot(u + np.float32(step), v)
            second = np.minimum(second, np.maximum(nearest, distance))
            nearest = np.minimum(nearest, distance)
    # On the border two centres are equally far; the distance to it is half the difference of the squared distances to
    # the centres, divided by the centres' distance from each other.
    return np.asarray((np.square(second) - np.square(nearest)) / (2 * across), np.float32)


def _ruling(grid: Grid) -> Field:
    """Mask of the ruling, 0 to 1: thin lines every 10 mm, thicker ones every 50 mm, ticks every 2 mm along some."""
    x, y = grid.coordinates()
    ink = grid.zeros()
    for along, across in ((x, y), (y, x)):
        fine = filled(np.abs(repeated(along, 10.0, 5.0)) - np.float32(0.11), grid)
        bold = filled(np.abs(repeated(along, 50.0, 25.0)) - np.float32(0.24), grid)
        tick = filled(np.abs(repeated(along, 2.0, 1.0)) - np.float32(0.09), grid)
        tick = tick * filled(np.abs(repeated(across, 200.0, 100.0)) - np.float32(1.2), grid)
        ink = np.maximum(ink, np.maximum(np.maximum(0.62 * fine, bold), 0.7 * tick))
    return ink


def _numbers(grid: Grid) -> Image:
    """Image of the centimetres' numbers beside the lines that carry ticks, 0 to 255, shape (H, W)."""
    image = np.zeros((grid.pixels, grid.pixels), np.uint8)
    for line in np.arange(0.0, grid.size_mm, 200.0):
        for centimetre in range(1, int(grid.size_mm / 10)):
            patch = text_patch(str(centimetre), 2.2, grid)
            stamp(image, patch, 10.0 * centimetre, line + 3.6, grid)
            stamp(image, patch, line + 3.8, 10.0 * centimetre - 2.2, grid)
    return image


def _cuts(rng: np.random.Generator, grid: Grid, count: int) -> Field:
    """Mask of knife cuts: long, nearly straight, many along the ruling, each as deep as its value; 0 to 1, (H, W)."""
    image = np.zeros((grid.pixels, grid.pixels), np.uint8)
    for _ in range(count):
        square = rng.random() < 0.6
        angle = rng.integers(2) * np.pi / 2 + rng.normal(0, 0.03) if square else rng.uniform(0, np.pi)
        length = min(float(rng.lognormal(4.0, 0.6)), 0.8 * grid.size_mm)
        steps = np.linspace(0, length, 5)
        bow = rng.normal(0, CUT_BEND_MM) * np.sin(np.pi * steps / length)
        start = rng.uniform(0, grid.size_mm, 2)
        path = np.stack(
            [
                start[0] + steps * np.cos(angle) - bow * np.sin(angle),
                start[1] + steps * np.sin(angle) + bow * np.cos(angle),
            ],
            axis=1,
        )
        layer = np.zeros_like(image)
        polylines(layer, path, float(rng.uniform(0.1, 0.3)), (float(rng.uniform(50, 255)),), grid)
        np.maximum(image, layer, out=image)
    broken = smoothstep(-1.6, 0.2, fractal(rng, grid, 20, 0.6, gain=0.75))
    return np.asarray(as_field(image) * broken, np.float32)


RECIPES = tuple(
    SurfaceRecipe(name, SurfaceFamily.PLASTIC, 0.4, draw, version)
    for name, draw, version in (
        ("cutting_mat", cutting_mat, 1),
        ("antistatic_mat_blue", antistatic_mat_blue, 2),
        ("antistatic_mat_green", antistatic_mat_green, 2),
        ("foam_mat", foam_mat, 1),
        ("honeycomb_mat", honeycomb_mat, 1),
    )
)
