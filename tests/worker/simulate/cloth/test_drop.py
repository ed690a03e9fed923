"""Both set-ups of the cloth let the cables of a scene fall."""

from collections.abc import Mapping

import numpy as np
import pytest

bpy = pytest.importorskip("bpy")

from benchmarks.physics.published_cloth import CABLES, all_eight  # noqa: E402
from blend.build import TEMPLATE  # noqa: E402  # after importorskip
from blend.contract import open_template  # noqa: E402
from farm.scene.scene import Scene  # noqa: E402
from farm.spec.simulation import ClothFall, Fall, Simulator  # noqa: E402
from tests.worker.scenes import make_scene  # noqa: E402
from worker.simulate.simulate import simulate  # noqa: E402

pytestmark = pytest.mark.blender

KINDS = ("objects", "meshes", "scenes", "collections")


@pytest.fixture(autouse=True)
def _template() -> None:
    open_template(TEMPLATE)


def short_cables(count: int) -> Scene:
    """A scene of cables of 6 cm, which are fast to simulate."""
    return make_scene(ranges={"cable": {"count": [count, count], "length_m": 0.06, "diameter_m": 0.002}})


def contents() -> Mapping[str, list[str]]:
    """Names of everything in the open file."""
    return {kind: sorted(block.name for block in getattr(bpy.data, kind)) for kind in KINDS}


def test_the_joined_cloth_repeats_bitwise() -> None:
    """The same scene gives the same nodes to the last bit, whatever fell in between."""
    scene, fall = short_cables(4), Fall()
    first = simulate(scene, Simulator.CLOTH, fall)
    simulate(short_cables(2), Simulator.CLOTH, fall)
    again = simulate(scene, Simulator.CLOTH, fall)
    assert [nodes.tobytes() for nodes in first.nodes_m] == [nodes.tobytes() for nodes in again.nodes_m]


def test_the_published_set_up_returns_the_shown_cables_and_leaves_nothing_behind() -> None:
    """Two cables of eight come back, finite and lower than they started, and the file is as before."""
    scene, before = short_cables(2), contents()
    shapes = simulate(scene, Simulator.CLOTH_PUBLISHED, Fall(cloth=ClothFall(quality=1)))
    assert len(shapes.nodes_m) == len(shapes.speeds_m_s) == 2
    assert shapes.steps == 100
    for nodes, cable in zip(shapes.nodes_m, scene.cables, strict=True):
        assert np.isfinite(nodes).all()
        assert nodes[:, 2].mean() < cable.start_height_m
    assert contents() == before


def test_the_hidden_cables_are_stacked_above_the_shown() -> None:
    """All eight start at different heights, the shown ones first and as they are."""
    scene = short_cables(3)
    cables = all_eight(scene.cables)
    assert len(cables) == CABLES
    assert tuple(cables[:3]) == scene.cables
    heights = [cable.start_height_m for cable in cables]
    assert heights == sorted(set(heights))
