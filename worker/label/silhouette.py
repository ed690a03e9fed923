"""The rendered pieces as a camera sees them: flat quads in order of distance. Pure numpy and OpenCV."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from worker.cable.piece import Convex, Piece
from worker.camera.view import View
from worker.curves import Points, tangents

_BAND_PIXELS = 2**18
"""Most pixels of a band of rows, whose quads are cut into scanlines at once; it bounds the memory."""


_UPRIGHT = 1e-6
"""Sine of the angle to the vertical below which a tube, a peg, is upright: its corners may then begin anywhere."""


@dataclass(frozen=True, slots=True)
class Silhouettes:
    """Cables as seen, in convex quads, the farthest first: a later one hides an earlier one.

    The distance is that from the eye to where a line of sight touches the ball that fits the tube there. Of two balls
    that do not meet, the one with the shorter tangent is the nearer on every line through both, whatever their sizes:
    the plane of equal tangents lies between them (Aurenhammer, SIAM J. Comput. 16(1), 1987).

    Attributes:
        quads_px: (N, 4, 2) corners in order around each.
        instances: (N,) numbers of the pieces; `worker.cable.piece.OCCLUDER` for a piece of no cable.
    """

    quads_px: NDArray[np.float64]
    instances: NDArray[np.int64]

    def bands(self, view: View) -> Iterator[tuple[slice, NDArray[np.float64], NDArray[np.int64]]]:
        """Bands of the picture's rows that bound the memory of large pictures, each with the quads in it.

        Yields:
            The rows; the quads (M, 4, 2), counted from the band's top; their instances (M,).
        """
        top, bottom = self.quads_px[:, :, 1].min(axis=1), self.quads_px[:, :, 1].max(axis=1)
        band = max(1, _BAND_PIXELS // view.resolution.width)
        for start in range(0, view.resolution.height, band):
            end = min(start + band, view.resolution.height)
            here = (bottom > start) & (top < end)
            yield slice(start, end), self.quads_px[here] - [0.0, float(start)], self.instances[here]


def silhouettes(pieces: Sequence[Piece], view: View, sides: int) -> Silhouettes:
    """The silhouettes of the rendered pieces.

    Args:
        pieces: the cables in pieces, and what hides them.
        view: the camera.
        sides: corners of the rendered tubes' cross-section, an even number; 20 are up to 0.6 % wider or narrower than
            a circle.
    """
    if not pieces:
        return Silhouettes(np.zeros((0, 4, 2)), np.zeros(0, np.int64))
    seen = [
        _outline(piece, view) if isinstance(piece, Convex) else _silhouette(piece.curve, piece.radius_m, view, sides)
        for piece in pieces
    ]
    distances = np.concatenate([distances for _, distances in seen])
    instances = np.repeat([piece.instance for piece in pieces], [len(distances) for _, distances in seen])
    order = np.argsort(-distances, kind="stable")
    return Silhouettes(np.concatenate([quads for quads, _ in seen])[order], instances[order])


def _outline(solid: Convex, view: View) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The convex hull of a solid's corners as seen, in quads that share a corner, all at the distance of the solid.

    A solid around cables has the distance of its farthest corner; the part of its side that is seen lies before them.
    """
    corners = solid.rings.reshape(-1, 3)
    if corners[:, 2].max() >= view.position_m[2]:
        return np.zeros((0, 4, 2)), np.zeros(0)
    seen = view.project(corners)
    hull = seen[cv2.convexHull(seen.astype(np.float32), returnPoints=False)[:, 0]]
    starts = np.arange(1, len(hull) - 1, 2)
    fan = np.stack([np.zeros_like(starts), starts, starts + 1, np.minimum(starts + 2, len(hull) - 1)], axis=1)
    if not solid.around:
        return hull[fan], np.full(len(fan), np.linalg.norm(view.eye_m - solid.place_m))
    side = _side(seen.reshape(*solid.rings.shape[:2], 2))
    away = np.linalg.norm(view.eye_m - corners, axis=1)
    distances = np.repeat([away.max(), away.min()], [len(fan), len(side)])
    return np.concatenate([hull[fan], side]), distances


