"""A cable as a strip of cloth: a zigzag of single triangles, and back."""

import numpy as np
from numpy.typing import NDArray

from worker.curves import Points

Faces = list[tuple[int, int, int]]


def zigzag(path: Points, width: float) -> Points:
    """Nodes (N, 3) of a level path, moved alternately left and right by half of `width`."""
    direction = np.gradient(path[:, :2], axis=0)
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    side = np.where(np.arange(len(path)) % 2 == 0, -0.5, 0.5)[:, None] * width
    vertices = path.copy()
    vertices[:, 0] -= side[:, 0] * direction[:, 1]
    vertices[:, 1] += side[:, 0] * direction[:, 0]
    return vertices


def zigzag_faces(nodes: int, first: int) -> Faces:
    """Triangles of a zigzag of `nodes` vertices, the first of which has number `first`, all facing up."""
    return [
        (first + k, first + k + 1, first + k + 2) if k % 2 else (first + k, first + k + 2, first + k + 1)
        for k in range(nodes - 2)
    ]


def centreline(vertices: NDArray[np.float64]) -> Points:
    """The middle line of a zigzag (N, 3): N nodes, the ends extrapolated in a straight line.

    The weights 1/4, 1/2, 1/4 cancel an alternating sideways offset exactly.
    """
    middle = np.empty_like(vertices)
    middle[1:-1] = 0.25 * vertices[:-2] + 0.5 * vertices[1:-1] + 0.25 * vertices[2:]
    middle[0] = 2 * middle[1] - middle[2]
    middle[-1] = 2 * middle[-2] - middle[-3]
    return middle


def ladder(path: Points, width: float) -> Points:
    """Two corners (2 N, 3) for each node of a level path (N, 3): `width` apart, one after the other."""
    direction = np.gradient(path[:, :2], axis=0)
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    side = 0.5 * width * np.stack([-direction[:, 1], direction[:, 0], np.zeros(len(path))], axis=1)
    corners: Points = np.stack([path - side, path + side], axis=1).reshape(-1, 3)
    return corners


def ladder_faces(nodes: int) -> list[tuple[int, int, int, int]]:
    """Quads of a ladder of `nodes` rungs, all facing up."""
    return [(2 * k, 2 * k + 2, 2 * k + 3, 2 * k + 1) for k in range(nodes - 1)]
