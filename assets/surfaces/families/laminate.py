"""White and light faces of tables and boards: plain at a glance, with traces of use at a closer look."""

from dataclasses import replace

import numpy as np

from assets.surfaces.kit.colour import mix, ramp
from assets.surfaces.kit.grid import Field, Grid
from assets.surfaces.kit.handwriting import written_lines
from assets.surfaces.kit.maps import SurfaceMaps, finish, joint_levels
from assets.surfaces.kit.marks import dust, scratches, specks, stains
from assets.surfaces.kit.noise import coverage, fractal, smoothstep, warp
from assets.surfaces.kit.shapes import filled
from assets.surfaces.kit.strokes import as_field, curve, polylines
from assets.surfaces.recipe import SurfaceFamily, SurfaceRecipe


def laminate_white(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """White office table: a satin face, wiped but not clean, with smudges, hairline scratches and pencil marks."""
    colour = ramp(0.5 + 0.2 * fractal(rng, grid, 150, 12, gain=0.55), ((0.0, "e6e5e1"), (1.0, "efeeea")))
    return _used(rng, grid, colour, orange_peel=0.004, gloss=0.36)


def laminate_grey(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Light grey laboratory bench with the fine dark and pale flecks of its print."""
    colour = ramp(0.5 + 0.2 * fractal(rng, grid, 150, 12, gain=0.55), ((0.0, "cfd0cf"), (1.0, "d8d9d7")))
    flecks = fractal(rng, grid, 2.4, 0.5, gain=0.9)
    colour = mix(colour, "a3a6a8", 0.55 * smoothstep(1.2, 2.0, flecks))
    colour = mix(colour, "eeeeec", 0.6 * smoothstep(1.1, 1.9, -flecks))
    colour = mix(colour, "8d9194", 0.7 * coverage(fractal(rng, grid, 4, 0.9, gain=0.9), 0.006, 0.2))
    return _used(rng, grid, colour, orange_peel=0.012, gloss=0.45)


def melamine_board(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """White melamine boards butted together: a dark seam between two edge bands, one of them yellowed."""
    base = ramp(0.5 + 0.2 * fractal(rng, grid, 130, 10, gain=0.55), ((0.0, "e3e1db"), (1.0, "edebe6")))
    _, y = grid.coordinates()
    from_seam = y - np.float32(0.382 * grid.size_mm) + 0.05 * fractal(rng, grid, 200, 20)
    first, second = np.abs(from_seam + 0.95) - 0.6, np.abs(from_seam - 0.95) - 0.6
    colour = mix(base, "e4dcc6", filled(np.asarray(first, np.float32), grid))
    colour = mix(colour, "eeeeec", filled(np.asarray(second, np.float32), grid))
    for line, strength in ((-1.6, 0.4), (1.6, 0.3)):
        thin = filled(np.asarray(np.abs(from_seam - line) - 0.09, np.float32), grid)
        colour = mix(colour, "8f897d", strength * thin * smoothstep(-1.5, 0.8, fractal(rng, grid, 50, 2, gain=0.6)))
    gap = filled(np.asarray(np.abs(from_seam) - 0.36, np.float32), grid)
    near = np.asarray(np.exp(-np.abs(from_seam) / 5.0), np.float32)
    colour = mix(colour, "8a8478", 0.3 * dust(rng, grid, near))
    maps_colour = mix(colour, "2a2723", 0.9 * gap)
    chips = coverage(fractal(rng, grid, 3.0, 0.5, gain=0.8), 0.05, 0.1) * np.exp(-np.square(from_seam / 1.5))
    maps_colour = mix(maps_colour, "a98b62", 0.8 * np.asarray(chips, np.float32))
    lip = -0.35 * gap - 0.06 * np.asarray(np.exp(-np.square(from_seam / 0.8)), np.float32) - 0.1 * chips
    maps = _used(rng, grid, maps_colour, orange_peel=0.007, gloss=0.4, relief=np.asarray(lip, np.float32))
    return replace(maps, joints=joint_levels(np.asarray(np.abs(from_seam) - 0.36, np.float32)))


def whiteboard(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Glossy whiteboard: lines and words in four colours of marker, half of them wiped to ghosts and grey smears."""
    colour = ramp(0.5 + 0.2 * fractal(rng, grid, 150, 12, gain=0.55), ((0.0, "e9ebeb"), (1.0, "f0f1f1")))
    bend = 30 * fractal(rng, grid, 200, 40, gain=0.5)
    wiped = warp(fractal(rng, grid, 20, 0.5, gain=0.72, stretch=(9.0, 0.8)), 0.3 * bend, bend, grid)
    streaks = smoothstep(-0.4, 2.0, wiped)
    colour = mix(colour, "8d93a0", 0.13 * streaks * smoothstep(-0.6, 1.2, fractal(rng, grid, 120, 12)))
    ink = grid.zeros()
    rows = rng.permutation(np.arange(22.0, grid.size_mm, 44.0))
    for number, code in enumerate(("26282c", "2b4a9b", "b3342f", "2f7b4f")):
        fresh, old = np.zeros((2, grid.pixels, grid.pixels), np.uint8)
        written_lines(rng, fresh if number < 2 else old, grid, rows[2 * number : 2 * number + 2], 11.0, 1.6)
        for target, count in ((fresh, 2), (old, 6)):
            for _ in range(count):
                start = rng.uniform(0, grid.size_mm, 2)
                path = curve(rng, start.tolist(), float(rng.uniform(40, 170)), 0.6, 9)
                polylines(target, path, float(rng.uniform(1.6, 2.6)), (235.0,), grid)
        # A felt tip leaves streaks along its way and more ink where it rests.
        felt = 0.72 + 0.28 * smoothstep(-1.0, 1.0, fractal(rng, grid, 4, 0.4, gain=0.75))
        line = felt * as_field(fresh)
        ghost = as_field(old) * (0.07 + 0.3 * smoothstep(0.4, 1.8, wiped))
        colour = mix(colour, code, np.asarray(np.maximum(0.9 * line, ghost), np.float32))
        ink = np.maximum(ink, line)
    hair = scratches(rng, grid, 90, 0.16)
    colour = mix(colour, "9b9da0", 0.3 * hair)
    colour = mix(colour, "5b5c60", 0.5 * specks(rng, grid, 0.0006, 0.5))
    rough = 0.14 + 0.14 * streaks + 0.25 * ink + 0.2 * hair
    height = 0.004 * fractal(rng, grid, 6, 2, gain=0.5) + 0.01 * ink - 0.006 * hair
    return finish(grid, colour, np.asarray(rough, np.float32), np.asarray(height, np.float32))


def _used(
    rng: np.random.Generator,
    grid: Grid,
    colour: Field,
    *,
    orange_peel: float,
    gloss: float,
    relief: Field | None = None,
) -> SurfaceMaps:
    """A light laminate face after years of use.

    Args:
        rng: Source of the randomness.
        grid: The tile.
        colour: The print, shape (H, W, 3).
        orange_peel: Depth of the fine ripple pressed into the face, in millimetres.
        gloss: Roughness of the clean face.
        relief: Height of seams and the like, millimetres, shape (H, W); None for a face without them.

    Returns:
        The maps.
    """
    bend = 25 * fractal(rng, grid, 180, 30, gain=0.5)
    wiped = warp(fractal(rng, grid, 26, 0.8, gain=0.7, stretch=(5.0, 0.8)), 0.4 * bend, bend, grid)
    smear = smoothstep(-0.2, 2.4, wiped) * smoothstep(-1.0, 1.5, fractal(rng, grid, 90, 10))
    film = smoothstep(-0.5, 2.4, fractal(rng, grid, 160, 8, gain=0.6))
    colour = mix(colour, "a59d8c", 0.11 * smear + 0.06 * film)
    body, rim = stains(rng, grid, 75, 0.02)
    colour = mix(colour, "a58c66", 0.06 * body + 0.2 * rim)
    hair = scratches(rng, grid, 110, 0.18)
    colour = mix(colour, "94918a", 0.3 * hair)
    scuff = scratches(rng, grid, 12, 0.9)
    colour = mix(colour, "6f6d69", 0.2 * scuff)
    pencil = _pencil(rng, grid, 14)
    colour = mix(colour, "6a6a6e", 0.4 * pencil)
    crumbs = specks(rng, grid, 0.0008, 0.5)
    colour = mix(colour, "5d564c", 0.6 * crumbs)
    peel = fractal(rng, grid, 2.4, 0.9, gain=0.6)
    rough = gloss + 0.1 * smear + 0.05 * film + 0.15 * hair + 0.1 * body + 0.02 * peel
    height = orange_peel * peel - 0.008 * hair + 0.05 * crumbs
    if relief is not None:
        height = height + relief
    return finish(grid, colour, np.asarray(rough, np.float32), np.asarray(height, np.float32))


def _pencil(rng: np.random.Generator, grid: Grid, count: int) -> Field:
    """Mask of short strokes of a pencil, or of a pen that somebody tried out, 0 to 1, shape (H, W)."""
    image = np.zeros((grid.pixels, grid.pixels), np.uint8)
    for _ in range(count):
        start = rng.uniform(0, grid.size_mm, 2)
        path = curve(rng, start.tolist(), float(rng.uniform(5, 45)), 0.15, 5)
        polylines(image, path, 0.35, (float(rng.uniform(90, 230)),), grid)
    grit = smoothstep(-1.2, 0.8, fractal(rng, grid, 1.5, 0.0, gain=0.9))
    return np.asarray(as_field(image) * grit, np.float32)


RECIPES = tuple(
    SurfaceRecipe(name, SurfaceFamily.SHEET, 0.4, draw, light=True)
    for name, draw in (
        ("laminate_white", laminate_white),
        ("laminate_grey", laminate_grey),
        ("melamine_board", melamine_board),
        ("whiteboard", whiteboard),
    )
)
