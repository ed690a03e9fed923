"""The fall of scenes without cables."""

import pytest

from farm.spec.category import Category
from farm.spec.simulation import Fall, Simulator
from tests.worker.scenes import make_scene
from worker.simulate.shapes import NOTHING_FELL
from worker.simulate.simulate import simulate

SCENES = [
    make_scene(Category.CLOSE_CONCENTRATED, index, style="wide", ranges={"cable": {"background_share": 1.0}})
    for index in range(20)
]
BARE = next(scene for scene in SCENES if not scene.sticks)
STICKS = next(scene for scene in SCENES if len(scene.sticks) > 1)


@pytest.mark.parametrize("simulator", Simulator)
def test_where_nothing_falls_nothing_is_simulated(simulator: Simulator) -> None:
    """A scene without cables and sticks has no shapes, whatever the simulator."""
    assert simulate(BARE, simulator, Fall()) is NOTHING_FELL


def test_sticks_fall_without_cables() -> None:
    """Rods bring all of a scene's sticks to rest on the floor or on each other."""
    shapes = simulate(STICKS, Simulator.ROD, Fall())
    assert shapes.nodes_m == ()
    assert len(shapes.sticks_m) == len(STICKS.sticks)
    lowest = [nodes[:, 2].min() - radius for nodes, radius in zip(shapes.sticks_m, shapes.stick_radii_m, strict=True)]
    assert min(lowest) == pytest.approx(0.0, abs=1e-4)
    assert shapes.fall_s < Fall().rod.max_time_s


def test_cloth_has_no_sticks() -> None:
    """Its scenes without cables have no shapes."""
    assert simulate(STICKS, Simulator.CLOTH, Fall()) is NOTHING_FELL
