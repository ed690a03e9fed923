"""`farm metrics`: serves the farm's figures to Prometheus over HTTP."""

import importlib.util
import signal
import threading
from collections import Counter
from contextlib import suppress
from types import FrameType
from typing import Annotated

import redis
import typer

from farm.cli.options import Broker
from farm.dataset.dataset import Dataset, open_dataset
from farm.dataset.destination import Destination, parse_destination
from farm.errors import ConflictError, DestinationError, MachineError, SpecError
from farm.run.handle import open_handle
from farm.run.progress import RunHandle
from farm.run.queue.broker import broker_url, connect
from farm.run.registry.port import Refusal
from farm.run.registry.redis import RedisRegistry
from farm.run.serving import refusal


def metrics(
    places: Annotated[
        list[str] | None, typer.Argument(metavar="[DATASET]...", help="Folders or URLs of datasets; or give --store.")
    ] = None,
    store: Annotated[
        str | None,
        typer.Option(envvar="FARM_STORE", help="Folder or URL of datasets: show those with a run."),
    ] = None,
    broker: Broker = None,
    address: Annotated[
        str, typer.Option(help="Address to listen at; the page has no password, so only Prometheus should reach it.")
    ] = "127.0.0.1",
    port: Annotated[int, typer.Option(min=0, max=65535, help="Port to listen at; 0 takes a free one.")] = 9464,
) -> None:
    """Serve figures to Prometheus: images by category and state, seconds a stage, retries, queue and workers."""
    if importlib.util.find_spec("prometheus_client") is None:
        raise MachineError("prometheus_client is not installed; run: pip install 'cable-farm[metrics]'")
    # Only machines that serve metrics have prometheus_client.
    from prometheus_client import CollectorRegistry, start_http_server  # noqa: PLC0415

    from farm.run.metrics import FarmCollector  # noqa: PLC0415

    if not places and store is None:
        raise SpecError("name datasets, or the --store that holds those that are worked on")
    datasets = [open_dataset(parse_destination(place)) for place in places or ()]
    names = Counter(dataset.name for dataset in datasets)
    if doubled := [name for name, count in names.items() if count > 1]:
        raise SpecError(f"{doubled[0]}: two datasets have this name, and figures go by names; serve them one by one")
    url = broker_url(broker)
    client = connect(url)
    found = _Datasets(url, client, datasets, store)
    registry = CollectorRegistry(auto_describe=False)
    registry.register(FarmCollector(found.find, RedisRegistry(client)))
    try:
        server, thread = start_http_server(port, address, registry)
    except OSError as error:
        raise DestinationError(f"{address}:{port}: can't listen: {error.strerror}; name another --port") from error
    typer.echo(f"metrics: http://{address}:{server.server_port}/metrics")
    stopped = threading.Event()

    def stop(_number: int, _frame: FrameType | None) -> None:
        stopped.set()

    for number in (signal.SIGTERM, signal.SIGINT):
        signal.signal(number, stop)
    stopped.wait()
    server.shutdown()
    thread.join()


class _Datasets:
    """The datasets that were named, and those in the store whose runs are registered or were at an earlier scrape.

    Args:
        url: address of Redis.
        client: client of the same Redis.
        named: datasets to show in any case.
        store: folder or URL of datasets; None to show the named ones only.
    """

    def __init__(self, url: str, client: "redis.Redis", named: list[Dataset], store: str | None) -> None:
        self._url = url
        self._client = client
        self._store = store
        self._named = named
        self._lock = threading.Lock()
        self._found: dict[str, tuple[Dataset, RunHandle]] = {}

    def find(self) -> list[tuple[Dataset, RunHandle]]:
        """Look for new runs, and return all datasets found so far; raises BrokerError if Redis can't be read."""
        with self._lock:  # each scrape has its own thread
            return self._look()

    def _look(self) -> list[tuple[Dataset, RunHandle]]:
        for dataset in list(self._named):
            with suppress(DestinationError):  # its folder is away; the next scrape asks again
                self._add(dataset)
                self._named.remove(dataset)
        known = {handle.run.key for _, handle in self._found.values()}
        for run in RedisRegistry(self._client).runs().values() if self._store is not None else ():
            if run.key not in known:
                # The registry lists runs of other stores too, whose datasets are not found here.
                with suppress(DestinationError, ConflictError, SpecError):
                    if refusal(self._store or "", run) in {None, Refusal.OTHER_RELEASE}:
                        self._add(open_dataset(Destination(self._store or "", run.dataset)))
        return list(self._found.values())

    def _add(self, dataset: Dataset) -> None:
        handle = open_handle(dataset, self._url, self._client)
        # A dataset that replaced another in the same folder replaces it here too.
        self._found[dataset.storage.location] = (dataset, handle)
