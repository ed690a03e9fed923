"""Tangles of sampled scenes."""

import itertools

import numpy as np
import pytest
from scipy.spatial import cKDTree

from farm.scene.cable import Cable
from farm.scene.scene import Scene
from farm.spec.category import Category
from farm.spec.job import Job
from farm.spec.ranges.tangle import TangleRanges
from farm.spec.styles import RANGES_OF, Style
from tests.worker.scenes import make_header
from worker.curves import Points
from worker.sample.scene import sample_scene
from worker.sample.tangle import TangleKind, sample_kind
from worker.simulate.shapes import start_nodes

WOVEN = [kind for kind in TangleKind if kind is not TangleKind.KNOT]


def shares(kind: TangleKind | None) -> dict[str, float]:
    """Shares of which one is 1, or none."""
    return {f"{each}_share": float(each is kind) for each in TangleKind}


def scenes(
    kind: TangleKind | None, number: int, category: Category = Category.CLOSE_CONCENTRATED, **cable: object
) -> list[Scene]:
    """Scenes of the wide style that all draw one kind; `cable` are ranges of the cables."""
    header = make_header(style="wide", ranges={"placement": {"tangle": shares(kind)}, "cable": cable})
    return [sample_scene(header, Job(category=category, index=index), 0) for index in range(number)]


def is_tangled(scene: Scene) -> bool:
    """Whether any cable is woven or knotted."""
    return any(cable.heights_m or cable.knot for cable in scene.cables)


def line(cable: Cable) -> Points:
    """The start of a cable, finely sampled."""
    return start_nodes(cable, 6 * round(cable.length_m / cable.diameter_m) + 1)


@pytest.mark.parametrize("kind", WOVEN)
def test_nothing_of_a_tangle_starts_inside_anything_else(kind: TangleKind) -> None:
    """Woven cables start apart by more than the sum of their radii, above the floor and every stick."""
    found = [scene for scene in scenes(kind, 12) if is_tangled(scene)]
    assert len(found) >= 6
    for scene in found:
        lines = [line(cable) for cable in scene.cables]
        for k, cable in enumerate(scene.cables):
            lowest = max((stick.start_height_m + stick.diameter_m for stick in scene.sticks), default=0.0)
            assert lines[k][:, 2].min() - cable.diameter_m / 2 >= lowest - 1e-6
            for other in range(k):
                apart = cKDTree(lines[other]).query(lines[k])[0].min()
                assert apart > (cable.diameter_m + scene.cables[other].diameter_m) / 2


def test_a_tangle_changes_cables_pegs_and_nothing_else() -> None:
    """The other values of a scene, and all values of one without a tangle, are those of a style without tangles."""
    for plain, heaped in zip(scenes(None, 6), scenes(TangleKind.HEAP, 6), strict=True):
        assert heaped.model_copy(update={"cables": plain.cables}) == plain
        for before, after in zip(plain.cables, heaped.cables, strict=True):
            same = (before.material, before.length_m, before.diameter_m, before.youngs_modulus_pa)
            assert same == (after.material, after.length_m, after.diameter_m, after.youngs_modulus_pa)


def test_a_threaded_cable_passes_over_one_side_of_a_loop_and_under_the_other() -> None:
    """Along one cable, its crossings with the loop of another alternate between over and under."""
    found = [scene for scene in scenes(TangleKind.THREADED, 12, count=[2, 2]) if is_tangled(scene)]
    assert found
    for scene in found:
        alternating = []
        for runner, looped in ((0, 1), (1, 0)):
            one, other = (line(scene.cables[k]) for k in (runner, looped))
            rises = crossing_rises(one, other)
            alternating.append(any(a * b < 0 for a, b in itertools.pairwise(rises)))
        assert any(alternating)


def crossing_rises(one: Points, other: Points) -> list[float]:
    """The height of a polyline above another at each of their crossings in plan view, in turn along it."""
    rises = []
    for k in range(len(one) - 1):
        p, r = one[k], one[k + 1] - one[k]
        q, s = other[:-1], np.diff(other, axis=0)
        cross = r[0] * s[:, 1] - r[1] * s[:, 0]
        w = q - p
        t = (w[:, 0] * s[:, 1] - w[:, 1] * s[:, 0]) / cross
        u = (w[:, 0] * r[1] - w[:, 1] * r[0]) / cross
        met = (t >= 0) & (t < 1) & (u >= 0) & (u < 1)
        rises += (p[2] + t[met] * r[2] - q[met, 2] - u[met] * s[met, 2]).tolist()
    return rises


