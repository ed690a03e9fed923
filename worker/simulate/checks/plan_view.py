"""The places where cables cross each other, or themselves, seen from above."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from worker.simulate.checks.spans import SAMPLES_PER_SPAN, Indices, Spans

END_RADII = 10.0
"""Arc length from an end, in the larger radius of the two cables, up to which a flipped crossing counts as a slip round
that end. A tip that slips round a cable comes to lie within a few radii of it (measured: up to 2), and may slide on
until all is at rest; and with so little of the cable beyond the crossing, either order is one that the cables could
have come to by themselves."""

_STRIDE = 3
"""Samples from one end to the other of a segment in the search for crossings: every third is enough to find them."""


@dataclass(frozen=True, slots=True)
class PlanCrossings:
    """All crossings, (C,) each.

    Attributes:
        one: the cable of the one strand.
        other: the cable of the other; the same where a cable crosses itself.
        rise_m: height of the other strand above the one.
        from_end_m: arc length from the crossing to the nearest end of either strand's cable.
    """

    one: Indices
    other: Indices
    rise_m: NDArray[np.float64]
    from_end_m: NDArray[np.float64]

    @property
    def own(self) -> NDArray[np.bool_]:
        """(C,): whether a cable crosses itself there."""
        own: NDArray[np.bool_] = self.one == self.other
        return own

    def flipped(self, order: tuple[int, ...]) -> NDArray[np.bool_]:
        """(C,): whether two cables lie the other way round than in `order`, which lists cables from the lowest up."""
        rank = np.argsort(order)
        rises = rank[self.other] > rank[self.one]
        flipped: NDArray[np.bool_] = ~self.own & np.where(rises, self.rise_m < 0, self.rise_m > 0)
        return flipped

    def near_end(self, radii_m: NDArray[np.float64]) -> NDArray[np.bool_]:
        """(C,): whether the crossing is within `END_RADII` of an end, for cables of these radii."""
        near: NDArray[np.bool_] = self.from_end_m <= END_RADII * np.maximum(radii_m[self.one], radii_m[self.other])
        return near


def find_crossings(spans: Spans, near: tuple[Indices, Indices]) -> PlanCrossings:
    """Find the crossings of the cables' projections on the floor.

    Neighbouring segments share a point and do not count.

    Args:
        spans: the centrelines.
        near: pairs of spans to search, from `Spans.near_in_plan` with any reach.
    """
    low, high = (corner[:, :2] for corner in spans.boxes_m)
    overlap = ((low[near[0]] <= high[near[1]]) & (low[near[1]] <= high[near[0]])).all(axis=1)
    # A span can cross itself only if it turns by half a circle.
    turn = spans.turn_rad[spans.first_sample + SAMPLES_PER_SPAN - 1] - spans.turn_rad[spans.first_sample]
    curled = np.flatnonzero(turn >= np.pi)
    first, second = (np.concatenate([side[overlap], curled]) for side in near)
    knots = np.arange(0, SAMPLES_PER_SPAN, _STRIDE)
    i, j = np.broadcast_arrays(
        spans.first_sample[first, None, None] + knots[:, None], spans.first_sample[second, None, None] + knots
    )
    i, j = i.ravel(), j.ravel()
    same = spans.cable_of_sample[i] == spans.cable_of_sample[j]
    # Within one cable each pair of segments is wanted once and not beside each other. (Across spans i < j already.)
    wanted = ~same | (j - i > _STRIDE)
    i, j = i[wanted], j[wanted]
    p, q = spans.samples_m[i], spans.samples_m[j]
    r, s = spans.samples_m[i + _STRIDE] - p, spans.samples_m[j + _STRIDE] - q
    w = q - p
    cross = r[:, 0] * s[:, 1] - r[:, 1] * s[:, 0]
    safe = np.where(cross == 0, np.inf, cross)
    t = (w[:, 0] * s[:, 1] - w[:, 1] * s[:, 0]) / safe
    u = (w[:, 0] * r[:, 1] - w[:, 1] * r[:, 0]) / safe
    met = (t >= 0) & (t < 1) & (u >= 0) & (u < 1) & (cross != 0)
    rise = w[met, 2] + u[met] * s[met, 2] - t[met] * r[met, 2]
    i, j = i[met], j[met]
    return PlanCrossings(
        one=spans.cable_of_sample[i],
        other=spans.cable_of_sample[j],
        rise_m=rise,
        from_end_m=np.minimum(_from_end(spans, i, t[met]), _from_end(spans, j, u[met])),
    )


def _from_end(spans: Spans, sample: Indices, fraction: NDArray[np.float64]) -> NDArray[np.float64]:
    """Arc length from the nearer end of its cable to a fraction of the way from a sample to the next but two."""
    arc, cable = spans.arc_m, spans.cable_of_sample
    first = np.searchsorted(cable, cable[sample])
    last = np.searchsorted(cable, cable[sample], side="right") - 1
    place = arc[sample] + fraction * (arc[sample + _STRIDE] - arc[sample])
    nearer: NDArray[np.float64] = np.minimum(place - arc[first], arc[last] - place)
    return nearer
