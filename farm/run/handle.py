"""Opens a dataset's run in Redis: its ledger, the queue and the run registry, over one client."""

from collections.abc import Mapping

import redis

from farm import __version__
from farm.dataset.dataset import Dataset
from farm.dataset.place import claim_place, is_elsewhere, locate, new_id, read_place, renew_place
from farm.run.ledger.redis import RedisLedger
from farm.run.progress import RunHandle
from farm.run.queue.celery import CeleryQueue
from farm.run.queue.settings import make_app
from farm.run.registry.port import Priority, Run, RunState
from farm.run.registry.redis import RedisRegistry
from farm.run.serving import others_of


def run_of(
    dataset: Dataset, priority: Priority = Priority.NORMAL, place: str = "", *, release: str = __version__
) -> Run:
    """Describe a dataset's run as at its first submission: active, with the given priority, and of a release."""
    return Run(
        dataset=dataset.name,
        spec_sha256=dataset.identity,
        priority=priority,
        place=place,
        release=release,
        located=locate(dataset) if place else "",
    )


def open_handle(
    dataset: Dataset,
    url: str,
    client: "redis.Redis",
    priority: Priority | None = None,
    *,
    settles: bool = False,
    mixes: bool = False,
) -> RunHandle:
    """Open the run of a dataset: the one that is up, be it of another release, else one of the release that began it.

    Args:
        dataset: the dataset.
        url: address of the broker.
        client: client of the same Redis, from `farm.run.queue.broker.connect`.
        priority: priority of the run; None keeps that of the registered run, or is normal if there is none.
        settles: whether to give the dataset's place an id if it needs one; without it nothing is written.
        mixes: whether a run that is not up yet is of this release, whichever began the dataset.

    Returns:
        The run with its ledger, queue and registry.

    Raises:
        BrokerError: if Redis can't be read.
        DestinationError: if the folder can't be read, or not be written where it must.
    """
    registry = RedisRegistry(client)
    runs = registry.runs()
    run = run_of(dataset, place=_place_of(dataset, runs, settles=False))
    others = sorted(others_of(run, runs), key=lambda other: other.state is RunState.CANCELLED)
    present = next(iter([runs[run.key]] if run.key in runs else others), None)
    if present is None:
        place = _place_of(dataset, runs, settles=settles)
        release = __version__ if mixes else dataset.header.farm_version
        run = run_of(dataset, priority or Priority.NORMAL, place, release=release)
    else:
        run = present.model_copy(update={"priority": priority or present.priority})
    return _handle(run, url, client, registry)


def open_new_run(dataset: Dataset, url: str, client: "redis.Redis", priority: Priority) -> tuple[RunHandle, Run | None]:
    """Register a run of this release for a dataset, as a person asks for it, in place of one that is up.

    Returns:
        The run with its ledger, queue and registry; and the run that it replaced, if that was another release's.

    Raises:
        BrokerError: if Redis can't be reached.
        DestinationError: if the folder can't be read or written.
    """
    registry = RedisRegistry(client)
    runs = registry.runs()
    handle = _handle(run_of(dataset, priority, _place_of(dataset, runs, settles=True)), url, client, registry)
    replaced = None
    former = runs.get(handle.run.key)
    if former is not None and former.release != __version__:
        # Its messages may have another form.
        handle.queue.clear(former)
        replaced = former
    for other in others_of(handle.run, runs):
        if other.state is not RunState.CANCELLED:
            # Cancelled in its own release's words, so that its coordinator ends and its workers leave it.
            registry.change(other.key, RunState.CANCELLED)
            handle.queue.clear(other)
            replaced = other
    registry.replace(handle.run)
    return handle, replaced


def _place_of(dataset: Dataset, runs: Mapping[str, Run], *, settles: bool) -> str:
    place = claim_place(dataset.storage) if settles else read_place(dataset.storage)
    if not place:
        return ""
    same = runs.get(run_of(dataset, place=place).key)
    if same is None or not is_elsewhere(same.located, dataset):
        return place
    # The folder is a copy of one whose run is up.
    return renew_place(dataset.storage) if settles else new_id()


def _handle(run: Run, url: str, client: "redis.Redis", registry: RedisRegistry) -> RunHandle:
    ledger = RedisLedger(client, run.key)
    return RunHandle(run=run, ledger=ledger, queue=CeleryQueue(make_app(url), client), registry=registry)
