"""Thin strokes that wrap round the tile: scratches, hairs, blades and needles."""

from collections.abc import Callable, Sequence

import cv2
import numpy as np
import numpy.typing as npt

from assets.surfaces.kit.grid import Field, Grid

SUBTEXEL_BITS = 4
"""Fractional bits of the positions handed to OpenCV's drawing functions: a sixteenth of a texel."""

Image = npt.NDArray[np.uint8]
Corners = npt.NDArray[np.int32]


def polylines(
    image: Image, path_mm: npt.NDArray[np.float64], width_mm: float, value: Sequence[float], grid: Grid
) -> None:
    """Draw an open line on an image of the tile, in place; what leaves the tile enters at the opposite edge.

    Args:
        image: Image of the tile, shape (H, W) or (H, W, C).
        path_mm: Corners x, y in millimetres, shape (n, 2); the line spans less than the tile.
        width_mm: Width of the line; at least one texel is drawn.
        value: Value to write, 0 to 255, one per channel.
        grid: The tile.
    """
    thickness = max(1, round(width_mm / grid.texel_mm))

    def draw(target: Image, corners: Corners) -> None:
        cv2.polylines(target, [corners], False, tuple(value), thickness, cv2.LINE_AA, SUBTEXEL_BITS)

    _draw_wrapped(image, path_mm / grid.texel_mm, thickness, draw)


def polygon(image: Image, corners_mm: npt.NDArray[np.float64], value: Sequence[float], grid: Grid) -> None:
    """Fill a polygon on an image of the tile, in place; what leaves the tile enters at the opposite edge.

    Args:
        image: Image of the tile, shape (H, W) or (H, W, C).
        corners_mm: Corners x, y in millimetres, shape (n, 2); the polygon is smaller than the tile.
        value: Value to write, 0 to 255, one per channel.
        grid: The tile.
    """

    def draw(target: Image, corners: Corners) -> None:
        cv2.fillPoly(target, [corners], tuple(value), cv2.LINE_AA, SUBTEXEL_BITS)

    _draw_wrapped(image, corners_mm / grid.texel_mm, 0, draw)


def curve(
    rng: np.random.Generator, start_mm: Sequence[float], length_mm: float, bend: float, points: int = 7
) -> npt.NDArray[np.float64]:
    """Draw a smooth random curve.

    Args:
        rng: Source of the randomness.
        start_mm: First point x, y.
        length_mm: Length along the curve.
        bend: Standard deviation of the total turn, radians.
        points: Number of corners of the result.

    Returns:
        Corners in millimetres, shape (points, 2).
    """
    heading = rng.uniform(0, 2 * np.pi) + np.linspace(0, 1, points - 1) * rng.normal(0, bend)
    steps = np.stack([np.cos(heading), np.sin(heading)], axis=1) * length_mm / (points - 1)
    return np.concatenate([[start_mm], np.asarray(start_mm) + np.cumsum(steps, axis=0)])


def as_field(image: Image) -> Field:
    """Turn an image of 8 bits into a field from 0 to 1."""
    return image.astype(np.float32) / np.float32(255.0)


def _draw_wrapped(
    image: Image, path: npt.NDArray[np.float64], thickness: int, draw: Callable[[Image, Corners], None]
) -> None:
    """Draw a path given in texels.

    A path near the tile's edge is drawn on a patch that wraps round the edge, and the patch is put back. OpenCV smooths
    lines wrongly in an image's first row and column, so a path is never drawn right up to the image's edge.
    """
    margin = thickness + 3
    low = np.floor(path.min(axis=0)).astype(np.int64) - margin
    high = np.ceil(path.max(axis=0)).astype(np.int64) + margin
    pixels = image.shape[0]
    if low.min() >= 0 and high.max() <= pixels:
        draw(image, _fixed_point(path))
        return
    where = np.ix_(np.arange(low[1], high[1]) % pixels, np.arange(low[0], high[0]) % pixels)
    patch = np.ascontiguousarray(image[where])
    draw(patch, _fixed_point(path - low))
    image[where] = patch


def _fixed_point(path: npt.NDArray[np.float64]) -> Corners:
    """Convert texel coordinates to OpenCV's fixed point.

    Integers lie between texels here, and on the centres of texels in OpenCV.
    """
    return np.asarray(np.rint((path - 0.5) * 2**SUBTEXEL_BITS), np.int32)
