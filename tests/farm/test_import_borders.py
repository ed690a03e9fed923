"""Who may import whom, proved in a fresh interpreter."""

import pkgutil
import subprocess
import sys

import pytest

import farm

PROGRAM = """
import importlib, sys
importlib.import_module(sys.argv[1])
print(*sorted({name.partition(".")[0] for name in sys.modules} & {"bpy", "worker", "blend"}))
"""
MODULES = ["farm", *(module.name for module in pkgutil.walk_packages(farm.__path__, "farm."))]


def test_all_modules_together() -> None:
    """No module of `farm` brings Blender, nor the packages that use it, however deep."""
    program = "\n".join(f"import {name}" for name in MODULES)
    program += "\nimport sys\nprint(*sorted({n.partition('.')[0] for n in sys.modules} & {'bpy', 'worker', 'blend'}))"
    result = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr
    assert result.stdout.split() == []


@pytest.mark.parametrize("module", ["worker.process", "worker.command", "worker.tasks", "worker.upload"])
def test_worker_process_starts_without_blender(module: str) -> None:
    """Celery's main process forks, so what it imports must not bring Blender."""
    result = subprocess.run([sys.executable, "-c", PROGRAM, module], capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr
    assert result.stdout.split() == ["worker"]
