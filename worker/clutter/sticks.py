"""Sticks as they are rendered, and their outlines for the labels. Pure numpy."""

import numpy as np

from farm.scene.clutter import Stick
from worker.clutter.solid import SIDES, Array, Finish, Section, Solid, joined, turned_on_lathe
from worker.clutter.stick_kinds import TURNERS
from worker.curves import Points

OUTLINE_STEP = 0.02
"""Of the radius: how finely cones are cut into cylinders."""

OUTLINE_PLACES = 2000


def stick_solid(stick: Stick) -> tuple[Solid, tuple[Finish, ...]]:
    """A stick along x from 0 to its length, up is z; and the finishes that its faces name."""
    turned = TURNERS[stick.kind](stick, np.random.default_rng(stick.pattern_seed))
    whole = joined([turned_on_lathe(turned.sections, SIDES), *turned.extras])
    roll = np.radians(turned.roll_deg)
    cosine, sine = np.cos(roll), np.sin(roll)
    return whole.turned(np.array([[1, 0, 0], [0, cosine, -sine], [0, sine, cosine]])), turned.finishes


def placed_on(nodes: Points) -> tuple[Array, Array]:
    """Where a stick lies.

    Args:
        nodes: (N, 3) of its axis as it settled, straight but for micrometres.

    Returns:
        (3, 3), the world's directions of the stick's x, y and z as columns; and (3,) where its axis starts.
    """
    along = nodes[-1] - nodes[0]
    along = along / np.linalg.norm(along)
    across = np.cross([0.0, 0.0, 1.0], along)
    across /= np.linalg.norm(across)
    return np.stack([along, across, np.cross(along, across)], axis=1), nodes[0]


def stick_outline(stick: Stick, nodes: Points) -> list[tuple[Points, float]]:
    """The silhouette of a rendered stick, for labels: cylinders end to end.

    Args:
        stick: as drawn.
        nodes: (N, 3) of its axis as it settled.

    Returns:
        Curves (M, 3) with a radius each, metres; cones in steps of a fiftieth of the stick's radius.
    """
    turned = TURNERS[stick.kind](stick, np.random.default_rng(stick.pattern_seed))
    along = np.linspace(0.0, stick.length_m, OUTLINE_PLACES)
    radius = np.zeros_like(along)
    for each in turned.sections:
        radius = np.maximum(radius, _radius_along(each, along))
    step = OUTLINE_STEP * stick.diameter_m / 2
    level = np.rint(radius / step).astype(np.int64)
    starts = np.flatnonzero(np.diff(level, prepend=level[0] - 1))
    ends = np.append(starts[1:], len(along) - 1)
    axes, origin = placed_on(nodes)
    pieces: list[tuple[Points, float]] = []
    for start, end in zip(starts, ends, strict=True):
        if level[start] > 0 and end > start:
            places = np.linspace(along[start], along[end], max(2, round((along[end] - along[start]) / 0.005) + 1))
            pieces.append((origin + places[:, None] * axes[:, 0], float(radius[start:end].mean())))
    return pieces


def _radius_along(each: Section, places: Array) -> Array:
    """How far a section reaches to either side of the axis at places along it; 0 where it is not."""
    along = each.along_m if each.along_m.ndim == 1 else each.along_m.mean(axis=1)
    radius = each.radius_m if each.radius_m.ndim == 1 else each.radius_m.max(axis=1)
    if each.rippled:
        radius = np.full_like(radius, radius.mean())
    if along[0] > along[-1]:
        along, radius = along[::-1], radius[::-1]
    return np.interp(places, along, radius, left=0.0, right=0.0)
