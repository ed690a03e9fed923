"""HDRIs as arrays: the light from above, turned as a scene wants it, and the backdrop. Numpy and OpenCV.

A panorama is (H, 2H, 3) of linear light, equirectangular, the zenith's row first, in float32.
"""

import math
from functools import lru_cache

import cv2
import numpy as np
from numpy.typing import NDArray

from farm.scene.camera import SENSOR_MM
from worker.camera.view import View

UPPER_WIDTH_PX = 512
"""Texels around the horizon of the light from above, 0.7 degrees each: finer than reflections on floors and cables."""

_SUBTEXELS = 3
"""Samples along an edge of a texel when a panorama is turned: a sun a few texels wide keeps its light."""

BELOW = math.sin(math.radians(2.0))
"""Sine of 2 degrees, down to which the light from below the horizon is kept: a pile sees it past the floor's edge."""

Panorama = NDArray[np.float32]


def upper_world(panorama: Panorama, turn: NDArray[np.float64]) -> Panorama:
    """Make the light that reaches a floor from above, in the world's own frame.

    Cycles finds the world's bright parts by a map in the world's frame. The map is exact if the panorama is turned
    beforehand and as fine as the map: Cycles then never misses a sun of a few texels, which would make white specks.
    The part of the world below the floor's edge lights nothing, so it is black.

    Args:
        panorama: the HDRI.
        turn: (3, 3), takes a direction in the world to one in the panorama.

    Returns:
        (W/2, W, 3) with W = `UPPER_WIDTH_PX`.
    """
    rows, columns = UPPER_WIDTH_PX // 2, UPPER_WIDTH_PX
    directions = _directions(rows, columns)
    seen = rows // 2 + math.ceil(rows * math.asin(BELOW) / math.pi)
    upper = _directions(rows * _SUBTEXELS, columns * _SUBTEXELS)[: seen * _SUBTEXELS]
    turned = _look_up(panorama, upper @ turn.T.astype(np.float32))
    lit = np.zeros((rows, columns, 3), np.float32)
    lit[:seen] = cv2.resize(turned, (columns, seen), interpolation=cv2.INTER_AREA)
    lit[directions[..., 2] < -BELOW] = 0.0
    return lit


def panorama_backdrop(
    panorama: Panorama, turn: NDArray[np.float64], view: View, lens_radius_m: float
) -> NDArray[np.float32]:
    """Make the picture that a camera takes of a panorama: out of focus, and before the lens distorts it.

    The world is infinitely far, so only a ray's direction counts. A ray through the lens at l meets the ray through the
    lens's middle in focus, at distance D, so their directions differ by l / D. Blur is therefore exactly a convolution
    with the lens's disc.

    Args:
        panorama: the HDRI.
        turn: (3, 3), takes a direction in the world to one in the panorama.
        view: the camera's direction, angle of view and distance in focus.
        lens_radius_m: radius of the camera's aperture, in metres.

    Returns:
        (H, W, 3) of linear light, the top row first.
    """
    pixel = SENSOR_MM / view.focal_length_mm / view.resolution.longer
    lens_disc = disc(lens_radius_m / view.focus_m / pixel)
    margin = lens_disc.shape[0] // 2
    fine = _samples_per_pixel(pixel, panorama.shape[1])
    rows, columns = (edge + 2 * margin for edge in view.resolution.shape)
    right, down = (((np.arange(edge * fine) + 0.5) / fine - edge / 2) * pixel for edge in (columns, rows))
    towards = np.empty((rows * fine, columns * fine, 3), np.float32)
    towards[..., 0], towards[..., 1], towards[..., 2] = right[None, :], -down[:, None], -1.0
    sharp = _look_up(panorama, towards @ (turn @ view.rotation).T.astype(np.float32))
    if fine > 1:
        sharp = cv2.resize(sharp, (columns, rows), interpolation=cv2.INTER_AREA).astype(np.float32, copy=False)
    blurred = cv2.filter2D(sharp, -1, lens_disc)
    seen: NDArray[np.float32] = blurred[margin : rows - margin, margin : columns - margin].astype(
        np.float32, copy=False
    )
    return seen


def _samples_per_pixel(pixel: float, columns: int) -> int:
    """Samples along an edge of a pixel, enough to step over no texel; 8 at most."""
    return min(8, max(1, math.ceil(pixel / (2 * math.pi / columns))))


def disc(radius_px: float) -> NDArray[np.float32]:
    """Make a disc (N, N), N odd, of unit sum; a pixel's weight is proportional to its part within the disc."""
    reach, fine = math.ceil(radius_px), 8
    place = (np.arange((2 * reach + 1) * fine) + 0.5) / fine - (reach + 0.5)
    inside = (place[:, None] ** 2 + place[None, :] ** 2 <= max(radius_px, 0.5) ** 2).astype(np.float32)
    share = cv2.resize(inside, (2 * reach + 1, 2 * reach + 1), interpolation=cv2.INTER_AREA)
    weights: NDArray[np.float32] = (share / share.sum()).astype(np.float32)
    return weights


@lru_cache(maxsize=4)
def _directions(rows: int, columns: int) -> NDArray[np.float32]:
    """Unit vectors (rows, columns, 3) of the middles of a panorama's texels, as Cycles maps them.

    The middle column looks along x, those right of it towards -y.
    """
    azimuth = np.pi - 2 * np.pi * (np.arange(columns) + 0.5) / columns
    elevation = 0.5 * np.pi - np.pi * (np.arange(rows) + 0.5) / rows
    across = np.cos(elevation)[:, None]
    vectors = np.stack(
        np.broadcast_arrays(across * np.cos(azimuth), across * np.sin(azimuth), np.sin(elevation)[:, None]), axis=-1
    ).astype(np.float32)
    vectors.setflags(write=False)  # they are shared
    unit: NDArray[np.float32] = vectors
    return unit


def _look_up(panorama: Panorama, towards: NDArray[np.float32]) -> Panorama:
    """Light (rows, columns, 3) from directions of any length, linear between texels."""
    rows, columns = panorama.shape[:2]
    x, y, z = towards[..., 0], towards[..., 1], towards[..., 2]
    azimuth, elevation = cv2.phase(x, y), np.arctan2(z, np.hypot(x, y))
    # cv2.phase counts from 0 to 2 pi, Cycles' columns from pi down to -pi.
    column = np.mod(0.5 - azimuth / np.float32(2 * np.pi), 1.0) * columns - 0.5
    row = (0.5 - elevation / np.float32(np.pi)) * rows - 0.5
    light: Panorama = cv2.remap(
        panorama,
        column.astype(np.float32, copy=False),
        row.astype(np.float32, copy=False),
        cv2.INTER_LINEAR,
        borderMode=cv2.BORDER_WRAP,
    ).astype(np.float32, copy=False)
    return light
