"""`farm assets`."""

import importlib
import os
from collections.abc import Callable
from pathlib import Path

import pytest
from PIL import Image
from rich.console import Console

from assets.environments import ENVIRONMENTS
from assets.surfaces.bake import BakedSet
from farm.cli import baking
from farm.cli.installed_assets import InstalledAssets
from farm.errors import AssetError, SpecError
from farm.spec.header import HdriRef
from tests.farm.cli.result import Farm, assert_refused
from tests.stand_in import stand_in_header


def test_assets_to_check(farm: Farm) -> None:
    """Without a folder the command says that there is nothing to check."""
    assert_refused(farm("assets", "check"), SpecError.exit_code, "--textures DIR")


def test_photographs_are_checked(farm: Farm, tmp_path: Path) -> None:
    """Each photograph is listed with its size, and an unusable one is refused."""
    Image.new("RGB", (400, 300)).save(tmp_path / "lab.jpg")
    assert farm("assets", "check", "--backgrounds", str(tmp_path)).stdout == "photograph lab: 400 x 300\n"
    Image.new("RGB", (40, 30)).save(tmp_path / "thumb.jpg")
    result = farm("assets", "check", "--backgrounds", str(tmp_path))
    assert_refused(result, AssetError.exit_code, "thumb.jpg", "256 pixels")


def test_everything_wrong_is_listed_at_once(farm: Farm, tmp_path: Path) -> None:
    """All folders are checked to the end, each file is named in a line of its own, and the code says what was found."""
    for folder in ("textures", "photos", "hdris", "good"):
        (tmp_path / folder).mkdir()
    colour = Image.effect_noise((300, 300), 60)
    for name in ("oak_color.png", "oak_bump.png", "oak_disp.png", "oak_rough.png"):
        colour.save(tmp_path / "good" / name)
    colour.save(tmp_path / "textures" / "oak_normal.png")
    colour.save(tmp_path / "photos" / "lab.png")
    colour.save(tmp_path / "photos" / "two\nlines.png")
    (tmp_path / "photos" / os.fsdecode(b"caf\xe9.jpg")).write_bytes(b"")
    (tmp_path / "photos" / "cut.jpg").write_bytes(b"")
    good = farm("assets", "check", "--textures", "good", "--backgrounds", "photos", "--backgrounds", "nowhere")
    assert good.stdout.splitlines() == [
        "surface oak: colour, roughness",
        "left aside: good/oak_bump.png: not used: a map of height",
        "left aside: good/oak_disp.png: not used: a map of height",
        "photograph lab: 300 x 300",
        "photograph two\\nlines: 300 x 300",
        r"can not be used: photos/caf\udce9.jpg: its path isn't UTF-8; rename the file or its folder",
        "can not be used: photos/cut.jpg: the file is empty; copy or download it again",
        "can not be used: nowhere: isn't a folder; give the folder that holds your photographs",
    ]
    assert_refused(good, AssetError.exit_code, r"caf\udce9.jpg", "2 more are listed above")
    bad = farm("assets", "check", "--textures", "textures", "--hdris", "hdris")
    assert_refused(bad, AssetError.exit_code, "'oak' has no colour map", "1 more")
    assert farm("assets", "check", "--textures", "good").returncode == 0


def test_a_dataset_says_what_it_leaves_out(tmp_path: Path) -> None:
    """Each file that can't be used is named, up to a number; those of no use are counted."""
    Image.effect_noise((300, 300), 60).save(tmp_path / "lab.png")
    (tmp_path / "phone.heic").write_bytes(b"")
    for number in range(25):
        (tmp_path / f"{number:02}.jpg").write_bytes(b"")
    lines: list[str] = []
    assert [plate.name for plate in InstalledAssets(lines.append).plates_in(tmp_path)] == ["lab"]
    assert lines[0] == f"left out: {tmp_path}/00.jpg: the file is empty; copy or download it again"
    assert lines[20:] == [
        f"left out: 5 more files of {tmp_path}",
        f"1 files of {tmp_path} are not used; list them: farm assets check --backgrounds {tmp_path}",
    ]


