"""Opens a dataset's run in Redis: its ledger, the queue and the run registry, over one client."""

import redis

from farm.dataset.dataset import Dataset
from farm.run.ledger.redis import RedisLedger
from farm.run.progress import RunHandle
from farm.run.queue.celery import CeleryQueue
from farm.run.queue.settings import make_app
from farm.run.registry.port import Priority, Run
from farm.run.registry.redis import RedisRegistry


def run_of(dataset: Dataset, priority: Priority = Priority.NORMAL) -> Run:
    """Describe a dataset's run as at its first submission: active, with the given priority."""
    return Run(dataset=dataset.name, spec_sha256=dataset.identity, priority=priority)


def open_handle(dataset: Dataset, url: str, client: "redis.Redis", priority: Priority | None = None) -> RunHandle:
    """Open the run of a dataset.

    Args:
        dataset: the dataset.
        url: address of the broker.
        client: client of the same Redis, from `farm.run.queue.broker.connect`.
        priority: priority of the run; None keeps that of the registered run, or is normal if there is none.

    Returns:
        The run with its ledger, queue and registry; nothing is written.

    Raises:
        BrokerError: if Redis can't be read.
    """
    registry = RedisRegistry(client)
    run = run_of(dataset, priority or Priority.NORMAL)
    present = registry.runs().get(run.key)
    if priority is None and present is not None:
        run = run.model_copy(update={"priority": present.priority})
    ledger = RedisLedger(client, dataset.name, dataset.identity)
    return RunHandle(run=run, ledger=ledger, queue=CeleryQueue(make_app(url), client), registry=registry)
