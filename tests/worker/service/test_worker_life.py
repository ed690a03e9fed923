"""The end of a real worker and of its renderers, and the reasons that hold it back."""

import shutil
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest
import redis

from farm.dataset.dataset import Dataset
from farm.dataset.quarantine import Quarantine
from farm.dataset.verify import verify
from farm.run.registry.port import WorkerState
from tests.live_farm import (
    PATIENCE_S,
    LiveFarm,
    done,
    is_once_each,
    live_farm,
    processes_with,
    wait_for,
    wait_until_done,
)
from worker.service.runner import MAX_STARTS

pytestmark = pytest.mark.redis


@pytest.fixture
def farm(tmp_path: Path, redis_url: str, redis_client: "redis.Redis", worker_command: list[str]) -> Iterator[LiveFarm]:
    """A farm without workers."""
    del redis_client  # this fixture empties Redis
    with live_farm(tmp_path, redis_url, worker_command) as farm:
        yield farm


@pytest.fixture
def six(farm: LiveFarm) -> Dataset:
    """A dataset of six jobs."""
    return farm.dataset("cables", far=6)


def test_worker_that_is_told_to_stop_finishes_its_image(farm: LiveFarm, six: Dataset) -> None:
    """A worker that is told to stop finishes its image, takes no more, and gives the rest back."""
    handle = farm.submit(six)
    worker = farm.start("w", STAND_IN_DELAY_S="1")
    wait_for(lambda: len(farm.starts()) == 2)
    worker.send_signal(signal.SIGTERM)
    assert worker.wait(PATIENCE_S) == 0
    begun = len(farm.starts())
    assert done(six) == begun < 6
    assert handle.ledger.claims() == {}
    assert handle.queue.length(handle.run) == 6 - begun
    assert handle.registry.workers() == ()
    assert processes_with(str(farm.logs)) == {}


def test_worker_that_is_told_twice_ends_at_once(farm: LiveFarm, six: Dataset) -> None:
    """A second signal ends a worker during its image, with its renderer; another worker makes the image."""
    handle = farm.submit(six)
    worker = farm.start("w", STAND_IN_DELAY_S="3600")
    wait_for(farm.starts)

    def ended() -> bool:
        worker.send_signal(signal.SIGTERM)
        return worker.poll() is not None

    wait_for(ended)
    assert worker.returncode == 128 + signal.SIGTERM
    wait_for(lambda: not processes_with(str(farm.logs)))
    farm.start("next")
    farm.submit(six)
    wait_until_done(six, 6)
    assert Quarantine(six).look() == handle.ledger.claims() == {}


def test_store_that_cannot_be_written_holds_the_worker(farm: LiveFarm, six: Dataset) -> None:
    """While a folder can't be written the worker is held, with the reason, and no job fails; then it continues."""
    in_the_way = Path(six.storage.location) / "far"
    in_the_way.write_text("no folder")
    handle = farm.submit_without_look(six)
    farm.start("w")
    wait_for(lambda: farm.workers(WorkerState.HELD))
    assert str(in_the_way) in farm.workers(WorkerState.HELD)[0].reason
    assert Quarantine(six).look() == {}
    in_the_way.unlink()
    wait_until_done(six)
    assert verify(six).clean
    wait_for(lambda: not handle.ledger.claims())
    assert len(farm.starts()) == 6


def test_folder_that_goes_away_amid_a_run(farm: LiveFarm, six: Dataset) -> None:
    """A folder that is replaced by a file during a run holds the worker; put back, it has all images."""
    farm.submit(six)
    farm.start("w", STAND_IN_DELAY_S="0.2")
    images = Path(six.storage.location) / "far/images"
    aside = images.with_name("aside")
    wait_until_done(six, 1)
    images.rename(aside)
    images.write_text("no folder")
    wait_for(lambda: farm.workers(WorkerState.HELD))
    assert Quarantine(six).look() == {}
    images.unlink()
    shutil.move(aside, images)
    wait_until_done(six)
    assert verify(six).clean


def test_replaced_renderers_lose_no_job(farm: LiveFarm) -> None:
    """A renderer that is replaced after three images hands over to the next; each image is made once."""
    dataset = farm.dataset("cables", far=8)
    farm.submit(dataset)
    farm.start("w", {"tasks_per_child": 3})
    wait_until_done(dataset)
    assert is_once_each(farm.starts(), dataset)
    assert len(farm.by_renderer()) == 3


@pytest.mark.slow
def test_renderer_above_its_memory_limit(farm: LiveFarm, six: Dataset) -> None:
    """A renderer above its memory limit is killed; its image is given up after three starts, and others are made."""
    farm.submit(six)
    farm.start("w", {"memory_per_child_kib": 160 * 1024}, STAND_IN_FAILS="far-000001=bloat")
    wait_for(lambda: "far-000001" in Quarantine(six).look())
    wait_until_done(six, 5)
    assert farm.starts().count("far-000001") == MAX_STARTS
    assert "MiB and is killed" in (farm.logs / "w.log").read_text()
    assert "its process died" in Quarantine(six).look()["far-000001"]


@pytest.mark.slow
def test_job_that_meets_the_hard_limit(farm: LiveFarm, six: Dataset) -> None:
    """A job that is killed at the time limit is tried again, but not for ever, and holds nobody up."""
    farm.submit(six)
    farm.start("w", {"time_limit_s": 2.0}, STAND_IN_FAILS="far-000001=hang")
    wait_for(lambda: "far-000001" in Quarantine(six).look())
    assert f"in each of {MAX_STARTS} attempts" in Quarantine(six).look()["far-000001"]
    assert farm.starts().count("far-000001") == MAX_STARTS
    wait_until_done(six, 5)
