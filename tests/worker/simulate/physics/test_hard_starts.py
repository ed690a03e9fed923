"""Scenes of the default style that an earlier solver drew again, each without the cables that did not matter.

They are all of the failures among 1,500 first attempts: cables that passed through each other, lay deep within each
other, or never came to rest. They hold coils, loops, bundles, sticks, and thin cables over and under thick ones.
"""

import json
from pathlib import Path
from typing import Any

import pytest

from farm.scene.scene import Scene
from farm.spec.simulation import RodFall
from tests.worker.scenes import make_scene, make_skin, make_stick
from worker.simulate.checks.accept import find_fault
from worker.simulate.checks.measure import measure
from worker.simulate.rod.fall import drop_cables
from worker.simulate.settle import find_unrest

STARTS = json.loads(Path(__file__).with_name("hard_starts.json").read_text(encoding="utf-8"))
"""For each scene its job, what failed, friction, wind (null for still air), and the geometry of cables and sticks."""


def scene_of(start: dict[str, Any]) -> Scene:
    """The scene, with plain cables and grey sticks."""
    plain = make_scene()
    skin, stick = make_skin().model_dump(mode="json"), make_stick().model_dump(mode="json")
    fields = {
        **plain.model_dump(mode="json"),
        "cables": [{**cable, "material": skin} for cable in start["cables"]],
        "sticks": [{**stick, **each} for each in start["sticks"]],
        "friction": start["friction"],
        "wind": start["wind"] or plain.wind.model_copy(update={"speed_m_s": 0.0}).model_dump(mode="json"),
    }
    return Scene.model_validate_json(json.dumps(fields))


@pytest.mark.parametrize("start", STARTS, ids=lambda start: f"{start['failed']}-{start['job']}")
def test_a_scene_that_once_failed_is_shipped(start: dict[str, Any]) -> None:
    """The cables rest, by all gates of the worker: none passed through another, or lies deep within one."""
    shapes = drop_cables(scene_of(start), RodFall())
    assert find_fault(measure(shapes)) is None
    assert find_unrest(shapes) is None
