"""Sheets of paper lying over one another: plain, squared, ruled, printed and written on."""

import numpy as np

from assets.surfaces.kit.circuit_layout import CELL_MM, lay_out
from assets.surfaces.kit.colour import mix, rgb, shade
from assets.surfaces.kit.grid import Field, Grid
from assets.surfaces.kit.handwriting import printed_page, written_lines
from assets.surfaces.kit.lettering import stamp, text_patch
from assets.surfaces.kit.maps import SurfaceMaps, finish, hollows
from assets.surfaces.kit.marks import specks
from assets.surfaces.kit.noise import fractal, smoothstep
from assets.surfaces.kit.pile import Pile, Sprite, local_frame, trimmed
from assets.surfaces.kit.shapes import box, filled, repeated
from assets.surfaces.kit.strokes import as_field, polygon, polylines
from assets.surfaces.recipe import SurfaceFamily, SurfaceRecipe

A4_MM = (210.0, 297.0)
"""Width and height of an A4 sheet, millimetres."""
A5_MM = (148.0, 210.0)
"""Width and height of an A5 sheet, millimetres."""
THICKNESS_MM = 0.12
"""Thickness of a sheet, millimetres: office paper with a little air beneath it."""
WHITES = ("f1f0ec", "e9e9e6", "f2efe6", "eaedef", "e2dfd5", "f0f0ee")
"""Colours of white paper, hexadecimal sRGB; each sheet has one of them."""


