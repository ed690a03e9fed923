"""Wooden floors and boards."""

import numpy as np

from assets.surfaces.kit.colour import mix, plain, shade, tint_each, value_each
from assets.surfaces.kit.grid import Grid
from assets.surfaces.kit.layouts import Layout, boards, chevron, herringbone
from assets.surfaces.kit.maps import SurfaceMaps, finish
from assets.surfaces.kit.marks import dust, scratches, specks, stains
from assets.surfaces.kit.noise import coverage, fractal, smoothstep
from assets.surfaces.kit.wood_grain import Species, grain
from assets.surfaces.recipe import SurfaceFamily, SurfaceRecipe

OAK = Species(((0.0, "c9a777"), (0.45, "b58d5c"), (1.0, "8f6639")), "5d3f22", 2.6, 0.6, 0.22, 0.09, 9.0, 16.0, 0.25)
WALNUT = Species(((0.0, "7d583c"), (0.5, "5b3c28"), (1.0, "382317")), "22140c", 4.2, 0.7, 0.3, 0.06, 8.0, 20.0)
PINE = Species(((0.0, "e3c593"), (0.5, "d6ad72"), (1.0, "b07a3e")), "5a3417", 3.8, 0.85, 0.14, 0.0, 5.0, 15.0, 1.6)
CHERRY = Species(((0.0, "a9653f"), (0.5, "8d4b2b"), (1.0, "66311b")), "4a2012", 5.0, 0.5, 0.3, 0.05, 5.0, 22.0)
BIRCH = Species(((0.0, "e2cca5"), (0.5, "d4b887"), (1.0, "bf9d69")), "94713f", 8.0, 0.5, 0.3, 0.04, 4.0, 26.0)
GREY_OAK = Species(((0.0, "b5aea4"), (0.5, "978e84"), (1.0, "6f665d")), "4c453e", 3.0, 0.6, 0.35, 0.08, 9.0, 18.0)
MAPLE = Species(((0.0, "ead9bb"), (0.5, "dfc9a3"), (1.0, "c9aa7c")), "a98a60", 4.5, 0.32, 0.24, 0.02, 3.0, 20.0)
BEECH = Species(((0.0, "e3c6a0"), (0.5, "d8b48a"), (1.0, "c39a6c")), "8d6440", 3.6, 0.35, 0.24, 0.07, 2.0, 14.0)
SILVERED = Species(((0.0, "a39c92"), (0.5, "857c72"), (1.0, "5b534b")), "2e2823", 3.2, 0.9, 0.5, 0.05, 14.0, 12.0, 0.6)
"""Wood that years of rain have turned grey."""


