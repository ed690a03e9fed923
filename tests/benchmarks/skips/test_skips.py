"""Pictures that Blender makes with the things that the farm leaves out."""

import json
from pathlib import Path

import pytest

from farm.errors import VerificationError
from farm.spec.category import Category

pytest.importorskip("bpy")

from assets.surfaces.bake import bake_surfaces  # after importorskip
from benchmarks.skips import command
from benchmarks.skips.savings import Saving

pytestmark = pytest.mark.blender


FLOOR = "linen"
"""Floor of the scene under a lamp, with which the far scene is tried, too."""


@pytest.fixture(scope="module")
def surfaces(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with that one small surface."""
    folder = tmp_path_factory.mktemp("surfaces")
    bake_surfaces(folder, pixels=256, names=[FLOOR], processes=1)
    return folder


@pytest.fixture(autouse=True)
def _found_there(surfaces: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The skips on a machine whose cache holds no other surface."""
    monkeypatch.setenv("FARM_ASSETS", str(surfaces))


@pytest.mark.parametrize("category", [Category.FAR, Category.CLOSE_CONCENTRATED])
def test_a_small_run(tmp_path: Path, capsys: pytest.CaptureFixture[str], category: Category) -> None:
    """Every skip of a category is timed, and those that must not change a picture don't."""
    assert command.run(tmp_path, seed=0, scenes=1, resolution=32, categories=(category,)) == 0
    found = {each["left_out"] for each in json.loads((tmp_path / "skips.json").read_text())["skips"]}
    only = {Category.FAR: "paths to what is behind the cables", Category.CLOSE_CONCENTRATED: "the HDRI under a lamp"}
    assert found & set(only.values()) == {only[category]}
    assert (tmp_path / "skips.png").stat().st_size > 0
    assert "undo steps" in capsys.readouterr().out


def test_a_changed_picture_fails_the_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A changed picture fails the run after its tables are written."""
    monkeypatch.setattr(Saving, "is_wrong", property(lambda saving: saving.skip.name == "undo steps"))
    with pytest.raises(VerificationError, match="undo steps"):
        command.run(tmp_path, seed=0, scenes=1, resolution=16, categories=(Category.FAR,))
    assert (tmp_path / "skips.json").exists()
