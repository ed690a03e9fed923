"""Weaves a diagram as wanted where cables can follow, and otherwise by an order in which they need not be steep."""

import itertools
from collections.abc import Collection, Sequence

import numpy as np

from worker.sample.loom import GAP, STEEPEST, Loom, Weave
from worker.sample.meetings import Meeting, Plan

_GIVE = 0.5
"""Share of a meeting's gap that the one strand makes; its partner makes the rest."""

_AT_ONCE = 8
"""Meetings that may give way for each of them that does before the next attempt."""


def weave_near(
    plans: Sequence[Plan],
    meetings: Sequence[Meeting],
    wanted: Sequence[bool],
    safe: Sequence[bool],
    firm: Collection[int] = (),
) -> tuple[Weave, tuple[bool, ...]] | None:
    """Weave as wanted, but give way to a safe choice, meeting by meeting, where a cable would be too steep.

    Args:
        plans: the plans.
        meetings: all meetings of the plans.
        wanted: for each meeting, whether its first strand is to be over the second.
        safe: a choice of the same kind that needs no steep cables, such as an order of the cables.
        firm: numbers of the meetings that must stay as wanted.

    Returns:
        The heights and the choice that they follow; None if all that may give way has, and one is too steep still.
    """
    loom, chosen = Loom(plans, meetings), list(wanted)
    given_way = [k in firm or want == safe[k] for k, want in enumerate(wanted)]
    lifts = [_GIVE * GAP * (plans[meeting.one].radius_m + plans[meeting.other].radius_m) for meeting in meetings]
    while True:
        culprit, slope = _steepest_step(meetings, chosen, given_way, lifts)
        if culprit is None or slope <= STEEPEST:
            break
        chosen[culprit], given_way[culprit] = safe[culprit], True
    while True:
        found = loom.weave(chosen)
        if found is not None and max(found.slopes, default=0.0) <= STEEPEST:
            return found, tuple(chosen)
        if all(given_way):
            return None
        for _ in range(max(1, given_way.count(False) // _AT_ONCE)):
            culprit = _nearest(meetings, given_way, found)
            if culprit is None:
                culprit, _ = _steepest_step(meetings, chosen, given_way, lifts)
            if culprit is None:
                culprit = given_way.index(False)
            chosen[culprit], given_way[culprit] = safe[culprit], True


def _steepest_step(
    meetings: Sequence[Meeting], chosen: Sequence[bool], given_way: Sequence[bool], lifts: Sequence[float]
) -> tuple[int | None, float]:
    """Find the meeting, of those that may give way, whose neighbour on a strand asks for the steepest step to it.

    A strand that is over at one meeting and under at the next rises by half of either's gap from the end of one to the
    beginning of the other.
    """
    strands: dict[int, list[tuple[float, float, int, bool]]] = {}
    for number, (meeting, is_over) in enumerate(zip(meetings, chosen, strict=True)):
        for cable, places, above in (
            (meeting.one, meeting.one_m, is_over),
            (meeting.other, meeting.other_m, not is_over),
        ):
            strands.setdefault(cable, []).append((float(places.min()), float(places.max()), number, above))
    worst: tuple[int | None, float] = (None, 0.0)
    for along in strands.values():
        along.sort()
        for (_, end, before, was_above), (start, _, after, above) in itertools.pairwise(along):
            free = [number for number in (before, after) if not given_way[number]]
            if was_above == above or not free:
                continue
            rise = (lifts[before] + lifts[after]) / 2
            slope = rise / max(start - end, 1e-3 * rise)
            if slope > worst[1]:
                worst = (free[-1], slope)
    return worst


def _nearest(meetings: Sequence[Meeting], given_way: Sequence[bool], found: Weave | None) -> int | None:
    """Find the meeting, of those that may give way, that is nearest to the steepest place of all cables."""
    if found is None:
        return None
    cable = int(np.argmax(found.slopes))
    place = found.steepest_m[cable]
    away = {
        number: min(
            float(np.abs(places - place).min())
            for k, places in ((meeting.one, meeting.one_m), (meeting.other, meeting.other_m))
            if k == cable
        )
        for number, meeting in enumerate(meetings)
        if not given_way[number] and cable in {meeting.one, meeting.other}
    }
    return min(away, key=lambda number: away[number]) if away else None
