"""The relative cost of surfaces."""

import pytest

from benchmarks.surfaces.costs import SurfaceCost, too_costly


def cost(name: str, render: float, build: float = 0.1) -> SurfaceCost:
    """Over two scenes in which a plain surface takes 1 s to render and 0.1 s to set."""
    return SurfaceCost(name, (render, render), (1.0, 1.0), (build, build), (0.1, 0.1))


def test_a_ratio_is_that_of_all_scenes_together() -> None:
    """A scene that takes longer counts more."""
    uneven = SurfaceCost("oak", (1.0, 3.0), (1.0, 1.0), (0.0, 0.0), (0.0, 0.0))
    assert uneven.ratio == 2.0


def test_setting_the_scene_counts_in_the_whole() -> None:
    """And not in the rendering."""
    assert cost("oak", 1.0, build=0.65).ratio == 1.0
    assert cost("oak", 1.0, build=0.65).whole_ratio == pytest.approx(1.5)


def test_what_is_too_costly_is_named_the_costliest_first() -> None:
    """Surfaces more than a tenth above the plain one are named, the costliest first."""
    costs = [cost("oak", 1.09), cost("grass", 1.2), cost("gravel", 1.3)]
    assert [each.name for each in too_costly(costs)] == ["gravel", "grass"]
