"""Draws stains, scratches and dust on a floor, and the filling of its joints, in metres. Numpy and OpenCV.

Marks lie in a square about the origin of the floor. Their size does not depend on the texture's texels and scale, and
they do not repeat with its tiles.
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
"""Edge of the square about the origin in which marks lie, in metres; beyond it, stains and dust are mirrored."""

CELL_M = 1.25e-3
"""Edge of a cell of the grid on which stains and dust are drawn, in metres; the texels give them their sharp edges."""

CELLS = round(EDGE_M / CELL_M)
"""Number of cells along an edge of the square."""

STAIN_RADII_M = (0.003, 0.022)
"""Range of a puddle's radius, in metres, sampled log-uniformly."""

MOST_STAINS = 1000
"""Number of puddles after which no more are added, though they cover less than they should."""

SCRATCH_LENGTHS_M = (0.004, 0.07)
"""Range of a scratch's length, in metres, sampled log-uniformly."""

SCRATCH_WIDTHS_M = (0.1e-3, 0.4e-3)
"""Range of a scratch's greatest width, in metres; each scratch has 0.4 to 1 of it."""


@dataclass(frozen=True, slots=True)
class Marks:
    """The strength of each kind of mark at each texel, (H, W); None if the window has no mark of that kind.

    Attributes:
        stain: 0 to 1, darkening by stains, as a share of the strongest.
        scratch: -1, dark, to 1, bright.
        dust: 0 to 1, density of the dust.
        joint: 0 to 1, share of the texture's colour that a joint's filling hides.
    """

    stain: Field | None
    scratch: Field | None
    dust: Field | None
    joint: Field | None = None

    @property
    def any(self) -> bool:
        """Whether there is a mark of any kind."""
        return not (self.stain is None and self.scratch is None and self.dust is None and self.joint is None)