def test_cables_keep_clear_of_a_peg_that_is_higher_than_they_are() -> None:
    """A peg stands apart from every cable and stick, above all cables, and below 0.4 of the camera's height."""
    found = [scene for scene in scenes(TangleKind.PEG, 20) if scene.pegs]
    assert len(found) >= 10
    for scene in found:
        (peg,) = scene.pegs
        for cable in scene.cables:
            away = np.linalg.norm(line(cable)[:, :2] - [peg.x_m, peg.y_m], axis=1).min()
            assert away > (cable.diameter_m + peg.diameter_m) / 2
            assert line(cable)[:, 2].max() + cable.diameter_m / 2 < peg.height_m
        assert peg.height_m <= 0.4 * scene.camera.height_m


def test_a_cable_runs_round_a_peg() -> None:
    """Seen from the peg, some cable near it covers an angle of 50 degrees or more."""
    for scene in scenes(TangleKind.PEG, 10, count=[1, 1]):
        for peg in scene.pegs:
            from_peg = line(scene.cables[0])[:, :2] - [peg.x_m, peg.y_m]
            near = np.linalg.norm(from_peg, axis=1) < peg.diameter_m / 2 + 5 * scene.cables[0].diameter_m
            bearing = np.unwrap(np.arctan2(from_peg[near, 1], from_peg[near, 0]))
            assert np.ptp(bearing) > np.radians(50)


def test_pegs_stand_on_floors_alone() -> None:
    """A picture without a visible floor has no peg, and its cables are not tangled."""
    assert not any(scene.pegs or is_tangled(scene) for scene in scenes(TangleKind.PEG, 10, Category.FAR))


@pytest.mark.parametrize("kind", WOVEN)
def test_aligned_categories_stay_aligned(kind: TangleKind) -> None:
    """Their cables are never woven."""
    assert not any(is_tangled(scene) for scene in scenes(kind, 5, Category.CLOSE_ALIGNED_CONCENTRATED))


def test_a_knotted_cable_starts_above_all_others() -> None:
    """It is the last, has no rise or heights, and its loop is no wider than a cable 20 radii long allows."""
    found = [scene for scene in scenes(TangleKind.KNOT, 20) if is_tangled(scene)]
    assert len(found) >= 10
    for scene in found:
        *others, cable = scene.cables
        assert cable.knot is not None
        assert not any(other.knot for other in others)
        assert all(other.start_height_m + other.rise_m + other.diameter_m < cable.start_height_m for other in others)
        assert cable.knot.loop_radius_m <= min(cable.length_m / 20, 0.2 * scene.camera.seen_m)
        assert cable.knot.loop_radius_m >= 3.99 * cable.diameter_m


def test_kinds_are_drawn_by_their_shares() -> None:
    """Of 4,000 draws each kind has its share within four standard deviations."""
    ranges = TangleRanges(heap_share=0.3, knot_share=0.1, peg_share=0.2)
    rng = np.random.default_rng(0)
    drawn = [sample_kind(ranges, Category.CLOSE_CONCENTRATED.traits, rng) for _ in range(4000)]
    for kind, share in ((TangleKind.HEAP, 0.3), (TangleKind.KNOT, 0.1), (TangleKind.PEG, 0.2), (None, 0.4)):
        assert abs(drawn.count(kind) - 4000 * share) < 4 * np.sqrt(4000 * share * (1 - share))


def test_about_a_tenth_of_the_wide_scenes_are_tangled() -> None:
    """In the published proportions of the categories 10 to 14 % draw a kind; some of them have too few cables."""
    ranges, rng = RANGES_OF[Style.WIDE].placement.tangle, np.random.default_rng(0)
    drawn = [
        sample_kind(ranges, category.traits, rng) is not None
        for category in Category
        for _ in range(1000 * category.traits.weight)
    ]
    assert 0.10 < np.mean(drawn) < 0.14
