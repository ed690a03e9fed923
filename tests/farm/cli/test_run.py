"""`farm run`, and the refusals that `farm submit` and `farm worker` share with it."""

import importlib
from pathlib import Path

import pytest
import redis
from PIL import Image

from farm.dataset.dataset import Dataset
from farm.errors import ConflictError, DestinationError, MachineError
from farm.local import run as local_run
from farm.local.run import LocalRun
from tests.farm.cli.result import Farm, assert_refused


@pytest.mark.redis
@pytest.mark.parametrize("command", ["run", "submit"])
def test_destination_that_cannot_be_written(
    farm: Farm, tmp_path: Path, redis_url: str, redis_client: "redis.Redis", command: str
) -> None:
    """A place below a file is refused before anything is queued."""
    (tmp_path / "file").write_text("")
    broker = ["--broker", redis_url] if command == "submit" else []
    result = farm(command, "--quota", "far=1", "--out", "file/data", *broker)
    assert_refused(result, DestinationError.exit_code, "file/data")
    assert redis_client.keys() == []


@pytest.mark.parametrize("command", ["run", "submit"])
def test_place_of_another_dataset(farm: Farm, redis_url: str, dataset: Dataset, command: str) -> None:
    """A place that holds another dataset is refused with the first difference, and stays as it is."""
    before = dataset.storage.files()
    broker = ["--broker", redis_url] if command == "submit" else []
    result = farm(command, "--quota", "far=1", "--out", dataset.storage.location, *broker)
    assert_refused(result, ConflictError.exit_code, "holds another dataset", "spec.quotas", "another --out")
    assert dataset.storage.files() == before


@pytest.mark.blender
@pytest.mark.redis
@pytest.mark.skipif(any(Path("/dev").glob("kfd")), reason="needs a machine without an AMD GPU")
@pytest.mark.parametrize("command", ["run", "worker"])
def test_device_that_is_not_there(farm: Farm, tmp_path: Path, redis_url: str, command: str) -> None:
    """A device that this machine lacks is refused before surfaces are drawn or a job is taken."""
    options = {"run": ["--images", "1", "--out", "data"], "worker": ["--store", ".", "--broker", redis_url]}[command]
    result = farm(command, *options, "--device", "hip", "--logs", "logs")
    assert_refused(result, MachineError.exit_code, "--device hip")
    assert not (tmp_path / "data").exists()
    assert list(tmp_path.rglob("*.png")) == []


def test_name_that_is_none(farm: Farm) -> None:
    """A place whose last part can't name a dataset is refused."""
    assert_refused(farm("run", "--images", "1", "--out", ".data"), DestinationError.exit_code, ".data")
    assert_refused(farm("run", "--images", "1", "--out", "two\nlines"), DestinationError.exit_code, r"two\nlines")


@pytest.mark.parametrize(
    ("options", "threads"),
    [
        ([], 1),
        (["--workers", "2"], 3),
        (["--workers", "4"], 1),
        (["--workers", "16"], 1),
        (["--workers", "1", "--threads", "5"], 5),
    ],
)
def test_threads_of_each_worker(farm: Farm, monkeypatch: pytest.MonkeyPatch, options: list[str], threads: int) -> None:
    """Threads are as given, else the cores divided by the workers, which are one per core by default; at least 1."""
    used: list[int] = []

    def note(_: object, __: object, how: LocalRun, ___: object) -> None:
        used.append(how.renderer.threads)
        raise MachineError("far enough")

    module = importlib.import_module("farm.cli.run")
    monkeypatch.setattr(local_run, "memory_bytes", lambda: 2**40)
    for place in (local_run, module):
        monkeypatch.setattr(place, "usable_cores", lambda: 6)
    monkeypatch.setattr(module, "run_locally", note)
    for step in ("require_blender", "check_device", "bake_for"):
        monkeypatch.setattr(module, step, lambda *_: None)
    result = farm("run", "--images", "1", "--out", "data", *options)
    assert_refused(result, MachineError.exit_code, "far enough")
    assert used == [threads]


def test_workers_look_in_the_commands_own_folders(farm: Farm, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A dataset whose header names files at their former places goes on with the folders that the command names."""
    for folder in ("textures", "photos", "more"):
        (tmp_path / folder).mkdir()
    Image.effect_noise((300, 300), 60).save(tmp_path / "textures" / "oak_color.png")
    Image.effect_noise((300, 300), 60).save(tmp_path / "photos" / "lab.png")
    (tmp_path / "mine.blend").write_bytes(b"BLENDER-v405")
    used: list[tuple[Path, ...]] = []

    def note(_: object, __: object, how: LocalRun, ___: object) -> None:
        used.append(how.renderer.inputs)
        raise MachineError("far enough")

    module = importlib.import_module("farm.cli.run")
    monkeypatch.setattr(module, "run_locally", note)
    for step in ("require_blender", "check_device", "bake_for", "ask_worker"):
        monkeypatch.setattr(module, step, lambda *_: None)
    own = ["--textures", "textures", "--backgrounds", "photos", "--template", "mine.blend", "--inputs", "more"]
    result = farm("run", "--images", "1", "--out", "data", *own)
    assert_refused(result, MachineError.exit_code, "far enough")
    assert used == [tuple(tmp_path / name for name in ("more", "textures", "photos", "mine.blend"))]