def marks_on(
    wear: Wear, rows: int, columns: int, to_floor: NDArray[np.float64], to_joint_m: Field | None = None
) -> Marks:
    """Draw the marks on a window of a texture.

    Args:
        wear: wear of the floor.
        rows: number of rows of the window's texels.
        columns: number of columns of the window's texels.
        to_floor: (2, 3), affine map from a texel's column and row to metres on the floor.
        to_joint_m: (rows, columns) metres, distance of each texel from the edge of a joint, negative inside; None if
            the texture has no joints.
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
    """Resample marks for maps of another size, `rows` by `columns` texels."""

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
        """Interpolate a grid (CELLS, CELLS) at the texels, (rows, columns)."""
        to_grid = self.to_floor / CELL_M
        to_grid[:, 2] += CELLS / 2 - 0.5
        flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
        size = (self.columns, self.rows)
        seen = cv2.warpAffine(grid, to_grid, size, flags=flags, borderMode=cv2.BORDER_REFLECT)
        return seen.astype(np.float32, copy=False)

    def texels_of(self, points_m: NDArray[np.float64]) -> NDArray[np.float64]:
        """Compute the columns and rows (N, 2) of points (N, 2) on the floor, in metres."""
        back = np.linalg.inv(self.to_floor[:, :2])
        texels: NDArray[np.float64] = np.einsum("ij,nj->ni", back, points_m - self.to_floor[:, 2])
        return texels

    @property
    def texels_per_m(self) -> float:
        return float(1 / np.sqrt(abs(np.linalg.det(self.to_floor[:, :2]))))


def _stains(share: float, rng: np.random.Generator, window: _Window) -> Field:
    """Draw dried puddles, (rows, columns), which are paler in the middle, where they dried last, than at the rim."""
    depth, strength = stain_grids(share, rng)
    depth_here = window.look_up(depth)
    # Most of the floor is dry, so only the wet texels are worked on.
    wet = np.flatnonzero(depth_here > -1e-3)
    grain = _grain(window).ravel()[wet]
    # Noise of about half a millimetre makes the rim uneven.
    deep = depth_here.ravel()[wet] + np.float32(0.25e-3) * grain
    rim = np.exp(-np.square((deep - np.float32(0.7e-3)) * np.float32(1 / 0.8e-3)))
    stain = np.zeros(depth_here.size, np.float32)
    stain[wet] = window.look_up(strength).ravel()[wet] * smooth_step(deep, -0.2e-3, 0.25e-3)
    stain[wet] *= 0.42 + 0.5 * rim + 0.05 * grain
    return np.clip(stain, 0, 1).reshape(depth_here.shape)


def stain_grids(share: float, rng: np.random.Generator) -> tuple[Field, Field]:
    """Sample puddles until they cover a share of the square.

    Args:
        share: share of the square that puddles cover, 0 to 1.
        rng: random generator of the stains.

    Returns:
        Two grids (CELLS, CELLS): the distance of each cell from a puddle's edge, in metres, above 0 inside and -1 far
        outside; and the strength of the stain, 0 to 1.
    """
    depth = np.full((CELLS, CELLS), -1.0, np.float32)
    strength = np.zeros((CELLS, CELLS), np.float32)
    low, high = np.log(STAIN_RADII_M)
    wanted = round(share * depth.size)
    for _ in range(MOST_STAINS):
        if wanted <= 0:
            break
        # The last puddles are small, so that the share is reached without being exceeded by much.
        radius = min(float(np.exp(rng.uniform(low, high))), CELL_M * (float(np.sqrt(wanted / np.pi)) + 1))
        wanted -= _spill(depth, strength, radius, rng)
    return depth, cv2.GaussianBlur(strength, (0, 0), 1.5).astype(np.float32, copy=False)


def _spill(depth: Field, strength: Field, radius_m: float, rng: np.random.Generator) -> int:
    """Add one puddle with an uneven outline, and some drops beside it, in place; return the number of cells wetted."""
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
    """Wet the cells within an outline, in place.

    Args:
        depth: (CELLS, CELLS) metres, distance of each cell from a puddle's edge, above 0 inside.
        strength: (CELLS, CELLS), strength of the stain.
        middle: (2,), column and row of the outline's middle.
        outline_m: (65,) metres, radius of the outline at bearings from -pi to pi.
        weight: strength of this stain, 0 to 1.

    Returns:
        The number of cells that were dry before.
    """
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
    """Draw fine lines, (rows, columns), some of them in sheaves, which fade at their ends."""
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
    """Sample the scratches of the square.

    Args:
        density: number of scratches in a square decimetre.
        rng: random generator of the scratches.

    Yields:
        For each scratch its points (13, 2) and its width, both in metres, and its strength, from -1, dark, to 1,
        bright.
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
    """Draw a film of dust, (rows, columns), with visible grains and soft edges, thicker in its middle."""
    film = rough_noise(rng, CELLS, CELLS, 60.0, 5)
    start = float(np.quantile(film[::4, ::4], 1 - share))
    here = smooth_step(window.look_up(film), start - 0.35, start + 0.9)
    dust: Field = here * np.clip(0.62 + 0.3 * _grain(window), 0, 1)
    return dust


def _filled(fill: JointFill, to_joint_m: Field, rng: np.random.Generator, window: _Window) -> Field:
    """Draw the filling of joints, (rows, columns), which has an uneven edge and grains, and is thin in places."""
    patches = window.look_up(rough_noise(rng, CELLS, CELLS, 40.0, 4))
    grain = _grain(window)
    edge_m = to_joint_m - np.float32(fill.spread_m) * (1 + 0.4 * np.clip(patches, -2, 2)) - np.float32(0.04e-3) * grain
    # The edge is soft over a texel at least, else it would show the texels' steps.
    soft_m = max(0.12e-3, 0.6 / window.texels_per_m)
    filled: Field = np.float32(fill.cover) * smooth_step(-edge_m, -soft_m, soft_m)
    filled *= (0.55 + 0.45 * smooth_step(patches, -1.6, 0.4)) * np.clip(0.84 + 0.16 * grain, 0, 1)
    return filled


def _grain(window: _Window) -> Field:
    """Make noise (rows, columns), the same for every floor, with grains of 0.2 mm, or of a texel if that is larger."""
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
