"""The changes of texels by wear."""

import numpy as np
import pytest

from farm.scene.floor import JointFill, Wear
from worker.floor.marks import Marks
from worker.floor.wear import turned_over, worn_colour, worn_roughness

UNWORN = Wear(
    brightness=1.0,
    tint=(1.0, 1.0, 1.0),
    saturation=1.0,
    contrast=1.0,
    stains=0.0,
    scratches=0.0,
    dust=0.0,
    mirrored=False,
    pattern_seed=0,
)
NO_MARKS = Marks(stain=None, scratch=None, dust=None)


def texels() -> np.ndarray[tuple[int, ...], np.dtype[np.uint8]]:
    """Random levels (64, 64, 3), every level among them."""
    return np.random.default_rng(0).permutation(np.arange(64 * 64 * 3) % 256).reshape(64, 64, 3).astype(np.uint8)


def light(levels: np.ndarray[tuple[int, ...], np.dtype[np.uint8]]) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    """The linear light of sRGB levels."""
    share = levels / 255
    return np.where(share <= 0.04045, share / 12.92, ((share + 0.055) / 1.055) ** 2.4)


def test_no_wear_leaves_every_level() -> None:
    """The way to linear light and back is exact."""
    assert (worn_colour(texels(), UNWORN, NO_MARKS) == texels()).all()


def test_brightness_and_tint_are_factors_of_light() -> None:
    """Half the brightness halves the light, and a tint adds a tenth to red."""
    grey = np.full((8, 8, 3), 188, np.uint8)
    worn = worn_colour(grey, UNWORN.model_copy(update={"brightness": 0.5, "tint": (1.1, 1.0, 1.0)}), NO_MARKS)
    assert light(worn)[0, 0] / light(grey)[0, 0] == pytest.approx(np.array([0.55, 0.5, 0.5]), rel=0.02)


def test_without_saturation_all_is_grey() -> None:
    """Without saturation all is grey, as bright as before."""
    worn = worn_colour(texels(), UNWORN.model_copy(update={"saturation": 0.0}), NO_MARKS)
    assert np.ptp(worn.astype(int), axis=2).max() <= 1
    luma = np.array([0.2126, 0.7152, 0.0722])
    assert (light(worn) @ luma).mean() == pytest.approx((light(texels()) @ luma).mean(), rel=0.01)


def test_contrast_keeps_the_mean() -> None:
    """Contrast scales the light's deviation from the mean, which stays."""
    rng = np.random.default_rng(1)
    soft = np.clip(rng.normal(150, 10, (256, 256, 3)), 0, 255).astype(np.uint8)
    worn = worn_colour(soft, UNWORN.model_copy(update={"contrast": 0.5}), NO_MARKS)
    assert light(worn).mean() == pytest.approx(light(soft).mean(), rel=0.02)
    assert light(worn).std() == pytest.approx(0.5 * light(soft).std(), rel=0.05)


def test_stains_darken_and_dust_pales() -> None:
    """Dust makes a dark floor paler, a stain a pale one darker, and places without marks don't change."""
    half = np.zeros((8, 8), np.float32)
    half[:, 4:] = 1
    pale, dark = np.full((8, 8, 3), 200, np.uint8), np.full((8, 8, 3), 30, np.uint8)
    stained = worn_colour(pale, UNWORN, Marks(stain=half, scratch=None, dust=None))
    dusty = worn_colour(dark, UNWORN, Marks(stain=None, scratch=None, dust=half))
    assert (stained[:, :4] == 200).all()
    assert (stained[:, 4:] < 185).all()
    assert (dusty[:, :4] == 30).all()
    assert (dusty[:, 4:] > 80).all()


def test_dust_takes_the_gloss() -> None:
    """A polished floor under dust is rough."""
    dust = Marks(stain=None, scratch=None, dust=np.ones((4, 4), np.float32))
    assert (worn_roughness(np.full((4, 4), 40, np.uint8), dust) > 180).all()


def test_what_fills_a_joint_hides_what_was_there() -> None:
    """Where the filling covers all, its own colour and roughness show; elsewhere nothing changes."""
    half = np.zeros((8, 8), np.float32)
    half[:, 4:] = 1
    filled = UNWORN.model_copy(update={"joints": JointFill(albedo=(0.3, 0.2, 0.1), cover=1.0, spread_m=0.0)})
    marks = Marks(stain=None, scratch=None, dust=None, joint=half)
    worn = worn_colour(np.full((8, 8, 3), 40, np.uint8), filled, marks)
    assert (worn[:, :4] == 40).all()
    assert light(worn)[0, 7] == pytest.approx(np.array([0.3, 0.2, 0.1]), rel=0.03)
    rough = worn_roughness(np.full((8, 8), 40, np.uint8), marks)
    assert (rough[:, :4] == 40).all()
    assert (rough[:, 4:] > 220).all()


def test_a_texture_turned_over_is_mirrored() -> None:
    """Colours change sides, and a normal map's slopes to the right become slopes to the left."""
    turned = turned_over(texels(), normal=False)
    assert (turned[:, ::-1] == texels()).all()
    normal = turned_over(texels(), normal=True)
    assert (normal[:, :, 0] == 255 - turned[:, :, 0]).all()
    assert (normal[:, :, 1:] == turned[:, :, 1:]).all()
