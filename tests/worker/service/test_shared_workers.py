"""Runs that share two real workers."""

import os
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from farm.cli.mending import repair, retry
from farm.dataset.dataset import Dataset
from farm.dataset.outputs import IMAGE
from farm.dataset.paths import file_path, manifest_path, quarantine_path
from farm.dataset.quarantine import Quarantine, QuarantineRecord, put_in_quarantine
from farm.dataset.verify import verify
from farm.errors import RunCancelledError
from farm.local.redis_server import private_redis
from farm.run.coordinator import Coordinator
from farm.run.progress import RunHandle
from farm.run.registry.port import Priority, RunState, WorkerState
from farm.spec.job import Job
from tests.live_farm import LiveFarm, done, is_once_each, live_farm, wait_for, wait_until_done
from worker.service.runner import MAX_STARTS

pytestmark = pytest.mark.redis

CRASHING = "close_concentrated_light-000001"


@pytest.fixture(scope="module")
def farm(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LiveFarm]:
    """Two workers that take a twentieth of a second for an image, on a Redis of their own."""
    command = [sys.executable, "-P", str(Path(__file__).parents[2] / "stand_in.py")]
    with private_redis() as url, live_farm(tmp_path_factory.mktemp("farm"), url, command) as farm:
        for name in ("one", "two"):
            farm.start(name, STAND_IN_DELAY_S="0.05", STAND_IN_FAILS=f"{CRASHING}=crash")
        wait_for(lambda: len(farm.workers(WorkerState.IDLE)) == 2)
        yield farm


def wait_until_settled(handle: RunHandle) -> None:
    """Wait until no worker works for a run, and a while longer, in which one might begin to."""
    for _ in range(2):
        wait_for(lambda: not handle.ledger.claims())
        time.sleep(1.5)


def test_two_runs_take_turns(farm: LiveFarm) -> None:
    """Two runs of one priority progress in step, and each image is made once."""
    since = len(farm.starts())
    one, two = farm.dataset("one", far=30), farm.dataset("two", far_aligned=30)
    for dataset in (one, two):
        handle = farm.handle(dataset)
        handle.registry.register(handle.run)
    time.sleep(3.0)  # both workers join both runs
    for dataset in (one, two):
        farm.submit(dataset)
    wait_until_done(one)
    wait_until_done(two)
    starts = farm.starts(since)
    assert len(starts) == 60
    assert 6 <= sum(job_id.startswith("far_aligned") for job_id in starts[:30]) <= 24


def test_urgent_run_goes_first(farm: LiveFarm) -> None:
    """A later run of high priority is made whole while the other one waits, except for messages already taken."""
    normal, urgent = farm.dataset("normal", far=200), farm.dataset("urgent", far_aligned=8)
    since = len(farm.starts())
    normal_hints = farm.submit(normal)
    wait_until_done(normal, 3)
    farm.submit(urgent, Priority.HIGH)
    wait_until_done(urgent)
    farm.cancel(normal_hints)
    starts = farm.starts(since)
    of_urgent = [number for number, job_id in enumerate(starts) if job_id.startswith("far_aligned")]
    assert len(of_urgent) == 8
    # Each worker has taken one message before, and may join a queue a second after the other.
    between = of_urgent[-1] - of_urgent[0] + 1 - 8
    assert between <= 30
    assert done(normal) < 200


def test_pause_and_resume(farm: LiveFarm) -> None:
    """A paused run stops once images that were begun are finished; resumed, it continues, each image made once."""
    dataset = farm.dataset("paused", far=60)
    since = len(farm.starts())
    handle = farm.submit(dataset)
    wait_until_done(dataset, 3)
    farm.want(handle, RunState.PAUSED)
    wait_until_settled(handle)
    stopped = done(dataset)
    waiting = handle.queue.length(handle.run)
    time.sleep(2.0)
    assert done(dataset) == stopped < 60
    assert handle.queue.length(handle.run) == waiting
    farm.want(handle, RunState.ACTIVE)
    Coordinator(dataset, handle, poll_s=0.2, lost_after_s=2.0).watch()
    assert is_once_each(farm.starts(since), dataset)


def test_cancel(farm: LiveFarm) -> None:
    """A cancelled run has an empty queue and whole images, and its watchers are told."""
    dataset = farm.dataset("cancelled", far=200)
    handle = farm.submit(dataset)
    wait_until_done(dataset, 3)
    farm.cancel(handle)
    wait_until_settled(handle)
    stopped = done(dataset)
    assert handle.queue.length(handle.run) == 0
    with pytest.raises(RunCancelledError):
        Coordinator(dataset, handle).watch()
    assert done(dataset) == stopped < 200
    assert {finding.path.split("/")[1] for finding in verify(dataset).findings} == {"manifests"}


def test_job_that_crashes_its_process(farm: LiveFarm) -> None:
    """The job is begun three times and goes to quarantine with its last output; the others are made."""
    dataset = farm.dataset("crashing", close_concentrated_light=4)
    since = len(farm.starts())
    farm.submit(dataset)
    wait_for(lambda: CRASHING in Quarantine(dataset).look())
    wait_until_done(dataset, 3)
    assert farm.starts(since).count(CRASHING) == MAX_STARTS
    record = QuarantineRecord.model_validate_json(dataset.storage.read(quarantine_path(Job.from_id(CRASHING))))
    assert "its process died" in record.reason
    assert "the last words" in record.log


def made(farm: LiveFarm, name: str) -> Dataset:
    """A finished dataset."""
    dataset = farm.dataset(name, far=4)
    farm.submit(dataset)
    wait_until_done(dataset)
    return dataset


def test_retry(farm: LiveFarm, capsys: pytest.CaptureFixture[str]) -> None:
    """`farm retry` puts a given-up job back, and it is made."""
    dataset, job = made(farm, "retried"), Job.from_id("far-000002")
    put_in_quarantine(dataset, job, "died", attempts=3, worker="host:1", log="")
    dataset.storage.remove(manifest_path(job))
    retry(dataset.storage.location, [job.id], broker=farm.url)
    assert "1 images put back; 1 queued" in capsys.readouterr().out
    wait_until_done(dataset)
    assert verify(dataset).clean
    assert Quarantine(dataset).look() == {}


def test_repair_with_checksums(farm: LiveFarm, capsys: pytest.CaptureFixture[str]) -> None:
    """`farm repair --checksums` makes an image again that only its checksum shows to be damaged."""
    dataset = made(farm, "repaired")
    path = file_path(Job.from_id("far-000002"), IMAGE)
    whole = dataset.storage.read(path)
    altered = bytearray(whole)
    altered[-20] ^= 1
    file = Path(dataset.storage.location) / path
    times = file.stat()
    file.write_bytes(altered)
    os.utime(file, ns=(times.st_atime_ns, times.st_mtime_ns))
    repair(dataset.storage.location, broker=farm.url)
    assert "0 of 4 images queued" in capsys.readouterr().out
    repair(dataset.storage.location, broker=farm.url, checksums=True)
    assert "1 of 4 images queued" in capsys.readouterr().out
    wait_until_done(dataset)
    assert dataset.storage.read(path) == whole
    assert verify(dataset).clean
