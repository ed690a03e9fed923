"""Joins a dataset to its run in Redis: the ledger, the queue and the board, over one client."""

import redis

from farm.dataset.dataset import Dataset
from farm.run.ledger.redis import RedisLedger
from farm.run.progress import RunHandle
from farm.run.queue.celery import CeleryQueue
from farm.run.queue.settings import make_app
from farm.run.registry.port import Priority, Run
from farm.run.registry.redis import RedisRegistry


def run_of(dataset: Dataset, priority: Priority = Priority.NORMAL) -> Run:
    """The notice of a dataset's run, as when it is first submitted."""
    return Run(dataset=dataset.name, spec_sha256=dataset.header.spec_sha256, priority=priority)


def open_handle(dataset: Dataset, url: str, client: "redis.Redis", priority: Priority | None = None) -> RunHandle:
    """What Redis tells of a dataset.

    Args:
        dataset: the dataset.
        url: the broker's address.
        client: of the same Redis, from `farm.run.queue.broker.connect`.
        priority: of the run; None for that of the notice that is up, else normal.

    Raises:
        BrokerError: if Redis can't be read.
    """
    registry = RedisRegistry(client)
    run = run_of(dataset, priority or Priority.NORMAL)
    present = registry.runs().get(run.key)
    if priority is None and present is not None:
        run = run.model_copy(update={"priority": present.priority})
    ledger = RedisLedger(client, dataset.name, dataset.header.spec_sha256)
    return RunHandle(run=run, ledger=ledger, queue=CeleryQueue(make_app(url), client), registry=registry)
