"""Keyboards side by side: rows of caps with legends, dark gaps with dust between them."""

from dataclasses import dataclass

import numpy as np

from assets.surfaces.kit.colour import mix, plain, shade
from assets.surfaces.kit.grid import Grid
from assets.surfaces.kit.lettering import text_patch
from assets.surfaces.kit.maps import SurfaceMaps, finish
from assets.surfaces.kit.marks import scratches, specks
from assets.surfaces.kit.noise import coverage, fractal, smoothstep
from assets.surfaces.kit.pile import Block
from assets.surfaces.kit.shapes import box, filled
from assets.surfaces.kit.strokes import as_field
from assets.surfaces.recipe import SurfaceFamily, SurfaceRecipe

UNIT_MM = 19.05
"""Pitch of the keys, millimetres: the usual three quarters of an inch."""
UNITS = 20
"""Pitches of keys along the tile's edge: a row of a full keyboard, with the gap to the next keyboard."""
AROUND_MM = 6.0
"""Margin around a cap within which distances to it are drawn, millimetres: beyond, its shadow has all but faded."""
BLOCK_GAP_MM = (UNITS - 18) * UNIT_MM / 3
"""Gap between two keyboards, millimetres: three keyboards of six rows each leave two units of the tile's edge."""

# Widths of the keys in units; a negative width is a gap. Each row adds up to UNITS.
ROWS: tuple[tuple[float, ...], ...] = (
    (1, -1, 1, 1, 1, 1, -0.5, 1, 1, 1, 1, -0.5, 1, 1, 1, 1, -0.5, 1, 1, 1, -0.5, 1),
    (1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2, -0.5, 1, 1, 1, -0.5, 1),
    (1.5, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1.5, -0.5, 1, 1, 1, -0.5, 1),
    (1.75, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2.25, -4, 1),
    (2.25, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 2.75, -1.5, 1, -1.5, 1),
    (1.25, 1.25, 1.25, 6.25, 1.25, 1.25, 1.25, 1.25, -0.5, 1, 1, 1, -0.5, 1),
)
LEGENDS = (
    "Esc F1 F2 F3 F4 F5 F6 F7 F8 F9 F10 F11 F12 Print Scroll Pause M1",
    "` 1 2 3 4 5 6 7 8 9 0 - = Back Ins Home PgUp M2",
    "Tab Q W E R T Y U I O P [ ] Enter Del End PgDn M3",
    "Caps A S D F G H J K L ; ' Enter M4",
    "Shift Z X C V B N M , . / Shift ^ M5",
    "Ctrl Fn Alt _ Alt Fn Menu Ctrl < v > M6",
)
"""Legends of the keys of each row, from left to right; an underscore stands for a blank key."""


@dataclass(frozen=True)
class Style:
    """The look and shape of a keyboard's caps.

    Attributes:
        cap: Colour of the caps, hexadecimal.
        plate: Colour of the plate between the caps, hexadecimal.
        legend: Colour of the letters, hexadecimal.
        gap_mm: Gap between the feet of two caps.
        wall_mm: Distance by which a cap's side wall leans inwards.
        high_mm: Height of a cap.
        dish_mm: Height of the rim of a cap's face over its middle.
    """

    cap: str
    plate: str
    legend: str
    gap_mm: float
    wall_mm: float
    high_mm: float
    dish_mm: float


