"""Brickwork: a wall of facing bricks and a pavement of clinker."""

import numpy as np

from assets.surfaces.kit.cells import rounded
from assets.surfaces.kit.colour import mix, ramp, rgb, shade, tint_each, value_each
from assets.surfaces.kit.grid import Field, Grid, Labels
from assets.surfaces.kit.layouts import Layout, herringbone, tiles
from assets.surfaces.kit.maps import SurfaceMaps, finish
from assets.surfaces.kit.marks import cracks, specks
from assets.surfaces.kit.noise import coverage, fractal, sample, smoothstep
from assets.surfaces.kit.tiled import Face, Joints, set_tiles
from assets.surfaces.recipe import SurfaceFamily, SurfaceRecipe

RED = ("8e4a35", "a35a40", "7c3f30", "a5674b", "6b3a31", "96553f")
"""Colours of red facing bricks, hexadecimal sRGB; each brick has one of them."""
CLINKER = ("7a4436", "8c5240", "6d4540", "9a6148", "5d4240", "87503a")
"""Colours of clinker pavers, hexadecimal sRGB; each paver has one of them."""


def brick_wall(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Red facing bricks, 190 by 57 mm, in a running bond with pale mortar; some burnt dark, some white with lime."""
    layout = tiles(grid, 2, 6, 0.5)
    face = _clay(rng, grid, layout, RED, rough_mm=0.35)
    lime = smoothstep(0.6, 2.4, fractal(rng, grid, 70, 0.6, gain=0.7)) * value_each(rng, layout.labels, 0.0, 1.0)
    colour = mix(face.colour, "d2c5b6", 0.6 * lime)
    smear = coverage(fractal(rng, grid, 40, 0.7, gain=0.7), 0.1, 0.3)
    colour = mix(colour, "b9ad9c", 0.35 * smear * (1 - smoothstep(5.0, 13.0, layout.edge_mm)))
    joints = Joints(10.0, 3.2, ((0.0, "837a6c"), (1.0, "b5aa98")), 2.2, 0.55, 0.004, 0.3)
    floor = set_tiles(rng, grid, _softened(layout, 3.0, grid), Face(colour, face.roughness, face.height_mm), joints)
    # Mortar is coarse sand: grains show in it, dark and pale, and some have fallen out.
    bed = 1 - smoothstep(4.2, 5.4, layout.edge_mm)
    grit = fractal(rng, grid, 2.6, 0.5, gain=0.9)
    colour = mix(floor.colour, "6d6557", 0.6 * bed * smoothstep(0.6, 1.8, grit))
    colour = mix(colour, "d8d0c0", 0.5 * bed * smoothstep(1.0, 2.0, -grit))
    height = np.asarray(floor.height_mm - 0.22 * bed * grit, np.float32)
    return finish(grid, colour, floor.roughness, height, to_joint_mm=floor.to_joint_mm)


def brick_paving(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Clinker pavers, 200 by 100 mm, in a herringbone: bevelled, worn, with sand and moss in the joints."""
    layout = herringbone(grid, 1, 2)
    face = _clay(rng, grid, layout, CLINKER, rough_mm=0.2)
    trodden = smoothstep(-0.3, 1.8, fractal(rng, grid, 90, 0.8, gain=0.66))
    colour = mix(face.colour, "a3978a", 0.22 * trodden)
    joints = Joints(4.0, 3.5, ((0.0, "6a6255"), (1.0, "a39883")), 3.6, 0.4, 0.006, 0.35)
    worn = Face(colour, np.asarray(face.roughness - 0.08 * trodden, np.float32), face.height_mm)
    floor = set_tiles(rng, grid, _softened(layout, 3.0, grid), worn, joints)
    damp = smoothstep(-0.3, 1.2, fractal(rng, grid, 70, 2, gain=0.6) + 0.5 * fractal(rng, grid, 5, 0.5, gain=0.8))
    moss = damp * (1 - smoothstep(1.6, 4.2, layout.edge_mm + 0.8 * fractal(rng, grid, 6, 0.6, gain=0.7)))
    tuft = fractal(rng, grid, 2.2, 0.4, gain=0.8)
    green = ramp(0.5 + 0.2 * tuft, ((0.0, "2f3a1c"), (0.6, "55642f"), (1.0, "7f8a4a")))
    height = floor.height_mm + moss * (0.9 + 0.35 * tuft)
    colour = mix(floor.colour, green, 0.85 * moss)
    return finish(grid, colour, floor.roughness, np.asarray(height, np.float32), to_joint_mm=floor.to_joint_mm)


def _clay(rng: np.random.Generator, grid: Grid, layout: Layout, tones: tuple[str, ...], rough_mm: float) -> Face:
    """Fired clay: every brick has its own tone, sand on its face, cracks from the kiln, grit and pits."""
    broad = _cut(rng, grid, layout.labels, fractal(rng, grid, 60, 0.8, gain=0.66))
    fine = fractal(rng, grid, 3.5, 0.0, gain=0.85)
    palette = np.stack([rgb(code) for code in tones])
    chosen = rng.integers(len(tones), size=int(layout.labels.max()) + 1)
    colour = palette[chosen][layout.labels] * tint_each(rng, layout.labels, 0.06, 0.03)
    colour = shade(colour, 1 + 0.1 * broad + 0.06 * fine)
    burnt = smoothstep(0.5, 2.0, _cut(rng, grid, layout.labels, fractal(rng, grid, 110, 1.5, gain=0.62)))
    colour = mix(colour, "3f2c2b", 0.55 * burnt)
    colour = mix(colour, "c99a77", 0.45 * specks(rng, grid, 0.02, 0.8))
    pits = coverage(fractal(rng, grid, 8, 1.0, gain=0.8) + 0.5 * fractal(rng, grid, 60, 5), 0.017, 0.12)
    split = cracks(rng, grid, 45, 0.5, 0.09)
    colour = shade(colour, np.asarray(1 - 0.5 * pits - 0.55 * split, np.float32))
    height = rough_mm * (0.35 * broad + 0.3 * fine) - 0.9 * pits - 0.5 * split
    rough = 0.84 + 0.04 * fine - 0.12 * burnt
    return Face(colour, np.asarray(rough, np.float32), np.asarray(height, np.float32))


def _cut(rng: np.random.Generator, grid: Grid, labels: Labels, field: Field) -> Field:
    """Give every brick its own piece of a field."""
    x, y = grid.coordinates()
    dx = value_each(rng, labels, 0, grid.size_mm)
    dy = value_each(rng, labels, 0, grid.size_mm)
    return sample(field, x + dx, y + dy, grid)


def _softened(layout: Layout, radius_mm: float, grid: Grid) -> Layout:
    """The same bricks with round corners."""
    return Layout(layout.labels, layout.u_mm, layout.v_mm, rounded(layout.edge_mm, radius_mm, grid))


RECIPES = tuple(
    SurfaceRecipe(name, SurfaceFamily.TILE, 0.4, draw)
    for name, draw in (
        ("brick_wall", brick_wall),
        ("brick_paving", brick_paving),
    )
)
