"""Cloth and carpets."""

import numpy as np
import numpy.typing as npt

from assets.surfaces.kit.cells import scatter, voronoi
from assets.surfaces.kit.colour import mix, ramp, rgb, shade, tint_each
from assets.surfaces.kit.grid import Field, Grid
from assets.surfaces.kit.maps import SurfaceMaps, finish, hollows
from assets.surfaces.kit.marks import stains
from assets.surfaces.kit.noise import coverage, fractal, smoothstep
from assets.surfaces.kit.strokes import as_field, curve, polylines
from assets.surfaces.kit.weave import Weave, basket_pattern, plain_pattern, twill_pattern, weave
from assets.surfaces.recipe import SurfaceFamily, SurfaceRecipe

KEY = (
    "################",
    "#..............#",
    "#.############.#",
    "#.#..........#.#",
    "#.#.########.#.#",
    "#.#.#......#.#.#",
    "#.#.#.####.#.#.#",
    "#.#.#.#..#.#.#.#",
    "#.#.#.##.#.#.#.#",
    "#.#.#....#.#.#.#",
    "#.#.######.#.#.#",
    "#.#........#.#..",
    "#.##########.###",
    "#............#..",
    "##############.#",
    "...............#",
)
"""One repeat of the meander carpet's pattern: '.' is the light yarn, '#' the dark one."""


