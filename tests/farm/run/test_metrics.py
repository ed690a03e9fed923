"""The metrics that Prometheus reads, over real Redis, parsed as Prometheus does."""

import os
import subprocess
import sys
import urllib.request
from pathlib import Path

import pytest
import redis
from prometheus_client import CollectorRegistry, generate_latest
from prometheus_client.parser import text_string_to_metric_families

from farm.dataset.dataset import Dataset
from farm.dataset.quarantine import put_in_quarantine
from farm.errors import BrokerError
from farm.run.handle import open_handle
from farm.run.metrics import FOLDER_EVERY_S, FarmCollector
from farm.run.progress import RunHandle
from farm.run.registry.port import Run, WorkerReport, WorkerState
from farm.run.registry.redis import RedisRegistry
from farm.spec.job import Job
from tests.doubles.ledger import MemoryLedger
from tests.doubles.queue import MemoryQueue
from tests.doubles.registry import MemoryRegistry
from tests.stand_in import StandInRenderer
from worker.service.upload import upload

DONE, GIVEN_UP = Job.from_id("far-000000"), Job.from_id("far-000001")

Values = dict[tuple[str, ...], float]


def scrape(text: str) -> Values:
    """Values by the metric's name and its labels' values, in order of the labels' names."""
    return {
        (sample.name, *(sample.labels[name] for name in sorted(sample.labels))): sample.value
        for family in text_string_to_metric_families(text)
        for sample in family.samples
    }


def values_of(collector: FarmCollector) -> Values:
    """The values of a collector's scrape."""
    registry = CollectorRegistry(auto_describe=False)
    registry.register(collector)
    return scrape(generate_latest(registry).decode())


@pytest.fixture
def handle(dataset: Dataset) -> RunHandle:
    """A run in memory."""
    run = Run(dataset=dataset.name, spec_sha256=dataset.identity)
    return RunHandle(run=run, ledger=MemoryLedger(), queue=MemoryQueue(), registry=MemoryRegistry())


@pytest.fixture
def half_done(dataset: Dataset) -> Dataset:
    """One image done, one given up, two missing."""
    upload(StandInRenderer().make(DONE, dataset.header), DONE, dataset)
    put_in_quarantine(dataset, GIVEN_UP, "no scene passed", attempts=1, worker="a:1", log="")
    return dataset


def test_images_by_category_and_state(half_done: Dataset, handle: RunHandle) -> None:
    """Every image asked for is in one state."""
    values = values_of(FarmCollector(lambda: [(half_done, handle)], handle.registry))
    assert values["farm_images", "far", "cables", "done"] == 1
    assert values["farm_images", "far", "cables", "quarantined"] == 1
    assert values["farm_images", "far", "cables", "missing"] == 0
    assert values["farm_images", "close_concentrated_light", "cables", "missing"] == 2


def test_queue_and_totals(dataset: Dataset, handle: RunHandle) -> None:
    """Waiting and running jobs and the totals are counted."""
    handle.registry.register(handle.run)
    handle.queue.submit(handle.run, [dataset.message(DONE), dataset.message(GIVEN_UP)])
    handle.ledger.claim(DONE.id, "elsewhere:1")
    handle.ledger.add_figures({"retries": 3, "images:far": 2, "seconds:render": 1.5})
    values = values_of(FarmCollector(lambda: [(dataset, handle)], handle.registry))
    assert values["farm_queue_length", "cables"] == 2
    assert values["farm_jobs_running", "cables"] == 1
    assert values["farm_run_active", "cables"] == 1
    assert values["farm_retries_total", "cables"] == 3
    assert values["farm_images_made_total", "far", "cables"] == 2
    assert values["farm_stage_seconds_total", "cables", "render"] == 1.5


def test_workers(handle: RunHandle) -> None:
    """The metrics hold the number of workers in each state, and each worker's jobs and memory."""
    handle.registry.report(WorkerReport(name="a@host", state=WorkerState.WORKING, done=7, rss_bytes=1000))
    handle.registry.report(WorkerReport(name="b@host", state=WorkerState.HELD, reason="full"))
    values = values_of(FarmCollector(list, handle.registry))
    assert values["farm_workers", "working"] == values["farm_workers", "held"] == 1
    assert values["farm_workers", "idle"] == 0
    assert values["farm_worker_jobs_total", "a@host"] == 7
    assert values["farm_worker_resident_memory_bytes", "a@host"] == 1000


def test_redis_that_is_away(half_done: Dataset, handle: RunHandle) -> None:
    """If Redis is away, the folder's metrics remain, and one says that Redis is away."""
    away = False

    def find() -> list[tuple[Dataset, RunHandle]]:
        if away:
            raise BrokerError("gone")
        return [(half_done, handle)]

    collector = FarmCollector(find, handle.registry)
    assert values_of(collector)["farm_redis_up",] == 1
    away = True
    values = values_of(collector)
    assert values["farm_redis_up",] == 0
    assert values["farm_images", "far", "cables", "done"] == 1
    assert ("farm_queue_length", "cables") not in values


def test_folder_is_not_listed_at_every_scrape(dataset: Dataset, handle: RunHandle) -> None:
    """A new image shows after a while and not at once."""
    now_s = 0.0

    def clock() -> float:
        return now_s

    collector = FarmCollector(lambda: [(dataset, handle)], handle.registry, clock)
    assert values_of(collector)["farm_images", "far", "cables", "done"] == 0
    upload(StandInRenderer().make(DONE, dataset.header), DONE, dataset)
    assert values_of(collector)["farm_images", "far", "cables", "done"] == 0
    now_s = FOLDER_EVERY_S
    assert values_of(collector)["farm_images", "far", "cables", "done"] == 1


@pytest.mark.redis
@pytest.mark.parametrize("named", [True, False])
def test_served_to_prometheus(
    half_done: Dataset,
    redis_url: str,
    redis_client: "redis.Redis",
    tmp_path: Path,
    named: bool,
) -> None:
    """`farm metrics` serves a dataset by its name, or all active ones of a store, on this host alone."""
    handle = open_handle(half_done, redis_url, redis_client)
    RedisRegistry(redis_client).register(handle.run)
    place = [half_done.storage.location] if named else ["--store", str(tmp_path / "store")]
    process = subprocess.Popen(
        [sys.executable, "-P", "-m", "farm", "metrics", *place, "--broker", redis_url, "--port", "0"],
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, "FARM_STORE": ""} if named else None,
    )
    try:
        assert process.stdout is not None
        address = process.stdout.readline().split()[1]
        assert address.startswith("http://127.0.0.1:")
        with urllib.request.urlopen(address) as page:  # noqa: S310 - its own page
            values = scrape(page.read().decode())
    finally:
        process.terminate()
        assert process.wait(30) == 0
    assert values["farm_images", "far", "cables", "done"] == 1
    assert values["farm_queue_length", "cables"] == 0
