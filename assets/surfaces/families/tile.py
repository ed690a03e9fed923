"""Tiled floors: ceramic, slate, terracotta, mosaic, cement."""

import numpy as np

from assets.surfaces.kit.cells import edge_distance, voronoi
from assets.surfaces.kit.colour import mix, plain, ramp, rgb, shade, tint_each, value_each
from assets.surfaces.kit.grid import Field, Grid, Labels
from assets.surfaces.kit.layouts import Layout, tiles
from assets.surfaces.kit.maps import SurfaceMaps, finish
from assets.surfaces.kit.marks import cracks, scratches, specks
from assets.surfaces.kit.noise import coverage, fractal, sample, smoothstep
from assets.surfaces.kit.stone_faces import cleft, marble_face, travertine_face
from assets.surfaces.kit.tiled import Face, Joints, SetFaces, set_tiles
from assets.surfaces.recipe import SurfaceFamily, SurfaceRecipe


def ceramic_white(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Glossy off-white wall and floor tiles, 100 mm."""
    layout = tiles(grid, 4, 4)
    mottle = fractal(rng, grid, 40, 1.5, gain=0.6)
    colour = ramp(0.5 + 0.2 * mottle, ((0.0, "d2cec3"), (1.0, "e2dfd6")))
    colour = colour * tint_each(rng, layout.labels, 0.015, 0.008)
    colour = mix(colour, "8f8674", 0.5 * specks(rng, grid, 0.004, 0.5))
    crazing = cracks(rng, grid, 11, 0.16, 0.3)
    colour = mix(colour, "a89f8d", 0.28 * crazing)
    marks = scratches(rng, grid, 20, 0.2)
    wave = 0.022 * fractal(rng, grid, 30, 8, gain=0.5)
    rough = 0.13 + 0.03 * smoothstep(0, 2, fractal(rng, grid, 60, 2)) + 0.2 * marks
    joints = Joints(2.6, 0.7, ((0.0, "807a6e"), (1.0, "b3ac9f")), 1.6, 0.05, 0.003, 0.22)
    return _finish(grid, set_tiles(rng, grid, layout, Face(colour, rough, wave), joints))


def slate_tiles(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Riven slate, 200 mm, grey to rust."""
    layout = tiles(grid, 2, 2, 0.5)
    height, ledge = cleft(_cut(rng, grid, layout, fractal(rng, grid, 120, 0.0, gain=0.56)), 6.0)
    fine = fractal(rng, grid, 4, 0.0, gain=0.75)
    tone = 0.45 + 0.16 * height + 0.06 * fine + 0.12 * fractal(rng, grid, 90, 1, gain=0.65)
    colour = ramp(tone, ((0.0, "3a3d3e"), (0.5, "5f6461"), (1.0, "85877f")))
    colour = colour * tint_each(rng, layout.labels, 0.1, 0.03)
    rust = smoothstep(0.6, 2.2, _cut(rng, grid, layout, fractal(rng, grid, 110, 0.8, gain=0.66)))
    colour = mix(colour, "8a6a45", 0.6 * rust)
    colour = mix(colour, "262725", 0.6 * ledge)
    relief = 0.55 * height + 0.03 * fine
    rough = 0.6 + 0.05 * fine + 0.1 * rust
    joints = Joints(3.0, 1.6, ((0.0, "4f4b45"), (1.0, "7d776d")), 1.5, 0.35, 0.004, 0.3)
    return _finish(grid, set_tiles(rng, grid, layout, Face(colour, rough, relief), joints))


def terracotta_tiles(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Hand-made terracotta, 133 mm, pitted, with a bloom of lime."""
    layout = tiles(grid, 3, 3)
    broad = _cut(rng, grid, layout, fractal(rng, grid, 80, 1.2, gain=0.6))
    fine = fractal(rng, grid, 3, 0.0, gain=0.8)
    tone = 0.5 + 0.17 * broad + 0.07 * fine
    colour = ramp(tone, ((0.0, "8a4a2e"), (0.5, "b56d48"), (1.0, "d39a70")))
    colour = colour * tint_each(rng, layout.labels, 0.08, 0.04)
    bloom = smoothstep(0.7, 2.2, fractal(rng, grid, 60, 0.7, gain=0.68))
    colour = mix(colour, "d9c6b0", 0.45 * bloom)
    pits = specks(rng, grid, 0.02, 0.7)
    colour = mix(colour, "5b2f1c", 0.65 * pits)
    colour = mix(colour, "e0bd93", 0.5 * specks(rng, grid, 0.012, 0.9))
    relief = 0.12 * broad + 0.015 * fine - 0.3 * pits
    joints = Joints(7.0, 1.6, ((0.0, "8f8373"), (1.0, "bdb2a0")), 3.0, 0.5, 0.006, 0.3)
    rough = 0.68 + 0.08 * bloom + 0.03 * fine
    return _finish(grid, set_tiles(rng, grid, layout, Face(colour, rough, relief), joints))


def glass_mosaic(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Blue and turquoise glass mosaic, 20 mm, in pale grout."""
    layout = tiles(grid, 20, 20)
    palette = np.stack([rgb(c) for c in ("1f4f73", "2f7390", "5ba0ad", "9cc7c6", "c7d8d2", "24365c")])
    share = rng.choice(len(palette), int(layout.labels.max()) + 1, p=(0.22, 0.27, 0.22, 0.13, 0.06, 0.10))
    colour = palette[share][layout.labels] * tint_each(rng, layout.labels, 0.09, 0.02)
    swirl = _cut(rng, grid, layout, fractal(rng, grid, 14, 0.5, gain=0.6, stretch=(2.0, 0.8)))
    colour = shade(colour, 1 + 0.07 * swirl)
    colour = mix(colour, "e6efec", 0.35 * specks(rng, grid, 0.01, 0.5))
    rough = np.maximum(0.12 + 0.05 * swirl, 0.06)
    joints = Joints(2.0, 0.7, ((0.0, "a39e93"), (1.0, "cbc6bb")), 1.4, 0.14, 0.012, 0.2)
    wave = _cut(rng, grid, layout, 0.05 * fractal(rng, grid, 9, 2, gain=0.5))
    return _finish(grid, set_tiles(rng, grid, layout, Face(colour, rough, wave), joints))


def checker_tiles(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Black and ivory vinyl tiles, 100 mm, marbled and scuffed."""
    layout = tiles(grid, 4, 4)
    dark = ((layout.labels // 4 + layout.labels % 4) % 2).astype(np.float32)
    streak = _cut(rng, grid, layout, fractal(rng, grid, 24, 0.8, gain=0.66, stretch=(2.5, 0.7)))
    ivory = ramp(0.5 + 0.2 * streak, ((0.0, "b5ab92"), (1.0, "d8d0ba")))
    black = ramp(0.5 + 0.22 * streak, ((0.0, "1f1e1e"), (0.7, "38373a"), (1.0, "67666a")))
    colour = mix(ivory, black, dark) * tint_each(rng, layout.labels, 0.03, 0.01)
    scuffs = scratches(rng, grid, 60, 0.5)
    colour = mix(colour, "8d887e", 0.22 * scuffs)
    worn = smoothstep(-0.5, 2.0, fractal(rng, grid, 110, 1.0, gain=0.65))
    colour = mix(colour, "9a917f", 0.16 * worn)
    rough = 0.32 + 0.18 * worn + 0.15 * scuffs
    joints = Joints(0.5, 0.25, ((0.0, "2e2a25"), (1.0, "4a443b")), 0.5, 0.04, 0.001, 0.35)
    relief = 0.012 * fractal(rng, grid, 6, 1.0, gain=0.6) - 0.015 * scuffs
    return _finish(grid, set_tiles(rng, grid, layout, Face(colour, rough, relief), joints))


def hexagon_tiles(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Matt porcelain hexagons, 57 mm, in three greys."""
    columns, rows = 7, 8
    cell = np.stack(np.meshgrid(np.arange(columns), np.arange(rows)), axis=-1).reshape(-1, 2)
    centres = np.stack([cell[:, 0] + 0.5 * (cell[:, 1] % 2) + 0.25, cell[:, 1] + 0.5], axis=1)
    points = centres * np.array([grid.size_mm / columns, grid.size_mm / rows])
    labels = voronoi(points, grid)
    layout = _from_labels(labels, grid)
    colours = np.stack([rgb(c) for c in ("b9b6b0", "8d8c89", "5e6063", "cdc9c0")])
    which = rng.choice(4, len(points), p=(0.4, 0.25, 0.15, 0.2))
    cloud = fractal(rng, grid, 50, 0.8, gain=0.68)
    colour = shade(colours[which][labels] * tint_each(rng, labels, 0.03, 0.01), 1 + 0.045 * cloud)
    colour = mix(colour, "5a564f", 0.3 * specks(rng, grid, 0.02, 0.35))
    relief = 0.01 * fractal(rng, grid, 3, 0.4, gain=0.8)
    rough = 0.5 + 0.05 * cloud
    joints = Joints(2.6, 0.6, ((0.0, "5f5b55"), (1.0, "87827a")), 0.9, 0.08, 0.002, 0.3)
    return _finish(grid, set_tiles(rng, grid, layout, Face(colour, rough, relief), joints))


def travertine_tiles(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Honed travertine, 200 mm, banded and full of holes."""
    layout = tiles(grid, 2, 2)
    colour, relief, rough = travertine_face(rng, grid)
    colour = colour * tint_each(rng, layout.labels, 0.04, 0.012)
    joints = Joints(2.0, 0.6, ((0.0, "9c8d76"), (1.0, "c0b299")), 0.7, 0.08, 0.002, 0.2)
    return _finish(grid, set_tiles(rng, grid, layout, Face(colour, rough, relief), joints))


def marble_tiles_green(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Polished dark green marble, 133 mm, with pale veins."""
    layout = tiles(grid, 3, 3)
    stops = ((0.0, "1d2f28"), (0.5, "35503f"), (1.0, "5b7a62"))
    colour, veins = marble_face(rng, grid, stops, "c3d0bf", 0.75)
    colour = colour * tint_each(rng, layout.labels, 0.09, 0.02)
    marks = scratches(rng, grid, 24, 0.18)
    rough = 0.16 + 0.05 * veins + 0.2 * marks
    joints = Joints(1.0, 0.4, ((0.0, "3a3f39"), (1.0, "5d6259")), 0.5, 0.04, 0.001, 0.2)
    return _finish(grid, set_tiles(rng, grid, layout, Face(colour, rough, 0.004 * veins), joints))


def cement_patterned(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Encaustic cement tiles, 133 mm: a worn star and petals in three colours."""
    layout = tiles(grid, 3, 3)
    half = grid.size_mm / 6
    x, y = np.abs(layout.u_mm) / half, np.abs(layout.v_mm) / half
    rough_edge = 0.004 * fractal(rng, grid, 8, 0.6, gain=0.6)
    petal = np.maximum(np.hypot(x - 1, y), np.hypot(x, y - 1)) + rough_edge
    corner = np.hypot(1 - x, 1 - y) + rough_edge
    star = x + y + 0.6 * np.abs(x - y) + rough_edge
    colour = plain("cfc5b0", x)
    colour = mix(colour, "39566a", 1 - smoothstep(1.0, 1.012, petal))
    colour = mix(colour, "a8583c", smoothstep(0.30, 0.312, corner) * (1 - smoothstep(0.42, 0.432, corner)))
    colour = mix(colour, "39566a", 1 - smoothstep(0.16, 0.172, corner))
    colour = mix(colour, "d6ccb8", 1 - smoothstep(0.56, 0.575, star))
    colour = mix(colour, "a8583c", 1 - smoothstep(0.34, 0.352, star))
    colour = colour * tint_each(rng, layout.labels, 0.035, 0.015)
    cloud = fractal(rng, grid, 30, 0.6, gain=0.7)
    worn = coverage(fractal(rng, grid, 90, 0.6, gain=0.7), 0.3, 1.2)
    colour = mix(shade(colour, 1 + 0.05 * cloud), "b3a893", 0.32 * worn)
    pits = specks(rng, grid, 0.01, 0.5)
    colour = mix(colour, "4e463c", 0.6 * pits)
    joints = Joints(1.4, 0.4, ((0.0, "6d675d"), (1.0, "938c80")), 0.6, 0.12, 0.002, 0.35)
    relief = 0.012 * cloud - 0.12 * pits
    rough = 0.55 + 0.06 * cloud
    return _finish(grid, set_tiles(rng, grid, layout, Face(colour, rough, relief), joints))


def _finish(grid: Grid, floor: SetFaces) -> SurfaceMaps:
    return finish(grid, floor.colour, floor.roughness, floor.height_mm, to_joint_mm=floor.to_joint_mm)


def _cut(rng: np.random.Generator, grid: Grid, layout: Layout, field: Field) -> Field:
    """Cut each tile from its own place of a field, so that the pattern breaks at the joints."""
    x, y = grid.coordinates()
    dx = value_each(rng, layout.labels, 0, grid.size_mm)
    dy = value_each(rng, layout.labels, 0, grid.size_mm)
    return sample(field, x + dx, y + dy, grid)


def _from_labels(labels: Labels, grid: Grid) -> Layout:
    """A layout of cells that have no long axis: u and v are 0, so that the cells lie level."""
    flat = grid.zeros()
    return Layout(labels, flat, flat, edge_distance(labels, grid))


RECIPES = tuple(
    SurfaceRecipe(name, SurfaceFamily.TILE, 0.4, draw, published=True, light=name == "ceramic_white")
    for name, draw in (
        ("ceramic_white", ceramic_white),
        ("slate_tiles", slate_tiles),
        ("terracotta_tiles", terracotta_tiles),
        ("glass_mosaic", glass_mosaic),
        ("checker_tiles", checker_tiles),
        ("hexagon_tiles", hexagon_tiles),
        ("travertine_tiles", travertine_tiles),
        ("marble_tiles_green", marble_tiles_green),
        ("cement_patterned", cement_patterned),
    )
)
