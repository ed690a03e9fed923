"""Parts lie on the floor with true sizes."""

import numpy as np
import pytest

from farm.scene.clutter import PartKind
from tests.worker.clutter.test_solid import volume_m3
from tests.worker.clutter.things import make_part
from worker.clutter.parts import NUTS_MM, part_extent, part_solid

SEEDS = range(4)


@pytest.mark.parametrize("kind", PartKind)
@pytest.mark.parametrize("seed", SEEDS)
def test_a_part_lies_on_the_floor_about_its_place(kind: PartKind, seed: int) -> None:
    """The lowest point is at z = 0, the middle at the origin; faces look outwards and have a finish."""
    solid, finishes = part_solid(make_part(kind, seed=seed, size_m=0.02))
    low, high = solid.vertices_m.min(axis=0), solid.vertices_m.max(axis=0)
    assert low[2] == pytest.approx(0.0, abs=1e-9)
    assert low[:2] + high[:2] == pytest.approx(np.zeros(2), abs=1e-9)
    assert volume_m3(solid) > 0
    assert 0 <= solid.finishes.min() <= solid.finishes.max() < len(finishes)


@pytest.mark.parametrize("kind", PartKind)
def test_a_part_is_about_as_large_as_drawn(kind: PartKind) -> None:
    """The greatest extent is right to a quarter: metal parts have standard sizes, connectors a whole pitch."""
    solid, _ = part_solid(make_part(kind, seed=1, size_m=0.016))
    extent = (solid.vertices_m.max(axis=0) - solid.vertices_m.min(axis=0))[:2].max()
    assert 0.75 * 0.016 < extent < 1.3 * 0.016


def test_a_nut_has_the_standard_width_across_flats() -> None:
    """An M6 nut is 10 mm wide and 5.2 mm high."""
    solid, _ = part_solid(make_part(PartKind.NUT, size_m=0.0116))
    _, flats, height = NUTS_MM[3]
    assert 1e3 * np.ptp(solid.vertices_m[:, 0]) == pytest.approx(flats, rel=0.01) or 1e3 * np.ptp(
        solid.vertices_m[:, 1]
    ) == pytest.approx(flats, rel=0.01)
    assert 1e3 * np.ptp(solid.vertices_m[:, 2]) == pytest.approx(height)


def test_a_screw_rests_at_both_ends() -> None:
    """A screw rests on the rim of its head and the end of its thread: lowest points near both ends touch the floor."""
    solid, _ = part_solid(make_part(PartKind.SCREW, seed=2, size_m=0.02))
    x, z = solid.vertices_m[:, 0], solid.vertices_m[:, 2]
    assert z[x < 0].min() < 1e-4
    assert z[x > 0].min() < 1e-4


def test_the_extent_holds_all_of_a_part() -> None:
    """The radius reaches the farthest vertex, and the height the highest."""
    part = make_part(PartKind.CONNECTOR, seed=3)
    radius, height = part_extent(part)
    vertices = part_solid(part)[0].vertices_m
    assert np.hypot(vertices[:, 0], vertices[:, 1]).max() == pytest.approx(radius)
    assert vertices[:, 2].max() == pytest.approx(height)
