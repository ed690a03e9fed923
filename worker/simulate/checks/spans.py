"""Centrelines cut into spans, one from node to node, and the pairs of spans that come near each other in plan view.

Cables on a floor form a thin layer, so most spans that are near in plan view are near, and the same pairs serve both
the search for contacts and the search for crossings seen from above.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from worker.curves import Points, smooth

Indices = NDArray[np.int64]

SAMPLES_PER_SPAN = 12
"""Samples of the smooth curve from one node to the next."""


@dataclass(frozen=True)
class Spans:
    """All spans of all cables, in order.

    Attributes:
        samples_m: (S, 3), the smooth curves through the nodes, one after the other.
        cable_of_sample: (S,), cable of each sample.
        first_sample: (P,), sample at which each span starts; the span ends `SAMPLES_PER_SPAN` later.
        cable: (P,), cable of each span.
    """

    samples_m: Points
    cable_of_sample: Indices
    first_sample: Indices
    cable: Indices

    @cached_property
    def span_samples(self) -> Indices:
        """(P, SAMPLES_PER_SPAN + 1): the samples of each span, its two ends included."""
        table: Indices = self.first_sample[:, None] + np.arange(SAMPLES_PER_SPAN + 1)
        return table

    @cached_property
    def lowest_m(self) -> NDArray[np.float64]:
        """(cables,): height of each cable's lowest place."""
        lowest = np.full(self.cable[-1] + 1, np.inf)
        np.minimum.at(lowest, self.cable_of_sample, self.samples_m[:, 2])
        return lowest

    @cached_property
    def arc_m(self) -> NDArray[np.float64]:
        """(S,): arc length up to each sample. It runs on from cable to cable: use differences within one."""
        steps = np.linalg.norm(np.diff(self.samples_m, axis=0), axis=1)
        return np.concatenate([[0.0], np.cumsum(steps)])

    @cached_property
    def turn_rad(self) -> NDArray[np.float64]:
        """(S,): turning of the tangent at all samples up to each, never falling; use differences within a cable."""
        step = np.diff(self.samples_m, axis=0)
        unit = step / np.maximum(np.linalg.norm(step, axis=1, keepdims=True), 1e-30)
        half_chord = np.minimum(np.linalg.norm(np.diff(unit, axis=0), axis=1) / 2, 1)
        turned = np.cumsum(2 * np.arcsin(half_chord))
        return np.concatenate([[0.0], turned, turned[-1:]])

    @cached_property
    def boxes_m(self) -> tuple[Points, Points]:
        """(P, 3) each: least and greatest coordinates of each span."""
        points = self.samples_m[self.span_samples]
        return points.min(axis=1), points.max(axis=1)

    def near_in_plan(self, reach_m: float) -> tuple[Indices, Indices]:
        """Pairs of spans, the first before the second, whose boxes are within `reach_m` of each other in plan view."""
        low, high = (corner[:, :2] for corner in self.boxes_m)
        centres, half = (low + high) / 2, (high - low) / 2
        widest = 2 * float(np.sqrt(np.einsum("ij,ij->i", half, half).max())) + np.sqrt(2) * reach_m
        pairs = cKDTree(centres).query_pairs(widest, output_type="ndarray")
        one, other = pairs[:, 0], pairs[:, 1]
        apart = np.abs(centres[one] - centres[other]) - half[one] - half[other]
        near = (apart <= reach_m).all(axis=1)
        # The tree's order is its own; sums and reports are to have one order.
        order = np.lexsort((other[near], one[near]))
        return one[near][order], other[near][order]


def cut(nodes_m: tuple[Points, ...]) -> Spans:
    """Smooth curves through the nodes of each cable (N, 3), N >= 2, as they are rendered, cut at the nodes."""
    curves = [smooth(nodes, SAMPLES_PER_SPAN) for nodes in nodes_m]
    counts = np.array([len(curve) for curve in curves])
    starts = np.concatenate([[0], np.cumsum(counts)[:-1]])
    cables = np.arange(len(curves))
    spans = [np.arange(start, start + count - 1, SAMPLES_PER_SPAN) for start, count in zip(starts, counts, strict=True)]
    return Spans(
        samples_m=np.concatenate(curves),
        cable_of_sample=np.repeat(cables, counts),
        first_sample=np.concatenate(spans),
        cable=np.repeat(cables, [len(each) for each in spans]),
    )
