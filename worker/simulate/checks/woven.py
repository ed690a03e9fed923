"""Whether cables of a tangle passed through each other between their start and their rest."""

import numpy as np
from numpy.typing import NDArray

from worker.simulate.checks.contact import search_reach_m
from worker.simulate.checks.plan_view import PlanCrossings, find_crossings
from worker.simulate.checks.spans import cut
from worker.simulate.shapes import WovenStart

_PASSAGE = 2
"""Change of the sum of a pair's signs by one passage. Moves without a passage add and take away crossings in pairs of
opposite signs, but for one at a time where an end goes over or under the other cable."""


def passed_woven_pairs(start: WovenStart, end: PlanCrossings, radii_m: NDArray[np.float64]) -> tuple[int, int]:
    """Count the passages of woven cables through each other that the signs of their crossings show.

    Twice the linking number of two closed curves is the sum of their crossings' signs, and only a passage changes it.
    Cables are open, so a pair is judged only if no crossing of it, at the start or at the end, is near an end.

    Args:
        start: the cables at the start.
        end: all crossings at the end.
        radii_m: radius of each cable, and of all else that has a number, in metres.

    Returns:
        The number of passages, and the number of pairs whose sum changed where an end is near and may have slipped.
    """
    if not start.cables:
        return 0, 0
    spans = cut(start.nodes_m)
    numbers = np.array(start.cables)
    begun = find_crossings(spans, spans.near_in_plan(search_reach_m(radii_m[numbers])))
    passed = slipped = 0
    for place, one in enumerate(start.cables):
        for shift, other in enumerate(start.cables[place + 1 :], place + 1):
            before = (begun.one == place) & (begun.other == shift)
            after = (end.one == one) & (end.other == other)
            change = abs(int(begun.sign[before].sum()) - int(end.sign[after].sum()))
            if change < _PASSAGE:
                continue
            near_end = begun.near_end(radii_m[numbers])[before].any() or end.near_end(radii_m)[after].any()
            slipped += int(near_end)
            passed += 0 if near_end else change // _PASSAGE
    return passed, slipped
