"""Templates that try to run code or write files, in real processes of Blender and of the farm's check."""

import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("bpy")

from farm.cli.installed_assets import InstalledAssets  # after importorskip
from farm.errors import TemplateError
from farm.run.worker_settings import DeviceChoice, RendererSettings
from farm.spec.make_header import Inputs, make_header
from farm.spec.parse import parse_spec

pytestmark = [pytest.mark.blender, pytest.mark.slow]

PROGRAM = Path(__file__).with_name("hostile.py")
CODE = ["text", "handler", "driver", "freestyle"]


def run(*arguments: str) -> None:
    """Run the program that makes and renders templates."""
    command = [sys.executable, "-P", str(PROGRAM), *arguments]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def make(kind: str, folder: Path) -> Path:
    """Make a template of a kind, and remove the marker that making it may have left."""
    run(kind, str(folder / "template.blend"), str(folder / "marker"))
    for marker in folder.glob("marker"):
        marker.unlink()
    return folder / "template.blend"


def ask_worker(command: list[str], template: Path) -> "subprocess.CompletedProcess[str]":
    """Run one of the worker's commands on a dataset with the template."""
    spec = parse_spec({"quotas": {"far": 1}, "style": "published", "resolution": 64, "quality": "draft"}, source="test")
    header = make_header(spec, Inputs(template=template, environments=False), InstalledAssets())
    renderer = RendererSettings(device=DeviceChoice.CPU, threads=1)
    options = ["--renderer", renderer.as_argument(), "--logs", str(template.parent / "logs")]
    return subprocess.run(
        [sys.executable, "-P", "-m", "worker", *command, *options],
        input=header.model_dump_json(),
        capture_output=True,
        text=True,
        check=False,
    )


def markers(template: Path) -> list[str]:
    """The files that the template's code or nodes have written."""
    return [path.name for path in template.parent.glob("marker*")]


@pytest.mark.parametrize("kind", CODE)
def test_code_in_a_template_is_refused_and_does_not_run(tmp_path: Path, kind: str) -> None:
    """The check names the code in one line, and neither check nor preview runs it. With scripts on, it runs."""
    template = make(kind, tmp_path)
    for command in (["check"], ["preview", "--job", "far-000000", "--out", str(tmp_path / "picture.png")]):
        told = ask_worker(command, template)
        assert told.returncode == TemplateError.exit_code
        assert "the template must not hold" in told.stderr
        assert len(told.stderr.splitlines()) == 1
    assert markers(template) == []
    run("trusting", str(template), str(tmp_path / "own.png"))
    assert markers(template) == ["marker"]


@pytest.mark.parametrize("kind", CODE)
def test_code_does_not_run_even_in_a_render_without_the_check(tmp_path: Path, kind: str) -> None:
    """The farm opens files with scripts off, which alone keeps code from running."""
    template = make(kind, tmp_path)
    run("careful", str(template), str(tmp_path / "own.png"))
    assert (tmp_path / "own.png").exists()
    assert markers(template) == []


@pytest.mark.parametrize(("kind", "words"), [("script_node", "script node"), ("image", "outside file")])
def test_files_beside_a_template_are_refused(tmp_path: Path, kind: str, words: str) -> None:
    """A file beside the template is refused, as no checksum covers it."""
    told = ask_worker(["check"], make(kind, tmp_path))
    assert told.returncode == TemplateError.exit_code
    assert words in told.stderr


def test_a_linked_library_is_refused(tmp_path: Path) -> None:
    """A linked library is refused, even at an absolute path of this machine."""
    told = ask_worker(["check"], make("library", tmp_path))
    assert told.returncode == TemplateError.exit_code
    assert "library.blend" in told.stderr


def test_nodes_that_write_files_write_none(tmp_path: Path) -> None:
    """The farm renders without the compositor, whose file output needs no script. Blender alone writes the file."""
    template = make("file_output", tmp_path)
    told = ask_worker(["preview", "--job", "far-000000", "--out", str(tmp_path / "picture.png")], template)
    assert told.returncode == 0, told.stderr
    assert markers(template) == []
    run("careful", str(template), str(tmp_path / "own.png"))
    assert markers(template) == ["marker1.png"]


def test_arithmetic_in_drivers_is_allowed(tmp_path: Path) -> None:
    """Drivers with plain arithmetic are allowed, as Blender evaluates them without Python."""
    told = ask_worker(["check"], make("arithmetic", tmp_path))
    assert told.returncode == 0, told.stderr
