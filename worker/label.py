"""Masks from the geometry itself: the silhouettes of the rendered tubes, drawn in order of height. Pure numpy.

The camera is taken as a pinhole in the middle of the lens. Opposite points of the lens see an edge moved to opposite
sides by the same, so that depth of field leaves its half-way line, and with it the mask, where the pinhole sees it.
What is left out: blur fills narrow gaps, of a pixel or so, between cables well above the floor, where the focus is.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from farm.lens import FOCAL_LENGTH_MM, SENSOR_MM
from worker.coverage import cover
from worker.shapes import Points, tangents

_BAND_PIXELS = 2**18
"""Pixels that are labelled at a time, which bounds the memory of large pictures."""


@dataclass(frozen=True, slots=True)
class View:
    """A pinhole camera straight above the origin.

    Attributes:
        height_m: above the floor.
        resolution: pixels on each edge of the square picture.
    """

    height_m: float
    resolution: int

    def project(self, points: Points) -> NDArray[np.float64]:
        """Pixel coordinates (N, 2) of points (N, 3); the top left corner of the picture is (0, 0)."""
        focal_px = self.resolution * FOCAL_LENGTH_MM / SENSOR_MM
        scale = focal_px / (self.height_m - points[:, 2])
        return np.stack(
            [self.resolution / 2 + scale * points[:, 0], self.resolution / 2 - scale * points[:, 1]], axis=1
        )


@dataclass(frozen=True, slots=True)
class Labels:
    """Labels of one picture.

    Attributes:
        mask: (H, W) uint8: 255 where cables cover at least half of the pixel, else 0.
        instances: (H, W) uint16: in the mask, 1 + the number of the cable that covers most of it; else 0.
    """

    mask: NDArray[np.uint8]
    instances: NDArray[np.uint16]


def label_cables(curves: list[Points], radii_m: NDArray[np.float64], view: View, sides: int) -> Labels:
    """Label a picture.

    Args:
        curves: finely sampled centrelines (N, 3), metres.
        radii_m: (cables,), radius of each.
        view: the camera.
        sides: corners of the rendered tubes' cross-section, an even number; 20 are up to 0.6 % wider or narrower than
            a circle.

    Returns:
        The binary mask and the instances.
    """
    pieces = [_silhouette(curve, float(radius), view, sides) for curve, radius in zip(curves, radii_m, strict=True)]
    heights = np.concatenate([piece.heights_m for piece in pieces])
    cables = np.repeat(np.arange(len(pieces)), [len(piece.heights_m) for piece in pieces])
    order = np.argsort(heights, kind="stable")
    quads, numbers = np.concatenate([piece.quads_px for piece in pieces])[order], cables[order] + 1
    top, bottom = quads[:, :, 1].min(axis=1), quads[:, :, 1].max(axis=1)
    band = max(1, _BAND_PIXELS // view.resolution)
    instances = np.zeros((view.resolution, view.resolution), np.uint16)
    for start in range(0, view.resolution, band):
        end = min(start + band, view.resolution)
        here = (bottom > start) & (top < end)
        instances[start:end] = cover(quads[here] - [0.0, float(start)], numbers[here], end - start, view.resolution)
    return Labels(mask=(instances > 0) * np.uint8(255), instances=instances)


@dataclass(frozen=True, slots=True)
class _Silhouette:
    """Silhouette of a cable in convex quads, (N, 4, 2), with the height of each, (N,)."""

    quads_px: NDArray[np.float64]
    heights_m: NDArray[np.float64]


def _silhouette(curve: Points, radius_m: float, view: View, sides: int) -> _Silhouette:
    """The tube between its outermost corners on either side, ring by ring, and its flat ends.

    For a point p of the axis with tangent t, let v be the part of (camera - p) across t and d its length. A ray from
    the camera touches a round cable at p + r (r/d v/d +- sqrt(1 - r^2/d^2) t x v/d), the tangents from a point to a
    circle, and the tube at the corner that lies nearest in angle.
    """
    along = tangents(curve)
    across = np.cross(along, [0.0, 0.0, 1.0])
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    up = np.cross(across, along)
    to_camera = np.array([0.0, 0.0, view.height_m]) - curve
    x, y = np.einsum("ij,ij->i", to_camera, across), np.einsum("ij,ij->i", to_camera, up)
    toward, half = np.arctan2(y, x), np.arccos(np.minimum(radius_m / np.hypot(x, y), 1.0))
    step = 2 * np.pi / sides
    corner_radius = 2 * radius_m / (1 + np.cos(np.pi / sides))

    def corners(angles: NDArray[np.float64], ring: slice) -> Points:
        sideways, upwards = np.cos(angles)[:, None] * across[ring], np.sin(angles)[:, None] * up[ring]
        place: Points = curve[ring] + corner_radius * (sideways + upwards)
        return place

    touching = [step * np.round((toward + side * half) / step) for side in (1, -1)]
    strips = [(corners(touching[0], slice(None)), corners(touching[1], slice(None)))]
    # An end is a polygon: its corners, paired from one side to the other, make a strip of quads.
    angles = step * np.arange(sides // 2)
    strips += [(corners(angles, ring), corners(-angles - step, ring)) for ring in (slice(0, 1), slice(-1, None))]
    quads, heights = zip(*(_quads(left, right, view) for left, right in strips), strict=True)
    return _Silhouette(quads_px=np.concatenate(quads), heights_m=np.concatenate(heights))


def _quads(left: Points, right: Points, view: View) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The strip between two lines of points (N, 3) in quads (N - 1, 4, 2) px, with the height of each (N - 1,).

    What reaches up to the camera is left out, for it has no picture.
    """
    middle = 0.5 * (left[:, 2] + right[:, 2])
    seen = np.maximum(left[:, 2], right[:, 2]) < view.height_m
    kept = seen[:-1] & seen[1:]
    with np.errstate(divide="ignore", over="ignore"):
        left_px, right_px = view.project(left), view.project(right)
    quads = np.stack([left_px[:-1], left_px[1:], right_px[1:], right_px[:-1]], axis=1)
    return quads[kept], 0.5 * (middle[:-1] + middle[1:])[kept]
