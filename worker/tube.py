"""A cable's render geometry: a round tube swept along its smooth centreline, cut flat at the ends. Pure numpy."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from worker.shapes import Points, tangents


@dataclass(frozen=True, slots=True)
class Tube:
    """A mesh of quads, with one polygon at either end.

    Attributes:
        vertices_m: (rings * sides, 3) float32.
        corners: (loops,) int32, vertex of each face corner, faces one after the other.
        face_sizes: (faces,) int32, corners of each face: 4, or `sides` for the two ends.
        uvs: (loops, 2) float32: metres along the cable and around it.
        normals: (loops, 3) float32 unit normals: round along the side, flat at the ends.
    """

    vertices_m: NDArray[np.float32]
    corners: NDArray[np.int32]
    face_sizes: NDArray[np.int32]
    uvs: NDArray[np.float32]
    normals: NDArray[np.float32]


def sweep(curve: Points, radius_m: float, sides: int) -> Tube:
    """Sweep a circle along a finely sampled curve.

    Args:
        curve: (N, 3) metres; nowhere vertical.
        radius_m: of the cable.
        sides: of the polygon that stands for the circle. Its corners lie outside the circle by as much as the
            middles of its sides lie inside, so that the silhouette is right on average.

    Returns:
        The tube's mesh.
    """
    along, across, up = _frames(curve)
    angle = 2 * np.pi * np.arange(sides) / sides
    outward = np.cos(angle)[None, :, None] * across[:, None] + np.sin(angle)[None, :, None] * up[:, None]
    corner_radius = 2 * radius_m / (1 + np.cos(np.pi / sides))
    vertices = (curve[:, None] + corner_radius * outward).reshape(-1, 3)
    rings = len(curve)
    ring, side = np.meshgrid(np.arange(rings - 1), np.arange(sides), indexing="ij")
    next_side = (side + 1) % sides
    quads = np.stack(
        [ring * sides + side, (ring + 1) * sides + side, (ring + 1) * sides + next_side, ring * sides + next_side],
        axis=-1,
    ).reshape(-1)
    first_end = np.arange(sides)
    last_end = (rings - 1) * sides + np.arange(sides)[::-1]
    arc = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=1))])
    girth = 2 * np.pi * radius_m / sides
    quad_uvs = np.stack(
        [
            np.stack([arc[ring], girth * side], axis=-1),
            np.stack([arc[ring + 1], girth * side], axis=-1),
            np.stack([arc[ring + 1], girth * (side + 1)], axis=-1),
            np.stack([arc[ring], girth * (side + 1)], axis=-1),
        ],
        axis=2,
    ).reshape(-1, 2)
    end_uvs = radius_m * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return Tube(
        vertices_m=vertices.astype(np.float32),
        corners=np.concatenate([quads, first_end, last_end]).astype(np.int32),
        face_sizes=np.concatenate([np.full((rings - 1) * sides, 4), [sides, sides]]).astype(np.int32),
        uvs=np.concatenate([quad_uvs, end_uvs, end_uvs[::-1] + np.array([arc[-1], 0.0])]).astype(np.float32),
        normals=np.concatenate(
            [outward.reshape(-1, 3)[quads], np.tile(-along[0], (sides, 1)), np.tile(along[-1], (sides, 1))]
        ).astype(np.float32),
    )


def _frames(curve: Points) -> tuple[Points, Points, Points]:
    """Tangent, level sideways direction and the third axis at each point; right-handed, without twist of its own."""
    along = tangents(curve)
    across = np.cross(along, [0.0, 0.0, 1.0])
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    return along, across, np.cross(across, along)
