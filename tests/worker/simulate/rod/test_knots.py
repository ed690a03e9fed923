"""Knots that are tied in cables before they fall."""

import numpy as np
import pytest

from farm.errors import SceneError
from farm.scene.cable import Cable
from farm.scene.knot import Knot, KnotKind
from tests.worker.scenes import make_scene
from worker.curves import smooth
from worker.simulate.checks.contact import segment_gap
from worker.simulate.checks.knot_type import determinant
from worker.simulate.rod import knots
from worker.simulate.rod.knot_start import loose_knot
from worker.simulate.rod.knots import DETERMINANTS, pull_knot, tie
from worker.simulate.rod.model import Array, Rod

DIAMETER_M = 0.004
SEGMENT_RADII = 4.0
KINDS = list(KnotKind)


def knotted(kind: KnotKind = KnotKind.OVERHAND, **changes: float | bool) -> Cable:
    """A cable of 0.4 m with a knot of a loop radius of four diameters in its middle."""
    knot = Knot(kind=kind, along=0.5, loop_radius_m=4 * DIAMETER_M, mirrored=False, set_share=0.0)
    cable = make_scene(ranges={"cable": {"count": [1, 1]}}).cables[0]
    plain = {"diameter_m": DIAMETER_M, "length_m": 0.4, "youngs_modulus_pa": 1e7, "density_kg_m3": 1500.0}
    return cable.model_copy(update={**plain, "knot": knot.model_copy(update=changes)})


def tied(kind: KnotKind = KnotKind.OVERHAND, **changes: float | bool) -> Rod:
    """The rod of such a cable."""
    return tie(knotted(kind, **changes), SEGMENT_RADII)


def gap(curve: Array) -> float:
    """Least distance of two parts of a curve, in radii of its cable, which are more than 8 radii apart along it."""
    step = float(np.linalg.norm(curve[1] - curve[0]))
    i, j = np.triu_indices(len(curve) - 1, k=int(np.ceil(8 / step)) + 1)
    return float(segment_gap(curve[i], curve[i + 1], curve[j], curve[j + 1]).min())


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("loop_radii", [4.0, 10.0, 20.0])
def test_a_loose_knot_does_not_touch_itself(kind: KnotKind, loop_radii: float) -> None:
    """Surfaces are apart at the start: axes by more than two radii."""
    nodes = loose_knot(kind, loop_radii, SEGMENT_RADII, 3 * loop_radii)
    assert gap(smooth(nodes, 8)) > 2.0


@pytest.mark.parametrize("kind", KINDS)
def test_a_loose_knot_has_equal_segments(kind: KnotKind) -> None:
    """Nodes are equally spaced, as a rod's must be."""
    steps = np.linalg.norm(np.diff(loose_knot(kind, 7.0, 3.0, 20.0), axis=0), axis=1)
    assert steps == pytest.approx(np.full(len(steps), 3.0), rel=1e-9)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("loop_radii", [5.0, 12.0])
def test_a_pulled_knot_is_still_that_knot(kind: KnotKind, loop_radii: float) -> None:
    """Its determinant is 3 for an overhand and 5 for a figure-eight knot."""
    assert determinant(smooth(pull_knot(kind, loop_radii, SEGMENT_RADII), 3)) == DETERMINANTS[kind]


@pytest.mark.parametrize("kind", KINDS)
def test_a_smaller_loop_takes_up_less_cable(kind: KnotKind) -> None:
    """The stated loop radius tightens the knot: what the ends approach each other by is about proportional to it."""
    short = []
    for loop_radii in (6.0, 12.0):
        nodes = pull_knot(kind, loop_radii, SEGMENT_RADII)
        short.append((len(nodes) - 1) * SEGMENT_RADII - float(np.linalg.norm(nodes[-1] - nodes[0])))
    assert 1.7 < short[1] / short[0] < 2.1


@pytest.mark.parametrize("kind", KINDS)
def test_a_tied_cable_keeps_its_length(kind: KnotKind) -> None:
    """All segments have the length of the first to 1e-6, and add up to the cable's."""
    steps = np.linalg.norm(np.diff(tied(kind).nodes_m, axis=0), axis=1)
    assert steps == pytest.approx(np.full(len(steps), 0.4 / len(steps)), rel=1e-6)


@pytest.mark.parametrize("along", [0.4, 0.55])
def test_a_knot_is_where_it_was_asked_for(along: float) -> None:
    """The middle of its loop, which is farthest off the chord, is at that share of the cable, to half a segment."""
    nodes = tied(along=along).nodes_m
    top = int(np.argmax(np.abs(nodes[:, 1] - np.median(nodes[:, 1]))))
    assert top / (len(nodes) - 1) == pytest.approx(along, abs=0.51 / (len(nodes) - 1))


@pytest.mark.parametrize("kind", KINDS)
def test_a_tied_cable_lies_level_about_the_origin(kind: KnotKind) -> None:
    """The chord's middle is at x = y = 0, its direction +x, the lowest underside at 0, and the loop wider than high."""
    nodes = tied(kind).nodes_m
    chord = nodes[-1] - nodes[0]
    assert (nodes[0] + nodes[-1])[:2] == pytest.approx([0, 0], abs=1e-12)
    assert chord[0] > 0
    assert chord[1:] == pytest.approx([0, 0], abs=1e-12)
    assert nodes[:, 2].min() == pytest.approx(DIAMETER_M / 2)
    assert np.ptp(nodes[:, 1]) > 1.5 * np.ptp(nodes[:, 2])


def test_a_mirrored_knot_has_every_crossing_the_other_way_round() -> None:
    """It is the same in plan view, with its heights upside down."""
    plain, mirrored = tied().nodes_m, tied(mirrored=True).nodes_m
    assert mirrored[:, :2] == pytest.approx(plain[:, :2])
    assert np.ptp(mirrored[:, 2] + plain[:, 2]) == pytest.approx(0, abs=1e-12)


def test_a_knot_repeats() -> None:
    """The same cable is tied into the same bits."""
    assert np.array_equal(tied().nodes_m, tied().nodes_m)


def test_a_cable_keeps_a_share_of_its_curvature() -> None:
    """The whole curvature makes about a turn of the loop, 2 pi, and half of it is half of that."""
    whole, half = tied(set_share=1.0), tied(set_share=0.5)
    assert whole.natural_curvature_per_m is not None
    assert half.natural_curvature_per_m is not None
    turns = np.arctan(whole.natural_curvature_per_m * whole.segment_length_m).sum() / (2 * np.pi)
    assert abs(turns) == pytest.approx(1.0, abs=0.15)
    assert half.natural_curvature_per_m == pytest.approx(whole.natural_curvature_per_m / 2)


def test_a_cable_that_is_too_short_for_its_knot_is_refused() -> None:
    """Both ends must stick out of the knot."""
    with pytest.raises(SceneError, match="too short for its knot"):
        tied(along=0.1)


@pytest.fixture
def _impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(knots, "MOST_CHECKS", 2)


@pytest.mark.usefixtures("_impatient")
def test_a_knot_that_does_not_rest_is_refused() -> None:
    """The pull ends after so many steps."""
    with pytest.raises(SceneError, match="does not rest"):
        pull_knot(KnotKind.OVERHAND, 8.0, SEGMENT_RADII)


def test_a_cable_without_a_knot_is_not_tied() -> None:
    """To tie it is a mistake of the caller."""
    with pytest.raises(ValueError, match="no knot"):
        tie(knotted().model_copy(update={"knot": None}), SEGMENT_RADII)
