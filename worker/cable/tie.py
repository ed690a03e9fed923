"""The solids of cable ties: a band around strands, the head that locks it, and the stub of its tail. Pure numpy."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from farm.scene.cable import Tie
from worker.cable.piece import OCCLUDER, Convex, Plain, Substance
from worker.cable.strands import turn_at
from worker.cable.tube import frames
from worker.curves import Points

_THICKNESS_M = 0.0009
"""Thickness of a band, in metres: makers' tables give 0.9 to 1.3 mm for nylon ties 2.5 to 5 mm wide."""

_CORNERS = 40
"""Number of corners of a band's outline."""

_BEVEL = 0.12
"""Part of the band on either side over which it rises to its thickness, as a share of its width."""

GOLDEN = 0.618034
"""Golden ratio less 1, whose multiples modulo 1 spread evenly without a pattern."""


def solids_of(
    tie: Tie,
    curve: Points,
    length_m: float,
    offsets_m: NDArray[np.float64],
    strand_m: float,
    *,
    lay_m: float,
    phase_deg: float,
) -> list[Convex]:
    """Build the solids of a tie around a bundle.

    Args:
        tie: position, width and colour of the tie.
        curve: (N, 3) metres, centreline of the bundle.
        length_m: length of the bundle, in metres.
        offsets_m: (strands, 2) metres, offsets of the strands' middles; see `worker.cable.strands.turning`.
        strand_m: radius of a strand, in metres.
        lay_m: length over which the strands turn once, in metres, negative if left-handed; 0 for no turn.
        phase_deg: angle of that turn at the bundle's start, in degrees.

    Returns:
        The band, the head and the stub of the tail.
    """
    middle_m = float(np.clip(tie.along * length_m, 0.5 * tie.width_m, length_m - 0.5 * tie.width_m))
    steps = np.array([-0.5, _BEVEL - 0.5, 0.5 - _BEVEL, 0.5])
    arc = middle_m + tie.width_m * steps
    centre, across, up = _frames_at(curve, length_m, arc)
    turns = turn_at(arc, lay_m, phase_deg)
    # The band is straight, so it goes around every position that a strand has under it.
    under = np.concatenate([_turned(offsets_m, turn) for turn in turns])
    angle = 2 * np.pi * np.arange(_CORNERS) / _CORNERS
    outward = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    outermost = under[np.argmax(under @ outward.T, axis=0)]
    reach = strand_m + _THICKNESS_M * np.array([0.6, 1.0, 1.0, 0.6])
    outline = outermost + reach[:, None, None] * outward
    rings = centre[:, None] + outline[..., :1] * across[:, None] + outline[..., 1:] * up[:, None]
    surface = Plain(Substance.PLASTIC, tie.colour)
    highest = float(under[:, 1].max())
    band = Convex(OCCLUDER, rings, centre[1] + (highest + 1e-5) * up[1], surface, around=True)
    # Ties are pulled tight from above, so heads are on the upper side, each at another angle.
    lean = np.pi / 2 + 1.1 * np.sin(2 * np.pi * (GOLDEN * (7 * tie.along + phase_deg / 360)))
    direction = np.array([np.cos(lean), np.sin(lean)])
    foot = under[np.argmax(under @ direction)] + (strand_m + 0.6 * _THICKNESS_M) * direction
    frame = (centre[1:3].mean(axis=0), across[1], up[1])
    return [band, *_head(tie.width_m, foot, direction, frame, surface)]


def is_clear(solids: Sequence[Convex], curve: Points, radius_m: float) -> bool:
    """Whether solids keep clear of a round cable; the ball around each solid stands for it.

    Args:
        solids: solids of a tie.
        curve: (N, 3) metres, centreline of the cable, finely sampled.
        radius_m: radius of the cable, in metres.
    """
    for solid in solids:
        corners = solid.rings.reshape(-1, 3)
        middle = corners.mean(axis=0)
        reach = np.linalg.norm(corners - middle, axis=1).max()
        if np.linalg.norm(curve - middle, axis=1).min() < reach + radius_m:
            return False
    return True


def _head(
    width_m: float, foot: NDArray[np.float64], direction: NDArray[np.float64], frame: tuple[Points, ...], surface: Plain
) -> list[Convex]:
    """Build a block with rounded edges, and the stub of the tail that comes through it."""
    centre, across, up = frame
    sideways = np.array([-direction[1], direction[0]])
    along = np.cross(up, across)

    def ring(out_m: float, half_along_m: float, half_aside_m: float, shift_m: float = 0.0) -> Points:
        cut = 0.25 * min(half_along_m, half_aside_m)
        x, y = half_along_m, half_aside_m
        corners = [(x, y - cut), (x - cut, y), (cut - x, y), (-x, y - cut), (-x, cut - y), (cut - x, -y), (x - cut, -y)]
        flat = [*corners, (x, cut - y)]
        plane = [foot + out_m * direction + (shift_m + aside) * sideways for _, aside in flat]
        points = [centre + p[0] * across + p[1] * up + a * along for p, (a, _) in zip(plane, flat, strict=True)]
        return np.array(points[::-1])

    def block(rings: list[Points]) -> Convex:
        stacked = np.array(rings)
        return Convex(OCCLUDER, stacked, stacked.mean(axis=(0, 1)), surface)

    high, long, wide = 0.85 * width_m, 0.66 * width_m, 0.68 * width_m
    head = block(
        [
            ring(0.0, long, wide),
            ring(0.88 * high, long, wide),
            ring(high, 0.88 * long, 0.88 * wide),
        ]
    )
    stub_m = high + 0.35 * width_m
    tail = block([ring(out, 0.4 * width_m, 0.5 * _THICKNESS_M, 0.3 * wide) for out in (0.5 * high, stub_m)])
    return [head, tail]


def _turned(offsets_m: NDArray[np.float64], angle: float) -> NDArray[np.float64]:
    cos, sin = np.cos(angle), np.sin(angle)
    turned: NDArray[np.float64] = offsets_m @ np.array([[cos, sin], [-sin, cos]])
    return turned


def _frames_at(curve: Points, length_m: float, arc_m: NDArray[np.float64]) -> tuple[Points, Points, Points]:
    """Interpolate the centreline and the sideways and up directions, (M, 3) each, at places (M,) along a curve."""
    knots = np.linspace(0.0, length_m, len(curve))
    across, up = frames(curve)
    centre, across, up = (
        np.stack([np.interp(arc_m, knots, values[:, axis]) for axis in range(3)], axis=1)
        for values in (curve, across, up)
    )
    return centre, across, up
