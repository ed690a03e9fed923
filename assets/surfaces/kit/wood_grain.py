"""Wood: growth rings cut lengthwise, fibres, pores and knots, drawn in the coordinates of each board."""

from dataclasses import dataclass

import numpy as np

from assets.surfaces.kit.colour import mix, ramp
from assets.surfaces.kit.grid import Field, Grid
from assets.surfaces.kit.layouts import Layout
from assets.surfaces.kit.noise import fractal, sample, smoothstep


@dataclass(frozen=True)
class Species:
    """The look of a kind of wood.

    Attributes:
        stops: Ramp from early wood (0) to late wood (1), hexadecimal sRGB.
        pore: Colour of the pores and of the darkest fibres.
        ring_mm: Width of a growth ring across the grain.
        ring_contrast: 0 hides the rings, 1 shows them fully.
        fibre_contrast: Strength of the fine streaks along the grain.
        pore_share: Share of the area that pores cover.
        pore_mm: Length of a pore.
        figure: Distance by which the rings wander, millimetres: small is quarter-sawn, large is flat-sawn.
        knots: Mean number of knots per board.
    """

    stops: tuple[tuple[float, str], ...]
    pore: str
    ring_mm: float = 3.0
    ring_contrast: float = 0.8
    fibre_contrast: float = 0.25
    pore_share: float = 0.06
    pore_mm: float = 7.0
    figure: float = 14.0
    knots: float = 0.0


@dataclass(frozen=True)
class Grain:
    """Wood drawn over a layout.

    Attributes:
        colour: Shape (H, W, 3), sRGB 0 to 1.
        relief: Height in units of the grain's own depth, about -1 in pores to 1 on late wood, shape (H, W).
        late: Late wood, 0 to 1, shape (H, W).
    """

    colour: Field
    relief: Field
    late: Field


def grain(rng: np.random.Generator, grid: Grid, layout: Layout, species: Species) -> Grain:
    """Draw wood over a layout; every board is cut from its own place in the wood.

    Args:
        rng: Source of the randomness.
        grid: The tile.
        layout: The boards.
        species: The wood.

    Returns:
        Colour and relief of the wood, without joints, dirt or varnish.
    """
    count = int(layout.labels.max()) + 1
    wander = np.stack(
        [
            fractal(rng, grid, 120, 8, gain=0.42, stretch=(3.2, 1.0)),
            fractal(rng, grid, 130, 24, gain=0.38, stretch=(3.0, 1.2)),
        ],
        axis=-1,
    )
    fibres = np.stack(
        [
            fractal(rng, grid, 5.0, 0.0, gain=0.8, stretch=(30.0, 1.0)),
            _pores(rng, grid, species),
            fractal(rng, grid, 24.0, 2.0, gain=0.75, stretch=(12.0, 1.0)),
            fractal(rng, grid, 1.1, 0.0, gain=0.9, stretch=(9.0, 1.0)),
        ],
        axis=-1,
    )
    offset_u = rng.uniform(0, grid.size_mm, count).astype(np.float32)[layout.labels]
    offset_v = rng.uniform(0, grid.size_mm, count).astype(np.float32)[layout.labels]
    wander = sample(wander, layout.u_mm + offset_u, layout.v_mm + offset_v, grid)
    fibres = sample(fibres, layout.u_mm + offset_u, layout.v_mm + offset_v, grid)
    swell, knot = _knots(rng, grid, layout, species)
    radius = _radius(rng, layout, wander, species)
    late = _rings(rng, radius + swell + 0.13 * species.ring_mm * fibres[..., 0], species.ring_mm)
    tone = species.ring_contrast * (late - 0.35) + 0.42
    tone += species.fibre_contrast * (0.4 * fibres[..., 0] + 0.6 * fibres[..., 2] + 0.3 * fibres[..., 3])
    tone = np.maximum(tone, 0.25 * knot + tone)
    colour = ramp(tone.astype(np.float32), species.stops)
    # Open-grained woods have their pores in the early wood.
    pores = fibres[..., 1] * (1.0 - 0.55 * late) * (1 - knot)
    colour = mix(colour, species.pore, np.clip(0.75 * pores, 0, 1))
    colour = mix(colour, species.pore, 0.62 * knot)
    return Grain(colour, (0.5 * late - pores + 0.15 * fibres[..., 0]).astype(np.float32), late)


