"""Natural ground: earth, sand, stones, grass and what falls on them."""

import numpy as np

from assets.surfaces.kit.cells import scatter, voronoi
from assets.surfaces.kit.colour import mix, ramp, shade
from assets.surfaces.kit.grid import Field, Grid
from assets.surfaces.kit.maps import SurfaceMaps, finish, hollows
from assets.surfaces.kit.noise import blur, coverage, fractal, smoothstep, warp
from assets.surfaces.kit.pile import Pile, pebble
from assets.surfaces.kit.plants import as_image, blades, leaf, twig_paths
from assets.surfaces.kit.strokes import as_field, polylines
from assets.surfaces.recipe import SurfaceFamily, SurfaceRecipe

EARTH = ((0.0, "2e2219"), (0.4, "4f3c2b"), (0.75, "715840"), (1.0, "937758"))
"""Colour ramp of bare earth, from damp and dark at 0 to dry and pale at 1, hexadecimal sRGB."""
GREENS = ("5f7a2e", "6f8a38", "4f6b2a", "86964a", "a39a58", "58702f")
"""Colours of growing grass, hexadecimal sRGB; each blade has one of them."""


def soil(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Crumbly garden soil with clods, small stones and roots."""
    pile = _crumbs(rng, grid)
    colour = as_image(pile.colour)
    roots = np.zeros((grid.pixels, grid.pixels), np.uint8)
    for path in twig_paths(rng, grid, 26, 60):
        polylines(colour, path, 0.7, (150.0, 122.0, 84.0), grid)
        polylines(roots, path, 0.7, (255.0,), grid)
    damp = smoothstep(-0.5, 1.5, fractal(rng, grid, 130, 3, gain=0.6))
    height = pile.height_mm + 0.5 * as_field(roots)
    shadow = 1 - 0.45 * hollows(height, 3.0, 2.5, grid)
    shown = shade(as_field(colour), shadow * (1 - 0.28 * damp))
    return finish(grid, shown, 0.95 - 0.14 * damp, height)


def gravel(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Crushed grey gravel, 5 to 18 mm."""
    tones = ("8d8a85", "a19d95", "77746f", "b0a797", "696763", "948577")
    return _stones(rng, grid, tones, 0.85, ((2.2, 3600), (4.2, 1700), (6.8, 800), (8.5, 260)))


def pebbles(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Rounded river pebbles of many kinds of rock, 8 to 30 mm."""
    tones = ("9a9389", "b9ad98", "6c6964", "86705c", "cdc5b5", "5b5f63", "9c7a63", "7d837f")
    return _stones(rng, grid, tones, 0.0, ((3.5, 2200), (6.5, 700), (10.0, 260), (13.0, 80)))


def sand(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Dry beach sand with soft ripples, dark grains and bits of shell."""
    dx, dy = (14 * fractal(rng, grid, 150, 20, gain=0.45) for _ in range(2))
    wave = warp(fractal(rng, grid, 42, 14, gain=0.4, stretch=(3.2, 0.8)), dx, dy, grid)
    grain = fractal(rng, grid, 2.2, 0.0, gain=0.95)
    lumps = fractal(rng, grid, 25, 0.8, gain=0.65)
    labels = voronoi(scatter(rng, grid, 0.75, 1.0), grid)
    minerals = rng.normal(0, 1, int(labels.max()) + 1).astype(np.float32)[labels]
    tone = 0.55 + 0.11 * minerals + 0.05 * grain + 0.07 * lumps + 0.05 * wave
    colour = ramp(tone, ((0.0, "7a6547"), (0.35, "b59c74"), (0.7, "cfb992"), (1.0, "ece1ca")))
    colour = mix(colour, "4a3f35", 0.6 * (minerals > 2.1).astype(np.float32))
    pile = Pile(grid, colour, np.asarray(1.3 * wave + 0.28 * lumps + 0.07 * grain, np.float32))
    bits = [
        pebble(rng, grid, rng.uniform(0.9, 2.6), code, 0.5)
        for code in ("e6dcc8", "d3b89a", "8b7d6d", "b9a58a", "efe7d8")
        for _ in range(4)
    ]
    pile.strew(rng, bits, 170, brightness=0.08, sink=0.0)
    return finish(grid, pile.colour, 0.92, pile.height_mm)


def grass(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Trodden lawn: green blades and some dry ones over thatch."""
    thatch = fractal(rng, grid, 14, 0.0, gain=0.75)
    colour = as_image(ramp(0.35 + 0.16 * thatch, EARTH))
    height = np.full((grid.pixels, grid.pixels), 10, np.uint8)
    blades(rng, grid, colour, height, 1400, (14, 34), 1.1, ("a08c58", "8a7846", "b5a06b"))
    blades(rng, grid, colour, height, 6200, (12, 38), 1.9, GREENS)
    blades(rng, grid, colour, height, 220, (18, 40), 1.6, ("b7a56a", "c2b078"))
    relief = blur(as_field(height), 0.16, grid) * 5.0
    shown = shade(as_field(colour), 1 - 0.42 * hollows(relief, 3.0, 2.4, grid))
    patch = smoothstep(0.2, 1.8, fractal(rng, grid, 140, 6, gain=0.6))
    shown = mix(shown, shade(shown, 0.85) * np.array([1.18, 1.02, 0.8], np.float32), 0.6 * patch)
    return finish(grid, shown, 0.72, np.asarray(relief, np.float32))


def mossy_ground(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Forest floor: cushions of moss, bare earth, straw, a few leaves and stones."""
    pile = _crumbs(rng, grid)
    cushion = fractal(rng, grid, 90, 1.2, gain=0.6) + 0.35 * fractal(rng, grid, 14, 1.0, gain=0.7)
    moss = coverage(cushion, 0.52, 0.5)
    tuft = fractal(rng, grid, 5.0, 0.5, gain=0.8)
    sprig = fractal(rng, grid, 1.6, 0.3, gain=0.85)
    green = ramp(
        0.47 + 0.13 * tuft + 0.16 * sprig + 0.06 * cushion,
        ((0.0, "1f2a10"), (0.35, "3f511d"), (0.65, "667a2c"), (1.0, "a4ab55")),
    )
    ragged = smoothstep(0.25, 0.75, moss + 0.16 * sprig)
    height = pile.height_mm * (1 - 0.6 * ragged) + ragged * (2.2 + 1.3 * moss + 0.55 * tuft + 0.35 * sprig)
    pile.colour = mix(pile.colour, green, ragged)
    pile.height_mm = np.asarray(height, np.float32)
    fallen = [leaf(rng, grid, rng.uniform(14, 30), code, 0) for code in ("7a5a36", "93703f", "5d4129") for _ in "ab"]
    pile.strew(rng, fallen, 26, sink=0.8)
    image = as_image(pile.colour)
    straw = np.zeros((grid.pixels, grid.pixels), np.uint8)
    for path in twig_paths(rng, grid, 130, 34):
        tone = rng.uniform(0.7, 1.15)
        polylines(image, path, 0.5, (min(255, 158 * tone), 130 * tone, 84 * tone), grid)
        polylines(straw, path, 0.5, (255.0,), grid)
    height = np.asarray(pile.height_mm + 0.4 * as_field(straw), np.float32)
    shown = shade(as_field(image), 1 - 0.4 * hollows(height, 4.0, 3.0, grid))
    return finish(grid, shown, 0.9, height)


def leaf_litter(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Fallen leaves of oak and beech on dark earth."""
    pile = _crumbs(rng, grid)
    codes = ("8a5a2c", "a9743a", "6f4524", "b98d4f", "7d3f24", "94692f", "5a3a22", "a85f2a")
    kinds = [leaf(rng, grid, rng.uniform(32, 62), codes[i % 8], 4 * (i % 3 == 0)) for i in range(36)]
    pile.strew(rng, kinds, 480, brightness=0.16, hue=0.04, sink=0.45)
    small = [leaf(rng, grid, rng.uniform(18, 32), codes[i % 8], 0) for i in range(12)]
    pile.strew(rng, small, 90, brightness=0.14, hue=0.05, sink=0.5)
    shadow = hollows(pile.height_mm, 3.5, 1.8, grid)
    colour = shade(pile.colour, 1 - 0.6 * shadow)
    return finish(grid, colour, 0.7 + 0.15 * shadow, pile.height_mm)


def _crumbs(rng: np.random.Generator, grid: Grid) -> Pile:
    """Bare crumbly earth with clods and a few stones, for other things to be laid on."""
    broad = fractal(rng, grid, 60, 0.6, gain=0.66)
    fine = fractal(rng, grid, 5, 0.0, gain=0.85)
    pile = Pile(grid, ramp(0.36 + 0.10 * broad + 0.12 * fine, EARTH), 0.8 * broad + 0.2 * fine)
    tones = ("5c4632", "6b523b", "4a3827", "7a6048", "53402f")
    for radius, count in ((3.6, 260), (1.9, 1400), (1.0, 2600)):
        clods = [pebble(rng, grid, radius * rng.uniform(0.7, 1.4), tones[i % 5], 0.7) for i in range(20)]
        pile.strew(rng, clods, count, brightness=0.16, hue=0.03, sink=0.15)
    stones = [pebble(rng, grid, rng.uniform(1.5, 4.0), c, 0.5) for c in ("8f8a82", "a39a8a", "77706a") for _ in "abc"]
    pile.strew(rng, stones, 60, sink=0.1)
    return pile


def _stones(
    rng: np.random.Generator,
    grid: Grid,
    tones: tuple[str, ...],
    angular: float,
    sizes: tuple[tuple[float, int], ...],
) -> SurfaceMaps:
    """Loose stones on earth; `sizes` holds the radius in millimetres and the number of each sort, laid in turn."""
    fine = fractal(rng, grid, 6, 0.0, gain=0.8)
    pile = Pile(grid, ramp(0.4 + 0.14 * fine, ((0.0, "2c2823"), (1.0, "6b6257"))), 0.3 * fine)
    for radius, count in sizes:
        kinds = [pebble(rng, grid, radius * rng.uniform(0.75, 1.3), tones[i % len(tones)], angular) for i in range(28)]
        pile.strew(rng, kinds, count, brightness=0.12, hue=0.035, sink=0.5)
    crevice = hollows(pile.height_mm, 5.0, 4.5, grid)
    dust = smoothstep(-0.6, 1.8, fractal(rng, grid, 60, 0.8, gain=0.68))
    colour = mix(shade(pile.colour, 1 - 0.62 * crevice), "9a9184", 0.14 * dust)
    return finish(grid, colour, _dry(0.72 - 0.1 * (1 - angular) + 0.12 * dust), pile.height_mm)


def _dry(roughness: Field) -> Field:
    return np.clip(roughness, 0.0, 0.95).astype(np.float32)


RECIPES = tuple(
    SurfaceRecipe(name, SurfaceFamily.GROUND, 0.4, draw, published=True)
    for name, draw in (
        ("soil", soil),
        ("gravel", gravel),
        ("pebbles", pebbles),
        ("sand", sand),
        ("grass", grass),
        ("mossy_ground", mossy_ground),
        ("leaf_litter", leaf_litter),
    )
)
