"""The diagram of a tangle: the plans of its cables, and which strand is to be over the other where they meet."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from farm.scene.cable import Cable
from farm.scene.clutter import Peg
from worker.sample.loom import knot_spacings_m
from worker.sample.meetings import Array, Meeting, Plan, find_meetings, samples_of
from worker.sample.weave import weave_near
from worker.simulate.shapes import bent_rod

PAIRS_PER_KNOT = 4
"""Places of a long meeting at which its gap holds, to one height that describes a cable."""

_DIGITS = 9
"""Decimal places of heights in metres."""

Choice = Callable[[Sequence[Meeting], list[bool]], list[bool]]
"""Chooses for each meeting whether its first strand is to be over the second, given a safe choice."""


@dataclass(frozen=True, slots=True)
class Diagram:
    """A tangle in plan view.

    Attributes:
        cables: the cables in their plan places; their heights do not count yet.
        choose: choice of what is over and under.
        firm: numbers of the meetings that must stay as chosen; elsewhere a safe choice may hold.
        peg: peg round which cables run, of which only the height may change.
    """

    cables: tuple[Cable, ...]
    choose: Choice
    firm: Callable[[Sequence[Meeting]], set[int]] = lambda _: set()
    peg: Peg | None = None


def plan_of(cable: Cable) -> Plan:
    """Make the plan of a cable, in its place."""
    radius = cable.diameter_m / 2
    points = bent_rod(cable.length_m, cable.bends_per_m, samples_of(cable.length_m, radius))
    return Plan(
        points_m=turned(points, cable.rotation_deg) + np.array([cable.x_m, cable.y_m]),
        length_m=cable.length_m,
        radius_m=radius,
        stiffness=cable.youngs_modulus_pa * radius**4,
    )


def turned(points_m: Array, bearing_deg: float) -> Array:
    """Turn points (..., 2) about the origin, anticlockwise."""
    turn = np.radians(bearing_deg)
    cosine, sine = np.cos(turn), np.sin(turn)
    rotated: Array = points_m @ np.array([[cosine, sine], [-sine, cosine]])
    return rotated


def weave_diagram(diagram: Diagram, lowest_m: float, rng: np.random.Generator) -> tuple[Cable, ...] | None:
    """Give the cables of a diagram the heights at which they pass over and under each other.

    Args:
        diagram: the diagram.
        lowest_m: height of the lowest underside above the floor, in metres.
        rng: random generator of the tangle, which draws the order to which a choice gives way.

    Returns:
        The cables, or None if they would be too steep, or what makes the tangle had to give way.
    """
    plans = [plan_of(cable) for cable in diagram.cables]
    meetings = find_meetings(plans, [spacing / PAIRS_PER_KNOT for spacing in knot_spacings_m(plans)])
    rank, rises = rng.permutation(len(plans)), rng.random(len(plans)) < 0.5
    # Where a cable meets itself, its later part is over, or under, throughout: it rises or falls like a coil.
    safe = [
        bool(not rises[each.one] if each.one == each.other else rank[each.one] > rank[each.other]) for each in meetings
    ]
    wanted = diagram.choose(meetings, safe)
    found = weave_near(plans, meetings, wanted, safe, diagram.firm(meetings))
    if found is None:
        return None
    woven, _ = found
    return tuple(
        _raised(cable, heights, lowest_m) for cable, heights in zip(diagram.cables, woven.heights_m, strict=True)
    )


def _raised(cable: Cable, heights_m: Array, lowest_m: float) -> Cable:
    """Give a cable heights, and the height of its lowest one as its start."""
    lowest = max(float(heights_m.min()), 0.0)
    return cable.model_copy(
        update={
            "start_height_m": lowest_m + round(lowest, _DIGITS),
            "rise_m": 0.0,
            # The last digits of the solution differ from one processor to another.
            "heights_m": tuple(np.round(np.maximum(heights_m - lowest, 0.0), _DIGITS).tolist()),
        }
    )
