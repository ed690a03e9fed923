"""A cable's render geometry: a round tube swept along its smooth centreline, cut flat at the ends. Pure numpy.

And that of small solids between rings of points, as of cable ties.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from worker.curves import Points, tangents


@dataclass(frozen=True, slots=True)
class Tube:
    """A mesh of quads, with one polygon at either end.

    The ends have vertices of their own, so that a mesh shaded smooth is round along the side and flat at the ends.

    Attributes:
        vertices_m: ((rings + 2) * sides, 3) float32; the last two rings are those of the ends.
        corners: (loops,) int32, vertex of each face corner, faces one after the other.
        face_starts: (faces,) int32, the first corner of each face; 4 corners each, and `sides` for the two ends.
        uvs: (loops, 2) float32: metres along the cable and around it.
    """

    vertices_m: NDArray[np.float32]
    corners: NDArray[np.int32]
    face_starts: NDArray[np.int32]
    uvs: NDArray[np.float32]


def sweep(curve: Points, radius_m: float | NDArray[np.float64], sides: int, *, start_m: float = 0.0) -> Tube:
    """Sweep a circle along a finely sampled curve.

    Args:
        curve: (N, 3) metres; nowhere vertical.
        radius_m: of the cable, or (N,) at each point; the texture then has the mean circumference.
        sides: of the polygon that stands for the circle. Its corners lie outside the circle by as much as the
            middles of its sides lie inside, so that the silhouette is right on average.
        start_m: how far along the cable the curve starts.

    Returns:
        The tube's mesh.
    """
    across, up = frames(curve)
    angle = 2 * np.pi * np.arange(sides) / sides
    corner_radius = np.reshape(2 * radius_m / (1 + np.cos(np.pi / sides)), (-1, 1, 1))
    circle = np.stack([np.cos(angle), np.sin(angle)])[..., None]
    rings = curve[:, None] + corner_radius * circle[0] * across[:, None] + corner_radius * circle[1] * up[:, None]
    vertices = np.concatenate([rings, rings[[0, -1]]]).reshape(-1, 3)
    mean_radius_m, first_m, last_m = np.mean(radius_m), np.ravel(radius_m)[0], np.ravel(radius_m)[-1]
    corners, face_starts, steps, turns = _topology(len(curve), sides)
    arc = start_m + np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=1))])
    uvs = np.empty((len(corners), 2), np.float32)
    uvs[: len(steps), 0] = arc[steps]
    uvs[: len(steps), 1] = (2 * np.pi * mean_radius_m / sides) * turns
    end = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    uvs[-2 * sides : -sides] = first_m * end + np.array([start_m, 0.0])
    uvs[-sides:] = last_m * end[::-1] + np.array([arc[-1], 0.0])
    return Tube(vertices_m=vertices.astype(np.float32), corners=corners, face_starts=face_starts, uvs=uvs)


def loft(rings: NDArray[np.float64]) -> Tube:
    """The skin between rings of points, and a flat end at the first and the last.

    Args:
        rings: (rings, points of each, 3) metres.
    """
    sides = rings.shape[1]
    corners, face_starts, steps, turns = _topology(len(rings), sides)
    uvs = np.zeros((len(corners), 2), np.float32)
    uvs[: len(steps)] = np.stack([steps, turns / sides], axis=1)
    vertices = np.concatenate([rings, rings[[0, -1]]]).reshape(-1, 3).astype(np.float32)
    return Tube(vertices_m=vertices, corners=corners, face_starts=face_starts, uvs=uvs)


@lru_cache(maxsize=64)
def _topology(
    rings: int, sides: int
) -> tuple[NDArray[np.int32], NDArray[np.int32], NDArray[np.int32], NDArray[np.int32]]:
    """What does not depend on the curve: `corners`, `face_starts`, and ring and side of each quad's corner."""
    ring, side = np.meshgrid(np.arange(rings - 1), np.arange(sides), indexing="ij")
    ring, side = ring[..., None] + np.array([0, 1, 1, 0]), side[..., None] + np.array([0, 0, 1, 1])
    quads = (ring * sides + side % sides).reshape(-1)
    first_end = rings * sides + np.arange(sides)
    last_end = (rings + 1) * sides + np.arange(sides)[::-1]
    sizes = np.concatenate([np.full((rings - 1) * sides, 4), [sides, sides]])
    arrays = (
        np.concatenate([quads, first_end, last_end]).astype(np.int32),
        np.concatenate([[0], np.cumsum(sizes)[:-1]]).astype(np.int32),
        ring.reshape(-1).astype(np.int32),
        side.reshape(-1).astype(np.int32),
    )
    for array in arrays:
        array.setflags(write=False)  # they are shared
    return arrays


def frames(curve: Points) -> tuple[Points, Points]:
    """Level sideways direction and the one across it and the tangent, at each point; right-handed, without twist."""
    along = tangents(curve)
    across = np.cross(along, [0.0, 0.0, 1.0])
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    return across, np.cross(across, along)
