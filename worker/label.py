"""Masks from the geometry itself: the cables' exact silhouettes, drawn in order of height. Pure numpy and OpenCV.

The camera is taken as a pinhole: depth of field blurs an edge to both sides alike and leaves its half-way line where
it is, so the mask is what a threshold of a half makes of a white-on-black render.
"""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from farm.lens import FOCAL_LENGTH_MM, SENSOR_MM
from worker.shapes import Points, tangents

SUBPIXELS = 8
"""Subdivisions of a pixel's edge; coverage is counted in 64ths."""

_FRACTION_BITS = 4

_BAND_PX = 512
"""Rows that are drawn at a time, which bounds the memory of large pictures."""


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


def label_cables(curves: list[Points], radii_m: NDArray[np.float64], view: View) -> Labels:
    """Label a picture.

    Args:
        curves: finely sampled centrelines (N, 3), metres.
        radii_m: (cables,), radius of each.
        view: the camera.

    Returns:
        The binary mask and the instances.
    """
    pieces = [_silhouette(curve, float(radius), view) for curve, radius in zip(curves, radii_m, strict=True)]
    heights = np.concatenate([piece.heights_m for piece in pieces])
    polygons = np.concatenate([piece.polygons_px for piece in pieces])
    cables = np.repeat(np.arange(len(pieces)), [len(piece.heights_m) for piece in pieces])
    order = np.argsort(heights, kind="stable")
    bands = [
        _label_band(polygons[order], cables[order] + 1, top, min(_BAND_PX, view.resolution - top), view.resolution)
        for top in range(0, view.resolution, _BAND_PX)
    ]
    return Labels(
        mask=np.concatenate([band.mask for band in bands]),
        instances=np.concatenate([band.instances for band in bands]),
    )


def _label_band(
    polygons_px: NDArray[np.float64], numbers: NDArray[np.int64], top: int, rows: int, resolution: int
) -> Labels:
    """Label `rows` rows of the picture from row `top` on, painting the polygons in the order given."""
    canvas = np.zeros((rows * SUBPIXELS, resolution * SUBPIXELS), np.uint8)
    shifted = polygons_px - [0.0, float(top)]
    low, high = shifted.min(axis=1), shifted.max(axis=1)
    seen = ((high >= 0) & (low <= [resolution, rows])).all(axis=1)
    # OpenCV counts from the middle of the first pixel, the picture from its corner.
    fixed = np.round((shifted * SUBPIXELS - 0.5) * 2**_FRACTION_BITS).astype(np.int32)
    for k in np.flatnonzero(seen):
        cv2.fillConvexPoly(canvas, fixed[k], (float(numbers[k]),), cv2.LINE_8, _FRACTION_BITS)
    return _downsample(canvas, int(numbers.max()), (resolution, rows))


@dataclass(frozen=True, slots=True)
class _Silhouette:
    """Outline of a cable in convex quads, with the height of each."""

    polygons_px: NDArray[np.float64]
    heights_m: NDArray[np.float64]


def _silhouette(curve: Points, radius_m: float, view: View) -> _Silhouette:
    """Where the rays from the camera touch the cable, on either side, pixel by pixel.

    For a point p of the axis with tangent t, let v be the part of (camera - p) across t and d its length. The touching
    points are p + r (r/d v/d +- sqrt(1 - r^2/d^2) t x v/d): the tangents from a point to a circle.
    """
    along = tangents(curve)
    to_camera = np.array([0.0, 0.0, view.height_m]) - curve
    across = to_camera - np.einsum("ij,ij->i", to_camera, along)[:, None] * along
    distance = np.linalg.norm(across, axis=1, keepdims=True)
    toward = across / distance
    sideways = np.cross(along, toward)
    ratio = radius_m / distance
    forward, lateral = radius_m * ratio * toward, radius_m * np.sqrt(1 - ratio**2) * sideways
    left, right = view.project(curve + forward + lateral), view.project(curve + forward - lateral)
    left, right = _inset(left, right)
    quads = np.stack([left[:-1], left[1:], right[1:], right[:-1]], axis=1)
    return _Silhouette(polygons_px=quads, heights_m=0.5 * (curve[:-1, 2] + curve[1:, 2]))


def _inset(left: NDArray[np.float64], right: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Move both edges inwards by half a subpixel, since OpenCV also fills the subpixels that an edge passes through."""
    outward = left - right
    outward /= np.linalg.norm(outward, axis=1, keepdims=True)
    step = 0.5 / SUBPIXELS * outward
    return left - step, right + step


def _downsample(canvas: NDArray[np.uint8], cables: int, size: tuple[int, int]) -> Labels:
    mask = _coverage(canvas > 0, size) >= _HALF
    best = np.zeros(mask.shape, np.uint8)
    instances = np.zeros(mask.shape, np.uint16)
    for cable in range(1, cables + 1):
        coverage = _coverage(canvas == cable, size)
        better = mask & (coverage > best)
        best[better] = coverage[better]
        instances[better] = cable
    return Labels(mask=np.where(mask, 255, 0).astype(np.uint8), instances=instances)


_HALF = 128


def _coverage(subpixels: NDArray[np.bool_], size: tuple[int, int]) -> NDArray[np.uint8]:
    """Share of each pixel, 0 to 255; `size` is (width, height). A half is 127.5, which OpenCV rounds to `_HALF`."""
    share = cv2.resize(subpixels.view(np.uint8) * np.uint8(255), size, interpolation=cv2.INTER_AREA)
    return share.astype(np.uint8, copy=False)
