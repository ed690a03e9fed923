"""Scenes in pieces: the instance of each piece, and the order in which they hide each other."""

import numpy as np
import pytest
from scipy.spatial.distance import cdist

from farm.dataset.instances import number_instances
from farm.scene.cable import Bundle, Cable, CableEnd, EndKind, Tie, envelope_ratio
from farm.scene.scene import Scene
from tests.worker.scenes import make_scene, make_skin, make_stick
from worker.cable.piece import OCCLUDER, Convex, Piece, Plain, Substance, Tubular
from worker.cable.pieces import pieces_of
from worker.curves import Points

LENGTH_M = 0.2


def line(height_m: float = 0.005, points: int = 201) -> Points:
    """A gently bent centreline of 0.2 m."""
    s = np.linspace(-LENGTH_M / 2, LENGTH_M / 2, points)
    return np.stack([s, 0.3 * s**2, np.full_like(s, height_m)], axis=1)


def cable(**keys: object) -> Cable:
    """A cable of a drawn scene with some fields changed."""
    drawn = make_scene(ranges={"cable": {"count": [1, 1]}}).cables[0]
    return drawn.model_copy(update={"length_m": LENGTH_M, "diameter_m": 0.004, "material": make_skin(), **keys})


def bundle(strands: int, *ties: Tie) -> Bundle:
    """A bundle of strands as thick as an envelope of 4 mm allows."""
    return Bundle(
        strands=tuple(make_skin(pattern_seed=seed) for seed in range(strands)),
        strand_diameter_m=0.004 / envelope_ratio(strands),
        lay_m=0.08,
        phase_deg=20.0,
        ties=ties,
    )


TIE = Tie(along=0.5, width_m=0.003, colour=(20, 20, 20))


def scene_of(*cables: Cable) -> Scene:
    """A scene with these cables."""
    return make_scene().model_copy(update={"cables": cables})


def pieces(*cables: Cable) -> list[Piece]:
    """The pieces of cables that lie on each other."""
    return pieces_of(scene_of(*cables), [line(0.002 + 0.004 * k) for k in range(len(cables))], ())


def test_a_cut_cable_is_one_piece_on_its_own_curve() -> None:
    """The piece has exactly the points that settled."""
    curve = line()
    (piece,) = pieces_of(scene_of(cable()), [curve], ())
    assert isinstance(piece, Tubular)
    assert piece.curve is curve
    assert (piece.instance, piece.radius_m, piece.start_m, piece.end_m) == (1, 0.002, 0.0, LENGTH_M)


def test_instances_count_through_cables_and_strands() -> None:
    """A cable, a bundle of three and a cable have the instances one to five."""
    cables = cable(), cable(material=bundle(3, TIE)), cable()
    found = pieces(*cables)
    assert sorted({piece.instance for piece in found} - {OCCLUDER}) == [1, 2, 3, 4, 5]
    assert len(list(number_instances(scene_of(*cables)))) == 5


@pytest.mark.parametrize("strands", range(2, 8))
def test_strands_stay_within_the_bundles_envelope(strands: int) -> None:
    """No strand reaches farther from the centreline than the cable's radius."""
    for piece in pieces(cable(material=bundle(strands))):
        assert isinstance(piece, Tubular)
        assert isinstance(piece.radius_m, float)
        nearest = cdist(piece.curve[5:-5], line(0.002, 8001)).min(axis=1)
        assert (nearest + piece.radius_m).max() <= 0.002 * (1 + 1e-3)


def test_a_tie_is_no_instance_and_goes_around_all_strands() -> None:
    """A tie's band is wider than the bundle from side to side, and has no instance."""
    band = pieces(cable(material=bundle(2, TIE)))[2]
    assert isinstance(band, Convex)
    assert band.instance == OCCLUDER
    middle = line(0.002)[100]
    reach = np.linalg.norm(band.rings[1] - middle, axis=1)
    assert 0.002 < reach.max() < 0.0035
    assert reach.min() > 0.001


def test_a_tie_lies_above_the_strands_and_below_what_crosses_them() -> None:
    """A tie is above the strands and below a crossing cable in the order by which pieces hide each other."""
    found = pieces_of(scene_of(cable(material=bundle(3, TIE)), cable()), [line(0.002), line(0.012)], ())
    band = next(piece for piece in found if isinstance(piece, Convex))
    strands = [piece for piece in found if isinstance(piece, Tubular) and piece.instance <= 3]
    above = next(piece for piece in found if isinstance(piece, Tubular) and piece.instance == 4)
    under = [strand.curve[np.abs(strand.curve[:, 0]) < 0.0015, 2].max() for strand in strands]
    assert max(under) < band.place_m[2] < above.curve[:, 2].min()


