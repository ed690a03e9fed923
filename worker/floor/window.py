"""The part of a floor's texture that the camera sees, no finer than it sees it. Pure numpy and OpenCV.

A map of 2048 texels across 0.4 m is decoded once; Blender then gets the texels under the view alone, at most as many
as a few for each pixel, in place of four million.
"""

import math
from dataclasses import dataclass
from typing import Self

import cv2
import numpy as np
from numpy.typing import NDArray

from farm.scene.floor import Floor
from worker.camera.view import View
from worker.colour import Texels, levels_of, light_of

MARGIN = 0.06
"""Of the view's width, on each side: what the pixel filter, blur and a tilt of the floor's normals may reach."""

TEXELS_PER_PIXEL = 2
"""Left along an edge: with one, weave and grain looked blurred (FLIP 0.054 where 0.017 was noise); more only take
time, as a renderer waits for texels that don't fit its caches."""

WORTH_AVERAGING = 1.25
"""Texels along an edge that become one, below which they stay as they are."""

FINEST_GRID = 64
"""Windows begin and end at a grid of at least so many lines a tile; maps of other sizes are taken whole."""


@dataclass(frozen=True, slots=True)
class TextureWindow:
    """A rectangle of a tile, in tiles, v upwards; it may reach over the tile's edge. All of it is (0, 0, 1, 1).

    Attributes:
        coarser: how many texels along an edge become one; 1, or `WORTH_AVERAGING` or more.
    """

    u: float
    v: float
    width: float
    height: float
    coarser: float

    @classmethod
    def whole(cls) -> Self:
        """All texels of a tile."""
        return cls(0.0, 0.0, 1.0, 1.0, 1)

    def place(self, uvs: NDArray[np.float64]) -> NDArray[np.float64]:
        """Coordinates (N, 2) in the window of coordinates in tiles."""
        return (uvs - [self.u, self.v]) / [self.width, self.height]

    def cut(self, texels: Texels, *, colour: bool) -> Texels:
        """The window's texels.

        Args:
            texels: (H, W) or (H, W, channels) of the tile, the top row first.
            colour: sRGB, which is averaged as light.
        """
        rows, columns = texels.shape[:2]
        if self == self.whole():
            return texels
        left, wide = round(self.u * columns), round(self.width * columns)
        high = round(self.height * rows)
        top = rows - round(self.v * rows) - high
        window: Texels = texels.take(np.arange(top, top + high), axis=0, mode="wrap")
        window = window.take(np.arange(left, left + wide), axis=1, mode="wrap")
        if self.coarser == 1:
            return window
        size = (max(1, round(wide / self.coarser)), max(1, round(high / self.coarser)))
        return _resampled(window, size, colour=colour)


def tile_coordinates(points_m: NDArray[np.float64], floor: Floor, size_m: float) -> NDArray[np.float64]:
    """Coordinates (N, 2) in tiles of points (N, 2) of the floor, metres.

    Args:
        points_m: of the floor.
        floor: how its texture lies.
        size_m: edge of a tile at scale 1.
    """
    turn = math.radians(floor.rotation_deg)
    rotation = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    # Whole tiles make no difference to the picture, and single precision keeps more of the rest.
    offset = np.mod([floor.offset_x, floor.offset_y], 1.0)
    placed: NDArray[np.float64] = points_m / (size_m * floor.scale) @ rotation.T + offset
    return placed


def texels_to_floor(window: TextureWindow, rows: int, columns: int, floor: Floor, size_m: float) -> NDArray[np.float64]:
    """What takes the column and row of a window's texel to metres on the floor, (2, 3); see `tile_coordinates`.

    Args:
        window: of the texture.
        rows: of the window's texels.
        columns: of them.
        floor: how the texture lies.
        size_m: edge of a tile at scale 1.
    """
    turn = math.radians(floor.rotation_deg)
    rotation = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    to_tile = np.diag([window.width / columns, -window.height / rows])
    first = np.array([window.u + 0.5 * window.width / columns, window.v + (1 - 0.5 / rows) * window.height])
    first -= np.mod([floor.offset_x, floor.offset_y], 1.0)
    tile_m = size_m * floor.scale
    return tile_m * np.column_stack([rotation.T @ to_tile, rotation.T @ first])


def window_on(
    floor: Floor, size_m: float, view: View, sizes: tuple[tuple[int, int], ...], most_tiles: float = 1.0
) -> TextureWindow:
    """The window on a surface's maps through which a view is the same as with all of them.

    Args:
        floor: how the texture lies.
        size_m: edge of a tile at scale 1.
        view: what the camera sees.
        sizes: (rows, columns) of each map.
        most_tiles: along an edge. With one, a view of more sees the same texels again; with more it has its own.
    """
    grid = math.gcd(*(edge for size in sizes for edge in size))
    # A pixel is smallest where the floor is nearest.
    pixel_m = view.depths_m(view.floor_corners_m()).min() / view.focal_length_px
    texel_m = size_m * floor.scale / min(edge for size in sizes for edge in size)
    coarser = float(pixel_m / (TEXELS_PER_PIXEL * texel_m))
    coarser = coarser if coarser >= WORTH_AVERAGING else 1.0
    if grid < FINEST_GRID:
        return TextureWindow.whole()
    rim = math.ceil(coarser)
    seen = tile_coordinates(view.floor_corners_m(MARGIN)[:, :2], floor, size_m)
    low = np.floor(seen.min(axis=0) * grid - rim) / grid
    extent = np.minimum(np.ceil(seen.max(axis=0) * grid + rim) / grid - low, most_tiles)
    return TextureWindow(float(low[0]), float(low[1]), float(extent[0]), float(extent[1]), coarser)


def _resampled(texels: Texels, size: tuple[int, int], *, colour: bool) -> Texels:
    """Average to fewer columns and rows, each with the parts of texels that it covers."""
    if colour:
        light = cv2.resize(light_of(texels), size, interpolation=cv2.INTER_AREA)
        return levels_of(light.astype(np.float32, copy=False))
    average: Texels = cv2.resize(texels, size, interpolation=cv2.INTER_AREA).astype(np.uint8, copy=False)
    return average
