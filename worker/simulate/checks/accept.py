"""Decides whether a settled scene may be shipped, from the figures of `worker.simulate.checks.measure`."""

from farm.dataset.manifest import SettleFigures
from worker.simulate.checks.measure import Gate, settled_figures

MAX_PENETRATION_ANYWHERE = 0.20
"""Deepest single place where cables may cut into each other or the floor, over the radius."""

MAX_SUPPORT_GAP = 0.5
"""Most air below a cable at its lowest place, over the radius."""

MAX_SPEED_RMS_MM_S = Gate.SPEED_RMS.value.target
"""Greatest root mean square speed of a picture's cables."""

MAX_SPEED_MM_S = Gate.SPEED_MAX.value.target
"""Greatest speed of any place of a picture's cables."""


def find_fault(figures: SettleFigures) -> str | None:
    """Find the reason why a scene must be drawn again; None if it may be shipped.

    A scene that breaks one of gates 1 to 3 is never shipped. A picture asks for more than the gates do:

    - Speed within gate 4's target, not its bound: labels are of the moment of capture and hold for a picture of cables
      at rest, and a cable that still creeps shows a pose which it would leave.
    - No single place deeper than a fifth of the radius: the 99.9th percentile passes over a short, deep cut, and one
      is enough to be seen.
    - Not more than half a radius of air below a cable at its lowest: its shadow would come away from it.

    Two things that real cables do are no faults: a cable may cross itself in plan view (where it cuts into itself,
    penetration tells), and its tip may slip round another's.
    """
    if figures.pass_throughs:
        return f"cables passed through each other {figures.pass_throughs} time(s)"
    if figures.floor_pass_throughs:
        return f"{figures.floor_pass_throughs} cable(s) passed through the floor"
    limits = [
        *((gate.value.name, figure, gate.value.never) for gate, figure in settled_figures(figures).items()),
        ("deepest cable penetration over radius", figures.cable_penetration_max, MAX_PENETRATION_ANYWHERE),
        ("deepest floor penetration over radius", figures.floor_penetration_max, MAX_PENETRATION_ANYWHERE),
        ("root mean square speed in mm/s", figures.speed_rms_mm_s, MAX_SPEED_RMS_MM_S),
        ("speed in mm/s", figures.speed_max_mm_s, MAX_SPEED_MM_S),
        ("gap below a cable over radius", figures.support_gap, MAX_SUPPORT_GAP),
    ]
    for name, figure, limit in limits:
        if not figure <= limit:
            return f"{name} {figure:.4g} is above {limit:g}"
    return None
