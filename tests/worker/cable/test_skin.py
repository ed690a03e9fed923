"""Skins: closed around the cable, with the shares and sizes asked for, and repeatable."""

import numpy as np
import pytest
from numpy.typing import NDArray

from farm.model import Rgb
from farm.scene.cable import Marking, Sheath, Skin, Stripe, StripeKind
from tests.worker.scenes import make_skin
from worker.cable.canvas import pigment
from worker.cable.skin import SkinImages, draw_skin

LENGTH_M, DIAMETER_M, PIXEL_M = 0.12, 0.004, 0.0002
WHITE: Rgb = (255, 255, 255)
MARKING = Marking(text="H07RN-F 3G1.5", colour=WHITE, height_share=0.5, repeat_m=0.06)


def drawn(skin: Skin) -> SkinImages:
    """The maps of a skin on a cable of usual size."""
    return draw_skin(skin, LENGTH_M, DIAMETER_M, PIXEL_M)


def striped(kind: StripeKind, share: float, count: int, pitch_m: float, **keys: object) -> Skin:
    """A skin with white stripes on red."""
    return make_skin(stripe=Stripe(kind=kind, colour=WHITE, share=share, count=count, pitch_m=pitch_m), **keys)


def share_of(images: SkinImages, colour: Rgb, other: Rgb) -> float:
    """Share of the surface that is closer to one colour than to the other."""
    return float(nearer(images, colour, other).mean())


def nearer(images: SkinImages, colour: Rgb, other: Rgb) -> NDArray[np.bool_]:
    """Where the surface is closer to one colour than to the other."""
    one, two = (np.linalg.norm(images.colour - 255.0 * pigment(c).ravel(), axis=2) for c in (colour, other))
    is_nearer: NDArray[np.bool_] = one < two
    return is_nearer


EVERYTHING = {
    "plain": make_skin(roughness=0.2),
    "translucent": make_skin(sheath=Sheath.TRANSLUCENT),
    "braided": make_skin(sheath=Sheath.BRAIDED),
    "spiral": striped(StripeKind.SPIRAL, 0.3, 2, 0.015),
    "straight": striped(StripeKind.STRAIGHT, 0.3, 3, 0.4),
    "soiled": make_skin(dirt=0.2, wear=0.2),
    "printed": make_skin(marking=MARKING),
}


@pytest.mark.parametrize("skin", EVERYTHING.values(), ids=EVERYTHING)
def test_images_close_around_the_cable(skin: Skin) -> None:
    """The mean step from the last row to the first is no larger than the largest between two rows."""
    images = drawn(skin)
    for image in (images.colour, images.roughness, images.normal):
        if image is None:
            continue
        rows = image.reshape(len(image), -1).astype(float)
        steps = np.abs(np.roll(rows, -1, axis=0) - rows).mean(axis=1)
        assert steps[-1] <= 1.2 * steps[:-1].max()


@pytest.mark.parametrize("skin", EVERYTHING.values(), ids=EVERYTHING)
def test_the_same_skin_is_drawn_the_same(skin: Skin) -> None:
    """The maps are the same byte by byte."""
    once, again = drawn(skin), drawn(skin)
    assert once.colour.tobytes() == again.colour.tobytes()
    assert once.roughness.tobytes() == again.roughness.tobytes()


def test_another_seed_is_another_pattern() -> None:
    """Two cables of one make have dirt in different places."""
    one, other = (drawn(make_skin(dirt=0.2, pattern_seed=seed)).colour.astype(float) for seed in (0, 1))
    assert np.abs(one - other).mean() > 5


@pytest.mark.parametrize(("kind", "pitch_m"), [(StripeKind.STRAIGHT, 0.5), (StripeKind.SPIRAL, 0.012)])
@pytest.mark.parametrize(("share", "count"), [(0.15, 1), (0.5, 2), (0.3, 4), (0.9, 3)])
def test_stripes_have_their_share(kind: StripeKind, pitch_m: float, share: float, count: int) -> None:
    """All stripes together cover their share of the surface, within 4 %."""
    images = drawn(striped(kind, share, count, pitch_m))
    assert share_of(images, WHITE, (200, 30, 30)) == pytest.approx(share, abs=0.04)


