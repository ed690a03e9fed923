"""docs/how-to/add-a-simulator.md, followed."""

import pytest

from tests.how_to.page import Tree, steps_of

PAGE = "add-a-simulator.md"

FALL = """
import numpy as np
from farm.spec.parse import parse_spec
from tests.worker.scenes import make_scene
from worker.simulate.checks.measure import measure
from worker.simulate.simulate import simulate
spec = parse_spec({"images": 6, "simulator": "flat", "fall": {"flat": {"nodes": 200}}}, source="test")
scene = make_scene(ranges={"cable": {"count": [1, 1]}})
shapes = simulate(scene, spec.simulator, spec.fall)
figures = measure(shapes)
assert len(shapes.nodes_m[0]) == 200
assert figures.length_error < 1e-6 and figures.floor_penetration < 1e-6
"""


def test_a_new_simulator_is_a_folder_and_one_file() -> None:
    """And nothing else."""
    files = {step.file for step in steps_of(PAGE)}
    assert {file for file in files if not file.startswith("worker/simulate/flat/")} == {"farm/spec/simulation.py"}


def test_a_new_simulator_has_settings_grants_and_a_word_of_the_command_line(tree: Tree) -> None:
    """The tests of all simulators pass with it, none of them touched, and `farm run --help` names it."""
    tree.follow(steps_of(PAGE))
    told = tree.pytest("tests/farm/spec/test_simulation.py", "tests/worker/simulate/test_grants.py")
    assert " passed" in told
    options = "from farm.cli import app; app(['run', '--simulator', 'string'])"
    with pytest.raises(AssertionError, match="flat"):
        tree.python(options)


@pytest.mark.blender
def test_a_new_simulator_lets_cables_fall(tree: Tree) -> None:
    """By the name and the settings of a description."""
    pytest.importorskip("bpy")
    tree.follow(steps_of(PAGE))
    tree.python(FALL)
