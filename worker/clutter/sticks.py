"""Builds the meshes of sticks, and their outlines for the labels. Pure numpy."""

import numpy as np

from farm.scene.clutter import Stick
from worker.clutter.solid import SIDES, Array, Finish, Section, Solid, joined, turned_on_lathe
from worker.clutter.stick_kinds import TURNERS
from worker.curves import Points

OUTLINE_STEP = 0.02
"""Difference of radius between the cylinders that stand for a cone in an outline, as a share of the stick's radius."""

OUTLINE_PLACES = 2000
"""Number of places along a stick at which its outline's radius is found."""


def stick_solid(stick: Stick) -> tuple[Solid, tuple[Finish, ...]]:
    """Build a stick whose axis is x, from 0 to its length, with z up.

    Returns:
        The mesh, and the finishes that its faces number.
    """
    turned = TURNERS[stick.kind](stick, np.random.default_rng(stick.pattern_seed))
    whole = joined([turned_on_lathe(turned.sections, SIDES), *turned.extras])
    roll = np.radians(turned.roll_deg)
    cosine, sine = np.cos(roll), np.sin(roll)
    return whole.turned(np.array([[1, 0, 0], [0, cosine, -sine], [0, sine, cosine]])), turned.finishes


def placed_on(nodes: Points) -> tuple[Array, Array]:
    """Find the position of a settled stick.

    Args:
        nodes: (N, 3) nodes of its settled axis, in metres, straight but for micrometres.

    Returns:
        (3, 3), whose columns are the directions of the stick's x, y and z in the world; and (3,), the start of its axis
        in metres.
    """
    along = nodes[-1] - nodes[0]
    along = along / np.linalg.norm(along)
    across = np.cross([0.0, 0.0, 1.0], along)
    across /= np.linalg.norm(across)
    return np.stack([along, across, np.cross(along, across)], axis=1), nodes[0]


def stick_outline(stick: Stick, nodes: Points) -> list[tuple[Points, float]]:
    """Compute the silhouette of a rendered stick for labels, as cylinders end to end.

    Args:
        stick: sampled stick.
        nodes: (N, 3) nodes of its settled axis, in metres.

    Returns:
        The axis (M, 3) and the radius of each cylinder, in metres; the cylinders of a cone differ by a fiftieth of the
        stick's radius.
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
    """Compute a section's radius at places (N,) along the axis, in metres; 0 where the section is not."""
    along = each.along_m if each.along_m.ndim == 1 else each.along_m.mean(axis=1)
    radius = each.radius_m if each.radius_m.ndim == 1 else each.radius_m.max(axis=1)
    if each.rippled:
        radius = np.full_like(radius, radius.mean())
    if along[0] > along[-1]:
        along, radius = along[::-1], radius[::-1]
    return np.interp(places, along, radius, left=0.0, right=0.0)
