"""docs/how-to/add-a-category.md, followed."""

import json

import pytest

from tests.how_to.page import SCRIPT, Tree, steps_of

PAGE = "add-a-category.md"
NAME = "far_concentrated_light"
CALIBRATION = "farm/spec/calibration.json"

DRAW = """
import sys
from farm.spec.category import Category
from farm.spec.job import Job
from farm.spec.quotas import split_total
from tests.worker.scenes import make_header
from worker.sample.scene import sample_scene
category = Category(sys.argv[1])
header = make_header(images=None, quotas={category: 2}, quality=sys.argv[2])
scene = sample_scene(header, Job(category=category, index=1), 0)
assert scene.floor is None and scene.hdri_world is None and scene.lamps
assert split_total(1000)[category] == 0
print(Job(category=category, index=1).id)
"""


def test_a_new_category_is_two_files() -> None:
    """Its traits, and the calibration that the page's program writes."""
    files = {step.file for step in steps_of(PAGE)}
    assert files == {"farm/spec/category.py", SCRIPT}
    assert CALIBRATION in next(step.block for step in steps_of(PAGE) if step.file == SCRIPT)


def test_before_it_is_calibrated_it_is_drawn_for_references_alone(tree: Tree) -> None:
    """Any other quality is told what to run."""
    tree.follow([step for step in steps_of(PAGE) if step.file != SCRIPT])
    assert tree.python(DRAW, NAME, "reference") == f"{NAME}-000001\n"
    with pytest.raises(AssertionError, match="run `make bench-render`"):
        tree.python(DRAW, NAME, "standard")


def test_once_calibrated_it_is_a_category_like_others(tree: Tree) -> None:
    """Here the measured settings are those of another; the tests of all categories pass, none of them touched."""
    category, script = steps_of(PAGE)
    tree.follow([category])
    known = json.loads((tree.folder / CALIBRATION).read_text())["categories"]
    (tree.folder / "results").mkdir()
    measured = {"categories": {**known, NAME: known["far"]}}
    (tree.folder / "results" / "calibration.json").write_text(json.dumps(measured))
    tree.follow([script])
    assert tree.python(DRAW, NAME, "standard") == f"{NAME}-000001\n"
    told = tree.pytest("tests/farm/spec", "tests/farm/cli/test_options.py", "tests/benchmarks/render/test_rows.py")
    assert " passed" in told