def oak_planks(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Oiled oak planks, 100 mm wide."""
    layout = boards(rng, grid, 4)
    return _floor(rng, grid, layout, OAK, bevel_mm=1.2, varnish=0.42)


def walnut_planks(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Dark varnished walnut planks, 80 mm wide."""
    layout = boards(rng, grid, 5)
    return _floor(rng, grid, layout, WALNUT, bevel_mm=1.0, varnish=0.33)


def cherry_planks(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Reddish cherry planks with tight joints, 100 mm wide."""
    layout = boards(rng, grid, 4, 0.7)
    return _floor(rng, grid, layout, CHERRY, bevel_mm=0.6, varnish=0.36)


def pine_boards(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Knotty pine boards, 100 mm wide, with open joints."""
    layout = boards(rng, grid, 4, 0.25)
    return _floor(rng, grid, layout, PINE, bevel_mm=1.8, varnish=0.5)


def oak_herringbone(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Oak parquet laid in a herringbone of 50 by 200 mm blocks."""
    return _floor(rng, grid, herringbone(grid, 1), OAK, bevel_mm=0.7, varnish=0.38)


def walnut_herringbone(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Small walnut parquet laid in a herringbone of 33 by 100 mm blocks."""
    return _floor(rng, grid, herringbone(grid, 2, 3), WALNUT, bevel_mm=0.6, varnish=0.4)


def oak_chevron(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Oak parquet laid in a chevron: boards 47 mm wide, cut at 45 degrees, in columns of 100 mm."""
    return _floor(rng, grid, chevron(grid, 4, 6), OAK, bevel_mm=0.7, varnish=0.4)


def maple_bench(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Pale maple bench top: glued staves 44 mm wide, oiled, with marks of work."""
    return _bench(rng, grid, boards(rng, grid, 9, 0.6), MAPLE)


def beech_bench(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Light beech bench top: glued staves 40 mm wide, flecked with fine rays."""
    return _bench(rng, grid, boards(rng, grid, 10, 0.8), BEECH)


def grey_laminate(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Grey oak laminate, 133 mm wide, printed and embossed."""
    layout = boards(rng, grid, 3, 0.6)
    return _floor(rng, grid, layout, GREY_OAK, bevel_mm=0.8, varnish=0.45)


def birch_veneer(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Birch plywood with a wild figure: panels 200 mm wide, butted together."""
    layout = boards(rng, grid, 2, 0.0)
    wood = grain(rng, grid, layout, BIRCH)
    shimmer = fractal(rng, grid, 18, 3, gain=0.6, stretch=(0.7, 1.6))
    flecks = coverage(fractal(rng, grid, 3, 1.0, gain=0.9, stretch=(3.0, 1.0)), 0.006, 0.4)
    colour = shade(wood.colour, 1 + 0.007 * shimmer + 0.03 * fractal(rng, grid, 200, 40))
    colour = mix(colour * tint_each(rng, layout.labels, 0.02, 0.01), "8a6638", 0.5 * flecks)
    joint = 1 - smoothstep(0.1, 0.6, layout.edge_mm)
    colour = mix(colour, "4f3c22", 0.8 * joint)
    rough = 0.58 + 0.03 * wood.relief + 0.2 * joint
    height = np.asarray(0.012 * wood.relief - 0.3 * joint, np.float32)
    return finish(grid, colour, rough, height, to_joint_mm=layout.edge_mm - np.float32(0.35))


def weathered_boards(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Old outdoor boards, silvered by rain, with raised grain, cracks and gaps."""
    layout = boards(rng, grid, 4, 0.3)
    wood = grain(rng, grid, layout, SILVERED)
    checks = fractal(rng, grid, 9, 0.7, gain=0.7, stretch=(34.0, 1.0))
    cracks = coverage(checks, 0.022, 0.25)
    brown = smoothstep(-0.2, 1.8, fractal(rng, grid, 130, 6, gain=0.6, stretch=(2.5, 1.0)))
    colour = wood.colour * tint_each(rng, layout.labels, 0.09, 0.03)
    colour = mix(colour, "6d5136", 0.5 * brown)
    algae = coverage(fractal(rng, grid, 70, 1.5, gain=0.65), 0.14, 0.8)
    colour = mix(colour, "6b6c4e", 0.35 * algae)
    colour = mix(colour, "1c1712", 0.9 * cracks)
    edge = layout.edge_mm + 0.25 * fractal(rng, grid, 30, 1, stretch=(3.0, 1.0))
    gap = smoothstep(0.6, 2.6, edge)
    colour = mix(plain("100d0a", gap), colour, gap)
    height = 0.16 * wood.relief - 0.5 * cracks - 2.6 * (1 - gap)
    rough = 0.86 - 0.06 * wood.late
    return finish(grid, colour, rough, height.astype(np.float32), to_joint_mm=edge - np.float32(1.6))


def _bench(rng: np.random.Generator, grid: Grid, layout: Layout, species: Species) -> SurfaceMaps:
    """A glued bench top sanded flat: no bevels, thin glue lines, scratches, rings and smudges."""
    wood = grain(rng, grid, layout, species)
    colour = wood.colour * tint_each(rng, layout.labels, 0.035, 0.009)
    colour = shade(colour, 1 + 0.02 * fractal(rng, grid, 140, 12, gain=0.55))
    rays = coverage(fractal(rng, grid, 1.6, 0.4, gain=0.9, stretch=(4.0, 1.0)), 0.03, 0.5)
    colour = mix(colour, species.pore, 0.3 * rays)
    glue = (1 - smoothstep(0.05, 0.35, layout.edge_mm)) * smoothstep(-1.6, 0.6, fractal(rng, grid, 40, 2, gain=0.6))
    colour = mix(colour, "8a6b45", 0.55 * glue)
    body, rim = stains(rng, grid, 90, 0.06)
    colour = mix(colour, "8d7656", 0.1 * body + 0.22 * rim)
    colour = mix(colour, "7a6a55", 0.09 * smoothstep(0.3, 2.2, fractal(rng, grid, 120, 2, gain=0.65)))
    dents = scratches(rng, grid, 40, 0.3)
    cuts = scratches(rng, grid, 10, 0.35)
    colour = mix(mix(colour, "f2e6cf", 0.22 * dents), "6b553c", 0.4 * cuts)
    colour = mix(colour, "4a4038", 0.5 * specks(rng, grid, 0.0015, 0.6))
    wear = fractal(rng, grid, 90, 3, gain=0.6)
    rough = 0.5 + 0.04 * wear - 0.03 * wood.relief + 0.12 * dents - 0.06 * body
    height = 0.008 * wood.relief - 0.06 * glue - 0.02 * dents - 0.05 * cuts
    return finish(grid, colour, np.asarray(rough, np.float32), np.asarray(height, np.float32))


def _floor(
    rng: np.random.Generator, grid: Grid, layout: Layout, species: Species, bevel_mm: float, varnish: float
) -> SurfaceMaps:
    """A laid wooden floor: grain, a tint for each board, bevelled joints with dirt, worn varnish."""
    wood = grain(rng, grid, layout, species)
    colour = wood.colour * tint_each(rng, layout.labels, 0.085, 0.022)
    colour = shade(colour, 1 + 0.03 * fractal(rng, grid, 150, 15, gain=0.55))
    bevel = smoothstep(0.0, bevel_mm, layout.edge_mm)
    seam = 1 - smoothstep(0.12, 0.12 + 0.45 * bevel_mm, layout.edge_mm)
    grime = dust(rng, grid, 1 - smoothstep(0.0, 7.0, layout.edge_mm))
    colour = shade(colour, 1 - 0.16 * (1 - bevel) - 0.10 * grime)
    colour = mix(colour, "150e09", 0.88 * seam)
    marks = scratches(rng, grid, 26, 0.22)
    colour = mix(colour, "e6d6bd", 0.10 * marks)
    wear = fractal(rng, grid, 90, 4, gain=0.6)
    rough = varnish + 0.045 * wear - 0.05 * wood.relief + 0.2 * marks + 0.15 * grime + 0.3 * seam
    rough = rough + value_each(rng, layout.labels, -0.03, 0.03)
    height = 0.022 * wood.relief + 0.45 * bevel_mm * (bevel - 1) - 0.5 * seam - 0.01 * marks
    tilt = value_each(rng, layout.labels, -0.0012, 0.0012) * layout.v_mm
    cup = 0.00002 * np.square(layout.v_mm)
    # The joint's edge is taken half-way through the seam's soft border.
    to_joint_mm = layout.edge_mm - np.float32(0.12 + 0.225 * bevel_mm)
    return finish(grid, colour, rough, np.asarray(height + (tilt - cup) * bevel, np.float32), to_joint_mm=to_joint_mm)


_PUBLISHED = tuple(
    SurfaceRecipe(name, SurfaceFamily.WOOD, 0.4, draw, published=True, light=name == "birch_veneer")
    for name, draw in (
        ("oak_planks", oak_planks),
        ("walnut_planks", walnut_planks),
        ("cherry_planks", cherry_planks),
        ("pine_boards", pine_boards),
        ("oak_herringbone", oak_herringbone),
        ("walnut_herringbone", walnut_herringbone),
        ("grey_laminate", grey_laminate),
        ("birch_veneer", birch_veneer),
        ("weathered_boards", weathered_boards),
    )
)

RECIPES = (
    *_PUBLISHED,
    SurfaceRecipe("oak_chevron", SurfaceFamily.WOOD, 0.4, oak_chevron),
    SurfaceRecipe("maple_bench", SurfaceFamily.WOOD, 0.4, maple_bench, light=True),
    SurfaceRecipe("beech_bench", SurfaceFamily.WOOD, 0.4, beech_bench, light=True),
)
