"""Meshes of cables and of their ties. Pure numpy.

A cable is a round tube that is swept along its smooth centreline and cut flat at the ends; a solid of a tie lies
between rings of points.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from worker.curves import Points, tangents


@dataclass(frozen=True, slots=True)
class Tube:
    """A mesh of quads, with one polygon at either end.

    The ends have their own vertices, so that a mesh with smooth shading is round along the side and flat at the ends.

    Attributes:
        vertices_m: ((rings + 2) * sides, 3) float32, metres; the last two rings are those of the ends.
        corners: (loops,) int32, number of the vertex at each corner, face after face.
        face_starts: (faces,) int32, number of each face's first corner; a face has 4 corners, each end `sides`.
        uvs: (loops, 2) float32, texture coordinates at each corner; see `sweep` and `loft`.
    """

    vertices_m: NDArray[np.float32]
    corners: NDArray[np.int32]
    face_starts: NDArray[np.int32]
    uvs: NDArray[np.float32]


def sweep(curve: Points, radius_m: float | NDArray[np.float64], sides: int, *, start_m: float = 0.0) -> Tube:
    """Sweep a circle along a finely sampled curve.

    Args:
        curve: (N, 3) metres, nowhere vertical.
        radius_m: radius of the cable, or (N,), radius at each point, in metres.
        sides: number of sides of the polygon that stands for the circle. Its corners lie as far outside the circle as
            the middles of its sides lie inside, so that the silhouette is right on average.
        start_m: place along the cable at which the curve starts, in metres.

    Returns:
        The tube's mesh. Its texture coordinates are metres along the cable and metres around it, in the circumference
        of the mean radius.
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
    """Join rings of points by a skin, with a flat end at the first and the last ring.

    Args:
        rings: (rings, points of a ring, 3) metres.

    Returns:
        The mesh. Its texture coordinates are the number of the ring, and the share of the way around it.
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
    """Compute what the curve does not change: `corners`, `face_starts`, and the ring and side of each quad corner."""
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
        array.setflags(write=False)  # calls share them
    return arrays


def frames(curve: Points) -> tuple[Points, Points]:
    """Compute the cross-section's axes at each point of a curve.

    Args:
        curve: (N, 3) metres, finely sampled, nowhere vertical.

    Returns:
        (N, 3), unit vectors sideways, which are level, and (N, 3), unit vectors up, across those and the tangent.
    """
    along = tangents(curve)
    across = np.cross(along, [0.0, 0.0, 1.0])
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    return across, np.cross(across, along)
