"""Builds the meshes of pegs, and their outlines for the labels. Pure numpy."""

import numpy as np

from farm.scene.clutter import Peg
from worker.clutter.solid import SIDES, Array, Finish, Solid, section, turned_on_lathe
from worker.clutter.stick_kinds import DARK_STEEL, STEEL, WOOD
from worker.curves import Points

_BEVEL = 0.12
"""Width of the bevel around a peg's top, as a share of its radius."""

_OUTLINE_STEP_M = 0.001
"""Largest distance of the points of an outline along its axis, in metres: each place hides what is farther away."""

_UPRIGHT: Array = np.array([[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]])
"""Rotation that turns the x axis, that of the lathe, to the vertical."""


def peg_solid(peg: Peg) -> tuple[Solid, tuple[Finish, ...]]:
    """Build a peg about the z axis, from the floor up: of steel, of wood or of plastic in its colour.

    Returns:
        The mesh, and the finishes that its faces number.
    """
    rng = np.random.default_rng(peg.pattern_seed)
    plastic = Finish(colour=peg.colour, roughness=float(rng.uniform(0.2, 0.6)), mottle=0.08)
    finish = (STEEL, DARK_STEEL, WOOD, plastic, plastic)[int(rng.integers(5))]
    radius, height, bevel = peg.diameter_m / 2, peg.height_m, _bevel_m(peg)
    side = section([(0.0, radius), (height - bevel, radius)], 0)
    edge = section([(height - bevel, radius), (height, radius - bevel)], 0)
    top = section([(height, radius - bevel), (height, 0.0)], 0)
    return turned_on_lathe([side, edge, top], SIDES).turned(_UPRIGHT), (finish,)


def peg_outline(peg: Peg) -> list[tuple[Points, float]]:
    """Compute the silhouette of a rendered peg for labels, as cylinders end to end.

    Returns:
        The axis (M, 3) and the radius of each cylinder, in metres; the bevel is one of its mean radius.
    """
    radius, shoulder = peg.diameter_m / 2, peg.height_m - _bevel_m(peg)
    return [
        (_axis(peg, 0.0, shoulder), radius),
        (_axis(peg, shoulder, peg.height_m), radius - _bevel_m(peg) / 2),
    ]


def _bevel_m(peg: Peg) -> float:
    return min(_BEVEL * peg.diameter_m / 2, peg.height_m / 2)


def _axis(peg: Peg, low_m: float, high_m: float) -> Points:
    heights = np.linspace(low_m, high_m, max(2, int(np.ceil((high_m - low_m) / _OUTLINE_STEP_M)) + 1))
    return np.stack([np.full_like(heights, peg.x_m), np.full_like(heights, peg.y_m), heights], axis=1)
