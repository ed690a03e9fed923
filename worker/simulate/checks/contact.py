"""The contacts of cables: the depth to which they cut into each other and themselves, and the air between them.

Distances are those of the smooth centrelines, segment to segment of a fine sampling, so a crossing between two samples
is measured where it is closest.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from worker.curves import Points
from worker.simulate.checks.spans import SAMPLES_PER_SPAN, Indices, Spans

SELF_ARC_RADII = 4.0
"""Arc length, in radii, within which a cable can't touch itself: a bend that tight would be as narrow as the cable."""

_SELF_TURN_RAD = 2 * np.pi / 3
"""A curve of arc length s that turns by p in all has a chord of at least s cos(p/2) (Schur). At s = 4 r and this turn
that is 2 r, so two spans with less turning between them can't touch and need no search."""
_SEARCH_RADII = 0.5
"""Air up to which a cable is another's neighbour, in the larger radius; more is not measured."""

_ROWS = 8192
"""Pairs of spans that are measured at once, to bound the memory."""


@dataclass(frozen=True, slots=True)
class Contacts:
    """The depth and the air of all contacts.

    Attributes:
        depth: (samples,), >= 0: overlap of the piece of cable around each sample with another cable, or with its own,
            over the smaller radius.
        clearance_m: (cables,): least air to another cable, negative where they overlap; inf without a neighbour within
            half the larger radius.
    """

    depth: NDArray[np.float64]
    clearance_m: NDArray[np.float64]


def find_contacts(spans: Spans, near: tuple[Indices, Indices], radii_m: NDArray[np.float64]) -> Contacts:
    """Measure all contacts between cables and of each cable with itself.

    Args:
        spans: the centrelines.
        near: pairs of spans to search, from `Spans.near_in_plan` with at least `search_reach_m`.
        radii_m: (cables,), each cable's radius.
    """
    one, other = _worth_searching(spans, near, radii_m)
    depth = np.zeros(len(spans.samples_m))
    clearance = np.full(len(radii_m), np.inf)
    for start in range(0, len(one), _ROWS):
        rows = slice(start, start + _ROWS)
        here, there = _nearest_samples(spans, one[rows], other[rows], radii_m)
        cables = spans.cable_of_sample[here], spans.cable_of_sample[there]
        air = _gap(spans, here, there) - radii_m[cables[0]] - radii_m[cables[1]]
        np.maximum.at(depth, here, -air / np.minimum(radii_m[cables[0]], radii_m[cables[1]]))
        apart = cables[0] != cables[1]
        np.minimum.at(clearance, cables[0][apart], air[apart])
    return Contacts(depth=depth, clearance_m=clearance)


def search_reach_m(radii_m: NDArray[np.float64]) -> float:
    """Distance of centrelines up to which contacts are looked for."""
    return float((2 + _SEARCH_RADII) * radii_m.max())


def _worth_searching(
    spans: Spans, near: tuple[Indices, Indices], radii_m: NDArray[np.float64]
) -> tuple[Indices, Indices]:
    """Select those of the pairs near in plan view that may touch."""
    one, other = near
    low, high = spans.boxes_m
    reach = _reach_m(radii_m, spans.cable[one], spans.cable[other])
    apart = np.maximum(low[one] - high[other], low[other] - high[one])
    may_touch = (apart <= reach[:, None]).all(axis=1)
    same = spans.cable[one] == spans.cable[other]
    turn = spans.turn_rad[spans.first_sample[other] + SAMPLES_PER_SPAN - 1] - spans.turn_rad[spans.first_sample[one]]
    may_touch &= ~same | (turn > _SELF_TURN_RAD)
    return one[may_touch], other[may_touch]


def _reach_m(radii_m: NDArray[np.float64], one: Indices, other: Indices) -> NDArray[np.float64]:
    reach: NDArray[np.float64] = (
        radii_m[one] + radii_m[other] + _SEARCH_RADII * np.maximum(radii_m[one], radii_m[other])
    )
    return reach


