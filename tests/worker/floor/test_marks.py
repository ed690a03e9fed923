"""Marks on floors: as numerous as asked for, and of the same size whatever the texels are."""

import numpy as np
import pytest

from farm.scene.floor import JointFill, Wear
from worker.floor.marks import CELL_M, EDGE_M, marks_on, scratch_lines, stain_grids

WEAR = Wear(
    brightness=1.0,
    tint=(1.0, 1.0, 1.0),
    saturation=1.0,
    contrast=1.0,
    stains=0.1,
    scratches=8.0,
    dust=0.2,
    mirrored=False,
    pattern_seed=1,
)


def window(texel_m: float, texels: int) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    """A window of this many texels along an edge around the origin, with rows downwards."""
    first = -(texels - 1) / 2 * texel_m
    return np.array([[texel_m, 0.0, first], [0.0, -texel_m, -first]])


@pytest.mark.parametrize("share", [0.02, 0.1, 0.2])
@pytest.mark.parametrize("seed", range(3))
def test_stains_cover_the_share_asked_for(share: float, seed: int) -> None:
    """Stains cover their share of the whole square, to about a tenth of it."""
    depth, strength = stain_grids(share, np.random.default_rng(seed))
    assert np.mean(depth > 0) == pytest.approx(share, rel=0.15)
    assert strength[depth > CELL_M].min() > 0.2


def test_dust_covers_about_its_share() -> None:
    """The share of the square with half or more dust is about that asked for."""
    dust = marks_on(WEAR, 800, 800, window(EDGE_M / 800, 800)).dust
    assert dust is not None
    assert np.mean(dust > 0.15) == pytest.approx(WEAR.dust, rel=0.4)


def test_there_are_as_many_scratches_as_asked_for() -> None:
    """A square decimetre has the number asked for, with lengths of millimetres to centimetres."""
    lines = list(scratch_lines(8.0, np.random.default_rng(0)))
    assert len(lines) == round(8.0 * EDGE_M**2 / 0.01)
    lengths = [np.linalg.norm(np.diff(points, axis=0), axis=1).sum() for points, _, _ in lines]
    assert min(lengths) > 0.001
    assert max(lengths) < 0.1


@pytest.mark.parametrize("mark", ["stain", "dust"])
def test_marks_have_their_size_whatever_the_texels_are(mark: str) -> None:
    """Texels of 0.2 mm and of 0.4 mm show the same stains and dust, apart from their grain."""
    fine = getattr(marks_on(WEAR, 512, 512, window(0.2e-3, 512)), mark)
    coarse = getattr(marks_on(WEAR, 256, 256, window(0.4e-3, 256)), mark)
    means = fine.reshape(16, 32, 16, 32).mean(axis=(1, 3)), coarse.reshape(16, 16, 16, 16).mean(axis=(1, 3))
    assert np.abs(means[0] - means[1]).mean() < 0.04


def test_a_turned_window_sees_the_same_marks_turned() -> None:
    """A quarter turn of the texels against the floor turns the marks."""
    straight = marks_on(WEAR.model_copy(update={"dust": 0.0}), 400, 400, window(0.3e-3, 400)).stain
    turn = np.array([[0.0, -1.0], [1.0, 0.0]]) @ window(0.3e-3, 400)
    turned = marks_on(WEAR.model_copy(update={"dust": 0.0}), 400, 400, turn).stain
    assert straight is not None
    assert turned is not None
    blocks = [each.reshape(20, 20, 20, 20).mean(axis=(1, 3)) for each in (np.rot90(straight, -1), turned)]
    assert blocks[0] == pytest.approx(blocks[1], abs=0.06)


def test_marks_come_from_the_seed_alone() -> None:
    """The same seed gives the same marks; without any asked for there are none."""
    one, again = (marks_on(WEAR, 128, 128, window(0.3e-3, 128)) for _ in range(2))
    for name in ("stain", "scratch", "dust"):
        assert getattr(one, name).tobytes() == getattr(again, name).tobytes()
    none = marks_on(WEAR.model_copy(update={"stains": 0.0, "scratches": 0.0, "dust": 0.0}), 8, 8, window(1e-3, 8))
    assert not none.any


def beside_a_joint(texel_m: float, texels: int) -> np.ndarray[tuple[int, int], np.dtype[np.float32]]:
    """Distances from a joint of 2 mm down the middle of a window."""
    across = (np.arange(texels) - (texels - 1) / 2) * texel_m
    return np.tile((np.abs(across) - 0.001).astype(np.float32), (texels, 1))


def filled(spread_m: float, texel_m: float = 0.1e-3, texels: int = 400) -> float:
    """Mean width of the filling of that joint, metres."""
    wear = WEAR.model_copy(update={"joints": JointFill(albedo=(0.2, 0.2, 0.2), cover=1.0, spread_m=spread_m)})
    joint = marks_on(wear, texels, texels, window(texel_m, texels), beside_a_joint(texel_m, texels)).joint
    assert joint is not None
    return float(joint.sum(axis=1).mean()) * texel_m


def test_what_fills_a_joint_is_as_wide_as_the_joint() -> None:
    """The filling is narrower where it has fallen out, and wider by its spread onto either edge."""
    width_m, wider_m = filled(0.0), filled(0.0005)
    assert 0.0013 < width_m < 0.0021
    assert wider_m - width_m == pytest.approx(2 * 0.0005 * width_m / 0.002, rel=0.25)


def test_filled_joints_have_their_width_whatever_the_texels_are() -> None:
    """Texels of 0.1 mm and of 0.3 mm show the same width."""
    assert filled(0.0003, 0.3e-3, 133) == pytest.approx(filled(0.0003), rel=0.1)


def test_joints_stay_as_they_are_unless_filled() -> None:
    """Without a fill, or on a surface without a map of joints, there is no such mark."""
    fill = JointFill(albedo=(0.2, 0.2, 0.2), cover=1.0, spread_m=0.0)
    assert marks_on(WEAR, 8, 8, window(1e-3, 8), beside_a_joint(1e-3, 8)).joint is None
    assert marks_on(WEAR.model_copy(update={"joints": fill}), 8, 8, window(1e-3, 8)).joint is None
