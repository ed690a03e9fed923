"""The conclusions of the rendering benchmark."""

from hypothesis import given
from hypothesis import strategies as st

from benchmarks.render.errors import Errors
from benchmarks.render.report import calibrate
from benchmarks.render.rows import Row, Shot, disturbing_settings, front, idle_settings
from benchmarks.render.variants import Group, Variant, ladder, turns
from farm.spec.category import Category
from farm.spec.rendering import CyclesSettings, PictureSettings

FIGURES = st.tuples(st.floats(0.1, 10), st.floats(0.001, 0.2), st.floats(20, 50))


def row(
    name: str,
    figures: tuple[float, float, float] = (1.0, 0.03, 36.0),
    *,
    sha256: str = "a",
    same: bool = False,
    category: Category = Category.FAR,
) -> Row:
    """A row of a single scene."""
    seconds, flip, psnr_db = figures
    variant = Variant(name, Group.SAMPLES, PictureSettings(cycles=CyclesSettings(samples=1)), same)
    return Row(variant, category, (Shot("far-000000", 0.0, seconds, Errors(flip, psnr_db), sha256),))


@given(st.lists(FIGURES, min_size=1, max_size=12))
def test_the_front_holds_what_nothing_beats(found: list[tuple[float, float, float]]) -> None:
    """No row of the front is slower and no better than another one; every row left out is."""
    rows = [row(str(number), figures) for number, figures in enumerate(found)]
    kept = front(rows)
    assert kept
    for each in rows:
        beaten = any(
            other.seconds <= each.seconds and other.flip <= each.flip and other.psnr_db >= each.psnr_db
            for other in kept
            if other is not each
        )
        assert each in kept or beaten
    assert list(kept) == sorted(kept, key=lambda each: each.seconds)


def test_a_setting_that_changes_nothing_is_named() -> None:
    """A changed setting that gave the base's bytes in every scene is named."""
    rows = [row("base"), row("turned"), row("acting", sha256="b"), row("kept", same=True)]
    assert idle_settings(rows) == ["turned"]


def test_a_setting_that_may_not_change_the_picture_is_named_if_it_does() -> None:
    """A setting that must not change the picture is named if it does."""
    rows = [row("base"), row("turned", sha256="b"), row("kept", sha256="b", same=True), row("held", same=True)]
    assert disturbing_settings(rows) == ["kept"]


def test_a_calibration_holds_the_front_of_each_category() -> None:
    """A calibration holds the mean figures, and the least number of scenes."""
    rows = [row("fast", (1.0, 0.05, 33.0), category=category) for category in Category]
    rows += [row("good", (2.0, 0.02, 38.0), category=category) for category in Category]
    rows += [row("bad", (3.0, 0.06, 30.0), category=category) for category in Category]
    calibration = calibrate(rows)
    assert calibration.scenes == 1
    assert [each.flip for each in calibration.categories[Category.FAR]] == [0.05, 0.02]


def test_variants_have_names_of_their_own() -> None:
    """The names of all variants differ."""
    for variants in (list(ladder()), list(turns())):
        names = [variant.name for variant in variants]
        assert len(set(names)) == len(names)


def test_each_turn_changes_the_base() -> None:
    """No setting is changed to the value that it already has."""
    base, *others = turns()
    assert all(variant.settings != base.settings for variant in others)
