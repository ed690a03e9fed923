"""The courses of strands that wind around each other within a circle. Pure numpy."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from farm.scene.cable import envelope_ratio
from worker.cable.tube import frames
from worker.curves import Points

_RING: dict[int, tuple[int, float]] = {
    2: (2, 1.0),
    3: (3, 2 / math.sqrt(3)),
    4: (4, math.sqrt(2)),
    5: (5, 1 / math.sin(math.pi / 5)),
    6: (6, 2.0),
    7: (6, 2.0),
}
"""The tightest packing of equal circles in a circle, by their number: the number of circles in the ring around the
middle, and the distance of their middles from it, in radii of a circle. A seventh lies in the middle. (Kravitz,
Mathematics Magazine 40, 1967, p. 65.)"""


def places(strands: int) -> NDArray[np.float64]:
    """Compute the middles (strands, 2) of 2 to 7 strands in the tightest packing about (0, 0), in radii of a strand."""
    ring, distance = _RING[strands]
    angle = 2 * np.pi * np.arange(ring) / ring
    around = distance * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return np.concatenate([around, np.zeros((strands - ring, 2))])


def strand_radius(strands: int, wanted_m: float, envelope_m: float, lay_m: float) -> float:
    """Compute the radius of strands that lie within an envelope and do not cut each other.

    Turning strands come nearer to their neighbours than a cut across the bundle shows.

    Args:
        strands: number of strands, 2 to 7.
        wanted_m: largest radius of a strand, in metres.
        envelope_m: radius of the circle around all strands, in metres.
        lay_m: length of one turn, in metres; 0 for strands that do not turn.

    Returns:
        The radius in metres.
    """
    packed_m = min(wanted_m, envelope_m / envelope_ratio(strands))
    ring, distance = _RING[strands]
    if not lay_m:
        return packed_m
    # The distance from a point of one helix to its neighbour is the least over all points of the neighbour.
    turn, step = np.zeros(1), np.pi
    squares = np.zeros(1)
    for _ in range(4):
        turn = turn[squares.argmin()] + np.linspace(-step, step, 41)
        across = 2 * distance**2 * (1 - np.cos(2 * np.pi / ring + turn))
        squares = across + (turn / (2 * np.pi) * lay_m / packed_m) ** 2
        step /= 20
    return packed_m * min(1.0, 0.5 * math.sqrt(float(squares.min())))


def turning(
    curve: Points, offsets_m: NDArray[np.float64], arc_m: NDArray[np.float64], lay_m: float, phase_deg: float
) -> Sequence[Points]:
    """Compute curves that turn about a centreline and keep their distance from it.

    Args:
        curve: (N, 3) metres, centreline, nowhere vertical.
        offsets_m: (strands, 2) or (strands, N, 2) metres, offset of each strand sideways and up where the turn is 0.
        arc_m: (N,) metres, place of each point along the centreline.
        lay_m: length of one turn, in metres, negative if left-handed; 0 for no turn.
        phase_deg: angle of the turn where `arc_m` is 0, in degrees.

    Returns:
        (N, 3) metres for each strand.
    """
    across, up = frames(curve)
    angle = turn_at(arc_m, lay_m, phase_deg)
    cos, sin = np.cos(angle), np.sin(angle)
    offsets = np.broadcast_to(offsets_m if offsets_m.ndim == 3 else offsets_m[:, None], (len(offsets_m), len(curve), 2))
    sideways = cos * offsets[..., 0] - sin * offsets[..., 1]
    upwards = sin * offsets[..., 0] + cos * offsets[..., 1]
    return list(curve + sideways[..., None] * across + upwards[..., None] * up)


def turn_at(arc_m: NDArray[np.float64], lay_m: float, phase_deg: float) -> NDArray[np.float64]:
    """Compute the angle, in radians, by which strands have turned at each place.

    Args:
        arc_m: (N,) metres, places along the strands.
        lay_m: length of one turn, in metres, negative if left-handed; 0 for no turn.
        phase_deg: angle where `arc_m` is 0, in degrees.

    Returns:
        (N,) radians.
    """
    turned = 2 * np.pi * arc_m / lay_m if lay_m else np.zeros_like(arc_m)
    angle: NDArray[np.float64] = turned + np.radians(phase_deg)
    return angle
