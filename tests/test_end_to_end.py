"""The whole farm as a user runs it: `farm run` with real Redis, real Celery workers and real Blender."""

import os
import signal
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import cv2
import numpy as np
import pytest

from farm.dataset.dataset import open_dataset
from farm.dataset.destination import parse_destination
from farm.dataset.outputs import OUTPUTS
from farm.dataset.paths import file_path
from farm.dataset.verify import verify
from farm.spec.category import Category

pytest.importorskip("bpy")
pytestmark = [pytest.mark.blender, pytest.mark.redis, pytest.mark.slow]

IMAGES = 12
PATIENCE_S = 240.0


@pytest.fixture(scope="module")
def textures(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A user's own texture: a colour map and a roughness map."""
    folder = tmp_path_factory.mktemp("textures")
    rng = np.random.default_rng(0)
    cv2.imwrite(str(folder / "speckle_1k_color.png"), rng.integers(60, 200, (64, 64, 3), dtype=np.uint8))
    cv2.imwrite(str(folder / "speckle_1k_roughness.png"), np.full((64, 64), 150, np.uint8))
    return folder


def start_run(out: Path, textures: Path, workers: int) -> "subprocess.Popen[str]":
    """Start `farm run` on small pictures of all six categories."""
    arguments = ["run", "--images", str(IMAGES), "--seed", "0", "--resolution", "96", "--quality", "draft"]
    arguments += ["--no-environments"]
    arguments += ["--textures", str(textures), "--no-builtin-textures", "--out", str(out)]
    arguments += ["--workers", str(workers), "--device", "cpu", "--logs", str(out.parent / f"logs-{out.name}")]
    program = [sys.executable, "-P", "-m", "farm", *arguments]
    return subprocess.Popen(program, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def finish(run: "subprocess.Popen[str]") -> None:
    """Wait for a run and require that it succeeded."""
    output, _ = run.communicate(timeout=PATIENCE_S)
    assert run.returncode == 0, output


def descendants(pid: int) -> list[int]:
    """The living descendants of a process, parents first."""
    children: dict[int, list[int]] = {}
    for folder in Path("/proc").iterdir():
        # A process may end while its folder is being read.
        with suppress(OSError, ValueError):
            state, parent = (folder / "stat").read_text().rpartition(")")[2].split()[:2]
            if state != "Z":
                children.setdefault(int(parent), []).append(int(folder.name))
    found = [pid]
    for each in found:
        found += children.get(each, [])
    return found[1:]


def is_a_worker(pid: int) -> bool:
    """Whether a process is a worker of the farm, a main process or a child."""
    with suppress(OSError):
        return b"\0worker.__main__\0serve" in Path(f"/proc/{pid}/cmdline").read_bytes()
    return False


def kill_a_worker_in_the_middle(run: "subprocess.Popen[str]", out: Path) -> None:
    """Kill the last started worker process with SIGKILL, once a picture is done and others aren't."""
    give_up_s = time.monotonic() + PATIENCE_S
    while not list(out.glob("*/manifests/*.json")):
        assert time.monotonic() < give_up_s
        assert run.poll() is None
        time.sleep(0.05)
    workers = [pid for pid in descendants(run.pid) if is_a_worker(pid)]
    assert len(list(out.glob("*/manifests/*.json"))) < IMAGES
    os.kill(workers[-1], signal.SIGKILL)


@pytest.fixture(scope="module")
def datasets(tmp_path_factory: pytest.TempPathFactory, textures: Path) -> tuple[Path, Path]:
    """The same dataset from one worker, and from two of which one is killed."""
    folder = tmp_path_factory.mktemp("datasets")
    calm, stormy = folder / "calm", folder / "stormy"
    finish(start_run(calm, textures, workers=1))
    run = start_run(stormy, textures, workers=2)
    kill_a_worker_in_the_middle(run, stormy)
    finish(run)
    return calm, stormy


def test_a_run_fills_the_quota_of_every_category(datasets: tuple[Path, Path]) -> None:
    """12 images are split 2:2:1:1:2:2, each with mask, instances and manifest."""
    for place in datasets:
        published = [category for category in Category if category.traits.weight]
        assert [len(list((place / category / "images").iterdir())) for category in published] == [3, 3, 1, 1, 2, 2]


def test_a_killed_worker_loses_and_doubles_nothing(datasets: tuple[Path, Path]) -> None:
    """After SIGKILL of a worker process every file is right, and there is no other."""
    for place in datasets:
        assert verify(open_dataset(parse_destination(str(place)))).findings == ()


def test_two_runs_give_the_same_bytes(datasets: tuple[Path, Path]) -> None:
    """Every image, mask and instance map is the same with one worker or two, even if one is killed."""
    calm, stormy = datasets
    for job in open_dataset(parse_destination(str(calm))).header.spec.jobs():
        for output in OUTPUTS:
            path = file_path(job, output)
            assert (calm / path).read_bytes() == (stormy / path).read_bytes(), path
