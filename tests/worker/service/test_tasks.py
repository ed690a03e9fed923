"""The Celery task, run by a real worker process."""

import os
import signal
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

import pytest
import redis

from farm.dataset.completion import Completion
from farm.dataset.dataset import Dataset
from farm.dataset.quarantine import Quarantine
from farm.errors import DatasetMissingError, MachineError
from farm.run.handle import run_of
from farm.run.ledger.redis import RedisLedger
from farm.run.queue.celery import CeleryQueue
from farm.run.queue.settings import QUEUE, TASK_NAME, make_app
from farm.run.registry.port import Run
from farm.run.registry.redis import RedisRegistry
from farm.run.worker_settings import WorkerSettings
from farm.spec.job import Job

pytestmark = pytest.mark.redis

PATIENCE_S = 60.0
JOB = Job.from_id("far-000000")


@pytest.fixture
def queue(redis_url: str, redis_client: "redis.Redis") -> CeleryQueue:
    """An empty queue."""
    return CeleryQueue(make_app(redis_url), redis_client)


@pytest.fixture
def run(redis_client: "redis.Redis", dataset: Dataset) -> Run:
    """The dataset's run, which is registered."""
    return RedisRegistry(redis_client).register(run_of(dataset))


@pytest.fixture
def ledger(redis_client: "redis.Redis", dataset: Dataset) -> RedisLedger:
    """The dataset's ledger."""
    return RedisLedger(redis_client, dataset.name, dataset.identity)


@pytest.fixture
def worker(
    worker_command: list[str], redis_url: str, tmp_path: Path, queue: CeleryQueue
) -> Iterator["subprocess.Popen[bytes]"]:
    """A worker with the stand-in renderer, on the store of the `dataset` fixture."""
    del queue  # emptied before the worker listens
    settings = WorkerSettings(store=str(tmp_path / "store"), name="test", logs=tmp_path / "logs", min_free_mib=0)
    process = subprocess.Popen(
        [*worker_command, *settings.serve_arguments()],
        env={
            **os.environ,
            "FARM_BROKER_URL": redis_url,
            "STAND_IN_FAILS": "far-000001=passing",
        },
        stdout=subprocess.DEVNULL,
        stderr=(tmp_path / "main.log").open("wb"),
    )
    yield process
    process.terminate()
    try:
        process.wait(PATIENCE_S)
    finally:
        process.kill()  # the worker's renderer ends with it


def wait_until_done(dataset: Dataset, count: int) -> None:
    """Wait until a number of images are done."""
    completion = Completion(dataset)
    give_up_s = time.monotonic() + PATIENCE_S
    while len(completion.look()) < count:
        assert time.monotonic() < give_up_s
        time.sleep(0.05)


def test_message_becomes_a_picture(
    queue: CeleryQueue, run: Run, worker: "subprocess.Popen[bytes]", dataset: Dataset, ledger: RedisLedger
) -> None:
    """A submitted job is made, counted and acknowledged."""
    del worker
    queue.submit(run, [dataset.message(JOB)])
    wait_until_done(dataset, 1)
    give_up_s = time.monotonic() + PATIENCE_S
    while ledger.claims() or not ledger.activity().last_picture:
        assert time.monotonic() < give_up_s
        time.sleep(0.05)
    assert queue.length(run) == 0


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
    redis_url: str, queue: CeleryQueue, run: Run, dataset: Dataset, kwargs: dict[str, object]
) -> None:
    """A worker survives a malformed message and makes the next picture."""
    make_app(redis_url).send_task(TASK_NAME, kwargs=kwargs, queue=QUEUE)
    queue.submit(run, [dataset.message(JOB)])
    wait_until_done(dataset, 1)


def test_passing_failure_is_put_off(
    queue: CeleryQueue, run: Run, worker: "subprocess.Popen[bytes]", dataset: Dataset, ledger: RedisLedger
) -> None:
    """A job with a failure that may pass is held for its next attempt, and doesn't count as failed."""
    del worker
    queue.submit(run, [dataset.message(Job.from_id("far-000001")), dataset.message(JOB)])
    wait_until_done(dataset, 1)
    assert "far-000001" in ledger.claims()
    assert Quarantine(dataset).look() == {}


