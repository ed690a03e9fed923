"""Blender's cloth lets the cables of a scene fall, in whatever template is open."""

from pathlib import Path
from typing import Any

import pytest

bpy = pytest.importorskip("bpy")

from blend import fall as fall_scene  # noqa: E402  # after importorskip
from blend.build import TEMPLATE  # noqa: E402
from blend.content import describe_content  # noqa: E402
from blend.contract import open_template  # noqa: E402
from farm.scene.scene import Scene  # noqa: E402
from farm.spec.simulation import ClothFall, Fall, Simulator  # noqa: E402
from tests.worker.scenes import make_scene  # noqa: E402
from worker.simulate.cloth import fall as cloth  # noqa: E402
from worker.simulate.simulate import simulate  # noqa: E402

pytestmark = pytest.mark.blender


@pytest.fixture(autouse=True)
def _template() -> None:
    open_template(TEMPLATE)


def short_cables(count: int) -> Scene:
    """A scene of cables of 6 cm, which are fast to simulate."""
    return make_scene(ranges={"cable": {"count": [count, count], "length_m": 0.06, "diameter_m": 0.002}})


def fallen(count: int, simulator: Simulator = Simulator.CLOTH) -> list[bytes]:
    """The settled nodes of a scene, to the last bit."""
    return [nodes.tobytes() for nodes in simulate(short_cables(count), simulator, Fall()).nodes_m]


def test_the_cloth_repeats_bitwise() -> None:
    """The same scene gives the same nodes to the last bit, whatever fell in between."""
    first = fallen(4)
    fallen(2)
    assert fallen(4) == first


def test_a_fall_leaves_the_open_file_as_it_was() -> None:
    """Every scene, object, mesh and material holds what it held before, so that no picture tells of the fall."""
    before = describe_content()
    fallen(2)
    assert describe_content() == before


@pytest.mark.parametrize("simulator", Simulator)
def test_a_template_without_a_scene_of_the_fall_gives_the_same_fall(tmp_path: Path, simulator: Simulator) -> None:
    """The template that comes with the farm holds such a scene; an artist's own need not."""
    with_one = fallen(2, simulator)
    bpy.data.batch_remove([*bpy.data.scenes[fall_scene.SCENE].objects, bpy.data.scenes[fall_scene.SCENE]])
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "picture.blend"), copy=True)
    open_template(tmp_path / "picture.blend")
    assert fallen(2, simulator) == with_one


def test_what_an_artist_changed_in_a_scene_of_the_fall_changes_no_fall() -> None:
    """Nothing reads it: here its floor is tilted and its wind blows."""
    untouched = fallen(2)
    scene = bpy.data.scenes[fall_scene.SCENE]
    for each in scene.objects:
        each.rotation_euler.x += 0.3
        if each.field is not None:
            each.field.strength = 50.0
    assert fallen(2) == untouched


@pytest.mark.parametrize("count", [1, 3])
def test_only_the_cables_of_the_scene_are_simulated(count: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """The mesh that falls has the vertices of the drawn cables and no more."""
    counted = []
    step_until_rest = cloth._step_until_rest

    def count_vertices(scene: Any, cables: Any, *rest: Any) -> Any:
        counted.append(len(cables.data.vertices))
        return step_until_rest(scene, cables, *rest)

    monkeypatch.setattr(cloth, "_step_until_rest", count_vertices)
    fallen(count)
    assert counted == [count * (round(0.06 / (5 * 0.001)) + 1)]


def test_a_fall_of_cloth_says_whether_it_came_to_rest() -> None:
    """One that its number of frames stops in mid-air has not rested."""
    scene = short_cables(1)
    assert simulate(scene, Simulator.CLOTH, Fall()).rested
    assert not simulate(scene, Simulator.CLOTH, Fall(cloth=ClothFall(max_frames=10))).rested
