"""Connects a dataset to its run in Redis, as the command line's options say."""

from farm.dataset.dataset import Dataset
from farm.errors import BrokerError
from farm.run.handle import open_handle
from farm.run.progress import RunHandle
from farm.run.queue.broker import broker_url, connect
from farm.run.registry.port import Priority


def handle_of(
    dataset: Dataset,
    broker: str | None,
    priority: Priority | None = None,
    *,
    settles: bool = False,
    mixes: bool = False,
) -> RunHandle:
    """Open the run of a dataset.

    Args:
        dataset: the dataset.
        broker: address of Redis; None for FARM_BROKER_URL or the default.
        priority: priority of the run; None keeps that of a registered run, else takes the normal one.
        settles: whether the command may queue jobs, so that the dataset's place needs an id.
        mixes: see `farm.run.handle.open_handle`.

    Returns:
        The run's ledger, queue and registry.

    Raises:
        BrokerError: if Redis can't be reached.
        DestinationError: if the folder can't be read, or not be written where it must.
    """
    url = broker_url(broker)
    return open_handle(dataset, url, connect(url), priority, settles=settles, mixes=mixes)


def handle_if_reachable(
    dataset: Dataset, broker: str | None, *, settles: bool = False, mixes: bool = False
) -> RunHandle | None:
    """Open the run of a dataset if Redis answers.

    Args:
        dataset: the dataset.
        broker: address of Redis; None for FARM_BROKER_URL or the default.
        settles: see `handle_of`.
        mixes: see `handle_of`.

    Returns:
        The run's ledger, queue and registry; None if `broker` is None and Redis can't be reached.

    Raises:
        BrokerError: if `broker` names a Redis that can't be reached.
    """
    try:
        return handle_of(dataset, broker, settles=settles, mixes=mixes)
    except BrokerError:
        if broker is not None:
            raise
        return None
