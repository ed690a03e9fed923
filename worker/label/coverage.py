"""Finds the polygon of a pile that covers most of each pixel, by scanlines cut where polygons begin or end. Pure numpy.

Along a scanline coverage is exact to 1/256 pixel. Everything is counted in whole numbers, so that neither the order of
equal numbers nor the processor's vector width decides anything.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

SCANLINES = 5
"""Scanlines of a pixel. The number is odd, so that the middle one tells, exactly as the area does, on which side of a
straight edge more of the pixel lies; more than five change nothing but the time."""

STEPS = 256
"""Places across a pixel where a scanline may be cut."""

_FULL = SCANLINES * STEPS
"""Steps of a pixel that is wholly covered."""

Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class _Stretches:
    """Pieces of scanlines, each with the number of the thing that covers it.

    Attributes:
        rows: (N,) scanlines, counted from the top.
        starts: (N,) steps from the left edge of the picture to the piece's start.
        ends: (N,) steps from the left edge of the picture to the piece's end, after its start.
        numbers: (N,) numbers of the things, 0 for one that only hides others.
    """

    rows: Ints
    starts: Ints
    ends: Ints
    numbers: Ints


def cover(quads_px: NDArray[np.float64], numbers: Ints, rows: int, width: int) -> NDArray[np.uint16]:
    """Find the thing that covers most of each pixel.

    Args:
        quads_px: (N, 4, 2) corners x, y of convex quads in order around each; a later quad hides an earlier one.
        numbers: (N,) number of the thing that each quad is a part of, 1 to 65,535; or 0 for a quad that hides
            things and belongs to none.
        rows: height of the picture, pixels; its top left corner is (0, 0).
        width: width of the picture, pixels.

    Returns:
        (rows, width): the number of the thing that covers most of a pixel, 0 where the visible parts of all things
        together cover less than half. Of two that cover the same, the lower number.
    """
    seen = _uppermost(_scan(quads_px, numbers, rows, width), width)
    pixels, shares, stretch = _by_pixel(seen, width)
    covered = 2 * np.bincount(pixels, weights=shares, minlength=rows * width) >= _FULL
    winners = np.zeros(rows * width, np.uint16)
    winners[covered] = _winners(covered, pixels, shares, seen.numbers[stretch])
    return winners.reshape(rows, width)


def covered_share(quads_px: NDArray[np.float64], rows: int, width: int) -> NDArray[np.float32]:
    """Find how much of each pixel is covered; see `cover`.

    Returns:
        (rows, width), 0 to 1.
    """
    together = np.ones(len(quads_px), np.int64)
    pixels, shares, _ = _by_pixel(_uppermost(_scan(quads_px, together, rows, width), width), width)
    steps = np.bincount(pixels, weights=shares, minlength=rows * width)
    return (steps / _FULL).astype(np.float32).reshape(rows, width)


def _scan(quads_px: NDArray[np.float64], numbers: Ints, rows: int, width: int) -> _Stretches:
    """Cut the quads along the scanlines into stretches, in the order of the quads, hidden parts included."""
    x, y = quads_px[:, :, 0] * STEPS, quads_px[:, :, 1] * SCANLINES - 0.5
    first, last = (
        np.clip(np.ceil(edge), 0, rows * SCANLINES).astype(np.int64) for edge in (y.min(axis=1), y.max(axis=1))
    )
    beside = (x.max(axis=1) <= 0) | (x.min(axis=1) >= width * STEPS)
    counts = np.where(beside, 0, last - first)
    quad = np.repeat(np.arange(len(counts)), counts)
    rows_down = _count_up(first, counts)
    row = rows_down.astype(np.float64)
    start, end = np.full(len(row), np.inf), np.full(len(row), -np.inf)
    for corner in range(4):
        x0, y0, x1, y1 = x[:, corner - 1], y[:, corner - 1], x[:, corner], y[:, corner]
        slope = (x1 - x0) / np.where(y1 == y0, 1.0, y1 - y0)
        crossed = (row >= np.minimum(y0, y1)[quad]) & (row < np.maximum(y0, y1)[quad])
        crossing = (x0 - slope * y0)[quad] + slope[quad] * row
        start = np.where(crossed, np.minimum(start, crossing), start)
        end = np.where(crossed, np.maximum(end, crossing), end)
    starts, ends = (np.clip(np.rint(edge), 0, width * STEPS).astype(np.int64) for edge in (start, end))
    kept = ends > starts
    return _Stretches(rows=rows_down[kept], starts=starts[kept], ends=ends[kept], numbers=numbers[quad[kept]])


def _uppermost(stretches: _Stretches, width: int) -> _Stretches:
    """Cut the hidden parts away from stretches, of which a later one hides an earlier one; the rest overlaps nowhere.

    Stretches of number 0 hide those beneath them and are left out themselves, as if nothing were there.
    """
    # The scanlines one after the other make one long line; a step between them keeps them apart.
    line = width * STEPS + 1
    offset = stretches.rows * line
    count = len(offset)
    cuts = np.concatenate([offset + stretches.starts, offset + stretches.ends])
    order = np.argsort(cuts)
    cuts, rank = cuts[order], np.empty(2 * count, np.int64)
    rank[order] = np.arange(2 * count)
    pieces = rank[count:] - rank[:count]
    # Between neighbouring cuts there is one uppermost stretch: of repeated indices, numpy keeps the last value.
    owner = np.zeros(2 * count, np.int64)
    owner[_count_up(rank[:count], pieces)] = np.repeat(stretches.numbers, pieces)
    changes = np.flatnonzero(np.diff(owner, prepend=0))
    number, start, end = owner[changes], cuts[changes], np.append(cuts[changes[1:]], cuts[-1:])[: len(changes)]
    kept = (number > 0) & (end > start)
    number, start, end = number[kept], start[kept], end[kept]
    rows = start // line
    return _Stretches(rows=rows, starts=start - rows * line, ends=end - rows * line, numbers=number)


def _by_pixel(stretches: _Stretches, width: int) -> tuple[Ints, Ints, Ints]:
    """Cut stretches at the pixels' edges; return each piece's pixel, its length in steps, and its stretch."""
    left, right = stretches.starts // STEPS, (stretches.ends - 1) // STEPS
    counts = right - left + 1
    pixels = _count_up(stretches.rows // SCANLINES * width + left, counts)
    shares = np.full(len(pixels), STEPS)
    after = np.cumsum(counts)
    shares[after - counts] -= stretches.starts - left * STEPS
    shares[after - 1] -= (right + 1) * STEPS - stretches.ends
    return pixels, shares, np.repeat(np.arange(len(counts)), counts)


def _winners(covered: NDArray[np.bool_], pixels: Ints, shares: Ints, numbers: Ints) -> Ints:
    """Find the number with the largest share of each covered pixel."""
    here = covered[pixels]
    place = (np.cumsum(covered) - 1)[pixels[here]]
    columns = int(numbers.max(initial=0)) + 1
    totals = np.bincount(
        place * columns + numbers[here], weights=shares[here], minlength=np.count_nonzero(covered) * columns
    )
    winners: Ints = totals.reshape(-1, columns).argmax(axis=1)
    return winners


def _count_up(starts: Ints, counts: Ints) -> Ints:
    """List `counts` whole numbers from each start on, one start after the other."""
    before = np.cumsum(counts) - counts
    return np.arange(counts.sum()) - np.repeat(before - starts, counts)