def test_stops_when_told(worker: "subprocess.Popen[bytes]", queue: CeleryQueue, run: Run, dataset: Dataset) -> None:
    """A worker that is told to stop ends by itself."""
    queue.submit(run, [dataset.message(JOB)])
    wait_until_done(dataset, 1)
    worker.send_signal(signal.SIGTERM)
    assert worker.wait(PATIENCE_S) == 0


def serve(command: list[str], store: Path, redis_url: str, **environment: str) -> "subprocess.CompletedProcess[str]":
    """A worker that ends by itself."""
    return subprocess.run(
        [*command, *WorkerSettings(store=str(store), name="unfit", logs=store.parent / "logs").serve_arguments()],
        env={**os.environ, "FARM_BROKER_URL": redis_url, **environment},
        capture_output=True,
        text=True,
        check=False,
        timeout=PATIENCE_S,
    )


def test_unfit_worker_takes_itself_out(
    worker_command: list[str],
    tmp_path: Path,
    redis_url: str,
    queue: CeleryQueue,
    run: Run,
    dataset: Dataset,
    ledger: RedisLedger,
) -> None:
    """A worker that can't open its renderer gives its job back and ends, with the reason and its code."""
    queue.submit(run, [dataset.message(JOB)])
    result = serve(worker_command, tmp_path / "store", redis_url, STAND_IN_UNFIT="--device optix: no such device")
    assert result.returncode == MachineError.exit_code
    assert result.stderr.splitlines()[-1] == "--device optix: no such device"
    assert list(queue.queued(run)) == [JOB]
    assert Quarantine(dataset).look() == ledger.claims() == {}


def test_worker_with_a_wrong_store_takes_itself_out(
    worker_command: list[str],
    tmp_path: Path,
    redis_url: str,
    queue: CeleryQueue,
    run: Run,
    dataset: Dataset,
) -> None:
    """A worker whose store lacks the dataset leaves all of its jobs to others."""
    queue.submit(run, [dataset.message(job) for job in dataset.header.spec.jobs()])
    result = serve(worker_command, tmp_path / "elsewhere", redis_url)
    assert result.returncode == DatasetMissingError.exit_code
    assert "elsewhere" in result.stderr.splitlines()[-1]
    assert len({job.id for job in queue.queued(run)}) == 4
    assert Quarantine(dataset).look() == {}


@pytest.mark.parametrize("spoilt", ["logs", "store"])
def test_folder_that_cannot_be_used(worker_command: list[str], tmp_path: Path, redis_url: str, spoilt: str) -> None:
    """A worker that can't write logs or read its store says so in one line before it takes a job."""
    (tmp_path / "file").write_text("")
    folders = {"logs": tmp_path / "logs", "store": tmp_path, spoilt: tmp_path / "file/below"}
    settings = WorkerSettings(store=str(folders["store"]), name="test", logs=folders["logs"])
    result = subprocess.run(
        [*worker_command, *settings.serve_arguments()],
        env={**os.environ, "FARM_BROKER_URL": redis_url},
        capture_output=True,
        text=True,
        check=False,
        timeout=PATIENCE_S,
    )
    assert result.returncode == 6
    assert len(result.stderr.splitlines()) == 1
    assert "file/below" in result.stderr


def test_no_redis(worker_command: list[str], tmp_path: Path) -> None:
    """A worker whose Redis is not there ends with one line and its exit code."""
    settings = WorkerSettings(store=str(tmp_path), name="test", logs=tmp_path / "logs")
    result = subprocess.run(
        [*worker_command, *settings.serve_arguments()],
        env={**os.environ, "FARM_BROKER_URL": "redis://127.0.0.1:1/0"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert result.returncode == 8
    assert len(result.stderr.splitlines()) == 1
    assert not (tmp_path / "logs").exists()
