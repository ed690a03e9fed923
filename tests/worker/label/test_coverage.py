"""Coverage of pixels by quads, against samples and against known areas."""

import numpy as np
import pytest
from numpy.typing import NDArray

from worker.label.coverage import SCANLINES, STEPS, cover

Quad = list[tuple[float, float]]


def box(left: float, top: float, right: float, bottom: float) -> Quad:
    """An upright rectangle."""
    return [(left, top), (right, top), (right, bottom), (left, bottom)]


def covered(*quads: Quad, numbers: tuple[int, ...] | None = None, size: int = 8) -> NDArray[np.uint16]:
    """The cover of a square picture; quads are numbered from 1 on unless numbers are given."""
    return cover(np.array(quads, np.float64), np.array(numbers or range(1, len(quads) + 1)), size, size)


def sampled(quads: NDArray[np.float64], size: int) -> NDArray[np.int64]:
    """The cover by a test of every place of every scanline against every edge."""
    y, x = np.meshgrid(
        (np.arange(size * SCANLINES) + 0.5) / SCANLINES, (np.arange(size * STEPS) + 0.5) / STEPS, indexing="ij"
    )
    owner = np.zeros(x.shape, np.int64)
    for number, quad in enumerate(quads, start=1):
        sides = [
            (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]) > 0
            for p, q in zip(quad, np.roll(quad, -1, axis=0), strict=True)
        ]
        owner[np.all(sides, axis=0) | ~np.any(sides, axis=0)] = number
    shares = np.stack(
        [(owner == k).reshape(size, SCANLINES, size, STEPS).sum(axis=(1, 3)) for k in range(len(quads) + 1)]
    )
    half = 2 * shares[1:].sum(axis=0) >= SCANLINES * STEPS
    return np.where(half, shares[1:].argmax(axis=0) + 1, 0)


@pytest.mark.parametrize("seed", range(8))
def test_piles_of_quads_are_as_sampled(seed: int) -> None:
    """Twelve random convex quads, some partly outside, are covered as sampled."""
    rng = np.random.default_rng(seed)
    angle = np.sort(rng.uniform(0, 2 * np.pi, (12, 4)), axis=1)
    ring = rng.uniform(0.5, 4, (12, 1, 1)) * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    quads = ring + rng.uniform(-1, 9, (12, 1, 2))
    assert (cover(quads, np.arange(1, 13), 8, 8) == sampled(quads, 8)).all()


@pytest.mark.parametrize(("right", "columns"), [(3.5, 2), (3.49, 1)])
def test_a_pixel_counts_from_half_on(right: float, columns: int) -> None:
    """A box that ends in a pixel's middle covers it, and one that ends just before doesn't."""
    assert (covered(box(2.0, 0.0, right, 8.0)).sum(axis=1) == columns).all()


@pytest.mark.parametrize("bottom", [3.45, 3.55])
def test_a_level_edge_counts_from_half_on(bottom: float) -> None:
    """The scanlines favour neither side of a level edge."""
    assert covered(box(0.0, 0.0, 8.0, bottom))[3].all() == (bottom > 3.5)


@pytest.mark.parametrize("angle_deg", [3.0, 20.0, 44.0, 70.0, 88.0])
def test_along_a_straight_edge_the_middle_of_the_pixel_decides(angle_deg: float) -> None:
    """A half-plane covers half of a pixel exactly if it covers the middle."""
    size, angle = 64, np.radians(angle_deg)
    along, inwards = np.array([np.cos(angle), np.sin(angle)]), np.array([-np.sin(angle), np.cos(angle)])
    start, end = 31.3 - 200 * along, 31.3 + 200 * along
    quad = [tuple(corner) for corner in (start, end, end + 200 * inwards, start + 200 * inwards)]
    y, x = np.mgrid[:size, :size] + 0.5
    depth = (x - 31.3) * inwards[0] + (y - 31.3) * inwards[1]
    sure = np.abs(depth) > 1 / STEPS
    assert ((covered(quad, size=size) > 0) == (depth > 0))[sure].all()


def test_two_that_overlap_do_not_add_up() -> None:
    """Two boxes over the same 40 % of a column cover 40 % of it."""
    assert not covered(box(2.0, 0.0, 2.4, 8.0), box(2.0, 0.0, 2.4, 8.0)).any()


def test_two_side_by_side_add_up() -> None:
    """Boxes of 20 % and 40 % of a column cover it, and the wider one gets it."""
    assert (covered(box(2.0, 0.0, 2.2, 8.0), box(2.2, 0.0, 2.6, 8.0))[:, 2] == 2).all()


def test_what_is_hidden_wins_nothing() -> None:
    """A box of 70 % of a column, of which a later one hides 40 %, loses it to the later one."""
    assert (covered(box(2.0, 0.0, 2.7, 8.0), box(2.3, 0.0, 2.7, 8.0))[:, 2] == 2).all()


def test_parts_of_one_thing_count_together() -> None:
    """Two parts with 30 % each get a column, and not the thing of 40 % between them."""
    quads = (box(2.0, 0.0, 2.3, 8.0), box(2.3, 0.0, 2.7, 8.0), box(2.7, 0.0, 3.0, 8.0))
    assert (covered(*quads, numbers=(1, 2, 1))[:, 2] == 1).all()


def test_number_0_hides_and_does_not_count() -> None:
    """If 60 % of a thing's column are hidden, it loses the column; if 40 % are, it keeps it."""
    whole = box(2.0, 0.0, 3.0, 8.0)
    assert not covered(whole, box(2.0, 0.0, 2.6, 8.0), numbers=(1, 0)).any()
    assert (covered(whole, box(2.0, 0.0, 2.4, 8.0), numbers=(1, 0))[:, 2] == 1).all()


def test_no_quads_cover_nothing() -> None:
    """Without quads the picture is empty."""
    assert not cover(np.zeros((0, 4, 2)), np.zeros(0, np.int64), 4, 4).any()
