"""Joining a dataset to its run in Redis, from the command line's options."""

from farm.dataset.dataset import Dataset
from farm.errors import BrokerError
from farm.run.handle import open_handle
from farm.run.progress import RunHandle
from farm.run.queue.broker import broker_url, connect
from farm.run.registry.port import Priority


def handle_of(dataset: Dataset, broker: str | None, priority: Priority | None = None) -> RunHandle:
    """The dataset's run.

    Raises:
        BrokerError: if Redis is not there.
    """
    url = broker_url(broker)
    return open_handle(dataset, url, connect(url), priority)


def handle_if_reachable(dataset: Dataset, broker: str | None) -> RunHandle | None:
    """The dataset's run; None where Redis is not there and none was asked for.

    Raises:
        BrokerError: if the Redis that was asked for is not there.
    """
    try:
        return handle_of(dataset, broker)
    except BrokerError:
        if broker is not None:
            raise
        return None
