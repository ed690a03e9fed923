"""The promises of the styles."""

import pytest

from benchmarks.pictures.promises import promises_of
from benchmarks.pictures.survey import FIGURES, Distribution, Summary
from farm.spec.category import Category


def summary(**figures: Distribution) -> Summary:
    """A group with these figures, and arbitrary others."""
    other = Distribution(10, 0.0, 0.0, 0.0, 0.0, 0.0)
    return Summary(10, {name: figures.get(name, other) for name in FIGURES}, 5.0, 0.7, 1.0)


def mean(value: float) -> Distribution:
    """A distribution with this mean."""
    return Distribution(10, value, 1.0, value - 2, value, value + 2)


def spread(p5: float, p95: float) -> Distribution:
    """A distribution with these percentiles."""
    return Distribution(10, 0.5 * (p5 + p95), 1.0, p5, 0.5 * (p5 + p95), p95)


def test_published_pictures_promise_means_within_the_examples() -> None:
    """The mean of each category must be in range, and the side that misses is named; all together don't count."""
    far = summary(coverage=mean(0.12), grey_level=mean(81.0), grey_deviation=mean(43.0), width_px=mean(5.0))
    found = promises_of("published", {None: summary(), Category.FAR: far}, {})
    assert [(promise.what, promise.kept) for promise in found] == [
        ("coverage of far", True),
        ("grey_level of far", True),
        ("grey_deviation of far", False),
        ("width_px of far", False),
    ]
    assert "too high" in found[2].found
    assert "too low" in found[3].found


def test_coverage_of_more_scenes_stands_for_that_of_the_pictures() -> None:
    """The coverage of labelled scenes replaces that of the pictures, for the categories that have it."""
    pictures = {None: summary(), Category.FAR: summary(coverage=mean(0.10)), Category.FAR_ALIGNED: summary()}
    far, _, _, _, aligned, *_ = promises_of("published", pictures, {Category.FAR: mean(0.12)})
    assert far.kept
    assert not aligned.kept


@pytest.mark.parametrize(
    ("grey_level", "missed"),
    [
        (spread(60, 200), ""),
        (spread(40, 220), ""),
        (spread(61, 220), ", the lower side misses"),
        (spread(40, 199), ", the upper side misses"),
        (spread(61, 199), ", the lower and the upper side misses"),
    ],
)
def test_wide_pictures_promise_to_cover_a_range(grey_level: Distribution, missed: str) -> None:
    """One in twenty pictures must lie at or beyond each end."""
    level, deviation = promises_of("wide", {None: summary(grey_level=grey_level, grey_deviation=spread(20, 75))}, {})
    assert level.kept == (not missed)
    assert level.found.endswith(missed)
    assert ("misses" in level.found) == bool(missed)
    assert deviation.kept


def test_what_is_not_known_keeps_no_promise() -> None:
    """If no picture shows a cable there is no width, and its promise is broken."""
    far = summary(coverage=mean(0.12), grey_level=mean(90.0), grey_deviation=mean(30.0), width_px=mean(float("nan")))
    assert not promises_of("published", {None: far, Category.FAR: far}, {})[-1].kept


def test_other_datasets_promise_nothing() -> None:
    """A dataset with a name of the user's own promises nothing."""
    assert promises_of("mine", {None: summary()}, {}) == []
