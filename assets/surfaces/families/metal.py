"""Metal floors and plates."""

import numpy as np

from assets.surfaces.kit.cells import edge_distance, mask_distance, scatter, voronoi, warp_labels
from assets.surfaces.kit.colour import mix, ramp, shade, value_each
from assets.surfaces.kit.grid import Field, Grid
from assets.surfaces.kit.maps import SurfaceMaps, finish
from assets.surfaces.kit.marks import scratches, specks, stains
from assets.surfaces.kit.noise import coverage, fractal, smoothstep
from assets.surfaces.recipe import SurfaceFamily, SurfaceRecipe

RUST = ((0.0, "2e1a12"), (0.3, "57301c"), (0.6, "8a4b25"), (0.85, "b0703a"), (1.0, "c79459"))
"""Colour ramp of rust, from dark scale at 0 to pale orange bloom at 1, hexadecimal sRGB."""


def brushed_steel(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Stainless steel brushed along x, with fingermarks and scratches."""
    brush = fractal(rng, grid, 3.0, 0.0, gain=0.9, stretch=(60.0, 1.0))
    smear = fractal(rng, grid, 90, 2, gain=0.6)
    marks = scratches(rng, grid, 60, 0.2)
    colour = ramp(0.5 + 0.12 * brush + 0.06 * smear, ((0.0, "8f9091"), (1.0, "c3c3c1")))
    colour = mix(colour, "d9d9d7", 0.3 * marks)
    body, rim = stains(rng, grid, 110, 0.14)
    colour = shade(colour, 1 - 0.07 * body - 0.06 * rim)
    rough = 0.33 + 0.05 * brush + 0.04 * smear + 0.08 * body
    height = 0.0035 * brush - 0.006 * marks
    return finish(grid, colour, np.asarray(rough, np.float32), np.asarray(height, np.float32), 1.0)


def rusted_steel(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Steel plate rusted all over, with dark scale, orange bloom and pits."""
    colour, height = _rust(rng, grid)
    scale = coverage(fractal(rng, grid, 70, 0.7, gain=0.62), 0.26, 0.25)
    dark = ramp(0.5 + 0.2 * fractal(rng, grid, 9, 0.0, gain=0.75), ((0.0, "241c1a"), (1.0, "5a453a")))
    colour = mix(colour, dark, 0.85 * scale)
    height = height + 0.15 * scale
    rough = 0.86 - 0.22 * scale
    return finish(grid, colour, rough, np.asarray(height, np.float32), 0.0)


def painted_metal_chipped(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Pale paint blistering and flaking off rusty plate, with runs of rust."""
    rust, relief = _rust(rng, grid)
    field = fractal(rng, grid, 110, 0.6, gain=0.66) + 0.45 * fractal(rng, grid, 14, 0.6, gain=0.75)
    level = float(np.quantile(field[::4, ::4], 0.30))
    present = field > level
    inset = mask_distance(present, grid, 12.0)
    paint = smoothstep(0.0, 0.3, inset)
    cloud = fractal(rng, grid, 60, 0.8, gain=0.65)
    coat = ramp(0.5 + 0.15 * cloud, ((0.0, "98a29d"), (0.5, "b6bdb7"), (1.0, "cfd2ca")))
    seep = np.exp(-inset / 4.5) * smoothstep(-0.6, 1.4, fractal(rng, grid, 30, 0.6, gain=0.7))
    coat = mix(coat, "9a5b30", np.clip(0.75 * seep, 0, 1))
    dots = coverage(fractal(rng, grid, 20, 1.0, gain=0.8), 0.025, 0.25)
    coat = mix(coat, "7a4222", 0.7 * dots)
    coat = mix(coat, "6a6f6c", 0.25 * scratches(rng, grid, 45, 0.35))
    blister = smoothstep(1.0, 2.4, fractal(rng, grid, 16, 3, gain=0.6))
    curl = np.exp(-inset / 1.2)
    colour = mix(shade(rust, 1 - 0.35 * np.exp(-mask_distance(~present, grid, 6.0) / 0.7)), coat, paint)
    height = relief + (0.16 + 0.22 * curl + 0.25 * blister + 0.02 * cloud - 0.8 * relief) * paint
    rough = 0.88 + (0.42 + 0.07 * cloud + 0.25 * seep - 0.88) * paint
    return finish(grid, colour, np.asarray(rough, np.float32), np.asarray(height, np.float32), 0.0)


def diamond_plate(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Steel tread plate: raised lozenges in alternating directions, worn bright on top and dirty between them."""
    pitch = grid.size_mm / 14
    x, y = grid.coordinates()
    column, row = np.floor(x / pitch), np.floor(y / pitch)
    u, v = x - (column + 0.5) * pitch, y - (row + 0.5) * pitch
    turn = np.where(np.mod(column + row, 2) > 0.5, 1.0, -1.0)
    along, across = (u + turn * v) * np.sqrt(0.5), (v - turn * u) * np.sqrt(0.5)
    lens = 1 - np.square(along / (0.56 * pitch)) - np.abs(across) / (0.135 * pitch)
    raised = smoothstep(0.0, 0.55, lens)
    grain = fractal(rng, grid, 5, 0.0, gain=0.8)
    wear = smoothstep(0.5, 1.0, raised + 0.1 * grain)
    dirt = smoothstep(-0.4, 1.6, fractal(rng, grid, 80, 0.7, gain=0.68) - 1.2 * raised)
    colour = ramp(0.5 + 0.12 * grain, ((0.0, "77787a"), (1.0, "a3a3a2")))
    colour = mix(colour, "c4c4c2", 0.7 * wear)
    marks = scratches(rng, grid, 90, 0.25)
    colour = mix(colour, "cfcfcd", 0.3 * marks)
    around = np.exp(-np.square((lens + 0.12) / 0.25)) * (1 - raised)
    grime = np.clip(0.7 * dirt + 0.35 * around, 0, 0.9).astype(np.float32)
    colour = mix(colour, "443a30", grime)
    rust = coverage(fractal(rng, grid, 60, 0.6, gain=0.72), 0.05, 0.5) * (1 - wear)
    colour = mix(colour, "7c4825", 0.7 * rust)
    cover = np.clip(grime + rust, 0, 1)
    rough = 0.42 - 0.14 * wear + 0.4 * cover + 0.03 * grain
    height = 1.3 * raised + 0.02 * grain
    metallic = np.asarray(1 - 0.9 * cover, np.float32)
    return finish(grid, colour, np.asarray(rough, np.float32), np.asarray(height, np.float32), metallic)


def galvanised_steel(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Hot-dip galvanised sheet with spangles of zinc, white bloom and scratches."""
    labels = voronoi(scatter(rng, grid, 13.0, 1.0), grid)
    dx, dy = (1.0 * fractal(rng, grid, 9, 1.0, gain=0.55) for _ in range(2))
    labels = warp_labels(labels, dx, dy, grid)
    tone = value_each(rng, labels, 0.15, 0.85)
    angle = value_each(rng, labels, 0.0, float(np.pi))
    x, y = grid.coordinates()
    ripple = 0.5 * fractal(rng, grid, 6, 0.5, gain=0.7)
    dendrite = np.sin((x * np.cos(angle) + y * np.sin(angle)) * 4.0 + 2.0 * ripple)
    border = 1 - smoothstep(0.0, 0.5, edge_distance(labels, grid, 3.0))
    tone = tone + 0.05 * dendrite + 0.06 * ripple - 0.12 * border
    colour = ramp(np.asarray(tone, np.float32), ((0.0, "868b8f"), (0.5, "a0a4a7"), (1.0, "babdbe")))
    bloom = smoothstep(0.9, 2.3, fractal(rng, grid, 80, 0.6, gain=0.7))
    colour = mix(colour, "c9cac8", 0.6 * bloom)
    marks = scratches(rng, grid, 45, 0.22)
    colour = mix(colour, "d5d6d6", 0.3 * marks)
    rough = 0.36 + 0.14 * (tone - 0.5) + 0.35 * bloom + 0.04 * ripple
    height = 0.004 * dendrite + 0.012 * ripple - 0.01 * border - 0.008 * marks
    metallic = np.asarray(1 - 0.85 * bloom, np.float32)
    return finish(grid, colour, np.asarray(rough, np.float32), np.asarray(height, np.float32), metallic)


def enamelled_steel(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Grey-green machine enamel on steel, grimy and scratched down to the bright metal."""
    cloud = fractal(rng, grid, 80, 0.8, gain=0.64)
    peel = fractal(rng, grid, 2.6, 0.8, gain=0.6)
    colour = ramp(0.5 + 0.14 * cloud, ((0.0, "48594f"), (0.5, "5d7064"), (1.0, "75877a")))
    chips = coverage(fractal(rng, grid, 30, 0.7, gain=0.72) + 0.8 * fractal(rng, grid, 130, 10), 0.018, 0.06)
    deep = np.maximum(scratches(rng, grid, 40, 0.4), chips)
    colour = mix(colour, "3a4a40", 0.3 * scratches(rng, grid, 120, 0.3))
    steel = smoothstep(0.35, 0.75, deep)
    primer = smoothstep(0.15, 0.5, deep)
    bare = ramp(0.5 + 0.2 * fractal(rng, grid, 6, 0.3, gain=0.7), ((0.0, "6d6661"), (1.0, "a9a7a3")))
    colour = mix(mix(colour, "8c4f38", primer), bare, steel)
    body, rim = stains(rng, grid, 130, 0.2)
    colour = mix(colour, "2c2a25", 0.3 * body + 0.15 * rim)
    colour = mix(colour, "2a2a26", 0.5 * specks(rng, grid, 0.01, 0.5))
    rough = 0.36 + 0.06 * cloud + 0.18 * body + 0.1 * steel
    height = 0.012 * peel - 0.09 * primer
    return finish(grid, colour, np.asarray(rough, np.float32), np.asarray(height, np.float32), np.asarray(0.9 * steel))


def _rust(rng: np.random.Generator, grid: Grid) -> tuple[Field, Field]:
    """Bare rust: colour (H, W, 3) and height in millimetres (H, W)."""
    grain = fractal(rng, grid, 7.0, 0.0, gain=0.85)
    bloom = fractal(rng, grid, 55, 0.5, gain=0.7)
    tone = 0.52 + 0.15 * bloom + 0.10 * grain
    colour = ramp(np.asarray(tone, np.float32), RUST)
    pits = coverage(fractal(rng, grid, 9, 0.9, gain=0.8), 0.06, 0.25)
    colour = mix(colour, "24140e", 0.6 * pits)
    height = 0.06 * grain + 0.1 * bloom - 0.35 * pits
    return colour, np.asarray(height, np.float32)


RECIPES = tuple(
    SurfaceRecipe(name, SurfaceFamily.METAL, 0.4, draw, version=2, published=True)
    for name, draw in (
        ("brushed_steel", brushed_steel),
        ("rusted_steel", rusted_steel),
        ("painted_metal_chipped", painted_metal_chipped),
        ("diamond_plate", diamond_plate),
        ("galvanised_steel", galvanised_steel),
        ("enamelled_steel", enamelled_steel),
    )
)
