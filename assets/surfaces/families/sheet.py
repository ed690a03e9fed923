"""Pressed, rolled and moulded sheets: boards of chips, cork, rubber, cardboard, linoleum, leather."""

import numpy as np

from assets.surfaces.kit.cells import edge_distance, scatter, voronoi, warp_labels
from assets.surfaces.kit.colour import mix, ramp, rgb, shade, tint_each, value_each
from assets.surfaces.kit.grid import Field, Grid
from assets.surfaces.kit.maps import SurfaceMaps, finish, hollows
from assets.surfaces.kit.marks import scratches, specks, stains
from assets.surfaces.kit.noise import coverage, fractal, smoothstep, warp
from assets.surfaces.kit.pile import Pile, Sprite, local_frame, smooth_noise, trimmed
from assets.surfaces.kit.strokes import as_field, curve, polylines
from assets.surfaces.recipe import SurfaceFamily, SurfaceRecipe


def osb_board(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Oriented strand board: overlapping flat strands of wood, pressed and waxed."""
    fine = fractal(rng, grid, 5, 0.0, gain=0.8)
    pile = Pile(grid, ramp(0.4 + 0.15 * fine, ((0.0, "7a5830"), (1.0, "b28c58"))), 0.02 * fine)
    tones = ("c9a26b", "c0975f", "d3b27e", "b78d57", "c79d66", "bf9058", "d6ba8a")
    strands = [_strand(rng, grid, tones[i % len(tones)]) for i in range(42)]
    pile.strew(rng, strands, 760, brightness=0.06, hue=0.02, sink=0.5)
    # The press leaves one flat face: only shallow steps remain of the strands' thickness.
    relief = 0.12 * np.tanh((pile.height_mm - pile.height_mm.mean()) / 0.5)
    slits = hollows(pile.height_mm, 1.0, 0.5, grid)
    colour = shade(pile.colour, 1 - 0.38 * slits)
    colour = shade(colour, 1 + 0.03 * fractal(rng, grid, 120, 5, gain=0.6))
    return finish(grid, colour, 0.6 + 0.1 * slits, np.asarray(relief - 0.12 * slits, np.float32))


def particle_board(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Raw particle board: fine flakes and slivers of many shades."""
    colour = ramp(0.5 + 0.14 * fractal(rng, grid, 5, 0.0, gain=0.8), ((0.0, "a98657"), (1.0, "d3b587")))
    height = 0.03 * fractal(rng, grid, 8, 0.0, gain=0.75)
    for size, share, weight in ((5.5, 0.55, 0.75), (3.0, 0.5, 0.8), (1.6, 0.4, 0.8)):
        labels = voronoi(scatter(rng, grid, size, 1.0), grid)
        dx, dy = (0.5 * size * fractal(rng, grid, 1.5 * size, 0.4 * size, gain=0.6) for _ in range(2))
        labels = warp_labels(labels, dx, dy, grid)
        kept = (value_each(rng, labels, 0.0, 1.0) < share).astype(np.float32)
        mask = smoothstep(0.1, 0.35, edge_distance(labels, grid, 8.0)) * kept
        flake = ramp(value_each(rng, labels, 0.0, 1.0), ((0.0, "8a6437"), (0.5, "c09a65"), (1.0, "e3cda4")))
        streak = fractal(rng, grid, 2.0, 0.3, gain=0.8, stretch=(3.0, 1.0))
        colour = mix(colour, shade(flake, 1 + 0.05 * streak), weight * mask)
        height = height + 0.03 * mask * value_each(rng, labels, -1.0, 1.0)
    colour = shade(colour, 1 - 0.35 * specks(rng, grid, 0.01, 0.6))
    colour = shade(colour, 1 + 0.025 * fractal(rng, grid, 90, 6, gain=0.6))
    return finish(grid, colour, 0.78, np.asarray(height, np.float32))


def cork(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Cork floor: pressed granules, honey to dark brown."""
    colour = ramp(0.5 + 0.15 * fractal(rng, grid, 8, 0.0, gain=0.75), ((0.0, "9a6c3f"), (1.0, "c3945f")))
    height = grid.zeros()
    fine = fractal(rng, grid, 3, 0.0, gain=0.8)
    for size, share in ((6.5, 0.8), (3.2, 0.45)):
        labels = voronoi(scatter(rng, grid, size, 1.0), grid)
        dx, dy = (0.14 * size * fractal(rng, grid, size, 0.5, gain=0.6) for _ in range(2))
        labels = warp_labels(labels, dx, dy, grid)
        kept = (value_each(rng, labels, 0.0, 1.0) < share).astype(np.float32)
        inset = edge_distance(labels, grid, 8.0)
        mask = smoothstep(0.05, 0.4, inset) * kept
        granule = ramp(
            value_each(rng, labels, 0.0, 1.0) + 0.07 * fine,
            ((0.0, "7d5330"), (0.25, "a87648"), (0.7, "c4975f"), (1.0, "d9b483")),
        )
        rim = 1 - smoothstep(0.0, 0.35, inset)
        colour = mix(shade(colour, np.asarray(1 - 0.3 * kept * rim, np.float32)), granule, mask)
        height = height + 0.05 * mask * value_each(rng, labels, -0.6, 1.0)
    bark = coverage(fractal(rng, grid, 7, 0.9, gain=0.75), 0.05, 0.15)
    colour = mix(colour, "4a2f1c", 0.75 * bark)
    height = np.asarray(height + 0.015 * fine - 0.12 * bark, np.float32)
    return finish(grid, colour, 0.62 + 0.12 * bark, height)


def rubber_studs(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Black rubber matting with round studs, dusty between them."""
    count = 16
    pitch = grid.size_mm / count
    x, y = grid.coordinates()
    row = np.floor(y / pitch)
    moved = x + 0.5 * pitch * np.mod(row, 2)
    u = np.mod(moved, pitch) - 0.5 * pitch
    v = np.mod(y, pitch) - 0.5 * pitch
    radius = np.hypot(u, v)
    stud = 1 - smoothstep(7.2, 8.6, radius)
    ring = np.exp(-np.square((radius - 5.2) / 0.5))
    grain = fractal(rng, grid, 3, 0.0, gain=0.8)
    colour = ramp(0.5 + 0.14 * grain, ((0.0, "2b2b2c"), (1.0, "474748")))
    dust = smoothstep(-0.8, 1.6, fractal(rng, grid, 50, 0.6, gain=0.7)) * (1 - 0.75 * stud)
    foot = np.exp(-np.square((radius - 9.2) / 1.1))
    colour = mix(colour, "857c6f", np.asarray(np.clip(0.5 * dust + 0.25 * foot, 0, 1), np.float32))
    worn = stud * smoothstep(-0.4, 1.8, fractal(rng, grid, 70, 1, gain=0.6))
    colour = mix(colour, "5f5e5d", 0.35 * worn)
    marks = scratches(rng, grid, 50, 0.3)
    colour = mix(colour, "7b7a78", 0.3 * marks)
    rough = 0.62 + 0.2 * dust - 0.14 * worn
    height = 1.4 * stud - 0.12 * ring + 0.025 * grain - 0.02 * marks
    return finish(grid, colour, np.asarray(rough, np.float32), np.asarray(height, np.float32))


def rubber_granules(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Sports flooring of black rubber granules with blue and grey flecks."""
    labels = voronoi(scatter(rng, grid, 2.3, 1.0), grid)
    codes = np.stack([rgb(code) for code in ("38383a", "464648", "555558", "54779c", "9a9c9e")])
    which = rng.choice(5, int(labels.max()) + 1, p=(0.42, 0.28, 0.16, 0.08, 0.06))
    inset = edge_distance(labels, grid, 4.0)
    dome = smoothstep(0.0, 0.75, inset)
    fine = fractal(rng, grid, 1.5, 0.0, gain=0.85)
    colour = codes[which][labels] * tint_each(rng, labels, 0.1, 0.02)
    colour = shade(colour, (0.62 + 0.38 * dome) * (1 + 0.06 * fine))
    dust = smoothstep(-0.4, 2.0, fractal(rng, grid, 80, 0.8, gain=0.68))
    colour = mix(colour, "8a8276", 0.2 * dust)
    height = 0.22 * dome * value_each(rng, labels, 0.5, 1.2) + 0.02 * fine
    return finish(grid, colour, 0.82 + 0.06 * dust, np.asarray(height, np.float32))


def cardboard(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Brown corrugated cardboard: the flutes show through, with fibres, dents and creases."""
    x, _ = grid.coordinates()
    flutes = np.cos(2 * np.pi * x * 56 / grid.size_mm)
    pulp = fractal(rng, grid, 12, 0.0, gain=0.8)
    cloud = fractal(rng, grid, 60, 1, gain=0.65)
    tone = 0.5 + 0.09 * pulp + 0.09 * cloud + 0.04 * flutes
    colour = ramp(np.asarray(tone, np.float32), ((0.0, "94704a"), (0.5, "b5905f"), (1.0, "cdad7f")))
    fibres = np.zeros((grid.pixels, grid.pixels), np.uint8)
    for _ in range(5200):
        path = curve(rng, rng.uniform(0, grid.size_mm, 2).tolist(), float(rng.uniform(1.5, 5)), 0.8, 4)
        polylines(fibres, path, 0.2, (float(rng.uniform(40, 200)),), grid)
    light = as_field(fibres)
    colour = mix(colour, "e0c79d", 0.35 * light)
    colour = mix(colour, "6d4f31", 0.5 * specks(rng, grid, 0.012, 0.45))
    marks = scratches(rng, grid, 26, 0.5)
    colour = mix(colour, "d8bd92", 0.3 * marks)
    body, rim = stains(rng, grid, 120, 0.07)
    colour = shade(colour, 1 - 0.14 * body - 0.16 * rim)
    dents = fractal(rng, grid, 60, 4, gain=0.5)
    height = 0.05 * flutes + 0.012 * pulp + 0.1 * dents - 0.05 * marks
    return finish(grid, colour, 0.83 + 0.04 * cloud, np.asarray(height, np.float32))


def linoleum(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Marbled ochre linoleum, polished and scuffed."""
    dx, dy = (10 * fractal(rng, grid, 70, 3, gain=0.55) for _ in range(2))
    swirl = warp(fractal(rng, grid, 30, 0.4, gain=0.68, stretch=(4.0, 0.8)), dx, dy, grid)
    second = warp(fractal(rng, grid, 22, 0.6, gain=0.65, stretch=(4.0, 0.8)), dy, dx, grid)
    colour = ramp(0.5 + 0.2 * swirl, ((0.0, "8f6c3c"), (0.4, "b08b51"), (0.7, "c2a06a"), (1.0, "d8c096")))
    colour = mix(colour, "6e5334", 0.5 * smoothstep(0.9, 2.2, second))
    colour = mix(colour, "dccba8", 0.45 * smoothstep(1.0, 2.2, -second))
    heel = scratches(rng, grid, 14, 1.6)
    colour = mix(colour, "3f3328", 0.35 * heel)
    marks = scratches(rng, grid, 60, 0.25)
    colour = mix(colour, "dfd0b2", 0.16 * marks)
    wear = fractal(rng, grid, 100, 2, gain=0.6)
    rough = 0.4 + 0.06 * wear + 0.14 * marks + 0.1 * heel
    height = 0.012 * fractal(rng, grid, 5, 0.8, gain=0.6) - 0.012 * marks
    return finish(grid, colour, np.asarray(rough, np.float32), np.asarray(height, np.float32))


def leather(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Brown full-grain leather: pebbled grain, creases, rubbed crowns."""
    height = grid.zeros()
    for size, weight in ((3.4, 0.16), (1.7, 0.07)):
        labels = voronoi(scatter(rng, grid, size, 0.9), grid)
        dx, dy = (0.16 * size * fractal(rng, grid, 2 * size, 0.5 * size, gain=0.6) for _ in range(2))
        labels = warp_labels(labels, dx, dy, grid)
        height = height + weight * np.sqrt(smoothstep(0.0, 0.42 * size, edge_distance(labels, grid, 4.0)))
    line = np.abs(fractal(rng, grid, 70, 1.5, gain=0.55, stretch=(1.6, 0.8)))
    crease = np.exp(-line / 0.03) * smoothstep(0.1, 1.2, fractal(rng, grid, 90, 8))
    height = np.asarray(height - 0.16 * crease, np.float32)
    crown = smoothstep(0.1, 0.24, height)
    cloud = fractal(rng, grid, 110, 1.2, gain=0.62)
    tone = 0.42 + 0.09 * cloud + 0.2 * crown
    colour = ramp(np.asarray(tone, np.float32), ((0.0, "40241a"), (0.5, "704229"), (1.0, "9c6743")))
    colour = mix(colour, "2b1710", np.asarray(0.5 * crease + 0.35 * (1 - crown), np.float32))
    marks = scratches(rng, grid, 30, 0.3)
    colour = mix(colour, "b58a63", 0.25 * marks)
    rough = 0.5 - 0.1 * crown + 0.06 * cloud + 0.1 * marks
    return finish(grid, colour, np.asarray(rough, np.float32), np.asarray(height, np.float32))


def _strand(rng: np.random.Generator, grid: Grid, code: str) -> Sprite:
    """One flat strand of wood, torn at its ends, lying mostly along x."""
    length, width = float(rng.uniform(32, 78)), float(rng.uniform(6, 21))
    x, y, _ = local_frame(rng, grid, 0.55 * length, spread=0.9)
    ragged = smooth_noise(rng.normal(0, 1, x.shape), 0.8 / grid.texel_mm)
    fray = _fibres(rng, y, 0.5)
    ends = 0.5 * length - np.abs(x) + 2.2 * fray
    sides = 0.5 * width * (1 - 0.25 * np.square(2 * x / length)) - np.abs(y) + 0.25 * ragged
    mask = np.clip(np.minimum(ends, sides) / grid.texel_mm + 0.5, 0, 1)
    drift = y + 0.02 * float(rng.normal(0, 1)) * x + 0.5 * smooth_noise(rng.normal(0, 1, x.shape), 5 / grid.texel_mm)
    grain = 0.6 * _fibres(rng, drift, 0.45) + 0.5 * _fibres(rng, drift, 1.6)
    light = 1 + 0.085 * grain + 0.02 * ragged
    colour = rgb(code) * light[..., None]
    height = 0.5 + 0.05 * grain - 0.1 * (1 - smoothstep(0.0, 0.8, np.minimum(ends, sides)))
    return trimmed(Sprite(colour.astype(np.float32), height.astype(np.float32), mask.astype(np.float32)))


def _fibres(rng: np.random.Generator, across_mm: Field, width_mm: float) -> Field:
    """A random profile across the grain, of the given width, standard deviation 1; shape of `across_mm`."""
    table = rng.standard_normal(512)
    position = np.mod(across_mm / width_mm, 511)
    return np.interp(position.ravel(), np.arange(512), table).reshape(across_mm.shape).astype(np.float32)


RECIPES = tuple(
    SurfaceRecipe(name, SurfaceFamily.SHEET, 0.4, draw, published=True)
    for name, draw in (
        ("osb_board", osb_board),
        ("particle_board", particle_board),
        ("cork", cork),
        ("rubber_studs", rubber_studs),
        ("rubber_granules", rubber_granules),
        ("cardboard", cardboard),
        ("linoleum", linoleum),
        ("leather", leather),
    )
)
