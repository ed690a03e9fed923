"""The part of a floor's texture that the camera sees, no finer than it sees it. Pure numpy and OpenCV.

A map of 2048 texels across 0.4 m is decoded once. In place of its four million texels, Blender then gets only those in
view, at most a few for each pixel.
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
"""Margin of a window on each side, as a share of the view's width: the reach of the pixel filter, of blur, and of the
floor's tilted normals."""

TEXELS_PER_PIXEL = 2
"""Texels for each pixel along an edge. With one, weave and grain look blurred (FLIP 0.054, of which 0.017 is noise);
more only take time, as a renderer waits for texels that do not fit into its caches."""

WORTH_AVERAGING = 1.25
"""Smallest number of texels along an edge that are averaged to one; below it, texels stay as they are."""

FINEST_GRID = 64
"""Smallest number of grid lines in a tile. Windows begin and end on lines that all maps of a surface have in common;
maps with fewer lines in common are taken whole."""


@dataclass(frozen=True, slots=True)
class TextureWindow:
    """A rectangle of a tile, in tiles; it may reach over the tile's edge. A whole tile is (0, 0, 1, 1).

    Attributes:
        u: left edge.
        v: lower edge, counted upwards.
        width: width.
        height: height.
        coarser: number of texels along an edge that are averaged to one: 1, or `WORTH_AVERAGING` or more.
    """

    u: float
    v: float
    width: float
    height: float
    coarser: float

    @classmethod
    def whole(cls) -> Self:
        """Make the window of a whole tile, at full resolution."""
        return cls(0.0, 0.0, 1.0, 1.0, 1)

    def place(self, uvs: NDArray[np.float64]) -> NDArray[np.float64]:
        """Convert coordinates (N, 2) in tiles to coordinates in the window, where 0 to 1 lies inside."""
        return (uvs - [self.u, self.v]) / [self.width, self.height]

    def cut(self, texels: Texels, *, colour: bool) -> Texels:
        """Cut the window out of a tile.

        Args:
            texels: (H, W) or (H, W, channels) uint8, texels of the tile, the top row first.
            colour: whether they are sRGB, which is averaged as linear light.

        Returns:
            (rows, columns) or (rows, columns, channels) uint8, the window's texels.
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
    """Compute the texture coordinates of points on the floor.

    Args:
        points_m: (N, 2) metres, points on the floor.
        floor: position, rotation and scale of the texture.
        size_m: edge of a tile at scale 1, in metres.

    Returns:
        (N, 2) tiles.
    """
    turn = math.radians(floor.rotation_deg)
    rotation = np.array([[math.cos(turn), -math.sin(turn)], [math.sin(turn), math.cos(turn)]])
    # Whole tiles make no difference to the picture, and single precision keeps more of the rest.
    offset = np.mod([floor.offset_x, floor.offset_y], 1.0)
    placed: NDArray[np.float64] = points_m / (size_m * floor.scale) @ rotation.T + offset
    return placed


def texels_to_floor(window: TextureWindow, rows: int, columns: int, floor: Floor, size_m: float) -> NDArray[np.float64]:
    """Compute the affine map from a texel's column and row to the floor; see `tile_coordinates` for the inverse.

    Args:
        window: window of the texture.
        rows: number of rows of the window's texels.
        columns: number of columns of the window's texels.
        floor: position, rotation and scale of the texture.
        size_m: edge of a tile at scale 1, in metres.

    Returns:
        (2, 3), which takes (column, row, 1) of a texel's middle to metres on the floor.
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
    """Choose the window of a surface's maps that makes the same picture as the whole maps.

    Args:
        floor: position, rotation and scale of the texture.
        size_m: edge of a tile at scale 1, in metres.
        view: view of the camera.
        sizes: (rows, columns) of each map.
        most_tiles: largest edge of the window, in tiles. A larger view repeats the window; with 1 it repeats the tile.
    """
    grid = math.gcd(*(edge for size in sizes for edge in size))
    # A pixel covers the smallest part of the floor where the floor is nearest.
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
    """Average texels to a size (columns, rows); a new texel weighs each old one by the part that it covers."""
    if colour:
        light = cv2.resize(light_of(texels), size, interpolation=cv2.INTER_AREA)
        return levels_of(light.astype(np.float32, copy=False))
    average: Texels = cv2.resize(texels, size, interpolation=cv2.INTER_AREA).astype(np.uint8, copy=False)
    return average