def test_a_folder_of_which_nothing_is_left_is_refused(tmp_path: Path) -> None:
    """The error names the folder and the first file's fault."""
    (tmp_path / "cut.jpg").write_bytes(b"")
    with pytest.raises(AssetError, match=r"holds no photograph that can be used: .*cut\.jpg: the file is empty"):
        InstalledAssets().plates_in(tmp_path)


def test_assets_are_listed(farm: Farm) -> None:
    """The list has surfaces and HDRIs, and says which are drawn."""
    result = farm("assets", "list")
    assert result.returncode == 0
    assert "not yet" in result.stdout
    assert "CC0" in result.stdout


def test_environments_are_listed(farm: Farm) -> None:
    """Each environment is listed with its content."""
    result = farm("assets", "list")
    assert "switch_room_2" in result.stdout
    assert "switch room" in result.stdout


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[list[str]]:
    """Requests to the worker's program; no surface is drawn."""
    calls: list[list[str]] = []
    monkeypatch.setattr(
        importlib.import_module("farm.cli.assets"),
        "bake",
        lambda *_: BakedSet(directory=Path("none"), surfaces=(), drawn=()),
    )

    def note(arguments: list[str], _header: object, _logs: object, told: Callable[[str], None]) -> None:
        calls.append(arguments)
        told("workshop_1")

    monkeypatch.setattr(baking, "ask_worker", note)
    monkeypatch.setattr(baking, "require_blender", lambda: None)
    return calls


def test_a_build_renders_the_environments(farm: Farm, asked: list[list[str]], monkeypatch: pytest.MonkeyPatch) -> None:
    """A build renders all missing environments, at the size asked for, in the folder of the surfaces."""
    monkeypatch.setattr(importlib.import_module("farm.cli.assets"), "blender_is_installed", lambda: True)
    result = farm("assets", "build", "--assets", "here", "--pixels", "128")
    assert result.returncode == 0, result.stderr
    (arguments,) = asked
    assert arguments[:5] == ["environments", "--out", "here", "--pixels", "128"]
    assert [arguments[place + 1] for place, word in enumerate(arguments) if word == "--name"] == list(ENVIRONMENTS)
    assert f"{len(ENVIRONMENTS)} of them rendered now" in result.stdout


def test_a_build_without_environments(farm: Farm, asked: list[list[str]]) -> None:
    """A build may leave environments out."""
    assert farm("assets", "build", "--no-environments").returncode == 0
    assert asked == []


def test_a_build_without_blender(farm: Farm, asked: list[list[str]], monkeypatch: pytest.MonkeyPatch) -> None:
    """Without Blender the environments are skipped with a message, as a coordinator doesn't need them."""
    monkeypatch.setattr(importlib.import_module("farm.cli.assets"), "blender_is_installed", lambda: False)
    result = farm("assets", "build")
    assert result.returncode == 0
    assert "left out" in result.stdout
    assert asked == []


def test_a_dataset_gets_the_environments_that_it_names(asked: list[list[str]], tmp_path: Path) -> None:
    """The environments that a dataset names are rendered before it starts, and no others."""
    room = HdriRef(name="office_2", path=None, dark=False, recipe_version=1)
    header = stand_in_header(far=1)
    baking.bake_for(header.model_copy(update={"hdris": (*header.hdris, room)}), tmp_path, Console(quiet=True))
    (arguments,) = asked
    assert arguments[-2:] == ["--name", "office_2"]
    assert arguments.count("--name") == 1


def test_pictures_under_lamps_need_no_environment(
    asked: list[list[str]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A dataset under lamps renders no environment."""
    monkeypatch.setattr(baking, "bake", lambda *_: None)
    room = HdriRef(name="office_2", path=None, dark=False, recipe_version=1)
    header = stand_in_header(close_concentrated_light=1)
    baking.bake_for(header.model_copy(update={"hdris": (*header.hdris, room)}), tmp_path, Console(quiet=True))
    assert asked == []
