import cv2
import numpy as np

from assets.surfaces.kit.grid import Grid
from assets.surfaces.kit.strokes import curve, polygon, polylines
from tests.assets.built import steps

GRID = Grid(128, 128.0)


def test_a_line_over_the_edge_goes_on_at_the_other_side() -> None:
    """Drawn across the corner, a line equals the same line drawn in the middle and rolled there."""
    path = np.array([[-20.0, -12.0], [24.0, 15.0]])
    across, inside = np.zeros((2, 128, 128), np.uint8)
    polylines(across, path, 2.0, (255.0,), GRID)
    polylines(inside, path + 64.0, 2.0, (255.0,), GRID)
    assert np.array_equal(across, np.roll(inside, (-64, -64), (0, 1)))


def test_a_polygon_over_the_edge_goes_on_at_the_other_side() -> None:
    """Filled across the corner, a polygon in colour equals the same one filled in the middle and rolled there."""
    corners = np.array([[-9.0, 3.0], [14.0, -8.0], [5.0, 20.0]])
    across, inside = np.zeros((2, 128, 128, 3), np.uint8)
    polygon(across, corners, (200.0, 100.0, 50.0), GRID)
    polygon(inside, corners + 64.0, (200.0, 100.0, 50.0), GRID)
    assert np.array_equal(across, np.roll(inside, (-64, -64), (0, 1)))


def test_many_strokes_leave_no_seam() -> None:
    """Strokes strewn over the whole tile leave no seam at its edges."""
    rng = np.random.default_rng(0)
    image = np.zeros((128, 128), np.uint8)
    for _ in range(600):
        polylines(image, curve(rng, rng.uniform(0, 128, 2).tolist(), 20.0, 0.5), 1.0, (255.0,), GRID)
    soft = cv2.blur(cv2.copyMakeBorder(image, 4, 4, 4, 4, cv2.BORDER_WRAP), (3, 3))[4:-4, 4:-4]
    for axis in (0, 1):
        seam, *inside = steps(soft, axis)
        assert seam <= 1.1 * max(inside)


def test_a_curve_has_the_length_asked_for() -> None:
    """The corners of a curve are evenly spaced along the length asked for."""
    path = curve(np.random.default_rng(1), (5.0, 5.0), 30.0, 0.7)
    assert np.allclose(np.linalg.norm(np.diff(path, axis=0), axis=1).sum(), 30.0)
