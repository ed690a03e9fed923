"""Stains, scratches and dust on a floor, and what fills its joints, in its own metres. Numpy and OpenCV.

They lie about the origin, so they have the same size whatever the texture's texels and scale are, and do not repeat
with its tiles.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from farm.scene.floor import JointFill, Wear
from worker.noise import Field, rough_noise, smooth_step

EDGE_M = 0.6
"""Of the square about the origin in which marks are drawn; beyond it they are mirrored."""

CELL_M = 1.25e-3
"""Of the grid on which stains and dust are drawn. They are smooth there; their edges are found at the texels."""

CELLS = round(EDGE_M / CELL_M)

STAIN_RADII_M = (0.003, 0.022)
MOST_STAINS = 1000
SCRATCH_LENGTHS_M = (0.004, 0.07)
SCRATCH_WIDTHS_M = (0.1e-3, 0.4e-3)


@dataclass(frozen=True, slots=True)
class Marks:
    """How far a texel is under each mark, (H, W) each; None: there are none of them.

    Attributes:
        stain: 0 to 1, how much of its light is missing, in parts of the most that may.
        scratch: -1 to 1: dark or bright.
        dust: 0 to 1.
        joint: 0 to 1, how far what fills a joint hides what was there.
    """

    stain: Field | None
    scratch: Field | None
    dust: Field | None
    joint: Field | None = None

    @property
    def any(self) -> bool:
        """Whether there are any."""
        return not (self.stain is None and self.scratch is None and self.dust is None and self.joint is None)


def marks_on(
    wear: Wear, rows: int, columns: int, to_floor: NDArray[np.float64], to_joint_m: Field | None = None
) -> Marks:
    """The marks on a window of a texture.

    Args:
        wear: of the floor.
        rows: of the window's texels.
        columns: of them.
        to_floor: (2, 3), what takes a texel's column and row to metres on the floor.
        to_joint_m: (rows, columns), how far texels are from the edges of joints, negative inside; None without any.
    """
    stain, scratch, dust, joint = (np.random.default_rng((wear.pattern_seed, kind)) for kind in range(4))
    window = _Window(rows, columns, to_floor)
    return Marks(
        stain=_stains(wear.stains, stain, window) if wear.stains > 0 else None,
        scratch=_scratches(wear.scratches, scratch, window) if wear.scratches > 0 else None,
        dust=_dust(wear.dust, dust, window) if wear.dust > 0 else None,
        joint=None if wear.joints is None or to_joint_m is None else _filled(wear.joints, to_joint_m, joint, window),
    )


def sized(marks: Marks, rows: int, columns: int) -> Marks:
    """The same marks on maps of another size."""

    def fit(field: Field | None) -> Field | None:
        if field is None or field.shape == (rows, columns):
            return field
        fitted: Field = cv2.resize(field, (columns, rows), interpolation=cv2.INTER_AREA).astype(np.float32, copy=False)
        return fitted

    return Marks(stain=fit(marks.stain), scratch=fit(marks.scratch), dust=fit(marks.dust), joint=fit(marks.joint))


@dataclass(frozen=True, slots=True)
class _Window:
    rows: int
    columns: int
    to_floor: NDArray[np.float64]

    def look_up(self, grid: Field) -> Field:
        """A grid (CELLS, CELLS) at the texels."""
        to_grid = self.to_floor / CELL_M
        to_grid[:, 2] += CELLS / 2 - 0.5
        flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
        size = (self.columns, self.rows)
        seen = cv2.warpAffine(grid, to_grid, size, flags=flags, borderMode=cv2.BORDER_REFLECT)
        return seen.astype(np.float32, copy=False)

    def texels_of(self, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """Columns and rows (N, 2) of points (N, 2) of the floor."""
        back = np.linalg.inv(self.to_floor[:, :2])
        texels: NDArray[np.float64] = np.einsum("ij,nj->ni", back, points_m - self.to_floor[:, 2])
        return texels

    @property
    def texels_per_m(self) -> float:
        return float(1 / np.sqrt(abs(np.linalg.det(self.to_floor[:, :2]))))


def _stains(share: float, rng: np.random.Generator, window: _Window) -> Field:
    """Dried puddles: paler in the middle, where they dried last, than at the rim."""
    depth, strength = stain_grids(share, rng)
    depth_here = window.look_up(depth)
    # Most of the floor is dry, so the rest is done where it is not.
    wet = np.flatnonzero(depth_here > -1e-3)
    grain = _grain(window).ravel()[wet]
    # Wobbled by half a millimetre, so that the rim is not drawn with a compass.
    deep = depth_here.ravel()[wet] + np.float32(0.25e-3) * grain
    rim = np.exp(-np.square((deep - np.float32(0.7e-3)) * np.float32(1 / 0.8e-3)))
    stain = np.zeros(depth_here.size, np.float32)
    stain[wet] = window.look_up(strength).ravel()[wet] * smooth_step(deep, -0.2e-3, 0.25e-3)
    stain[wet] *= 0.42 + 0.5 * rim + 0.05 * grain
    return np.clip(stain, 0, 1).reshape(depth_here.shape)


def stain_grids(share: float, rng: np.random.Generator) -> tuple[Field, Field]:
    """Puddles until they cover a share of the square: how deep in one each cell is, metres, and how strong it is.

    Args:
        share: of the square.
        rng: draws places, sizes and outlines.

    Returns:
        (CELLS, CELLS) each; the first is negative outside, -1 far away.
    """
    depth = np.full((CELLS, CELLS), -1.0, np.float32)
    strength = np.zeros((CELLS, CELLS), np.float32)
    low, high = np.log(STAIN_RADII_M)
    wanted = round(share * depth.size)
    for _ in range(MOST_STAINS):
        if wanted <= 0:
            break
        # The last puddles are small, so that the share is met and not passed.
        radius = min(float(np.exp(rng.uniform(low, high))), CELL_M * (float(np.sqrt(wanted / np.pi)) + 1))
        wanted -= _spill(depth, strength, radius, rng)
    return depth, cv2.GaussianBlur(strength, (0, 0), 1.5).astype(np.float32, copy=False)


def _spill(depth: Field, strength: Field, radius_m: float, rng: np.random.Generator) -> int:
    """One puddle with an uneven outline, and some drops beside it, in place; returns how many cells got wet."""
    middle = rng.uniform(0, CELLS, 2)
    weight = float(rng.uniform(0.5, 1.0))
    waves = rng.normal(0, 1, (2, 6)) * (0.16 / np.arange(1, 7))
    angle = np.arange(1, 7)[:, None] * np.linspace(-np.pi, np.pi, 65)
    outline = np.maximum(1 + waves[0] @ np.cos(angle) + waves[1] @ np.sin(angle), 0.35)
    wet = _wet(depth, strength, middle, radius_m * outline, weight)
    for _ in range(int(rng.poisson(1.0))):
        away = radius_m * float(rng.uniform(1.1, 1.9)) / CELL_M
        bearing = float(rng.uniform(0, 2 * np.pi))
        place = middle + away * np.array([np.cos(bearing), np.sin(bearing)])
        wet += _wet(depth, strength, place, radius_m * float(rng.uniform(0.08, 0.2)) * np.sqrt(outline), weight)
    return wet


def _wet(
    depth: Field, strength: Field, middle: NDArray[np.float64], outline_m: NDArray[np.float64], weight: float
) -> int:
    """Wet the cells within an outline, radii (65,) at bearings from -pi to pi, in place; returns how many were dry."""
    reach = int(outline_m.max() / CELL_M) + 4
    (top, bottom), (left, right) = ((max(0, int(at) - reach), min(CELLS, int(at) + reach)) for at in middle[::-1])
    if top >= bottom or left >= right:
        return 0
    down = (np.arange(top, bottom)[:, None] - middle[1]) * CELL_M
    across = (np.arange(left, right)[None] - middle[0]) * CELL_M
    edge = np.interp(np.arctan2(down, across), np.linspace(-np.pi, np.pi, len(outline_m)), outline_m)
    here = (edge - np.hypot(down, across)).astype(np.float32)
    part = (slice(top, bottom), slice(left, right))
    strength[part] = np.where(here > -3 * CELL_M, np.maximum(strength[part], weight), strength[part])
    dry = np.count_nonzero((depth[part] <= 0) & (here > 0))
    depth[part] = np.maximum(depth[part], here)
    return dry


def _scratches(density: float, rng: np.random.Generator, window: _Window) -> Field:
    """Fine lines, some of them in sheaves, fading at their ends."""
    bright, dark = (np.zeros((window.rows, window.columns), np.uint8) for _ in range(2))
    for points_m, width_m, strength in scratch_lines(density, rng):
        points = window.texels_of(points_m)
        if (points.max(axis=0) < 0).any() or (points.min(axis=0) > [window.columns, window.rows]).any():
            continue
        width = width_m * window.texels_per_m
        level = round(255 * abs(strength) * min(1.0, max(width, 0.25)))
        place = np.rint(points * 16).astype(np.int32)
        canvas = bright if strength > 0 else dark
        count = len(place)
        for start, end, share in ((0, count, 0.4), (count // 6, count - count // 6, 1.0)):
            cv2.polylines(canvas, [place[start:end]], False, (level * share,), max(1, round(width)), cv2.LINE_AA, 4)
    both = bright.astype(np.float32) - dark
    drawn = np.flatnonzero(both)
    worn = np.zeros(both.size, np.float32)
    grain = np.clip(_grain(window).ravel()[drawn], -1.5, 1.5)
    worn[drawn] = np.clip(both.ravel()[drawn] / 255 * (0.75 + 0.25 * grain), -1, 1)
    return worn.reshape(both.shape)


def scratch_lines(density: float, rng: np.random.Generator) -> Iterator[tuple[NDArray[np.float64], float, float]]:
    """The scratches of the square: points (13, 2), width, both in metres, and strength, -1 dark to 1 bright.

    Args:
        density: of them, a square decimetre.
        rng: draws them.
    """
    left = round(density * EDGE_M**2 / 1e-2)
    low, high = np.log(SCRATCH_LENGTHS_M)
    t = np.linspace(-0.5, 0.5, 13)
    while left > 0:
        sheaf = min(left, int(rng.geometric(0.6)) if rng.random() < 0.8 else int(rng.integers(3, 9)))

        left -= sheaf
        length = float(np.exp(rng.uniform(low, high)))
        bearing, bend = float(rng.uniform(0, np.pi)), float(rng.normal(0, 0.25))
        middle = rng.uniform(-EDGE_M / 2, EDGE_M / 2, 2)
        bright = rng.random() < 0.6
        for _ in range(sheaf):
            turn = bearing + float(rng.normal(0, 0.06)) + bend * t
            long = length * float(rng.uniform(0.5, 1.2))
            points = middle + rng.normal(0, 0.0025, 2) * (sheaf > 1)
            points = points + (long * t)[:, None] * np.stack([np.cos(turn), np.sin(turn)], axis=1)
            width = float(rng.uniform(*SCRATCH_WIDTHS_M)) * float(rng.uniform(0.4, 1))
            strength = float(rng.uniform(0.4, 1.0))
            yield points, width, strength if bright else -strength


def _dust(share: float, rng: np.random.Generator, window: _Window) -> Field:
    """A film with soft edges, thicker in its middle, of visible grains and some fibres."""
    film = rough_noise(rng, CELLS, CELLS, 60.0, 5)
    start = float(np.quantile(film[::4, ::4], 1 - share))
    here = smooth_step(window.look_up(film), start - 0.35, start + 0.9)
    dust: Field = here * np.clip(0.62 + 0.3 * _grain(window), 0, 1)
    return dust


def _filled(fill: JointFill, to_joint_m: Field, rng: np.random.Generator, window: _Window) -> Field:
    """What fills joints: its edge wanders a little, it is grainy, and in places it is thin."""
    patches = window.look_up(rough_noise(rng, CELLS, CELLS, 40.0, 4))
    grain = _grain(window)
    edge_m = to_joint_m - np.float32(fill.spread_m) * (1 + 0.4 * np.clip(patches, -2, 2)) - np.float32(0.04e-3) * grain
    # Soft over a texel at least, or edges of joints show its steps.
    soft_m = max(0.12e-3, 0.6 / window.texels_per_m)
    filled: Field = np.float32(fill.cover) * smooth_step(-edge_m, -soft_m, soft_m)
    filled *= (0.55 + 0.45 * smooth_step(patches, -1.6, 0.4)) * np.clip(0.84 + 0.16 * grain, 0, 1)
    return filled


def _grain(window: _Window) -> Field:
    """Noise of the size of a fifth of a millimetre, but never finer than texels; the same for every floor."""
    tile = _grain_tile()
    texels = max(1.0, 0.2e-3 * window.texels_per_m)
    edge = round(len(tile) * texels)
    grown = tile if edge == len(tile) else cv2.resize(tile, (edge, edge), interpolation=cv2.INTER_LINEAR)
    repeats = (-(-window.rows // edge), -(-window.columns // edge))
    grain = np.tile(grown, repeats)[: window.rows, : window.columns]
    return grain.astype(np.float32, copy=False)


@lru_cache(maxsize=1)
def _grain_tile() -> Field:
    noise = np.random.default_rng(0).standard_normal((509, 509)).astype(np.float32)
    tile: Field = 0.7 * noise + 2.0 * cv2.GaussianBlur(noise, (0, 0), 1.5)
    tile.setflags(write=False)
    return tile
