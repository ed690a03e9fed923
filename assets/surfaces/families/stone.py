"""Stone floors: polished, sawn, flagged and cobbled."""

import numpy as np

from assets.surfaces.kit.cells import edge_distance, rounded, scatter, voronoi, warp_labels
from assets.surfaces.kit.colour import mix, ramp, shade, tint_each, value_each
from assets.surfaces.kit.grid import Field, Grid
from assets.surfaces.kit.layouts import tiles
from assets.surfaces.kit.maps import SurfaceMaps, finish, hollows
from assets.surfaces.kit.marks import cracks, scratches, specks, stains
from assets.surfaces.kit.noise import coverage, fractal, sample, smoothstep, warp
from assets.surfaces.kit.stone_faces import cleft, granite_face, marble_face, terrazzo_face
from assets.surfaces.kit.tiled import Face, Joints, set_tiles
from assets.surfaces.recipe import SurfaceFamily, SurfaceRecipe


def granite_grey(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Polished grey granite with black mica."""
    minerals = (("b9b5ae", 0.42), ("8e8c89", 0.26), ("d3cec4", 0.14), ("2c2b2d", 0.18))
    colour = granite_face(rng, grid, minerals, 2.6)
    return _polished(rng, grid, colour, 0.2)


def granite_red(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Polished red granite with coarse feldspar."""
    minerals = (("a5654d", 0.46), ("c08a6d", 0.2), ("777371", 0.16), ("2a2426", 0.18))
    colour = granite_face(rng, grid, minerals, 4.6)
    return _polished(rng, grid, colour, 0.22)


def marble_white(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Polished white marble with grey veins."""
    stops = ((0.0, "b9b9b8"), (0.35, "d3d1cd"), (1.0, "e4e2dd"))
    colour, veins = marble_face(rng, grid, stops, "62666b", 0.8)
    ochre = smoothstep(0.8, 2.4, fractal(rng, grid, 120, 3, gain=0.6)) * smoothstep(0.02, 0.5, veins)
    return _polished(rng, grid, mix(colour, "a58a5f", 0.5 * ochre), 0.18)


def marble_black(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Polished black marble with white veins."""
    stops = ((0.0, "232325"), (0.5, "353537"), (1.0, "56565a"))
    colour, _ = marble_face(rng, grid, stops, "cfccc6", 0.8)
    return _polished(rng, grid, colour, 0.16)


def terrazzo_light(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Pale terrazzo with cream, grey and honey chips."""
    chips = (("dcd3c0", 0.42), ("a8a097", 0.22), ("c2ab86", 0.16), ("6f6a66", 0.12), ("efe9dd", 0.08))
    colour, taken = terrazzo_face(rng, grid, ((0.0, "aea89e"), (1.0, "cac5bb")), chips, 0.62)
    return _polished(rng, grid, colour, 0.3, taken)


def terrazzo_dark(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Charcoal terrazzo with white, rose and green chips."""
    chips = (("b9b2a6", 0.3), ("7a6a60", 0.22), ("8f5f50", 0.16), ("5d6b60", 0.14), ("2a2a2c", 0.18))
    colour, taken = terrazzo_face(rng, grid, ((0.0, "35363a"), (1.0, "505155")), chips, 0.6)
    return _polished(rng, grid, colour, 0.28, taken)


def sandstone(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Sawn sandstone with bands of sediment."""
    bend = 7 * fractal(rng, grid, 260, 30, gain=0.4)
    bands = warp(fractal(rng, grid, 60, 0.8, gain=0.7, stretch=(7.0, 1.0)), grid.zeros(), bend, grid)
    sand = fractal(rng, grid, 0.9, 0.0, gain=0.95)
    cloud = fractal(rng, grid, 120, 2, gain=0.6)
    tone = 0.5 + 0.16 * bands + 0.09 * sand + 0.07 * cloud
    colour = ramp(tone, ((0.0, "94683f"), (0.35, "b88f61"), (0.7, "cfae82"), (1.0, "e2cca6")))
    rust = smoothstep(1.0, 2.4, warp(fractal(rng, grid, 50, 1, gain=0.6, stretch=(5.0, 1.0)), bend, bend, grid))
    colour = mix(colour, "8c5430", 0.5 * rust)
    pits = specks(rng, grid, 0.018, 0.8)
    colour = mix(shade(colour, 1 - 0.35 * pits), "4c3a2a", 0.3 * specks(rng, grid, 0.008, 0.5))
    height = 0.035 * sand + 0.04 * bands - 0.3 * pits
    return finish(grid, colour, 0.82 + 0.04 * sand, np.asarray(height, np.float32))


def cobble(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Worn cobbles, about 65 mm, in dark earth with moss."""
    labels = voronoi(scatter(rng, grid, 66.0, 0.55), grid)
    dx, dy = (4.0 * fractal(rng, grid, 70, 10, gain=0.45) for _ in range(2))
    labels = warp_labels(labels, dx, dy, grid)
    wear = 0.35 * fractal(rng, grid, 22, 1.5, gain=0.5)
    edge = rounded(edge_distance(labels, grid, 50.0) - 2.6, 14.0, grid) + wear
    dome = 1 - np.square(1 - np.clip(edge / 20.0, 0, 1))
    x, y = grid.coordinates()
    shift = value_each(rng, labels, 0, grid.size_mm), value_each(rng, labels, 0, grid.size_mm)
    face = sample(fractal(rng, grid, 60, 0.0, gain=0.6), x + shift[0], y + shift[1], grid)
    split, ledge = cleft(face, 2.2)
    grain = fractal(rng, grid, 2.2, 0.0, gain=0.85)
    stone = smoothstep(-0.3, 0.8, edge)
    height = (
        7.5 * dome + (0.35 * split + 0.25 * face) * stone + 0.05 * grain + value_each(rng, labels, -1.2, 1.2) * stone
    )
    tone = 0.46 + 0.13 * face + 0.09 * grain
    colour = ramp(tone, ((0.0, "453d35"), (0.5, "756a5d"), (1.0, "a69a89"))) * tint_each(rng, labels, 0.13, 0.05)
    colour = mix(shade(colour, 0.62 + 0.38 * dome), "332d26", 0.2 * ledge)
    earth = ramp(0.5 + 0.25 * grain, ((0.0, "231d17"), (1.0, "4a3f31")))
    colour = mix(earth, colour, stone)
    low = 1 - smoothstep(0.5, 9.0, edge + 2.5 * fractal(rng, grid, 25, 0.6, gain=0.7))
    moss = low * smoothstep(0.0, 1.2, fractal(rng, grid, 110, 2, gain=0.6))
    green = ramp(0.5 + 0.25 * fractal(rng, grid, 1.5, 0.3, gain=0.9), ((0.0, "2c3319"), (1.0, "66702f")))
    colour = mix(colour, green, 0.85 * moss)
    height = height + 0.5 * moss * (1 + 0.4 * fractal(rng, grid, 1.6, 0.4, gain=0.9))
    rough = 0.72 + 0.05 * grain + 0.12 * moss - 0.14 * smoothstep(0.7, 1, dome)
    return finish(grid, colour, rough, np.asarray(height, np.float32), to_joint_mm=edge - np.float32(0.25))


def paving_slabs(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Pale flagstones, 267 by 200 mm, weathered, with sandy joints."""
    layout = tiles(grid, 2, 2, 0.5)
    grain = fractal(rng, grid, 2.0, 0.0, gain=0.85)
    broad = fractal(rng, grid, 55, 0.8, gain=0.62)
    split, ledge = cleft(fractal(rng, grid, 90, 2.5, gain=0.5), 5.0)
    tone = 0.52 + 0.1 * grain + 0.1 * broad
    colour = ramp(tone, ((0.0, "837e76"), (0.5, "a7a198"), (1.0, "c8c2b7"))) * tint_each(
        rng, layout.labels, 0.07, 0.025
    )
    colour = mix(colour, "605a51", 0.14 * ledge)
    body, rim = stains(rng, grid, 140, 0.16)
    colour = shade(colour, 1 - 0.10 * body - 0.09 * rim)
    lichen = coverage(fractal(rng, grid, 22, 0.7, gain=0.75) + 0.8 * fractal(rng, grid, 150, 20), 0.05, 0.35)
    colour = mix(colour, "b9b48b", 0.5 * lichen)
    relief = 0.14 * split + 0.12 * broad + 0.06 * grain
    joints = Joints(4.5, 2.2, ((0.0, "4a4136"), (1.0, "7f725f")), 2.6, 0.8, 0.004, 0.5)
    floor = set_tiles(rng, grid, layout, Face(colour, 0.78 + 0.04 * grain, relief), joints)
    return finish(grid, floor.colour, floor.roughness, floor.height_mm, to_joint_mm=floor.to_joint_mm)


def cracked_rock(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Grey bedrock, split and chipped, with dark pits."""
    dx, dy = (9 * fractal(rng, grid, 90, 3, gain=0.5) for _ in range(2))
    broad = warp(fractal(rng, grid, 130, 1.6, gain=0.48), dx, dy, grid)
    split, ledge = cleft(broad, 4.0)
    grain = fractal(rng, grid, 20.0, 0.0, gain=0.75)
    fissure = cracks(rng, grid, 85, 2.6, 0.55)
    hairline = cracks(rng, grid, 30, 0.5, 0.35)
    pits = coverage(fractal(rng, grid, 30, 1.5, gain=0.68, stretch=(1.8, 0.9)), 0.035, 0.3)
    height = 1.2 * split + 0.12 * grain - 2.2 * fissure - 0.5 * hairline - 1.8 * pits
    tone = 0.5 + 0.1 * grain + 0.12 * fractal(rng, grid, 80, 0.8, gain=0.65)
    colour = ramp(tone, ((0.0, "65645f"), (0.5, "8f8d87"), (1.0, "b9b6ae")))
    colour = shade(colour, 1 - 0.3 * hollows(np.asarray(height, np.float32), 3.0, 1.5, grid))
    colour = mix(colour, "3c3934", 0.28 * ledge + 0.45 * pits)
    colour = mix(colour, "191714", np.clip(0.9 * fissure + 0.6 * hairline, 0, 0.92))
    return finish(grid, colour, 0.8 + 0.04 * grain, np.asarray(height, np.float32))


def _polished(
    rng: np.random.Generator, grid: Grid, colour: Field, gloss: float, chips: Field | None = None
) -> SurfaceMaps:
    """Finish a ground and polished stone floor: add fine scratches, dull paths and a few pinholes."""
    marks = scratches(rng, grid, 40, 0.18)
    holes = specks(rng, grid, 0.003, 0.5)
    dull = smoothstep(-0.6, 2.0, fractal(rng, grid, 100, 1.5, gain=0.6))
    if chips is not None:
        dull = dull + 0.5 * (1 - chips)
    colour = mix(colour, "4a443c", 0.55 * holes)
    colour = shade(colour, 1 - 0.03 * dull)
    rough = gloss + 0.09 * dull + 0.18 * marks + 0.4 * holes
    height = -0.08 * holes - 0.006 * marks + 0.004 * fractal(rng, grid, 25, 4, gain=0.5)
    if chips is not None:
        height = height + 0.012 * chips
    return finish(grid, colour, np.asarray(rough, np.float32), np.asarray(height, np.float32))


_LIGHT = ("marble_white", "terrazzo_light")

RECIPES = tuple(
    SurfaceRecipe(name, SurfaceFamily.STONE, size_m, draw, published=True, light=name in _LIGHT)
    for name, size_m, draw in (
        ("granite_grey", 0.4, granite_grey),
        ("granite_red", 0.4, granite_red),
        ("marble_white", 0.5, marble_white),
        ("marble_black", 0.5, marble_black),
        ("terrazzo_light", 0.4, terrazzo_light),
        ("terrazzo_dark", 0.4, terrazzo_dark),
        ("sandstone", 0.4, sandstone),
        ("cobble", 0.5, cobble),
        ("paving_slabs", 0.5, paving_slabs),
        ("cracked_rock", 0.4, cracked_rock),
    )
)
