"""The points and faces of simple solids, in numpy."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]
Faces = tuple[NDArray[np.int64], ...]


@dataclass(frozen=True, slots=True)
class Solid:
    """A solid: points (N, 3) in metres, faces as index arrays (M, K), and whether they are shaded as if curved."""

    points: Points
    faces: Faces
    smooth: bool = False


@dataclass(frozen=True, slots=True)
class BoxTemplate:
    """A box of any size.

    Attributes:
        signs: signs of the corners' coordinates, (N, 3).
        outer: whether a corner reaches the box's full extent along each axis, (N, 3); along the others a chamfer
            sets it back.
        faces: index arrays (M, K).
    """

    signs: Points
    outer: NDArray[np.bool_]
    faces: Faces


def _outward(points: Points, face: Sequence[int]) -> list[int]:
    """Order the corners of a convex face so that it faces away from the origin, which lies inside the solid."""
    corners = points[list(face)]
    middle = corners.mean(axis=0)
    across = np.linalg.svd(corners - middle)[2]
    angles = np.arctan2((corners - middle) @ across[1], (corners - middle) @ across[0])
    ring = [face[place] for place in np.argsort(angles)]
    a, b, c = points[ring[0]], points[ring[1]], points[ring[2]]
    return ring if np.dot(np.cross(b - a, c - b), middle) > 0 else ring[::-1]


def _box_template(*, chamfered: bool) -> BoxTemplate:
    corners = list(product((-1.0, 1.0), repeat=3))
    if not chamfered:
        signs = np.array(corners)
        faces = [
            _outward(signs, [n for n, corner in enumerate(corners) if corner[axis] == side])
            for axis in range(3)
            for side in (-1.0, 1.0)
        ]
        return BoxTemplate(signs, np.ones((8, 3), bool), (np.array(faces),))
    signs = np.repeat(np.array(corners), 3, axis=0)
    outer = np.tile(np.eye(3, dtype=bool), (8, 1))
    points = signs * np.where(outer, 1.0, 0.8)
    index = {(corner, axis): 3 * n + axis for n, corner in enumerate(corners) for axis in range(3)}
    quads = []
    for axis, side in product(range(3), (-1.0, 1.0)):
        quads.append([index[corner, axis] for corner in corners if corner[axis] == side])
    for axis in range(3):
        one, two = (other for other in range(3) if other != axis)
        for first, second in product((-1.0, 1.0), repeat=2):
            ends = [corner for corner in corners if corner[one] == first and corner[two] == second]
            quads.append([index[corner, other] for corner in ends for other in (one, two)])
    triangles = [[index[corner, axis] for axis in range(3)] for corner in corners]
    return BoxTemplate(
        signs,
        outer,
        (
            np.array([_outward(points, quad) for quad in quads]),
            np.array([_outward(points, triangle) for triangle in triangles]),
        ),
    )


CUBE = _box_template(chamfered=False)
CHAMFERED = _box_template(chamfered=True)


def turned(x: float, y: float, z: float, turn: float = 0.0, lean: float = 0.0) -> Points:
    """Make a matrix (4, 4): lean about x, then turn about the vertical, then move to x, y, z; degrees and metres."""
    c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    cl, sl = math.cos(math.radians(lean)), math.sin(math.radians(lean))
    return np.array(
        [[c, -s * cl, s * sl, x], [s, c * cl, -c * sl, y], [0.0, sl, cl, z], [0.0, 0.0, 0.0, 1.0]], np.float64
    )


def lathed(profile: Sequence[tuple[float, float]], axis: str, sides: int) -> Iterator[Solid]:
    """Make a body of revolution: a smooth mantle, and its flat ends as solids of their own.

    Args:
        profile: radius and distance along the axis of each ring, metres.
        axis: "x", "y" or "z".
        sides: number of sides of the polygon that stands for the circle.
    """
    angle = np.arange(sides) * 2 * np.pi / sides
    circle = np.column_stack([np.cos(angle), np.sin(angle)])
    rings = np.stack([np.column_stack([circle * max(r, 1e-5), np.full(sides, h)]) for r, h in profile])
    order = {"x": [2, 0, 1], "y": [1, 2, 0], "z": [0, 1, 2]}[axis]
    rings = rings[..., order]
    around = np.arange(sides)
    after = (around + 1) % sides
    mantle = np.concatenate(
        [
            np.column_stack([around, after, after + sides, around + sides]) + level * sides
            for level in range(len(profile) - 1)
        ]
    )
    yield Solid(rings.reshape(-1, 3), (mantle,), smooth=True)
    for end, ring in ((0, around[::-1]), (-1, around)):
        if profile[end][0] > 1e-4:
            yield Solid(rings[end], (ring[None, :],))


def swept(points: Points, radius: float, sides: int = 7) -> Solid:
    """Make a tube along points (N, 3); its rings follow one another without twist."""
    along = np.gradient(points, axis=0)
    along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-9)
    side = np.cross(along[0], [0.0, 0.0, 1.0] if abs(along[0, 2]) < 0.9 else [1.0, 0.0, 0.0])
    angle = np.arange(sides) * 2 * np.pi / sides
    rings = []
    for place, direction in zip(points, along, strict=True):
        side = side - direction * np.dot(side, direction)
        side /= max(float(np.linalg.norm(side)), 1e-9)
        other = np.cross(direction, side)
        rings.append(place + radius * (np.cos(angle)[:, None] * side + np.sin(angle)[:, None] * other))
    around = np.arange(sides)
    after = (around + 1) % sides
    quads = [
        np.column_stack([around, after, after + sides, around + sides]) + level * sides
        for level in range(len(points) - 1)
    ]
    return Solid(np.concatenate(rings), (np.concatenate(quads),), smooth=True)


def hanging(start: Sequence[float], end: Sequence[float], sag: float, count: int = 9) -> Points:
    """Compute points (count, 3) of a cable that sags by `sag` metres in the middle between two ends."""
    share = np.linspace(0.0, 1.0, count)[:, None]
    points: Points = np.array(start) * (1 - share) + np.array(end) * share
    points[:, 2] -= 4 * sag * (share * (1 - share))[:, 0]
    return points
