"""The published set-up lets eight cables fall."""

import numpy as np
import pytest

pytest.importorskip("bpy")

from benchmarks.physics.published_cloth import CABLES, all_eight, drop_cables  # after importorskip
from blend.build import TEMPLATE
from blend.content import describe_content
from blend.contract import open_template
from farm.scene.scene import Scene
from farm.spec.simulation import ClothFall
from tests.worker.scenes import make_scene

pytestmark = pytest.mark.blender


def short_cables(count: int) -> Scene:
    """A scene of cables of 6 cm, which are fast to simulate."""
    return make_scene(ranges={"cable": {"count": [count, count], "length_m": 0.06, "diameter_m": 0.002}})


def test_it_returns_the_shown_cables_and_leaves_nothing_behind() -> None:
    """Two cables of eight come back, finite and lower than they started, and the file holds what it held before."""
    open_template(TEMPLATE)
    scene, before = short_cables(2), describe_content()
    shapes = drop_cables(scene, ClothFall(quality=1))
    assert len(shapes.nodes_m) == len(shapes.speeds_m_s) == 2
    assert shapes.steps == 100
    for nodes, cable in zip(shapes.nodes_m, scene.cables, strict=True):
        assert np.isfinite(nodes).all()
        assert nodes[:, 2].mean() < cable.start_height_m
    assert describe_content() == before


def test_the_hidden_cables_are_stacked_above_the_shown() -> None:
    """All eight start at different heights, the shown ones first and as they are."""
    scene = short_cables(3)
    cables = all_eight(scene.cables)
    assert len(cables) == CABLES
    assert tuple(cables[:3]) == scene.cables
    heights = [cable.start_height_m for cable in cables]
    assert heights == sorted(set(heights))
