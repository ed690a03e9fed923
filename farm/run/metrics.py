"""The farm's metrics for Prometheus, read at each scrape from the registry and ledgers in Redis, and from the folders.

Flower's metrics count Celery's tasks; these count images. Names follow Prometheus' conventions: base units, and
`_total` for counters.
"""

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import ClassVar

from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily, Metric
from prometheus_client.registry import Collector

from farm.dataset.completion import Completion
from farm.dataset.dataset import Dataset
from farm.dataset.quarantine import Quarantine
from farm.errors import BrokerError, DestinationError
from farm.run.ledger.owner import live_claims
from farm.run.ledger.port import RETRY_OWNER
from farm.run.progress import RunHandle
from farm.run.registry.port import RunRegistry, RunState, WorkerReport, WorkerState
from farm.spec.job import Job
from farm.spec.job_set import JobSet

FOLDER_EVERY_S = 30.0
"""Shortest time between two listings of a folder, in seconds, however often Prometheus scrapes."""


@dataclass(slots=True)
class _Folder:
    completion: Completion
    quarantine: Quarantine
    quarantined: JobSet
    looked_s: float = float("-inf")


Found = tuple[Dataset, RunHandle]


class FarmCollector(Collector):
    """Collects the metrics of some datasets and of all workers.

    Args:
        find: function that returns the datasets, each with its run in Redis; called at each scrape, and may raise
            BrokerError.
        registry: registry in which workers report.
        clock: function that returns a time in seconds, which never goes back.
    """

    def __init__(
        self, find: Callable[[], Sequence[Found]], registry: RunRegistry, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._find = find
        self._registry = registry
        self._clock = clock
        self._known: Sequence[Found] = ()
        self._folders: dict[str, _Folder] = {}

    def collect(self) -> Iterator[Metric]:
        """Yield all metric families; while Redis is away, those read from it are left out and `farm_redis_up` is 0."""
        up = True
        try:
            self._known = self._find()
            told = list(self._from_redis())
        except BrokerError:
            up, told = False, []
        images = GaugeMetricFamily(
            "farm_images", "Images by category and state.", labels=["dataset", "category", "state"]
        )
        for dataset, _ in self._known:
            self._add_images(images, dataset)
        yield from (images, *told)
        yield GaugeMetricFamily("farm_redis_up", "Whether Redis answers.", value=float(up))

    def _add_images(self, images: GaugeMetricFamily, dataset: Dataset) -> None:
        if dataset.storage.location not in self._folders:
            self._folders[dataset.storage.location] = _folder(dataset)
        folder = self._folders[dataset.storage.location]
        if self._clock() - folder.looked_s >= FOLDER_EVERY_S:
            try:
                folder.completion.look()
                folder.quarantined = JobSet(dataset.header.spec.quotas)
                for job_id in folder.quarantine.look():
                    folder.quarantined.add(Job.from_id(job_id))
                folder.looked_s = self._clock()
            except DestinationError:
                return  # a folder that can't be read has no counts to show
        done, given_up = folder.completion.done.counts(), (folder.quarantined - folder.completion.done).counts()
        for category, quota in dataset.header.spec.quotas.items():
            states = {
                "done": done[category],
                "quarantined": given_up[category],
                "missing": quota - done[category] - given_up[category],
            }
            for state, count in states.items():
                images.add_metric([dataset.name, str(category), state], count)

    def _from_redis(self) -> Iterator[Metric]:
        waiting = GaugeMetricFamily("farm_queue_length", "Jobs that wait in Redis.", labels=["dataset"])
        running = GaugeMetricFamily("farm_jobs_running", "Jobs that workers hold.", labels=["dataset"])
        retrying = GaugeMetricFamily("farm_jobs_postponed", "Jobs that wait for their next try.", labels=["dataset"])
        active = GaugeMetricFamily("farm_run_active", "Whether the run may be worked on.", labels=["dataset"])
        serving = GaugeMetricFamily("farm_run_workers", "Workers that serve the run.", labels=["dataset"])
        reports = self._registry.workers()
        totals = _Totals()
        for dataset, handle in self._known:
            owners = list(live_claims(handle.ledger).values())
            run = handle.registry.runs().get(handle.run.key)
            waiting.add_metric([dataset.name], handle.queue.length(handle.run))
            running.add_metric([dataset.name], sum(owner != RETRY_OWNER for owner in owners))
            retrying.add_metric([dataset.name], sum(owner == RETRY_OWNER for owner in owners))
            active.add_metric([dataset.name], float(run is not None and run.state is RunState.ACTIVE))
            serving.add_metric([dataset.name], sum(handle.run.key in report.serves for report in reports))
            totals.add(dataset.name, handle.ledger.figures())
        yield from (waiting, running, retrying, active, serving, *totals.families())
        yield from _workers(reports)


class _Totals:
    """Counters of the ledgers' running totals; an emptied Redis starts them from 0, which Prometheus allows."""

    _PLAIN: ClassVar = {
        "retries": "Failures that may pass, tried again.",
        "crashes": "Processes that died, or were killed at the time limit, with their job.",
        "quarantined": "Jobs given up.",
        "redrawn": "Scenes that failed a physics check and were drawn again.",
    }

    def __init__(self) -> None:
        labels = ["dataset"]
        self._plain = {
            name: CounterMetricFamily(f"farm_{name}", text, labels=labels) for name, text in self._PLAIN.items()
        }
        self._made = CounterMetricFamily("farm_images_made", "Images made.", labels=["dataset", "category"])
        self._seconds = CounterMetricFamily(
            "farm_stage_seconds", "Seconds spent in each stage of the images made.", labels=["dataset", "stage"]
        )

    def add(self, dataset: str, totals: Mapping[str, float]) -> None:
        """Add the totals of one ledger.

        Args:
            dataset: name of the dataset.
            totals: value of each total, by its name in the ledger, such as `retries`, `images:far` or `seconds:render`.
        """
        for name, family in self._plain.items():
            family.add_metric([dataset], totals.get(name, 0.0))
        for name, value in sorted(totals.items()):
            kind, _, what = name.partition(":")
            if kind == "images":
                self._made.add_metric([dataset, what], value)
            elif kind == "seconds":
                self._seconds.add_metric([dataset, what], value)

    def families(self) -> Iterator[Metric]:
        """Yield the metric families of all totals."""
        yield from (*self._plain.values(), self._made, self._seconds)


def _folder(dataset: Dataset) -> _Folder:
    return _Folder(Completion(dataset), Quarantine(dataset), JobSet(dataset.header.spec.quotas))


def _workers(reports: Sequence[WorkerReport]) -> Iterator[Metric]:
    states = GaugeMetricFamily("farm_workers", "Workers by state.", labels=["state"])
    done = CounterMetricFamily("farm_worker_jobs", "Jobs a worker finished since it started.", labels=["worker"])
    memory = GaugeMetricFamily(
        "farm_worker_resident_memory_bytes", "Resident memory of a worker's renderers.", labels=["worker"]
    )
    for state in WorkerState:
        states.add_metric([str(state)], sum(report.state is state for report in reports))
    for report in reports:
        done.add_metric([report.name], report.done)
        memory.add_metric([report.name], report.rss_bytes)
    yield from (states, done, memory)