def keyboard_black(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """Black keyboard with tall hollowed caps, shiny where fingers strike them, and dust and crumbs in the gaps."""
    return _keyboard(rng, grid, Style("434447", "1a1a1b", "d3d4d2", 1.1, 2.9, 5.0, 0.5))


def keyboard_white(rng: np.random.Generator, grid: Grid) -> SurfaceMaps:
    """White flat keyboard: low caps with grey letters, shadowed gaps, and the grey that hands leave on the keys."""
    return _keyboard(rng, grid, Style("e4e4e1", "a9acad", "66686b", 2.6, 0.9, 1.8, 0.12))


def _keyboard(rng: np.random.Generator, grid: Grid, style: Style) -> SurfaceMaps:
    caps = _Caps(grid, style)
    for block in range(3):
        shift = float(rng.integers(UNITS))
        for number, (widths, legends) in enumerate(zip(ROWS, LEGENDS, strict=True)):
            names = iter(legends.split())
            y = (block * 6 + number + 0.5) * UNIT_MM + (block + 0.5) * BLOCK_GAP_MM
            start = shift
            for width in widths:
                if width > 0:
                    caps.put(rng, (start + 0.5 * width) * UNIT_MM, y, width, next(names))
                start += abs(width)
    fine = fractal(rng, grid, 1.0, 0.0, gain=0.9)
    cloud = fractal(rng, grid, 90, 1.5, gain=0.62)
    cap = shade(plain(style.cap, fine), 1 + 0.025 * fine + 0.03 * cloud)
    cap = mix(shade(cap, 0.62 + 0.38 * caps.face) * caps.tint[..., None], style.legend, 0.9 * caps.legend)
    hands = smoothstep(-0.6, 1.6, fractal(rng, grid, 50, 1.0, gain=0.66)) * caps.face
    cap = mix(cap, "8b8880", 0.12 * hands)
    marks = scratches(rng, grid, 40, 0.15)
    cap = mix(cap, "9b9b98", 0.22 * marks * caps.face)
    plate = shade(plain(style.plate, fine), 1 + 0.05 * cloud + 0.04 * fine)
    shadow = np.exp(-caps.outside_mm / 2.2)
    plate = shade(plate, np.asarray(1 - 0.7 * shadow, np.float32))
    fluff = coverage(fractal(rng, grid, 6, 0.5, gain=0.88) + 0.8 * fractal(rng, grid, 70, 6), 0.06, 0.4)
    plate = mix(plate, "8d877b", 0.32 * fluff)
    crumbs = specks(rng, grid, 0.003, 0.7)
    plate = mix(plate, "b39f7d", 0.6 * crumbs)
    colour = mix(mix(plate, cap, caps.mask), "c9c6bd", 0.5 * specks(rng, grid, 0.001, 0.4))
    rough = 0.8 + caps.mask * (0.46 + 0.03 * fine - 0.14 * caps.polish - 0.8) + 0.1 * hands
    height = caps.height_mm + (1 - caps.mask) * (0.2 * crumbs + 0.1 * fluff) + 0.006 * fine
    return finish(grid, colour, np.asarray(rough, np.float32), np.asarray(height, np.float32))


class _Caps:
    """The caps drawn so far; every field has shape (H, W).

    Attributes:
        mask: Mask of the caps, 1 on a cap.
        face: Position on a cap, from 0 at the foot of its wall to 1 on its face.
        legend: Mask of the letters, 0 to 1.
        polish: Wear by fingers, up to 1 in the middle of the keys that are struck most often.
        tint: Factor for the colour of each cap.
        height_mm: Relief.
        outside_mm: Distance from the nearest cap, 0 on a cap.
    """

    def __init__(self, grid: Grid, style: Style) -> None:
        self._grid, self._style = grid, style
        self.mask, self.face, self.legend = grid.zeros(), grid.zeros(), grid.zeros()
        self.polish, self.height_mm = grid.zeros(), grid.zeros()
        self.tint = grid.zeros() + 1
        self.outside_mm = grid.zeros() + np.float32(UNIT_MM)

    def put(self, rng: np.random.Generator, x_mm: float, y_mm: float, units: float, name: str) -> None:
        """Set a cap on the plate.

        Args:
            rng: Source of the randomness.
            x_mm: Position of the cap's middle to the right.
            y_mm: Position of the cap's middle downwards.
            units: Width of the cap, in pitches of keys.
            name: Legend of the cap; an underscore for a blank one.
        """
        style, texel = self._style, self._grid.texel_mm
        wide, high = units * UNIT_MM - style.gap_mm, UNIT_MM - style.gap_mm
        half_x, half_y = int((0.5 * wide + AROUND_MM) / texel), int((0.5 * high + AROUND_MM) / texel)
        column, row = int(x_mm / texel), int(y_mm / texel)
        rows = np.arange(row - half_y, row + half_y + 1)
        columns = np.arange(column - half_x, column + half_x + 1)
        where = np.ix_(rows % self._grid.pixels, columns % self._grid.pixels)
        u, v = np.meshgrid((columns + 0.5) * texel - x_mm, (rows + 0.5) * texel - y_mm)
        u, v = u.astype(np.float32), v.astype(np.float32)
        foot = box(u, v, wide, high, 1.2)
        inside = filled(foot, self._grid)
        # The face sits a little towards the back of the foot.
        back = v + np.float32(0.25 * style.wall_mm)
        face = -box(u, back, wide - 2 * style.wall_mm, high - 2 * style.wall_mm, 1.6)
        rise = smoothstep(-style.wall_mm, 0.15 * style.wall_mm, face)
        dish = np.square(u / (0.5 * wide)) if units < 3 else np.square(v / (0.5 * high))
        tilt = float(rng.normal(0, 0.004)) * u + float(rng.normal(0, 0.004)) * v
        top = style.high_mm * rise + style.dish_mm * dish * rise + tilt
        self.mask[where] = np.maximum(self.mask[where], inside)
        self.face[where] = np.where(foot < texel, rise, self.face[where])
        self.height_mm[where] = np.where(foot < 0, top, self.height_mm[where])
        self.outside_mm[where] = np.minimum(self.outside_mm[where], np.maximum(foot, 0))
        self.tint[where] = np.where(foot < texel, np.float32(1 + 0.02 * rng.standard_normal()), self.tint[where])
        struck = float(rng.random()) * np.exp(-np.square(np.hypot(u, back) / 5.5))
        self.polish[where] = np.maximum(self.polish[where], np.asarray(struck, np.float32) * rise)
        if name != "_":
            self._letter(rng, where, u.shape, name)

    def _letter(self, rng: np.random.Generator, where: Block, shape: tuple[int, ...], name: str) -> None:
        """Print a cap's legend towards the back left of its face, rubbed off to a random degree."""
        patch = as_field(text_patch(name, 3.0 if len(name) == 1 else 1.7, self._grid, 0.15))
        inset = self._style.wall_mm + AROUND_MM
        top, left = int((inset + 0.8) / self._grid.texel_mm), int((inset + 1.8) / self._grid.texel_mm)
        sheet = np.zeros(shape, np.float32)
        room = sheet[top : top + patch.shape[0], left : left + patch.shape[1]]
        room[:] = patch[: room.shape[0], : room.shape[1]] * float(rng.uniform(0.65, 1.0))
        self.legend[where] = np.maximum(self.legend[where], sheet)


RECIPES = tuple(
    SurfaceRecipe(name, SurfaceFamily.ELECTRONICS, UNITS * UNIT_MM / 1000, draw)
    for name, draw in (
        ("keyboard_black", keyboard_black),
        ("keyboard_white", keyboard_white),
    )
)