def _nearest_samples(
    spans: Spans, one: Indices, other: Indices, radii_m: NDArray[np.float64]
) -> tuple[Indices, Indices]:
    """Find for each sample of a pair of spans, both ways round, the nearest sample of the other span within reach."""
    table_one, table_other = spans.span_samples[one], spans.span_samples[other]
    # Places are relative to a point of the pair, so that the products below lose no digits far from the origin.
    origin = spans.samples_m[table_one[:, :1]]
    a, b = spans.samples_m[table_one] - origin, spans.samples_m[table_other] - origin
    squares = np.einsum("pik,pik->pi", a, a)[:, :, None] + np.einsum("pik,pik->pi", b, b)[:, None, :]
    squared = squares - 2 * (a @ b.transpose(0, 2, 1))
    cables = spans.cable[one], spans.cable[other]
    same = np.flatnonzero(cables[0] == cables[1])
    if len(same):
        along = spans.arc_m[table_other[same]][:, None, :] - spans.arc_m[table_one[same]][:, :, None]
        too_near = along < SELF_ARC_RADII * radii_m[cables[0][same], None, None]
        squared[same] = np.where(too_near, np.inf, squared[same])
    steps = np.diff(spans.arc_m[np.concatenate([table_one, table_other])], axis=1)
    # A segment's nearest point is at most half a step from one of its ends, on either side.
    within = (_reach_m(radii_m, *cables) + steps.max(initial=0))[:, None] ** 2
    here, there = [], []
    for axis, table, facing in ((2, table_one, table_other), (1, table_other, table_one)):
        nearest = squared.argmin(axis=axis)
        pair, sample = np.nonzero(squared.min(axis=axis) <= within)
        here.append(table[pair, sample])
        there.append(facing[pair, nearest[pair, sample]])
    return np.concatenate(here), np.concatenate(there)


def _gap(spans: Spans, here: Indices, there: Indices) -> NDArray[np.float64]:
    """Compute the distance from the piece of cable around each sample `here` to the segments that meet at `there`.

    The piece reaches half way to the samples beside it, so the pieces make up the cable and none counts twice.
    """
    points, cable = spans.samples_m, spans.cable_of_sample
    gap = np.full(len(here), np.inf)
    for side in (-1, 1):
        for facing in (-1, 1):
            half_way = (points[here] + points[_beside(here, side, cable)]) / 2
            far_end = points[_beside(there, facing, cable)]
            gap = np.minimum(gap, segment_gap(points[here], half_way, points[there], far_end))
    return gap


def _beside(sample: Indices, side: int, cable: Indices) -> Indices:
    """The sample before or after, or the sample itself at an end of its cable."""
    neighbour = np.clip(sample + side, 0, len(cable) - 1)
    return np.where(cable[neighbour] == cable[sample], neighbour, sample)


def segment_gap(p: Points, p_end: Points, q: Points, q_end: Points) -> NDArray[np.float64]:
    """Least distance of segments p to p_end and q to q_end, (N, 3) each; a segment may be a point."""
    u, v, w = p_end - p, q_end - q, p - q
    uu, vv = np.maximum(_dot(u, u), 1e-30), np.maximum(_dot(v, v), 1e-30)
    uv, uw, vw = _dot(u, v), _dot(u, w), _dot(v, w)
    # Nearest points of the two lines, drawn back to the segments one after the other (Ericson, Real-Time Collision
    # Detection, 5.1.9). Parallel lines may start anywhere.
    spread = uu * vv - uv * uv
    crossing = spread > 1e-12 * uu * vv
    s = np.clip(np.where(crossing, (uv * vw - vv * uw) / np.where(crossing, spread, 1), 0), 0, 1)
    t = np.clip((uv * s + vw) / vv, 0, 1)
    s = np.clip((uv * t - uw) / uu, 0, 1)
    gap: NDArray[np.float64] = np.linalg.norm(w + s[:, None] * u - t[:, None] * v, axis=1)
    return gap


def _dot(one: Points, other: Points) -> NDArray[np.float64]:
    product: NDArray[np.float64] = np.einsum("ij,ij->i", one, other)
    return product
