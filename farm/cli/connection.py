"""Joining a dataset to its ledger and queue in Redis."""

import redis

from farm.coordinator import Coordinator
from farm.dataset import Dataset
from farm.errors import BrokerError
from farm.ledger.port import Ledger
from farm.ledger.redis import RedisLedger
from farm.queue.broker import broker_url, connect
from farm.queue.celery import CeleryQueue
from farm.queue.settings import make_app


def ledger_of(dataset: Dataset, client: "redis.Redis") -> RedisLedger:
    """The dataset's ledger."""
    return RedisLedger(client, dataset.name, dataset.header.spec_sha256)


def coordinator_of(dataset: Dataset, url: str, client: "redis.Redis") -> Coordinator:
    """The dataset's coordinator."""
    return Coordinator(dataset, ledger_of(dataset, client), CeleryQueue(make_app(url), client))


def ledger_if_reachable(dataset: Dataset, broker: str | None) -> Ledger | None:
    """The dataset's ledger; None where Redis is not there and none was asked for.

    Raises:
        BrokerError: if the Redis that was asked for is not there.
    """
    url = broker_url(broker)
    try:
        return ledger_of(dataset, connect(url))
    except BrokerError:
        if broker is not None:
            raise
        return None