def _side(rings_px: NDArray[np.float64]) -> NDArray[np.float64]:
    """The quads between rings as seen (rings, points of each, 2) that face the camera."""
    beside = np.roll(rings_px, -1, axis=1)
    quads = np.stack([rings_px[:-1], rings_px[1:], beside[1:], beside[:-1]], axis=2).reshape(-1, 4, 2)
    one, other = quads[:, 2] - quads[:, 0], quads[:, 3] - quads[:, 1]
    facing: NDArray[np.float64] = quads[one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0] < 0]  # rows count downwards
    return facing


def _silhouette(
    curve: Points, radius_m: float | NDArray[np.float64], view: View, sides: int
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The tube between its outermost corners on either side, ring by ring, and its ends: quads and their distances.

    For a point p of the axis with tangent t, let v be the part of (camera - p) across t and d its length. A ray from
    the camera touches a round cable at p + r (r/d v/d +- sqrt(1 - r^2/d^2) t x v/d), the tangents from a point to a
    circle, and the tube at the corner that lies nearest in angle.
    """
    along = tangents(curve)
    across = np.cross(along, [0.0, 0.0, 1.0])
    upright = np.linalg.norm(across, axis=1) < _UPRIGHT
    across[upright] = np.cross(along[upright], [1.0, 0.0, 0.0])
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    up = np.cross(across, along)
    to_camera = view.eye_m - curve
    x, y = np.einsum("ij,ij->i", to_camera, across), np.einsum("ij,ij->i", to_camera, up)
    toward, half = np.arctan2(y, x), np.arccos(np.minimum(radius_m / np.maximum(np.hypot(x, y), 1e-12), 1.0))
    step = 2 * np.pi / sides
    corner_radius = np.broadcast_to(2 * radius_m / (1 + np.cos(np.pi / sides)), len(curve))[:, None]

    def corners(angles: NDArray[np.float64], ring: slice) -> Points:
        sideways, upwards = np.cos(angles)[:, None] * across[ring], np.sin(angles)[:, None] * up[ring]
        place: Points = curve[ring] + corner_radius[ring] * (sideways + upwards)
        return place

    tangent = np.sqrt(np.maximum(np.einsum("ij,ij->i", to_camera, to_camera) - np.square(radius_m), 0.0))
    touching = [step * np.round((toward + side * half) / step) for side in (1, -1)]
    strips = [(corners(touching[0], slice(None)), corners(touching[1], slice(None)), tangent)]
    # An end is a polygon: its corners, paired from one side to the other, make a strip of quads.
    angles = step * np.arange(sides // 2)
    strips += [
        (corners(angles, ring), corners(-angles - step, ring), np.broadcast_to(tangent[ring], len(angles)))
        for ring in (slice(0, 1), slice(-1, None))
    ]
    quads, distances = zip(*(_quads(left, right, away, view) for left, right, away in strips), strict=True)
    return np.concatenate(quads), np.concatenate(distances)


def _quads(
    left: Points, right: Points, away_m: NDArray[np.float64], view: View
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The strip between two lines of points (N, 3) in quads (N - 1, 4, 2) px, with the distance of each (N - 1,).

    Quads that are not in front of the camera are left out, since they have no picture.
    """
    seen = np.minimum(view.depths_m(left), view.depths_m(right)) > 0.0
    kept = seen[:-1] & seen[1:]
    with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
        left_px, right_px = view.project(left), view.project(right)
    quads = np.stack([left_px[:-1], left_px[1:], right_px[1:], right_px[:-1]], axis=1)
    return quads[kept], 0.5 * (away_m[:-1] + away_m[1:])[kept]
