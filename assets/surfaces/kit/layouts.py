"""Layouts of boards and tiles: the piece that holds a texel, the texel's place in it and its distance to the edge."""

from dataclasses import dataclass

import numpy as np

from assets.surfaces.kit.grid import Field, Grid, Labels


@dataclass(frozen=True)
class Layout:
    """Pieces that cover the tile.

    Attributes:
        labels: Piece of each texel, shape (H, W), from 0.
        u_mm: Position along the piece's long axis, from a point that is fixed for each piece, shape (H, W).
        v_mm: Position across the piece, from its centre line, shape (H, W).
        edge_mm: Distance to the nearest edge of the piece, shape (H, W).
    """

    labels: Labels
    u_mm: Field
    v_mm: Field
    edge_mm: Field


def boards(rng: np.random.Generator, grid: Grid, rows: int, joint_share: float = 0.5) -> Layout:
    """Lay boards along x, longer than the tile; some rows show the joint between two boards' ends.

    Args:
        rng: Source of the randomness: it chooses the rows that have a joint, and where the joint is.
        grid: The tile.
        rows: Number of boards across the tile.
        joint_share: Probability that a row shows a joint.

    Returns:
        The layout.
    """
    x, y = grid.coordinates()
    width = grid.size_mm / rows
    row = np.minimum((y / width).astype(np.int32), rows - 1)
    v = y - (row + 0.5).astype(np.float32) * np.float32(width)
    across = width / 2 - np.abs(v)
    joint = rng.uniform(0.0, grid.size_mm, rows).astype(np.float32)[row]
    has_joint = (rng.random(rows) < joint_share)[row]
    from_joint = np.mod(x - joint, np.float32(grid.size_mm))
    along = np.where(has_joint, np.minimum(from_joint, grid.size_mm - from_joint), np.float32(1e6))
    u = np.where(has_joint, from_joint, x)
    return Layout(row, u.astype(np.float32), v, np.minimum(across, along).astype(np.float32))


def tiles(grid: Grid, columns: int, rows: int, bond: float = 0.0) -> Layout:
    """Lay equal rectangular tiles in rows.

    Args:
        grid: The tile.
        columns: Number of tiles along x.
        rows: Number of tiles along y; even if `bond` isn't 0.
        bond: Share of a tile's length by which every other row is shifted: 0.5 is a brick bond.

    Returns:
        The layout; u runs along x.
    """
    x, y = grid.coordinates()
    width, height = grid.size_mm / columns, grid.size_mm / rows
    row = np.minimum((y / height).astype(np.int32), rows - 1)
    moved = np.mod(x - (row % 2) * np.float32(bond * width), np.float32(grid.size_mm))
    column = np.minimum((moved / width).astype(np.int32), columns - 1)
    u = moved - (column + 0.5).astype(np.float32) * np.float32(width)
    v = y - (row + 0.5).astype(np.float32) * np.float32(height)
    edge = np.minimum(width / 2 - np.abs(u), height / 2 - np.abs(v))
    return Layout(row * columns + column, u, v, edge.astype(np.float32))


def herringbone(grid: Grid, blocks: int, ratio: int = 4) -> Layout:
    """Lay blocks in a herringbone, parallel to the axes.

    Args:
        grid: The tile.
        blocks: Number of periods of the pattern across the tile.
        ratio: Length of a block over its width.

    Returns:
        The layout; u runs along each block's own length.
    """
    cells = 2 * ratio * blocks
    width = grid.size_mm / cells
    x, y = grid.coordinates()
    column = np.minimum((x / width).astype(np.int32), cells - 1)
    row = np.minimum((y / width).astype(np.int32), cells - 1)
    turn = np.mod(column - row, 2 * ratio)
    lying = turn < ratio
    step = np.where(lying, turn, turn - ratio)
    start_column = np.where(lying, column - step, column)
    # A standing block's cells are counted from its bottom row up; start_row is its top row.
    start_row = np.where(lying, row, row + step - (ratio - 1))
    labels = (np.mod(start_row, cells) * cells + np.mod(start_column, cells)) * 2 + lying
    _, compact = np.unique(labels, return_inverse=True)
    from_left = x - start_column.astype(np.float32) * np.float32(width)
    from_top = y - start_row.astype(np.float32) * np.float32(width)
    along = np.where(lying, from_left, from_top).astype(np.float32)
    across = np.where(lying, from_top, from_left).astype(np.float32)
    edge = np.minimum(np.minimum(along, ratio * width - along), np.minimum(across, width - across))
    pieces = compact.reshape(labels.shape).astype(np.int32)
    return Layout(pieces, along, (across - width / 2).astype(np.float32), edge.astype(np.float32))


def chevron(grid: Grid, columns: int, pieces: int) -> Layout:
    """Lay boards in a chevron: columns of parallel boards at 45 degrees, cut where they meet, each column mirrored.

    Args:
        grid: The tile.
        columns: Number of columns across the tile; even, so that the edges meet.
        pieces: Number of boards in a column as high as the tile.

    Returns:
        The layout; u runs along each board's own length.
    """
    x, y = grid.coordinates()
    width, pitch = grid.size_mm / columns, grid.size_mm / pieces
    column = np.minimum((x / width).astype(np.int32), columns - 1)
    from_left = x - column.astype(np.float32) * np.float32(width)
    rise = np.where(column % 2 == 0, from_left, np.float32(width) - from_left)
    along = np.where(column % 2 == 0, from_left, from_left - np.float32(width)) * np.float32(np.sqrt(2.0))
    level = np.mod(y + rise, np.float32(grid.size_mm))
    piece = np.minimum((level / pitch).astype(np.int32), pieces - 1)
    across = (level - (piece + 0.5).astype(np.float32) * np.float32(pitch)) * np.float32(np.sqrt(0.5))
    edge = np.minimum(pitch * np.sqrt(0.125) - np.abs(across), np.minimum(from_left, width - from_left))
    return Layout(column * pieces + piece, along, across, edge.astype(np.float32))