def paper_sheets(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """White sheets strewn over a table: blank, printed, ruled and squared ones, some folded, all a little curled."""
    kinds = ("plain", "printed", "squared", "printed", "ruled", "plain", "printed", "plain", "printed")
    pile = Pile(grid, np.broadcast_to(rgb("dddbd4"), (grid.pixels, grid.pixels, 3)), grid.zeros())
    step = grid.size_mm / 3
    # The first nine sheets cover the ground, six more lie on top of them.
    places = [(column * step, row * step) for row in range(3) for column in range(3)]
    places += [tuple(place) for place in rng.uniform(0, grid.size_mm, (6, 2))]
    for number, (x, y) in enumerate(places):
        size = A4_MM if number < 11 else A5_MM
        kind = kinds[number % len(kinds)]
        sheet = _sheet(rng, grid, size, WHITES[int(rng.integers(len(WHITES)))], kind)
        tint = np.float32(1.0 + 0.02 * rng.uniform(-1, 0.4)) * np.ones(3, np.float32)
        jitter = rng.uniform(-0.3, 0.3, 2) * step
        pile.lay(sheet, float(x + jitter[0]), float(y + jitter[1]), tint, 1.0)
    # A sheet that lies on top shades the one below, beside its edge.
    shadow = 0.15 * hollows(pile.height_mm, 1.0, 0.35, grid) + 0.1 * hollows(pile.height_mm, 6.0, 1.6, grid)
    relief = np.tanh(pile.height_mm / 6.0) * 3.0
    return _lit(rng, grid, shade(pile.colour, np.asarray(1 - shadow, np.float32)), np.asarray(relief, np.float32))


def squared_paper(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Pages of a pad with 5 mm squares, written on with pencil and ballpoint, creased by use."""
    x, y = grid.coordinates()
    colour = np.broadcast_to(rgb("efeee8"), (grid.pixels, grid.pixels, 3)).copy()
    faded = 0.45 + 0.55 * smoothstep(-1.5, 0.8, fractal(rng, grid, 80, 0.6, gain=0.7))
    colour = mix(colour, "8fa9c4", np.asarray(0.62 * faded * _squares(x, y, 5.0, grid), np.float32))
    ink = np.zeros((grid.pixels, grid.pixels), np.uint8)
    pencil = np.zeros_like(ink)
    rows = rng.permutation(np.arange(9.0, grid.size_mm, 15.0))
    written_lines(rng, ink, grid, rows[:8], height_mm=3.0)
    written_lines(rng, pencil, grid, rows[8:15], height_mm=3.2)
    colour = mix(colour, "33437f", 0.75 * ink.astype(np.float32) / 255)
    grit = smoothstep(-1.2, 0.8, fractal(rng, grid, 1.2, 0.0, gain=0.9))
    colour = mix(colour, "66666a", 0.6 * grit * pencil.astype(np.float32) / 255)
    edge = np.asarray(np.abs(repeated(x, grid.size_mm)), np.float32)
    gutter = np.asarray(np.exp(-edge / 7.0), np.float32)
    colour = shade(colour, np.asarray(1 - 0.16 * gutter, np.float32))
    colour = shade(colour, np.asarray(1 - 0.45 * filled(edge - np.float32(0.15), grid), np.float32))
    crease, relief = _crumple(rng, grid)
    colour = shade(colour, np.asarray(1 - 0.09 * crease, np.float32))
    return _lit(rng, grid, colour, np.asarray(relief - 0.8 * gutter, np.float32))


def wiring_plan(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Large wiring plan on white paper: boxes with names, joined by printed lines in the colours of wires."""
    plan = lay_out(rng, grid.size_mm)
    colour = np.broadcast_to(rgb("eeede8"), (grid.pixels, grid.pixels, 3)).copy()
    inks = ("2b2b2e", "b23a34", "3157a0", "3d7d4c", "7a5435", "2b2b2e")
    layers = np.zeros((len(inks), grid.pixels, grid.pixels), np.uint8)
    for number, trace in enumerate(plan.traces):
        polylines(layers[number // 5 % len(inks)], trace.path, 0.36, (225.0,), grid)
    for body in plan.bodies:
        middle, size = np.array([body.x, body.y]), np.array([body.width, body.height])
        corners = middle + 0.5 * size * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
        for layer in layers:
            polygon(layer, corners, (0.0,), grid)
        polylines(layers[0], np.concatenate([corners, corners[:1]]), 0.45, (235.0,), grid)
        above = text_patch(body.name, 1.7 if size.min() < 4 else 2.6, grid, 0.12)
        stamp(layers[0], above, body.x, body.y - 0.5 * body.height - 1.6, grid)
    faint = 0.7 + 0.3 * smoothstep(-1.2, 0.8, fractal(rng, grid, 90, 0.5, gain=0.7))
    for ink, layer in zip(inks, layers, strict=True):
        colour = mix(colour, ink, np.asarray(0.8 * faint * as_field(layer), np.float32))
    fold, relief = _folds(grid)
    crease, crumpled = _crumple(rng, grid)
    colour = shade(colour, np.asarray(1 - 0.1 * fold - 0.07 * crease, np.float32))
    worn = fold * smoothstep(-0.2, 1.4, fractal(rng, grid, 8, 0.5, gain=0.75))
    colour = mix(colour, "f4f3ef", 0.6 * worn)
    return _lit(rng, grid, colour, np.asarray(relief + 0.6 * crumpled, np.float32))


def _lit(rng: np.random.Generator, grid: Grid, colour: Field, height: Field) -> SurfaceMaps:
    """Finish paper with what all of it shares: fibres, thumb marks and specks."""
    pulp = fractal(rng, grid, 3.0, 0.0, gain=0.85)
    colour = shade(colour, 1 + 0.006 * pulp + 0.008 * fractal(rng, grid, 120, 6, gain=0.6))
    thumbed = smoothstep(0.3, 2.6, fractal(rng, grid, 110, 5, gain=0.55))
    colour = mix(colour, "a89b84", 0.07 * thumbed)
    colour = mix(colour, "6d6558", 0.5 * specks(rng, grid, 0.0006, 0.45))
    return finish(grid, colour, 0.86 - 0.1 * thumbed, np.asarray(height + 0.004 * pulp, np.float32))


def _sheet(rng: np.random.Generator, grid: Grid, size_mm: tuple[float, float], code: str, kind: str) -> Sprite:
    """One sheet at a random angle, with its print, folds and curl."""
    reach = 0.5 * float(np.hypot(*size_mm)) + 1.0
    u, v, _ = local_frame(rng, grid, reach)
    inside = filled(box(u, v, *size_mm, 0.4), grid)
    colour = np.broadcast_to(rgb(code), (*u.shape, 3)).copy()
    if kind == "squared":
        margin = filled(box(u, v, size_mm[0] - 10, size_mm[1] - 10, 0.1), grid)
        colour = mix(colour, "9db2c8", np.asarray(0.6 * margin * _squares(u, v, 5.0, grid), np.float32))
    elif kind == "ruled":
        rows = filled(np.abs(repeated(v, 8.0)) - np.float32(0.11), grid)
        colour = mix(colour, "93abc6", np.asarray(0.6 * rows * (np.abs(v) < 0.5 * size_mm[1] - 18), np.float32))
        colour = mix(colour, "c58a8a", 0.6 * filled(np.abs(u + 0.5 * size_mm[0] - 25) - np.float32(0.15), grid))
    elif kind == "printed":
        page = printed_page(rng, size_mm, grid)
        rows = np.clip((v + 0.5 * size_mm[1]) / grid.texel_mm, 0, page.shape[0] - 1).astype(np.int32)
        columns = np.clip((u + 0.5 * size_mm[0]) / grid.texel_mm, 0, page.shape[1] - 1).astype(np.int32)
        colour = mix(colour, "3a3a3d", 0.72 * page[rows, columns])
    corner = np.hypot(u / size_mm[0], v / size_mm[1])
    lean = rng.uniform(-1, 1, 3)
    curl = lean[0] * np.square(u / size_mm[0]) + lean[1] * np.square(v / size_mm[1]) + 0.5 * lean[2] * corner
    height = THICKNESS_MM + 1.6 * curl
    if rng.random() < 0.5:
        # The sheet was folded across once or twice, as for an envelope, which leaves a ridge of broken, greyed paper.
        for line in (-0.167, 0.167) if rng.random() < 0.6 else (0.0,):
            distance = np.abs(v - line * size_mm[1])
            height = height + float(rng.choice([-1, 1])) * 1.1 * np.exp(-distance / 9.0)
            colour = shade(colour, np.asarray(1 - 0.14 * np.exp(-distance / 0.3), np.float32))
    return trimmed(Sprite(colour.astype(np.float32), np.asarray(height, np.float32), inside))


def _squares(u: Field, v: Field, pitch_mm: float, grid: Grid) -> Field:
    """Mask of printed squares, 0 to 1, shape of `u`."""
    lines = [filled(np.abs(repeated(axis, pitch_mm)) - np.float32(0.1), grid) for axis in (u, v)]
    return np.maximum(lines[0], lines[1])


def _folds(grid: Grid) -> tuple[Field, Field]:
    """The folds of a plan: two across, one a ridge and one a valley, and one along.

    Returns:
        The fold lines, 0 to 1, and the relief in millimetres, each shape (H, W).
    """
    x, y = grid.coordinates()
    along = np.abs(repeated(y, grid.size_mm, 0.2 * grid.size_mm))
    line = np.exp(-along / 0.35)
    relief = 1.2 * np.exp(-along / 14.0)
    for middle, up in ((0.25, 1.0), (0.75, -1.0)):
        across = np.abs(repeated(x, grid.size_mm, (middle - 0.5) * grid.size_mm))
        line = np.maximum(line, np.exp(-across / 0.35))
        relief = relief + up * 1.2 * np.exp(-across / 14.0)
    return np.asarray(line, np.float32), np.asarray(relief, np.float32)


def _crumple(rng: np.random.Generator, grid: Grid) -> tuple[Field, Field]:
    """Soft creases of handled paper: the mask of the lines, 0 to 1, and the relief in millimetres."""
    field = fractal(rng, grid, 150, 18, gain=0.5)
    second = fractal(rng, grid, 110, 14, gain=0.5)
    present = smoothstep(0.4, 1.6, fractal(rng, grid, 120, 10))
    fold = np.abs(field)
    line = np.exp(-fold / 0.012) * present
    relief = 0.5 * np.minimum(fold, 0.6) * present + 0.3 * second
    return np.asarray(line, np.float32), np.asarray(relief, np.float32)


PLAN_M = 700 * CELL_MM / 1000
"""Edge of the wiring plan's tile, metres: 700 cells of the lattice on which it is laid out, so that its edges meet."""

RECIPES = tuple(
    SurfaceRecipe(name, SurfaceFamily.PAPER, size_m, draw, light=True)
    for name, size_m, draw in (
        ("paper_sheets", 0.4, paper_sheets),
        ("squared_paper", 0.4, squared_paper),
        ("wiring_plan", PLAN_M, wiring_plan),
    )
)
