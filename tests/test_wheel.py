"""What ships: the wheel that users and the images install."""

import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
COMMAND = "cable_farm.py"
PACKAGES = ("assets", "blend", "farm", "worker")
DATA = (".toml", ".json", ".html", ".lua", ".blend", ".typed")


@pytest.fixture(scope="module")
def shipped(tmp_path_factory: pytest.TempPathFactory) -> set[str]:
    """The paths in a wheel built from a copy of the tree."""
    source, out = tmp_path_factory.mktemp("source"), tmp_path_factory.mktemp("wheel")
    for folder in (*PACKAGES, "benchmarks", "tests"):
        shutil.copytree(ROOT / folder, source / folder, ignore=shutil.ignore_patterns("__pycache__"))
    for name in ("pyproject.toml", "README.md", "LICENSE", COMMAND):
        shutil.copy(ROOT / name, source)
    command = [sys.executable, "-m", "pip", "wheel", "--quiet", "--disable-pip-version-check", "--no-deps"]
    command += ["--no-build-isolation", "--no-index", "--wheel-dir", str(out), str(source)]
    subprocess.run(command, check=True, capture_output=True)
    (wheel,) = out.glob("*.whl")
    with zipfile.ZipFile(wheel) as archive:
        return {name for name in archive.namelist() if ".dist-info/" not in name}


def test_benchmarks_and_tests_stay_out(shipped: set[str]) -> None:
    """The wheel holds the four packages of the product and the module of its command, and nothing else."""
    assert {name.partition("/")[0] for name in shipped} == {*PACKAGES, COMMAND}


def test_modules_and_data_are_all_there(shipped: set[str]) -> None:
    """Every module of the four packages ships, and so does every data file beside a module."""
    wanted = {
        file.relative_to(ROOT).as_posix()
        for package in PACKAGES
        for file in (ROOT / package).rglob("*")
        if file.suffix in {".py", *DATA} and "built" not in file.parts
    }
    assert wanted - shipped == set()
