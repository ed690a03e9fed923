"""`farm worker`."""

import importlib
import os
from pathlib import Path

import pytest

from farm.errors import DestinationError
from farm.run.worker_settings import WorkerSettings
from tests.farm.cli.result import Farm, assert_refused


@pytest.mark.redis
def test_worker_whose_store_is_a_file(farm: Farm, tmp_path: Path, redis_url: str) -> None:
    """A store that can't be read is refused before a job is taken."""
    (tmp_path / "file").write_text("")
    assert_refused(farm("worker", "--store", "file", "--broker", redis_url), DestinationError.exit_code, "file")


@pytest.fixture
def started(monkeypatch: pytest.MonkeyPatch) -> list[WorkerSettings]:
    """Settings of the workers that the command would become; nothing is asked or drawn before."""
    module, settings = importlib.import_module("farm.cli.worker"), list[WorkerSettings]()
    for name in ("require_blender", "wait_for", "check_device", "bake"):
        monkeypatch.setattr(module, name, lambda *_: None)
    monkeypatch.setattr(module, "become_worker", lambda chosen, _: settings.append(chosen))
    return settings


def test_a_worker_is_told_where_inputs_are(
    farm: Farm, tmp_path: Path, started: list[WorkerSettings], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The folders come by the option, repeated, or by FARM_INPUTS; they are absolute."""
    assert farm("worker", "--store", ".", "--inputs", "a", "--inputs", "/b c").returncode == 0
    monkeypatch.setenv("FARM_INPUTS", os.pathsep.join(["/d e", "f"]))
    assert farm("worker", "--store", ".").returncode == 0
    monkeypatch.delenv("FARM_INPUTS")
    assert farm("worker", "--store", ".").returncode == 0
    assert [settings.renderer.inputs for settings in started] == [
        (tmp_path / "a", Path("/b c")),
        (Path("/d e"), tmp_path / "f"),
        (),
    ]
    assert WorkerSettings.from_argument(started[0].as_argument()) == started[0]
