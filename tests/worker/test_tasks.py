"""The Celery task, run by a real worker process."""

import os
import signal
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
import redis

from farm.completion import Completion
from farm.dataset import Dataset
from farm.job import Job
from farm.ledger.redis import RedisLedger
from farm.queue.celery import CeleryQueue
from farm.queue.settings import QUEUE, TASK_NAME, make_app

pytestmark = pytest.mark.redis

PATIENCE_S = 60.0
JOB = Job.from_id("far-000000")


@pytest.fixture
def queue(redis_url: str, redis_client: "redis.Redis") -> CeleryQueue:
    """An empty queue."""
    return CeleryQueue(make_app(redis_url), redis_client)


@pytest.fixture
def ledger(redis_client: "redis.Redis", dataset: Dataset) -> RedisLedger:
    """The dataset's ledger."""
    return RedisLedger(redis_client, dataset.name, dataset.header.spec_sha256)


@pytest.fixture
def worker(
    worker_command: list[str], redis_url: str, tmp_path: Path, queue: CeleryQueue
) -> Iterator["subprocess.Popen[bytes]"]:
    """A worker with the stand-in maker, on the store of the `dataset` fixture."""
    del queue  # emptied before the worker listens
    command = [*worker_command, "serve", "--store", str(tmp_path / "store"), "--name", "test"]
    process = subprocess.Popen(
        [*command, "--logs", str(tmp_path / "logs")],
        env={**os.environ, "FARM_BROKER_URL": redis_url, "STAND_IN_FAILS": "far-000001=passing"},
        stdout=subprocess.DEVNULL,
        stderr=(tmp_path / "main.log").open("wb"),
    )
    yield process
    process.terminate()
    process.wait(PATIENCE_S)


def wait_until_done(dataset: Dataset, count: int) -> None:
    """Wait for so many images."""
    completion = Completion(dataset)
    give_up_s = time.monotonic() + PATIENCE_S
    while len(completion.refresh()) < count:
        assert time.monotonic() < give_up_s
        time.sleep(0.05)


def test_message_becomes_a_picture(
    queue: CeleryQueue, worker: "subprocess.Popen[bytes]", dataset: Dataset, ledger: RedisLedger
) -> None:
    """A submitted job is made, counted and acknowledged."""
    del worker
    queue.submit([dataset.message(JOB)])
    wait_until_done(dataset, 1)
    give_up_s = time.monotonic() + PATIENCE_S
    while ledger.claims() or not ledger.activity().done:
        assert time.monotonic() < give_up_s
        time.sleep(0.05)
    assert queue.length() == 0


@pytest.mark.usefixtures("worker")
@pytest.mark.parametrize(
    "kwargs",
    [
        {},
        {"message": None},
        {"message": {"version": 9}},
        {"message": {"version": 1, "dataset": "../cables", "spec_sha256": "0" * 64, "job_id": "far-000000"}},
        {"other": 1},
    ],
)
def test_bad_message_does_not_stop_the_worker(
    redis_url: str, queue: CeleryQueue, dataset: Dataset, kwargs: dict[str, object]
) -> None:
    """A worker survives a malformed message and makes the next picture."""
    make_app(redis_url).send_task(TASK_NAME, kwargs=kwargs, queue=QUEUE)
    queue.submit([dataset.message(JOB)])
    wait_until_done(dataset, 1)


def test_passing_failure_is_put_off(
    queue: CeleryQueue, worker: "subprocess.Popen[bytes]", dataset: Dataset, ledger: RedisLedger
) -> None:
    """A job that fails in a way that may pass is held for its next try, and not counted as failed."""
    del worker
    queue.submit([dataset.message(Job.from_id("far-000001")), dataset.message(JOB)])
    wait_until_done(dataset, 1)
    assert "far-000001" in ledger.claims()
    assert ledger.failures() == {}


def test_stops_when_told(worker: "subprocess.Popen[bytes]", queue: CeleryQueue, dataset: Dataset) -> None:
    """A worker that is told to stop ends by itself."""
    queue.submit([dataset.message(JOB)])
    wait_until_done(dataset, 1)
    worker.send_signal(signal.SIGTERM)
    assert worker.wait(PATIENCE_S) == 0


def test_no_redis(worker_command: list[str], tmp_path: Path) -> None:
    """A worker whose Redis is not there ends with one line and its exit code."""
    result = subprocess.run(
        [*worker_command, "serve", "--store", str(tmp_path), "--name", "test", "--logs", str(tmp_path / "logs")],
        env={**os.environ, "FARM_BROKER_URL": "redis://127.0.0.1:1/0"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == 8
    assert len(result.stderr.splitlines()) == 1
    assert not (tmp_path / "logs").exists()
