"""Place things: in rows along walls, strewn over tables, side by side on shelves."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from blend.environments.assembly import Assembly
from blend.environments.palette import pick

Build = Callable[[Assembly, np.random.Generator], None]
"""A function that builds a thing with its back at y = 0, its front towards +y, its foot at z = 0, its middle at
x = 0."""


@dataclass(frozen=True, slots=True)
class Piece:
    """A thing to place, and the room that it takes along x and y, metres."""

    build: Build
    width: float
    depth: float = 0.6


def line_up(
    a: Assembly, rng: np.random.Generator, pieces: Sequence[Piece], left: float, right: float, gap: float = 0.08
) -> None:
    """Place random pieces side by side from `left` to `right`, with gaps of about `gap`, all in metres.

    No piece comes twice in succession if another one fits.
    """
    x, before = left, None
    while True:
        fitting = [piece for piece in pieces if x + piece.width <= right]
        if not fitting:
            return
        others = [piece for piece in fitting if piece is not before] or fitting
        before = pick(rng, others)
        with a.at(x + 0.5 * before.width, rng.uniform(0.0, 0.05), turn=rng.normal(0, 0.7)):
            before.build(a, rng)
        x += before.width + gap * rng.uniform(0.3, 2.5)


def clutter(
    a: Assembly,
    rng: np.random.Generator,
    pieces: Sequence[Piece],
    size: tuple[float, float],
    z: float,
    *,
    density: float = 0.7,
) -> None:
    """Strew small things over a table top, without overlap.

    Args:
        a: assembly that receives the things.
        rng: source of the randomness.
        pieces: things to choose from.
        size: width and depth of the top, metres; the middle of its back edge is at the origin.
        z: height of the top, metres.
        density: fullness of the top, 0 to 1: at 1, things cover about 60 % of it.
    """
    taken: list[tuple[float, float, float]] = []
    room = size[0] * size[1]
    used = 0.0
    for _ in range(60):
        if used > density * room * 0.6:
            return
        piece = pick(rng, pieces)
        radius = 0.5 * max(piece.width, piece.depth)
        if size[1] < piece.depth or size[0] < piece.width:
            continue
        x = rng.uniform(-0.5, 0.5) * (size[0] - piece.width)
        y = rng.uniform(0.0, 1.0) * (size[1] - piece.depth) + 0.5 * piece.depth
        if any((x - ox) ** 2 + (y - oy) ** 2 < (0.9 * (radius + other)) ** 2 for ox, oy, other in taken):
            continue
        taken.append((x, y, radius))
        used += piece.width * piece.depth
        with a.at(x, y, z, turn=rng.normal(0, 14)), a.at(0.0, -0.5 * piece.depth):
            piece.build(a, rng)


def row_on(
    a: Assembly, rng: np.random.Generator, pieces: Sequence[Piece], width: float, z: float, *, empty: float = 0.12
) -> None:
    """Fill a shelf from left to right; things of the same kind mostly stand together.

    Args:
        a: assembly that receives the things.
        rng: source of the randomness.
        pieces: things to choose from.
        width: width of the shelf, metres; its middle is at the origin.
        z: height of the shelf, metres.
        empty: probability of a gap before a thing.
    """
    x = -0.5 * width + 0.02
    piece = pick(rng, pieces)
    while x < 0.5 * width - 0.05:
        if rng.random() < 0.4:
            piece = pick(rng, pieces)
        if rng.random() < empty:
            x += rng.uniform(0.05, 0.35)
        if x + piece.width > 0.5 * width - 0.02:
            smaller = [each for each in pieces if x + each.width <= 0.5 * width - 0.02]
            if not smaller:
                return
            piece = pick(rng, smaller)
        with a.at(x + 0.5 * piece.width, rng.uniform(0.01, 0.06), z, turn=rng.normal(0, 2.5)):
            piece.build(a, rng)
        x += piece.width + rng.uniform(0.005, 0.05)