def test_a_tie_keeps_clear_of_a_cable_that_crosses_its_bundle() -> None:
    """A tie moves along the bundle away from a crossing cable; if there is no room all along, it is left out."""
    across = line(0.006)[:, [1, 0, 2]]
    scene = scene_of(cable(material=bundle(3, TIE)), cable())
    moved = [piece for piece in pieces_of(scene, [line(0.002), across], ()) if isinstance(piece, Convex)]
    assert moved
    for solid in moved:
        assert cdist(solid.rings.reshape(-1, 3), across).min() > 0.002
    assert not any(isinstance(piece, Convex) for piece in pieces_of(scene, [line(0.002), line(0.006)], ()))


def test_a_tie_keeps_clear_of_a_stick_that_lies_on_its_bundle() -> None:
    """A tie moves along the bundle until it doesn't reach the stick."""
    axis = np.array([[0.0, -0.06, 0.008], [0.0, 0.06, 0.008]])
    stick = make_stick(diameter_m=0.008, length_m=0.12, start_height_m=0.01, rotation_deg=90.0)
    scene = scene_of(cable(material=bundle(3, TIE))).model_copy(update={"sticks": (stick,)})
    solids = [piece for piece in pieces_of(scene, [line(0.002)], (axis,)) if isinstance(piece, Convex)]
    assert solids
    for solid in solids:
        corners = solid.rings.reshape(-1, 3)
        assert np.linalg.norm(corners[:, [0, 2]] - axis[0, [0, 2]], axis=1).min() > 0.004


def test_ties_do_not_sit_on_each_other() -> None:
    """Two ties that were drawn at one place end up side by side."""
    bands = [
        piece for piece in pieces(cable(material=bundle(3, TIE, TIE))) if isinstance(piece, Convex) and piece.around
    ]
    one, other = (band.rings.mean(axis=(0, 1)) for band in bands)
    assert np.linalg.norm(one - other) > TIE.width_m


def test_a_stripped_end_shows_copper() -> None:
    """The bared end shows copper thinner than the sheath, which is shorter by the bared length."""
    ends = (CableEnd(kind=EndKind.STRIPPED, bare_m=0.01), CableEnd())
    sheath, *fine = pieces(cable(ends=ends))
    assert isinstance(sheath, Tubular)
    assert (sheath.start_m, sheath.end_m) == (0.01, LENGTH_M)
    for strand in fine:
        assert isinstance(strand, Tubular)
        assert isinstance(strand.surface, Plain)
        assert strand.surface.substance is Substance.COPPER
        assert strand.instance == 1
        assert np.linalg.norm(strand.curve[0] - sheath.curve[0]) < 0.002
        assert np.linalg.norm(strand.curve[-1] - line(0.002)[0]) < 0.002


def test_fine_strands_stay_above_the_floor() -> None:
    """However far fine strands spread, they stay within the sheath's width."""
    ends = (CableEnd(), CableEnd(kind=EndKind.STRIPPED, bare_m=0.012))
    for piece in pieces(cable(ends=ends)):
        assert isinstance(piece, Tubular)
        assert (piece.curve[:, 2] - piece.radius_m).min() > -1e-9


def test_a_ferrule_is_a_collar_and_a_tube() -> None:
    """A collar as wide as the sheath is followed by a narrower tube of tin."""
    ends = (CableEnd(), CableEnd(kind=EndKind.FERRULE, bare_m=0.012, collar=(0, 0, 200)))
    sheath, collar, tube = pieces(cable(ends=ends))
    assert isinstance(sheath, Tubular)
    assert isinstance(collar, Tubular)
    assert isinstance(tube, Tubular)
    assert sheath.end_m == collar.start_m == pytest.approx(LENGTH_M - 0.012)
    assert collar.end_m == tube.start_m == pytest.approx(LENGTH_M - 0.006)
    assert np.max(collar.radius_m) == pytest.approx(0.002, rel=0.01)
    assert np.max(tube.radius_m) < 0.002
    assert collar.surface == Plain(Substance.PLASTIC, (0, 0, 200))
    assert isinstance(tube.surface, Plain)
    assert tube.surface.substance is Substance.TIN


def test_more_bare_than_there_is_cable_leaves_some_sheath() -> None:
    """Ends take at most two fifths of a cable each."""
    end = CableEnd(kind=EndKind.STRIPPED, bare_m=1.0)
    sheath = pieces(cable(ends=(end, end)))[0]
    assert isinstance(sheath, Tubular)
    assert sheath.end_m - sheath.start_m >= 0.2 * LENGTH_M - 1e-9


def test_strands_of_a_bundle_have_ends_of_their_own() -> None:
    """Every strand of a bundle is bared at its own length."""
    ends = (CableEnd(), CableEnd(kind=EndKind.STRIPPED, bare_m=0.008))
    found = [piece for piece in pieces(cable(material=bundle(3), ends=ends)) if isinstance(piece, Tubular)]
    copper = {piece.instance: piece for piece in found if isinstance(piece.surface, Plain)}
    assert set(copper) == {1, 2, 3}
    assert len({round(piece.end_m, 6) for piece in copper.values()}) == 3