@pytest.mark.parametrize("count", [1, 3])
def test_a_spiral_comes_back_after_its_pitch(count: int) -> None:
    """Along a row, the stripes' starts are the pitch divided by their number apart."""
    images = drawn(striped(StripeKind.SPIRAL, 0.4, count, 0.02))
    row = nearer(images, WHITE, (200, 30, 30))[5]
    starts = np.flatnonzero(row[1:] & ~row[:-1])
    step_m = np.diff(starts).mean() * LENGTH_M / len(row)
    assert step_m == pytest.approx(0.02 / count, rel=0.05)


def test_a_marking_is_as_high_as_asked() -> None:
    """A marking is half a diameter high, within a pixel on either side."""
    images = drawn(make_skin(marking=MARKING, colour=(10, 10, 10)))
    rows = nearer(images, WHITE, (10, 10, 10)).any(axis=1)
    # It may lie across the seam; the rows without ink are then counted in the middle.
    height_m = np.count_nonzero(rows) * np.pi * DIAMETER_M / len(rows)
    assert height_m == pytest.approx(0.5 * DIAMETER_M, abs=3.5 * PIXEL_M)


def test_letters_are_as_wide_as_high() -> None:
    """A printed text has the proportions of its font: 13 letters are 8 to 13 times as long as high."""
    skin = make_skin(marking=MARKING.model_copy(update={"repeat_m": 0.5}), colour=(10, 10, 10))
    lengths = []
    for seed in range(12):
        images = drawn(skin.model_copy(update={"pattern_seed": seed}))
        columns = np.flatnonzero(nearer(images, WHITE, (10, 10, 10)).any(axis=0))
        if len(columns) and columns[0] > 2 and columns[-1] < images.colour.shape[1] - 3:
            lengths.append(np.ptp(columns) * LENGTH_M / images.colour.shape[1])
    assert lengths
    assert all(8 < length / (0.5 * DIAMETER_M) < 13 for length in lengths)


@pytest.mark.parametrize("share", [0.05, 0.2])
def test_dirt_has_its_share(share: float) -> None:
    """On a white cable the share of pixels darker than half is the dirt's, within half, as spots have soft edges."""
    images = drawn(make_skin(colour=WHITE, dirt=share))
    assert np.mean(images.colour.max(axis=2) < 150) == pytest.approx(share, rel=0.5)


def test_dirt_is_duller_than_the_sheath() -> None:
    """The dark spots of a glossy cable are rough."""
    images = drawn(make_skin(colour=WHITE, dirt=0.2, roughness=0.2))
    dark = images.colour.max(axis=2) < 120
    assert images.roughness[dark].mean() > 2 * images.roughness[~dark].mean()


def test_wear_pales() -> None:
    """A black cable becomes greyer where it is rubbed."""
    new, worn = (drawn(make_skin(colour=(10, 10, 10), wear=wear)).colour.mean() for wear in (0.0, 0.3))
    assert worn > new + 10


def test_a_matt_sheath_needs_no_relief() -> None:
    """A matt sheath has no normal map, which would cost tangents of every mesh."""
    assert drawn(make_skin(roughness=0.7)).normal is None
    assert drawn(make_skin(roughness=0.2)).normal is not None


def test_metal_braid_is_metal() -> None:
    """A grey and shiny braid is metal, any other one textile."""
    metal = drawn(make_skin(sheath=Sheath.BRAIDED, colour=(190, 190, 185), roughness=0.2))
    textile = drawn(make_skin(sheath=Sheath.BRAIDED, colour=(190, 30, 30), roughness=0.2))
    assert metal.metallic > 0.5
    assert textile.metallic == 0.0


def test_a_long_cable_close_by_stays_small() -> None:
    """Images have at most 4,096 columns and 256 rows."""
    images = draw_skin(make_skin(), 3.0, 0.02, 0.00005)
    assert images.colour.shape == (256, 4096, 3)
