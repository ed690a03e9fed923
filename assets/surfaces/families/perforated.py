"""Surfaces with dark openings: perforated sheet, cable tray, grating, profiles with T-slots, pegboard."""

import numpy as np

from assets.surfaces.kit.cells import edge_distance, scatter, voronoi, warp_labels
from assets.surfaces.kit.colour import mix, plain, ramp, shade, value_each
from assets.surfaces.kit.grid import Field, Grid, Labels
from assets.surfaces.kit.maps import SurfaceMaps, finish
from assets.surfaces.kit.marks import dust, scratches, specks, stains
from assets.surfaces.kit.noise import coverage, fractal, smoothstep
from assets.surfaces.kit.shapes import box, filled, repeated
from assets.surfaces.recipe import SurfaceFamily, SurfaceRecipe


def perforated_steel(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Steel sheet with round 5 mm holes, staggered 8 mm apart; the face is worn, the holes are dark."""
    x, y = grid.coordinates()
    row_mm = grid.size_mm / 58
    odd = np.mod(np.floor(y / np.float32(row_mm)), 2)
    radius = np.hypot(repeated(x, grid.size_mm / 50, 0.5 * odd * (grid.size_mm / 50)), repeated(y, row_mm))
    edge = np.asarray(radius - 2.5, np.float32)
    brush = fractal(rng, grid, 4.0, 0.0, gain=0.9, stretch=(1.0, 18.0))
    cloud = fractal(rng, grid, 110, 0.8, gain=0.64)
    colour = ramp(0.5 + 0.1 * brush + 0.13 * cloud, ((0.0, "8b8d8f"), (0.5, "a3a5a6"), (1.0, "bcbdbc")))
    marks = scratches(rng, grid, 90, 0.25)
    colour = mix(colour, "d4d4d2", 0.35 * marks)
    grime = dust(rng, grid, np.asarray(np.exp(-np.maximum(edge, 0) / 0.5), np.float32))
    rust = coverage(fractal(rng, grid, 70, 0.6, gain=0.72), 0.03, 0.5)
    colour = mix(mix(colour, "4c4339", 0.6 * grime), "7c4c2b", 0.6 * rust)
    # The punch presses the edge of each hole down and leaves it bright.
    rim = np.asarray(np.exp(-np.square((edge - 0.22) / 0.18)), np.float32)
    colour = mix(colour, "d6d6d4", 0.35 * rim * (1 - grime))
    body, stain_rim = stains(rng, grid, 100, 0.08)
    colour = shade(colour, 1 - 0.08 * body - 0.07 * stain_rim)
    rough = 0.4 + 0.04 * brush + 0.05 * cloud + 0.3 * np.maximum(rust, grime)
    height = -0.25 * np.exp(-np.maximum(edge, 0) / 0.3) + 0.002 * brush - 0.006 * marks
    metal = np.asarray(1 - 0.85 * np.maximum(rust, 0.7 * grime), np.float32)
    return _opened(rng, grid, edge, colour, rough, height, metal)


def cable_tray(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Galvanised cable tray: rows of 7 by 25 mm slots between pressed ribs."""
    x, y = grid.coordinates()
    pitch_x, pitch_y = grid.size_mm / 8, grid.size_mm / 20
    odd = np.mod(np.floor(y / np.float32(pitch_y)), 2)
    u, v = repeated(x, pitch_x, 0.5 * odd * pitch_x), repeated(y, pitch_y)
    edge = box(u, v, 25.0, 7.0, 3.5)
    colour, rough, height, metal = _zinc(rng, grid)
    rib = np.exp(-np.square(repeated(y, 5 * pitch_y, 0.5 * 5 * pitch_y) / 2.2))
    shoulder = np.exp(-np.maximum(edge, 0) / 0.8)
    height = height + 1.1 * rib * smoothstep(0.0, 3.0, edge) - 0.3 * shoulder
    grime = dust(rng, grid, np.asarray(0.7 * shoulder, np.float32))
    colour = mix(colour, "5b5448", 0.5 * grime)
    cut = np.asarray(np.exp(-np.square((edge - 0.25) / 0.22)), np.float32)
    colour = mix(colour, "dfe1e1", 0.3 * cut)
    return _opened(rng, grid, edge, colour, rough + 0.3 * grime, height, np.asarray(metal * (1 - 0.5 * grime)))


def bar_grating(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Galvanised bar grating: bearing bars 33 mm apart, cross rods every 50 mm, dark between them."""
    x, y = grid.coordinates()
    across = np.abs(repeated(y, grid.size_mm / 12)) - 2.0
    twist = repeated(x, grid.size_mm / 8)
    rod_width = 2.4 + 0.5 * np.sin(2 * np.pi * y * 48 / grid.size_mm + 0.9 * twist)
    rods = np.abs(twist) - rod_width
    edge = -np.minimum(across, rods)
    on_bar = filled(np.asarray(across, np.float32), grid)
    colour, rough, height, metal = _zinc(rng, grid)
    # Rods lie a little below the bars and are round; welds thicken where they cross.
    round_rod = np.sqrt(np.clip(1 - np.square(twist / np.maximum(rod_width, 0.5)), 0, 1))
    colour = shade(colour, np.asarray(on_bar + (1 - on_bar) * (0.42 + 0.4 * round_rod), np.float32))
    weld = np.exp(-np.square(np.maximum(across, rods).clip(0) / 1.0)) * (1 - on_bar)
    colour = mix(colour, "7b7c7a", np.asarray(0.3 * weld, np.float32))
    wear = on_bar * smoothstep(-0.6, 1.6, fractal(rng, grid, 80, 0.8, gain=0.66))
    colour = mix(colour, "c9c9c6", 0.35 * wear)
    rust = coverage(fractal(rng, grid, 45, 0.6, gain=0.74), 0.06, 0.4) * (1 - 0.6 * wear)
    colour = mix(colour, "7a4a2a", 0.65 * rust)
    crown = smoothstep(0.0, 0.9, -across)
    height = height + on_bar * 0.7 * crown + (1 - on_bar) * 1.8 * round_rod
    metal = np.asarray(metal * (1 - 0.8 * rust), np.float32)
    return _opened(rng, grid, np.asarray(edge, np.float32), colour, rough + 0.3 * rust, height, metal, deep=26.0)


def pegboard_white(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """White pegboard: painted hardboard with 6 mm holes every 25 mm, frayed brown where hooks hung."""
    x, y = grid.coordinates()
    pitch = grid.size_mm / 16
    edge = np.asarray(np.hypot(repeated(x, pitch), repeated(y, pitch)) - 3.0, np.float32)
    cloud = fractal(rng, grid, 130, 3, gain=0.6)
    peel = fractal(rng, grid, 2.6, 0.9, gain=0.6)
    colour = ramp(0.5 + 0.14 * cloud, ((0.0, "dfded9"), (1.0, "ebeae6")))
    hooked = smoothstep(-0.4, 1.6, fractal(rng, grid, 60, 8) + 0.5 * fractal(rng, grid, 3, 0.5, gain=0.8))
    around = np.asarray(np.exp(-np.maximum(edge, 0) / 0.7), np.float32)
    frayed = smoothstep(0.45, 0.75, around * (0.5 + 0.6 * hooked))
    colour = mix(colour, "b3ab9c", 0.35 * dust(rng, grid, around))
    marks = scratches(rng, grid, 90, 0.25)
    scuffs = scratches(rng, grid, 20, 1.1)
    colour = mix(mix(colour, "8f8b84", 0.32 * marks), "6a6763", 0.25 * scuffs)
    chips = coverage(fractal(rng, grid, 26, 0.7, gain=0.7) + 0.6 * around, 0.004, 0.06)
    colour = mix(colour, "80603f", np.maximum(0.75 * frayed, 0.8 * chips))
    smear = smoothstep(0.2, 2.4, fractal(rng, grid, 80, 1.0, gain=0.66))
    colour = mix(colour, "a79e8d", 0.1 * smear)
    rough = 0.45 + 0.04 * peel + 0.1 * smear + 0.35 * np.maximum(frayed, chips)
    height = 0.01 * peel - 0.3 * np.exp(-np.maximum(edge, 0) / 0.4) - 0.08 * chips - 0.01 * marks
    return _opened(rng, grid, edge, colour, np.asarray(rough), np.asarray(height), grid.zeros())


def aluminium_profile(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Anodised profiles side by side: 8 mm T-slots with dim floors every 40 mm, some closed by a cover strip."""
    pitch = grid.size_mm / 10
    _, y = grid.coordinates()
    across = repeated(y, pitch)
    bar = np.minimum((y / np.float32(pitch)).astype(np.int32), 9)
    grain = fractal(rng, grid, 2.2, 0.0, gain=0.9, stretch=(90.0, 1.0))
    cloud = fractal(rng, grid, 120, 3, gain=0.6, stretch=(2.0, 1.0))
    tone = 0.5 + 0.13 * grain + 0.06 * cloud + value_each(rng, bar, -0.12, 0.12)
    colour = ramp(np.asarray(tone, np.float32), ((0.0, "a6a9ab"), (0.5, "b8bbbc"), (1.0, "c9cbcb")))
    marks = scratches(rng, grid, 70, 0.22)
    dents = coverage(fractal(rng, grid, 14, 0.8, gain=0.8), 0.002, 0.1)
    colour = mix(mix(colour, "dfe0df", 0.45 * marks), "73767a", 0.5 * dents)
    smear = smoothstep(0.2, 2.2, fractal(rng, grid, 80, 1.0, gain=0.66))
    colour = mix(colour, "7d7a72", 0.12 * smear)
    # Each face carries two fine grooves that guide a drill, and meets its neighbour in a rounded joint.
    groove = np.exp(-np.square((np.abs(across) - 0.3 * pitch) / 0.22))
    from_joint = 0.5 * pitch - np.abs(across)
    joint = filled(np.asarray(from_joint - 0.12, np.float32), grid)
    colour = shade(colour, np.asarray(1 - 0.3 * groove, np.float32))
    near = np.asarray(np.exp(-from_joint / 1.6), np.float32)
    colour = mix(mix(colour, "5d584f", 0.4 * dust(rng, grid, near)), "17171a", 0.92 * joint)
    corner = 1.5 * (1 - np.sqrt(np.clip(1 - np.square(1 - np.clip(from_joint / 1.5, 0, 1)), 0, 1)))
    slot = np.abs(across) - 4.1
    lip = np.clip(1 - slot / 0.8, 0, 1) * (slot > 0)
    height = 0.0025 * grain - 0.12 * groove - corner - 0.35 * np.square(lip) - 0.006 * marks - 0.04 * dents
    rough = 0.36 + 0.03 * grain + 0.08 * smear + 0.08 * marks
    inner, inner_rough = _slot_floor(rng, grid, across, bar)
    opened = filled(np.asarray(slot, np.float32), grid)
    return finish(
        grid,
        mix(colour, inner, opened),
        np.asarray(rough + (inner_rough - rough) * opened, np.float32),
        np.asarray(height * (1 - opened), np.float32),
        np.asarray(1 - opened, np.float32),
    )


def _slot_floor(rng: np.random.Generator, grid: Grid, across: Field, bar: Labels) -> tuple[Field, Field]:
    """Draw the inside of the slots: a dim floor with chips and dust between dark undercuts, or a cover strip.

    Args:
        rng: Source of the randomness.
        grid: The tile.
        across: Distance from the middle of the nearest profile's slot, millimetres, shape (H, W).
        bar: Number of the profile, shape (H, W).

    Returns:
        Colour, shape (H, W, 3), and roughness, shape (H, W).
    """
    depth = smoothstep(0.6, 4.1, 4.1 - np.abs(across))
    streak = fractal(rng, grid, 3.0, 0.2, gain=0.8, stretch=(40.0, 1.0))
    floor = ramp(np.asarray(0.15 + 0.75 * depth + 0.08 * streak, np.float32), ((0.0, "0d0d0f"), (1.0, "3d4043")))
    litter = coverage(fractal(rng, grid, 9, 0.7, gain=0.85), 0.03, 0.2)
    floor = mix(floor, "6d6a62", 0.4 * litter * depth)
    covers = {2: "1f2022", 6: "34383c"}
    rough = 0.55 + 0.2 * litter
    for number, code in covers.items():
        strip = np.asarray(bar == number, np.float32) * filled(np.asarray(np.abs(across) - 3.9, np.float32), grid)
        bow = np.square(across / 4.1)
        colour = shade(plain(code, across), np.asarray(1.1 - 0.4 * bow + 0.05 * streak, np.float32))
        floor = mix(floor, mix(colour, "6f6d68", 0.25 * litter), strip)
        rough = rough + (0.45 - rough) * strip
    return floor, np.asarray(rough, np.float32)


def _zinc(rng: np.random.Generator, grid: Grid) -> tuple[Field, Field, Field, Field]:
    """Galvanised steel: colour, roughness, height in millimetres, and bare metal from 0 to 1."""
    labels = voronoi(scatter(rng, grid, 9.0, 1.0), grid)
    dx, dy = (0.8 * fractal(rng, grid, 7, 0.8, gain=0.55) for _ in range(2))
    labels = warp_labels(labels, dx, dy, grid)
    border = 1 - smoothstep(0.0, 0.5, edge_distance(labels, grid, 3.0))
    grainy = fractal(rng, grid, 5, 0.3, gain=0.75)
    tone = value_each(rng, labels, 0.25, 0.75) + 0.06 * grainy - 0.08 * border
    colour = ramp(np.asarray(tone, np.float32), ((0.0, "8b9093"), (0.5, "a3a7a9"), (1.0, "b9bcbd")))
    bloom = smoothstep(0.8, 2.4, fractal(rng, grid, 80, 0.6, gain=0.7))
    marks = scratches(rng, grid, 60, 0.22)
    colour = mix(mix(colour, "c6c7c5", 0.55 * bloom), "d8d9d9", 0.3 * marks)
    colour = mix(colour, "4c463e", 0.5 * specks(rng, grid, 0.004, 0.5))
    rough = 0.4 + 0.1 * (tone - 0.5) + 0.3 * bloom
    height = 0.012 * grainy - 0.008 * border - 0.008 * marks
    metal = 1 - 0.85 * bloom
    return colour, np.asarray(rough, np.float32), np.asarray(height, np.float32), np.asarray(metal, np.float32)


def _opened(
    rng: np.random.Generator,
    grid: Grid,
    edge: Field,
    colour: Field,
    rough: Field,
    height: Field,
    metal: Field,
    deep: float = 1.6,
) -> SurfaceMaps:
    """Cut openings into a sheet.

    Args:
        rng: Source of the randomness.
        grid: The tile.
        edge: Signed distance to the openings in millimetres, negative inside them, shape (H, W).
        colour: Colour of the sheet, shape (H, W, 3).
        rough: Roughness of the sheet, shape (H, W).
        height: Relief of the sheet in millimetres, shape (H, W).
        metal: Bare metal of the sheet, 0 to 1, shape (H, W).
        deep: Depth of the openings in millimetres: in a deeper one, light from the wall reaches further in.

    Returns:
        The maps.
    """
    below = 0.5 + 0.25 * fractal(rng, grid, 60, 4, gain=0.6) + 0.1 * fractal(rng, grid, 5, 0.6, gain=0.8)
    # The wall of an opening still catches some light; further in there is hardly any.
    wall = np.exp(edge / np.float32(0.25 * min(deep, 4.0)))
    dark = ramp(np.asarray(below, np.float32), ((0.0, "171615"), (1.0, "33302d")))
    dark = mix(dark, "58564f", np.asarray(np.clip(0.55 * wall, 0, 0.55) * (edge < 0), np.float32))
    inside = filled(edge, grid)
    flat = np.asarray(height * (1 - inside), np.float32)
    rough = rough + (0.9 - rough) * inside
    # A cavity has no sheen: as metal, it reflects no more than its dark colour does.
    metal = np.asarray(metal + (1 - metal) * inside, np.float32)
    return finish(grid, mix(colour, dark, inside), np.asarray(rough, np.float32), flat, metal)


RECIPES = (
    *(
        SurfaceRecipe(name, SurfaceFamily.METAL, 0.4, draw, version=2)
        for name, draw in (
            ("perforated_steel", perforated_steel),
            ("cable_tray", cable_tray),
            ("bar_grating", bar_grating),
            ("aluminium_profile", aluminium_profile),
        )
    ),
    SurfaceRecipe("pegboard_white", SurfaceFamily.SHEET, 0.4, pegboard_white, version=2, light=True),
)
