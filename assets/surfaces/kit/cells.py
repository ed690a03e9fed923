"""Periodic Voronoi cells: stones, chips, grains and spangles."""

import cv2
import numpy as np
import numpy.typing as npt

from assets.surfaces.kit.grid import Field, Grid, Labels


def scatter(rng: np.random.Generator, grid: Grid, spacing_mm: float, jitter: float = 0.8) -> npt.NDArray[np.float64]:
    """Spread points over the tile: one in each square of a grid, moved at random within it.

    Args:
        rng: Source of the randomness.
        grid: The tile.
        spacing_mm: Mean distance between neighbours.
        jitter: Share of a square over which its point may lie: 0 is the centre alone, 1 the whole square.

    Returns:
        Positions x, y in millimetres, shape (n, 2), within the tile.
    """
    count = max(2, round(grid.size_mm / spacing_mm))
    step = grid.size_mm / count
    cell = np.stack(np.meshgrid(np.arange(count), np.arange(count)), axis=-1).reshape(-1, 2)
    # Alternate rows move by half a square, so that the points never line up as a square lattice.
    shifted = cell + np.stack([0.5 * (cell[:, 1] % 2), np.zeros(len(cell))], axis=1)
    moved = shifted + 0.5 + jitter * rng.uniform(-0.5, 0.5, cell.shape)
    return np.asarray(np.mod(moved * step, grid.size_mm))


def voronoi(points_mm: npt.NDArray[np.float64], grid: Grid) -> Labels:
    """Label every texel with the nearest point, across the tile's edges too.

    Args:
        points_mm: Positions, shape (n, 2), within the tile.
        grid: The tile.

    Returns:
        Index into `points_mm`, shape (H, W). Points that share a texel give one cell.
    """
    texels = np.minimum((points_mm / grid.texel_mm).astype(np.int64), grid.pixels - 1)
    owner = np.full((grid.pixels, grid.pixels), -1, np.int32)
    owner[texels[:, 1], texels[:, 0]] = np.arange(len(points_mm), dtype=np.int32)
    margin = min(grid.pixels, int(grid.pixels * 4 / max(1.0, len(points_mm) ** 0.5)) + 2)
    tiled = cv2.copyMakeBorder(owner, margin, margin, margin, margin, cv2.BORDER_WRAP)
    holes = (tiled < 0).astype(np.uint8)
    _, index = cv2.distanceTransformWithLabels(holes, cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL)
    names = np.zeros(int(index.max()) + 1, np.int32)
    seeds = holes == 0
    names[index[seeds]] = tiled[seeds]
    return np.asarray(names[index[margin:-margin, margin:-margin]], np.int32)


def edge_distance(labels: Labels, grid: Grid, reach_mm: float = 40.0) -> Field:
    """Measure how far each texel is from the border of its piece.

    Args:
        labels: Pieces, shape (H, W), periodic.
        grid: The tile.
        reach_mm: Largest distance that is measured correctly across the tile's edges.

    Returns:
        Millimetres, shape (H, W).
    """
    margin = min(grid.pixels, int(reach_mm / grid.texel_mm) + 2)
    inner = (labels == np.roll(labels, 1, 0)) & (labels == np.roll(labels, 1, 1))
    inner &= (labels == np.roll(labels, -1, 0)) & (labels == np.roll(labels, -1, 1))
    tiled = cv2.copyMakeBorder(inner.astype(np.uint8), margin, margin, margin, margin, cv2.BORDER_WRAP)
    distance = cv2.distanceTransform(tiled, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    return np.asarray(distance[margin:-margin, margin:-margin] * grid.texel_mm, np.float32)


def rounded(edge_mm: Field, radius_mm: float, grid: Grid) -> Field:
    """Round the corners of pieces.

    Args:
        edge_mm: Distance to the edge of the piece, negative outside, shape (H, W).
        radius_mm: Radius of the corners.
        grid: The tile.

    Returns:
        Distance to the edge of the rounded piece, shape (H, W).
    """
    outside_core = mask_distance(edge_mm <= radius_mm, grid, 3 * radius_mm)
    return np.asarray(np.where(edge_mm > radius_mm, edge_mm, radius_mm - outside_core), np.float32)


def mask_distance(mask: npt.NDArray[np.bool_], grid: Grid, reach_mm: float = 40.0) -> Field:
    """Measure how far each texel of a periodic mask is from the mask's border.

    Args:
        mask: True inside, shape (H, W), periodic.
        grid: The tile.
        reach_mm: Largest distance that is measured correctly across the tile's edges.

    Returns:
        Millimetres, 0 outside the mask, shape (H, W).
    """
    margin = min(grid.pixels, int(reach_mm / grid.texel_mm) + 2)
    tiled = cv2.copyMakeBorder(mask.astype(np.uint8), margin, margin, margin, margin, cv2.BORDER_WRAP)
    distance = cv2.distanceTransform(tiled, cv2.DIST_L2, cv2.DIST_MASK_PRECISE)
    return np.asarray(distance[margin:-margin, margin:-margin] * grid.texel_mm, np.float32)


def warp_labels(labels: Labels, dx_mm: Field, dy_mm: Field, grid: Grid) -> Labels:
    """Displace labels, wrapping round: each texel takes the label found (dx_mm, dy_mm) away from it."""
    rows = np.arange(grid.pixels)[:, None] + np.rint(dy_mm / grid.texel_mm).astype(np.int32)
    columns = np.arange(grid.pixels)[None, :] + np.rint(dx_mm / grid.texel_mm).astype(np.int32)
    return np.asarray(labels[rows % grid.pixels, columns % grid.pixels])
