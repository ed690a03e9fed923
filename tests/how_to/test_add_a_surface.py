"""docs/how-to/add-a-surface.md, followed."""

import pytest

from assets.surfaces.catalogue import SURFACES
from tests.how_to.page import Tree, steps_of

PAGE = "add-a-surface.md"

BAKE = """
import sys
from pathlib import Path
from assets.surfaces.bake import bake_surfaces
from assets.surfaces.catalogue import SURFACES
from farm.cli.installed_assets import InstalledAssets
from farm.spec.styles import Style
bake_surfaces(Path(sys.argv[1]), pixels=64, names=[sys.argv[2]], processes=1)
print(*(surface.name for surface in InstalledAssets().builtin_surfaces(Style.PUBLISHED)))
print(*(surface.name for surface in InstalledAssets().builtin_surfaces(Style.WIDE)))
"""


@pytest.mark.parametrize(
    ("heading", "name"), [("To a family that is there", "mouse_mat"), ("In a family of its own", "blackboard")]
)
def test_a_new_surface_is_one_file_and_is_drawn_and_found(tree: Tree, heading: str, name: str) -> None:
    """It is baked, the wide style shows it, the published one does not, and the others keep their order."""
    steps = steps_of(PAGE, heading)
    assert len({step.file for step in steps}) == 1
    tree.follow(steps)
    published, wide = tree.python(BAKE, str(tree.folder / "baked"), name).splitlines()
    assert (tree.folder / "baked" / name / "surface.json").is_file()
    assert published.split() == [known for known, recipe in SURFACES.items() if recipe.published]
    assert [each for each in wide.split() if each != name] == list(SURFACES)
    assert name in wide.split()


def test_the_new_surfaces_pass_the_tests_of_all_surfaces(tree: Tree) -> None:
    """As the page says, and no test needs to know them."""
    tree.follow(steps_of(PAGE))
    told = tree.pytest("tests/assets/surfaces/test_catalogue.py", "-k", "blackboard or mouse_mat or name or order")
    assert " passed" in told
