"""Who may import whom, proved in a fresh interpreter."""

import pkgutil
import subprocess
import sys

import pytest

import assets
import farm

PROGRAM = """
import importlib, sys
for name in sys.argv[1:]: importlib.import_module(name)
print(*sorted({name.partition(".")[0] for name in sys.modules} & {"bpy", "worker", "blend"}))
"""
PURE_STAGES = [
    f"worker.{stage}"
    for stage in [
        "randomize",
        "shapes",
        "check",
        "tube",
        "label",
        "gates",
        "plate",
        "rod.fall",
        "cloth.strip",
        "cloth.scale",
    ]
]
ASSETS = ["assets", *(module.name for module in pkgutil.walk_packages(assets.__path__, "assets."))]
MODULES = ["farm", *(module.name for module in pkgutil.walk_packages(farm.__path__, "farm."))]


def test_all_modules_together() -> None:
    """No module of `farm` brings Blender, nor the packages that use it, however deep."""
    program = "\n".join(f"import {name}" for name in MODULES)
    program += "\nimport sys\nprint(*sorted({n.partition('.')[0] for n in sys.modules} & {'bpy', 'worker', 'blend'}))"
    result = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr
    assert result.stdout.split() == []


@pytest.mark.parametrize(
    "module", ["worker.service.process", "worker.cli", "worker.service.tasks", "worker.service.upload"]
)
def test_worker_process_starts_without_blender(module: str) -> None:
    """Celery's main process forks, so what it imports must not bring Blender."""
    result = subprocess.run([sys.executable, "-c", PROGRAM, module], capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr
    assert result.stdout.split() == ["worker"]


@pytest.mark.parametrize("module", PURE_STAGES)
def test_stage_without_blender(module: str) -> None:
    """The stages that need no Blender don't bring it, so they can be tested and read without."""
    result = subprocess.run([sys.executable, "-c", PROGRAM, module], capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr
    assert result.stdout.split() == ["worker"]


def test_assets_stand_alone() -> None:
    """Surfaces and HDRIs are drawn and checked without Blender and without what uses them."""
    result = subprocess.run([sys.executable, "-c", PROGRAM, *ASSETS], capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr
    assert result.stdout.split() == []
