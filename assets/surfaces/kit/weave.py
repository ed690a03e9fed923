"""Woven cloth: two sets of threads that pass over and under each other."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from assets.surfaces.kit.grid import Field, Grid, Labels
from assets.surfaces.kit.noise import fractal


@dataclass(frozen=True)
class Weave:
    """A woven cloth drawn on a grid.

    Attributes:
        warp_on_top: True where a thread that runs along y is seen, shape (H, W).
        thread: Number of the thread seen, shape (H, W): the warp threads first, then the weft threads.
        height_mm: Relief, shape (H, W).
        fibre: Streaks that follow the threads, standard deviation near 1, shape (H, W).
        gap: 1 in a gap between the threads, 0 on a thread, shape (H, W).
        light: Brightness from the roundness of the threads, 0 in the valleys to 1 on the crowns, shape (H, W).
    """

    warp_on_top: npt.NDArray[np.bool_]
    thread: Labels
    height_mm: Field
    fibre: Field
    gap: Field
    light: Field


def weave(
    rng: np.random.Generator,
    grid: Grid,
    threads: tuple[int, int],
    pattern: npt.NDArray[np.bool_],
    *,
    fill: float = 0.95,
    slub: float = 0.08,
) -> Weave:
    """Weave a cloth.

    Args:
        rng: Source of the randomness.
        grid: The tile.
        threads: Number of threads along y (warp) and along x (weft) on the tile: multiples of the pattern's width
            and height.
        pattern: One repeat, shape (rows, columns): True where the warp passes over.
        fill: Width of a thread, as a share of the distance between two threads.
        slub: Relative unevenness of the threads' width.

    Returns:
        The cloth.
    """
    pitch_x, pitch_y = grid.size_mm / threads[0], grid.size_mm / threads[1]
    x, y = grid.coordinates()
    x = x + 0.09 * pitch_x * fractal(rng, grid, 25, 2, gain=0.6, stretch=(0.5, 2.0))
    y = y + 0.09 * pitch_y * fractal(rng, grid, 25, 2, gain=0.6, stretch=(2.0, 0.5))
    column, row = np.floor(x / pitch_x), np.floor(y / pitch_y)
    across_x, across_y = x / pitch_x - column - 0.5, y / pitch_y - row - 0.5
    warp_index = np.mod(column.astype(np.int32), threads[0])
    weft_index = np.mod(row.astype(np.int32), threads[1])
    on_top = pattern[weft_index % pattern.shape[0], warp_index % pattern.shape[1]]
    warp_half = 0.5 * fill * (1 + slub * fractal(rng, grid, 10, 1.5, gain=0.7, stretch=(0.4, 5.0)))
    weft_half = 0.5 * fill * (1 + slub * fractal(rng, grid, 10, 1.5, gain=0.7, stretch=(5.0, 0.4)))
    over_x = _float_profile(pattern, warp_index, weft_index, across_y, along_rows=True)
    over_y = _float_profile(~pattern, warp_index, weft_index, across_x, along_rows=False)
    warp_round = _round(across_x / warp_half)
    weft_round = _round(across_y / weft_half)
    warp_height = np.where(warp_round > 0, 0.25 + 0.45 * over_x * warp_round + 0.3 * warp_round, 0)
    weft_height = np.where(weft_round > 0, 0.25 + 0.45 * over_y * weft_round + 0.3 * weft_round, 0)
    # Where the thread on top is narrower than the pitch, the other one shows beside it.
    seen_warp = np.where(on_top, warp_round > 0, weft_round <= 0)
    top = np.where(seen_warp, warp_height, weft_height)
    hidden = np.where(seen_warp, on_top, ~on_top)
    top = np.where(hidden, top, 0.45 * top)
    gap = ((warp_round <= 0) & (weft_round <= 0)).astype(np.float32)
    fibres_x = fractal(rng, grid, 1.6, 0.0, gain=0.85, stretch=(7.0, 1.0))
    fibres_y = fractal(rng, grid, 1.6, 0.0, gain=0.85, stretch=(1.0, 7.0))
    fibre = np.where(seen_warp, fibres_y, fibres_x)
    pitch = 0.5 * (pitch_x + pitch_y)
    height = 0.42 * pitch * top + 0.018 * pitch * fibre
    thread = np.where(seen_warp, warp_index, threads[0] + weft_index)
    return Weave(
        seen_warp,
        thread.astype(np.int32),
        np.asarray(height, np.float32),
        np.asarray(fibre, np.float32),
        gap,
        np.asarray(np.clip(top, 0, 1), np.float32),
    )


def plain_pattern() -> npt.NDArray[np.bool_]:
    """Make the pattern of a plain weave: each thread passes over one thread, then under one."""
    return np.array([[True, False], [False, True]])


def twill_pattern(over: int, under: int) -> npt.NDArray[np.bool_]:
    """A twill: the warp passes over `over` wefts and under `under`; each row is shifted by a thread, so ribs slant."""
    repeat = over + under
    return np.array([[(column + row) % repeat < over for column in range(repeat)] for row in range(repeat)])


def basket_pattern(size: int) -> npt.NDArray[np.bool_]:
    """Make the pattern of a basket weave: groups of `size` threads pass over and under groups of `size`."""
    return np.kron(plain_pattern().astype(np.int8), np.ones((size, size), np.int8)).astype(bool)


def _round(offset: npt.NDArray[np.floating[Any]]) -> npt.NDArray[np.floating[Any]]:
    return np.sqrt(np.clip(1 - offset * offset, 0, 1))


def _float_profile(
    over: npt.NDArray[np.bool_], warp: Labels, weft: Labels, across: npt.NDArray[np.floating[Any]], along_rows: bool
) -> npt.NDArray[np.floating[Any]]:
    """Compute the height of a thread on top: 1 along a float, falling to 0 where the thread dives under another."""
    rows, columns = over.shape
    step = (1, 0) if along_rows else (0, 1)
    before = over[(weft - step[0]) % rows, (warp - step[1]) % columns]
    after = over[(weft + step[0]) % rows, (warp + step[1]) % columns]
    fall_before = np.where(before, 1.0, np.clip((across + 0.5) * 2.2, 0, 1))
    fall_after = np.where(after, 1.0, np.clip((0.5 - across) * 2.2, 0, 1))
    low = np.minimum(fall_before, fall_after)
    return np.asarray(np.sin(0.5 * np.pi * low), np.float32)
