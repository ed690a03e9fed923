"""The seconds that leaving something out saves, from scenes made both ways."""

from typing import Any

import pytest

from farm.spec.category import Category

pytest.importorskip("bpy")

from benchmarks.skips.savings import Saving, Trial  # after importorskip
from benchmarks.skips.skips import Skip

LAMP, HDRI = Category.CLOSE_CONCENTRATED, Category.CLOSE_DISTRIBUTED
"""Categories with two shares and with one share of the published mix of ten."""


def saving(*trials: Trial, same_picture: bool = True) -> Saving:
    """The saving of something that these two categories do without."""

    def prepare(*_: Any) -> Any:
        raise AssertionError("nothing is made here")

    return Saving(Skip("it", "render", (LAMP, HDRI), same_picture, prepare), trials)


def test_means_are_those_of_the_published_mix() -> None:
    """A category with two shares counts twice."""
    found = saving(Trial(LAMP, 2.0, 1.0, True), Trial(HDRI, 5.0, 1.0, True))
    assert found.with_s == pytest.approx(3.0)
    assert found.without_s == pytest.approx(1.0)


def test_what_few_pictures_do_without_saves_little_of_the_mix() -> None:
    """Two seconds saved in three shares of ten are 0.6 s per picture."""
    assert saving(Trial(LAMP, 3.0, 1.0, True), Trial(HDRI, 3.0, 1.0, True)).mix_s == pytest.approx(0.6)


@pytest.mark.parametrize(("same", "wrong"), [(True, False), (False, True), (None, False)])
def test_a_changed_picture_is_wrong(same: bool | None, wrong: bool) -> None:
    """A changed picture is wrong if it must not change; without a picture nothing is wrong."""
    trials = (Trial(LAMP, 1.0, 1.0, True), Trial(HDRI, 1.0, 1.0, same))
    assert saving(*trials).is_wrong is wrong
    assert not saving(*trials, same_picture=False).is_wrong
