"""The farm's programs find the farm's own packages."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from farm.errors import MachineError
from farm.start import PACKAGES, ROOT, arranged, program

NAMESAKES = ("worker", "blend", "assets", "farm", "celery", "redis", "numpy", "pydantic", "queue", "calendar")


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A project of somebody that has modules of the farm's and its libraries' names; each of them tells of itself."""
    for name in (*NAMESAKES, "only_here"):
        (tmp_path / f"{name}.py").write_text(f"print('the {name} of a project')\n")
    (tmp_path / "usercustomize.py").write_text("print('a customised Python')\n")
    return tmp_path


def run(command: list[str], folder: Path, **more: str) -> "subprocess.CompletedProcess[str]":
    """Run a command in a folder that is on Python's path too, with more variables."""
    environment = {**os.environ, "PYTHONPATH": ".", **more}
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)


def test_programs_find_their_own(project: Path) -> None:
    """A program of the farm finds no module of the working folder or of PYTHONPATH that has another home."""
    found = run([*program("tests.farm.found_modules"), *NAMESAKES, "only_here"], project, OCIO="/nowhere")
    assert found.returncode == 0, found.stderr
    told = json.loads(found.stdout)
    places = {name: Path(place).parent for name, place in told["origins"].items()}
    assert [name for name, place in places.items() if place == project] == ["only_here"]
    assert {places[name] for name in PACKAGES} == {ROOT / name for name in PACKAGES}
    assert "OCIO" not in told["environment"]


def test_the_command_finds_its_own(project: Path) -> None:
    """The command `farm` runs in a project that has modules of all its names."""
    starter = "import sys; sys.argv[1:] = ['--version']; import cable_farm; cable_farm.main()"
    found = run([sys.executable, "-P", "-c", starter], project, PYTHONPATH=os.pathsep.join([".", str(ROOT)]))
    assert found.returncode == 0, found.stderr
    assert "of a project" not in found.stdout + found.stderr


@pytest.mark.parametrize("name", ["worker", "farm"])
def test_another_package_of_our_name_is_told(project: Path, name: str) -> None:
    """A package of the farm's name that was imported before gives one line with its file, and code 14."""
    starter = f"import {name}, cable_farm; cable_farm.main()"
    found = run([sys.executable, "-c", starter], project, PYTHONPATH=os.pathsep.join([".", str(ROOT)]))
    assert found.returncode == MachineError.exit_code
    assert found.stderr.startswith(f"farm: {project / name}.py: ")
    assert found.stderr.count("\n") == 1


def test_path_in_order() -> None:
    """Python's own library comes first, then the farm, then what is installed, and what is foreign last."""
    library = str(Path(os.__file__).parent)
    path = ["/scripts", "/project", library, f"{library}/lib-dynload", "/v/site-packages", ""]
    assert arranged(path, ["/project", "/scripts", "/project"], "/root") == [
        *(library, f"{library}/lib-dynload", "/root", "/v/site-packages", "/project", "/scripts")
    ]


def test_root_on_a_foreign_path_stays_in_front() -> None:
    """A farm that PYTHONPATH itself names is found before the rest of PYTHONPATH."""
    assert arranged(["/other", "/root", "/v/site-packages"], ["/other", "/root"], "/root") == [
        *("/root", "/v/site-packages", "/other")
    ]


def test_the_worker_started_by_hand_starts_afresh(project: Path) -> None:
    """`python -m worker` becomes the isolated program: neither its warnings nor its locale are those of its caller."""
    command = [sys.executable, "-P", "-m", "worker", "--help"]
    found = run(command, project, PYTHONPATH=str(ROOT), PYTHONWARNINGS="error", OCIO="/nowhere")
    assert found.returncode == 0, found.stderr