def linen(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Natural linen in plain weave, a thread every 1.1 mm, with slubs and creases."""
    cloth = weave(rng, grid, (270, 270), plain_pattern(), fill=0.92, slub=0.16)
    colour = _yarn(rng, cloth, (((0.0, "a79678"), (1.0, "d6c8ab")), ((0.0, "a2916f"), (1.0, "d2c3a3"))), 0.08)
    return _cloth(rng, grid, cloth, colour, "5a4c37", 0.5)


def denim(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Washed denim: indigo warp over a pale weft in a 3/1 twill."""
    cloth = weave(rng, grid, (320, 320), twill_pattern(3, 1), fill=1.0, slub=0.12)
    colour = _yarn(rng, cloth, (((0.0, "25395c"), (1.0, "5a7499")), ((0.0, "9aa4ae"), (1.0, "d3d8da"))), 0.12)
    faded = smoothstep(-1.2, 2.2, fractal(rng, grid, 90, 1.2, gain=0.62))
    colour = mix(colour, "93a6bd", 0.34 * faded)
    return _cloth(rng, grid, cloth, colour, "131c2e", 0.4)


def jute(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Coarse jute matting, a thread every 3 mm, hairy and uneven."""
    cloth = weave(rng, grid, (100, 100), plain_pattern(), fill=0.9, slub=0.2)
    colour = _yarn(rng, cloth, (((0.0, "7b5b36"), (1.0, "c6a370")), ((0.0, "80613b"), (1.0, "c2a06d"))), 0.12)
    hairs = _hairs(rng, grid, 2600, 0.16, 9.0)
    colour = mix(colour, "d2b585", 0.45 * hairs)
    return _cloth(rng, grid, cloth, colour, "2e2113", 0.35)


def tweed(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Grey and charcoal wool in a 2/2 twill, with bright flecks."""
    cloth = weave(rng, grid, (160, 160), twill_pattern(2, 2), fill=1.0, slub=0.2)
    colour = _yarn(rng, cloth, (((0.0, "34363a"), (1.0, "64676b")), ((0.0, "6d6a64"), (1.0, "aaa59b"))), 0.16)
    flecks = coverage(fractal(rng, grid, 5, 1.0, gain=0.85), 0.03, 0.3)
    fleck = ramp(fractal(rng, grid, 20, 3), ((-1.0, "9c4a33"), (0.0, "c0a04e"), (1.0, "4f7f86")))
    colour = mix(colour, fleck, 0.7 * flecks)
    colour = mix(colour, "a8a59f", 0.3 * _hairs(rng, grid, 3000, 0.1, 6.0))
    return _cloth(rng, grid, cloth, colour, "17181a", 0.4)


def carpet_basket(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Flat-woven sisal carpet in a basket weave, sand and brown."""
    cloth = weave(rng, grid, (160, 160), basket_pattern(2), fill=0.97, slub=0.12)
    colour = _yarn(rng, cloth, (((0.0, "6f6152"), (1.0, "a8967d")), ((0.0, "9d8d74"), (1.0, "d1c2a4"))), 0.1)
    return _cloth(rng, grid, cloth, colour, "2b241b", 0.35)


def knit(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Stocking-stitch knit of thick oatmeal wool."""
    columns, rows = 44, 58
    width, height = grid.size_mm / columns, grid.size_mm / rows
    x, y = grid.coordinates()
    x = x + 0.35 * fractal(rng, grid, 40, 4, gain=0.6)
    y = y + 0.35 * fractal(rng, grid, 40, 4, gain=0.6)
    column = np.floor(x / width)
    u = x / width - column - 0.5
    side = np.sign(u) + (u == 0)
    # Each stitch is a V: two legs that lean towards each other, each laid over the one above it.
    lean = y / height + 1.3 * np.abs(u)
    row = np.floor(lean)
    along = lean - row - 0.5
    across = (np.abs(u) - 0.25) / 0.25
    round_leg = np.sqrt(np.clip(1 - across * across, 0, 1))
    arch = np.sqrt(np.clip(1 - np.square(along / 0.51), 0, 1))
    crown = round_leg * (0.2 + 0.8 * arch)
    ply = np.sin(2 * np.pi * (1.6 * across * 0.5 + 2.0 * along * side * 0.8 + 0.25))
    fibre = fractal(rng, grid, 2.0, 0.0, gain=0.85)
    relief = 1.5 * crown + 0.12 * ply * crown + 0.08 * fibre
    labels = (np.mod(row, rows) * columns + np.mod(column, columns)).astype(np.int32)
    colour = ramp(np.asarray(0.55 + 0.14 * fibre + 0.08 * ply, np.float32), ((0.0, "a89a86"), (1.0, "d9cebb")))
    colour = colour * tint_each(rng, labels, 0.04, 0.01)
    colour = shade(colour, np.asarray(0.34 + 0.66 * crown, np.float32))
    hairs = _hairs(rng, grid, 3500, 0.1, 8.0)
    colour = mix(colour, "ded5c6", 0.35 * hairs)
    return finish(grid, colour, 0.93, np.asarray(relief + 0.1 * hairs, np.float32))


def carpet_meander(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Loop carpet with a meander of cream lines on navy."""
    points = scatter(rng, grid, 2.3, 0.55)
    base = np.where(_light_yarn(points, grid)[:, None], rgb("b7a98a"), rgb("26384d")).astype(np.float32)
    return _loops(rng, grid, points, base)


def carpet_loop(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Office loop carpet, heathered grey."""
    points = scatter(rng, grid, 2.6, 0.6)
    yarns = np.stack([rgb(code) for code in ("6a6c70", "85868a", "55585d", "9a9894", "6e6660")])
    base = yarns[rng.choice(5, len(points), p=(0.34, 0.24, 0.22, 0.12, 0.08))]
    return _loops(rng, grid, points, base)


def felt(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Pressed grey-green felt: matted fibres of several shades."""
    lumps = fractal(rng, grid, 22, 0.5, gain=0.7)
    fine = fractal(rng, grid, 2.0, 0.0, gain=0.85)
    colour = ramp(0.5 + 0.10 * lumps + 0.08 * fine, ((0.0, "4b564c"), (0.5, "65725f"), (1.0, "87917b")))
    height = 0.10 * lumps + 0.04 * fine
    for code, weight in (("98a28b", 0.4), ("3d463e", 0.5), ("b4b7a4", 0.3)):
        hairs = _hairs(rng, grid, 2600, 0.14, 11.0)
        colour = mix(colour, code, weight * hairs)
        height = height + 0.05 * hairs
    return finish(grid, colour, 0.95, np.asarray(height, np.float32))


def _light_yarn(points_mm: npt.NDArray[np.float64], grid: Grid) -> npt.NDArray[np.bool_]:
    """Find the loops of light yarn in the meander, whose pattern is turned by 45 degrees and still tiles."""
    key = np.array([[cell == "." for cell in line] for line in KEY])
    cell = grid.size_mm / 3 / len(KEY)
    rows = np.floor((points_mm[:, 1] - points_mm[:, 0]) / cell).astype(np.int64) % len(KEY)
    columns = np.floor((points_mm[:, 0] + points_mm[:, 1]) / cell).astype(np.int64) % len(KEY)
    return np.asarray(key[rows, columns])


def _yarn(
    rng: np.random.Generator, cloth: Weave, ramps: tuple[tuple[tuple[float, str], ...], ...], uneven: float
) -> Field:
    """Colour the warp by the first ramp and the weft by the second; threads differ in shade."""
    tone = np.asarray(0.5 + 0.17 * cloth.fibre, np.float32)
    colour = np.where(cloth.warp_on_top[..., None], ramp(tone, ramps[0]), ramp(tone, ramps[1]))
    return np.asarray(colour * tint_each(rng, cloth.thread, uneven, 0.25 * uneven), np.float32)


def _cloth(rng: np.random.Generator, grid: Grid, cloth: Weave, colour: Field, gap: str, depth: float) -> SurfaceMaps:
    """Finish a woven cloth: darken the valleys and add creases and faint soiling."""
    colour = shade(colour, (1 - depth) + depth * smoothstep(0.05, 0.85, cloth.light))
    colour = mix(colour, gap, 0.85 * cloth.gap)
    soil = smoothstep(-0.2, 2.2, fractal(rng, grid, 110, 2, gain=0.62))
    body, rim = stains(rng, grid, 90, 0.06)
    colour = shade(colour, 1 - 0.10 * soil - 0.05 * body - 0.05 * rim)
    crease = 0.35 * fractal(rng, grid, 130, 18, gain=0.45)
    return finish(grid, colour, 0.9 + 0.04 * cloth.gap, np.asarray(cloth.height_mm + crease, np.float32))


def _loops(rng: np.random.Generator, grid: Grid, points: npt.NDArray[np.float64], base: Field) -> SurfaceMaps:
    """A carpet of yarn loops, one at each point, shape (n, 2), of the given colours, shape (n, 3)."""
    labels = voronoi(points, grid)
    centre = points.astype(np.float32)[labels]
    x, y = grid.coordinates()
    half = np.float32(0.5 * grid.size_mm)
    dx = np.mod(x - centre[..., 0] + half, 2 * half) - half
    dy = np.mod(y - centre[..., 1] + half, 2 * half) - half
    angle = rng.uniform(0, np.pi, len(points)).astype(np.float32)[labels]
    along, across = dx * np.cos(angle) + dy * np.sin(angle), dy * np.cos(angle) - dx * np.sin(angle)
    spacing = grid.size_mm / len(points) ** 0.5
    dome = np.clip(1 - (np.square(along) * 0.9 + np.square(across) * 1.5) / (0.72 * spacing) ** 2, 0, 1)
    twist = np.sin((along + 0.8 * across) * (7.0 / spacing) * 1.6)
    fibre = fractal(rng, grid, 2.0, 0.0, gain=0.85)
    tall = rng.normal(1.0, 0.14, len(points)).astype(np.float32)[labels]
    height = 1.7 * np.sqrt(dome) * tall + 0.10 * twist * dome + 0.07 * fibre
    height = np.asarray(height + 0.3 * fractal(rng, grid, 60, 8), np.float32)
    light = (0.42 + 0.62 * dome) * (1 + 0.07 * twist + 0.09 * fibre)
    colour = shade(base[labels] * tint_each(rng, labels, 0.1, 0.02), np.asarray(light, np.float32))
    colour = shade(colour, 1 - 0.25 * hollows(height, 2.0, 1.2, grid))
    trodden = smoothstep(0.0, 2.0, fractal(rng, grid, 140, 6, gain=0.6))
    colour = mix(colour, "6b6459", 0.13 * trodden)
    return finish(grid, colour, 0.95, height)


def _hairs(rng: np.random.Generator, grid: Grid, count: int, width_mm: float, length_mm: float) -> Field:
    """Mask of loose fibres that lie in every direction; 0 to 1, shape (H, W)."""
    image = np.zeros((grid.pixels, grid.pixels), np.uint8)
    for _ in range(count):
        start = rng.uniform(0, grid.size_mm, 2).tolist()
        path = curve(rng, start, length_mm * float(rng.uniform(0.4, 1.3)), 1.2)
        polylines(image, path, width_mm, (float(rng.uniform(80, 255)),), grid)
    return as_field(image)


RECIPES = tuple(
    SurfaceRecipe(name, SurfaceFamily.FABRIC, size_m, draw, published=True)
    for name, size_m, draw in (
        ("linen", 0.3, linen),
        ("denim", 0.288, denim),
        ("jute", 0.3, jute),
        ("tweed", 0.288, tweed),
        ("carpet_basket", 0.3, carpet_basket),
        ("knit", 0.3, knit),
        ("carpet_meander", 0.4, carpet_meander),
        ("carpet_loop", 0.4, carpet_loop),
        ("felt", 0.3, felt),
    )
)