def _radius(rng: np.random.Generator, layout: Layout, wander: Field, species: Species) -> Field:
    """Distance from the tree's pith to each texel, mm: a board is a plane that passes the pith at some depth."""
    count = int(layout.labels.max()) + 1
    depth = rng.uniform(0.6, 3.2, count).astype(np.float32) * species.figure
    centre = rng.uniform(-1.0, 1.0, count) * 42.0
    across = layout.v_mm - centre.astype(np.float32)[layout.labels] + 2.2 * wander[..., 0]
    below = depth[layout.labels] + species.figure * wander[..., 1]
    return np.asarray(np.sqrt(across * across + below * below + 4.0), np.float32)


def _rings(rng: np.random.Generator, radius: Field, ring_mm: float) -> Field:
    """Late wood, 0 to 1: it builds up slowly through a ring, then ends sharply; rings differ in width."""
    years = np.cumsum(rng.lognormal(0.0, 0.32, 400)) * ring_mm * 0.95
    strength = rng.uniform(0.5, 1.0, 401).astype(np.float32)
    table_step = 0.02 * ring_mm
    positions = np.arange(0.0, years[-2], table_step)
    year = np.searchsorted(years, positions)
    start = np.concatenate([[0.0], years])[year]
    phase = (positions - start) / (years[year] - start)
    profile = smoothstep(0.25, 0.92, phase) * (1 - smoothstep(0.84, 1.0, phase)) * strength[year]
    place = np.clip(radius / np.float32(table_step), 0, len(profile) - 2)
    index = place.astype(np.int32)
    table = profile.astype(np.float32)
    # Interpolate between two entries: the nearest entry would show as steps where the cut meets rings at a low angle.
    return np.asarray(table[index] + (place - index) * (table[index + 1] - table[index]), np.float32)


def _pores(rng: np.random.Generator, grid: Grid, species: Species) -> Field:
    """Pores: short thin streaks along the grain, 0 to 1."""
    if species.pore_share <= 0:
        return grid.zeros()
    field = fractal(rng, grid, 0.9, 0.34, gain=0.9, stretch=(species.pore_mm / 0.6, 1.0))
    level = float(np.quantile(field[::4, ::4], 1.0 - species.pore_share))
    return smoothstep(level - 0.1, level + 0.7, field)


def _knots(rng: np.random.Generator, grid: Grid, layout: Layout, species: Species) -> tuple[Field, Field]:
    """Knots: the swelling of the rings around them, millimetres, and the mask of the knots, 0 to 1."""
    swell, inside = grid.zeros(), grid.zeros()
    if species.knots <= 0:
        return swell, inside
    rough = fractal(rng, grid, 12, 1.0, gain=0.6)
    for board in range(int(layout.labels.max()) + 1):
        rows, columns = np.nonzero(layout.labels == board)
        for _ in range(int(rng.poisson(species.knots))):
            chosen = int(rng.integers(len(rows)))
            centre_u = layout.u_mm[rows[chosen], columns[chosen]]
            centre_v = layout.v_mm[rows[chosen], columns[chosen]]
            radius = float(rng.uniform(3.0, 8.5))
            u = layout.u_mm[rows, columns] - centre_u
            # A board without a joint runs on over the tile's edge.
            u -= np.rint(u / grid.size_mm) * grid.size_mm
            v = layout.v_mm[rows, columns] - centre_v
            swell[rows, columns] += 2.6 * radius * np.exp(-((u / (4.0 * radius)) ** 2) - (v / (1.7 * radius)) ** 2)
            distance = np.sqrt((u / 1.35) ** 2 + v**2) + 0.35 * rough[rows, columns]
            year_marks = 0.8 + 0.14 * np.sin(distance * 5.2)
            disc = (1 - smoothstep(0.82 * radius, 1.0 * radius, distance)) * year_marks
            rim = np.exp(-(((distance - radius) / 0.7) ** 2))
            inside[rows, columns] = np.maximum(inside[rows, columns], np.maximum(disc, 0.95 * rim))
    return swell, inside
