import numpy as np

from assets.surfaces.kit.cells import edge_distance, mask_distance, rounded, scatter, voronoi, warp_labels
from assets.surfaces.kit.grid import Grid

GRID = Grid(128, 128.0)


def test_scattered_points_lie_in_the_tile() -> None:
    """Each square of the spacing has one point, and all lie in the tile."""
    points = scatter(np.random.default_rng(0), GRID, 8.0, 1.0)
    assert points.shape == (256, 2)
    assert points.min() >= 0.0
    assert points.max() < 128.0


def test_each_texel_belongs_to_the_nearest_point_round_the_edges() -> None:
    """Labels agree with a search over all points, except at texels almost as near to another point."""
    points = scatter(np.random.default_rng(1), GRID, 16.0)
    labels = voronoi(points, GRID)
    x, y = GRID.coordinates()
    # Points are rounded to texels before the search.
    seeds = np.floor(points) + 0.5
    gap = np.abs(np.stack([x, y], axis=-1)[:, :, None, :] - seeds[None, None])
    distance = np.linalg.norm(np.minimum(gap, 128.0 - gap), axis=-1)
    own = np.take_along_axis(distance, labels[..., None].astype(np.int64), axis=2)[..., 0]
    assert (own - distance.min(axis=2)).max() < 1.0


def test_edge_distance_is_measured_across_the_tiles_edge() -> None:
    """A piece that straddles the tile's edge has no border there."""
    labels = np.zeros((128, 128), np.int32)
    labels[:, 32:96] = 1
    distance = edge_distance(labels, GRID, 64.0)
    assert abs(distance[64, 0] - 32.0) < 1.5
    assert distance[64, 32] <= 1.0


def test_mask_distance_is_zero_outside() -> None:
    """Only texels of the mask have a distance."""
    mask = np.zeros((128, 128), bool)
    mask[40:80, 40:80] = True
    distance = mask_distance(mask, GRID)
    assert distance[~mask].max() == 0.0
    assert abs(distance[60, 60] - 20.0) < 1.5


def test_rounding_takes_the_corners_away_only() -> None:
    """A square keeps its sides but loses its corners."""
    labels = np.zeros((128, 128), np.int32)
    labels[32:96, 32:96] = 1
    edge = np.where(labels == 1, edge_distance(labels, GRID), np.float32(-1.0))
    round_edge = rounded(edge.astype(np.float32), 16.0, GRID)
    assert round_edge[64, 34] > 0.0
    assert round_edge[34, 34] < 0.0


def test_warping_labels_by_a_constant_rolls_them() -> None:
    """Labels move round the tile."""
    labels = voronoi(scatter(np.random.default_rng(2), GRID, 16.0), GRID)
    move = np.full((128, 128), 5.0, np.float32)
    assert np.array_equal(warp_labels(labels, move, 0 * move, GRID), np.roll(labels, -5, 1))
