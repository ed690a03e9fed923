"""`farm metrics`: the farm's figures for Prometheus, over HTTP."""

import importlib.util
import signal
import threading
from types import FrameType
from typing import Annotated

import typer

from farm.cli.connection import hints_of
from farm.cli.options import Broker
from farm.dataset import open_dataset, parse_destination
from farm.errors import DestinationError, EnvironmentMissingError


def metrics(
    places: Annotated[list[str], typer.Argument(metavar="DATASET...", help="Folders or URLs of datasets.")],
    broker: Broker = None,
    address: Annotated[str, typer.Option(help="The page has no password: keep it where only Prometheus is.")] = (
        "127.0.0.1"
    ),
    port: Annotated[int, typer.Option(min=0, max=65535, help="0 takes a free one.")] = 9464,
) -> None:
    """Serve images by category and state, seconds a stage, retries, queue and workers to Prometheus."""
    if importlib.util.find_spec("prometheus_client") is None:
        raise EnvironmentMissingError("prometheus_client is not installed; run: pip install 'cable-farm[metrics]'")
    # Not every machine of a farm has it.
    from prometheus_client import CollectorRegistry, start_http_server  # noqa: PLC0415

    from farm.metrics import FarmCollector  # noqa: PLC0415

    datasets = [open_dataset(parse_destination(place)) for place in places]
    registry = CollectorRegistry(auto_describe=False)
    registry.register(FarmCollector([(dataset, hints_of(dataset, broker)) for dataset in datasets]))
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
