"""`farm submit`: hand a dataset's jobs to whatever workers listen."""

from typing import Annotated

import typer

from farm.asset_source import InstalledAssets
from farm.catalogue import make_header
from farm.cli.connection import coordinator_of
from farm.cli.display import console
from farm.cli.options import Broker, DatasetOptions, Logs, Out, log_folder, takes_dataset_options
from farm.cli.status import watch_to_the_end
from farm.cli.worker_program import ask_worker, blender_is_installed
from farm.dataset import create_dataset, parse_destination
from farm.queue.broker import broker_url, connect


@takes_dataset_options
def submit(
    options: DatasetOptions,
    out: Out,
    broker: Broker = None,
    wait: Annotated[bool, typer.Option("--wait", help="Stay until all is done, and mend what gets lost.")] = False,
    logs: Logs = None,
) -> None:
    """Queue a dataset's images for the workers; only those that are missing."""
    destination = parse_destination(out)
    description = options.describe()
    header = make_header(description.spec, description.inputs, InstalledAssets())
    url = broker_url(broker)
    client = connect(url)
    if description.inputs.template is not None and blender_is_installed():
        ask_worker(["check"], header, log_folder(logs))
    dataset = create_dataset(destination, header)
    coordinator = coordinator_of(dataset, url, client)
    screen = console()
    with screen.status("queueing") as status:
        count = coordinator.submit_missing(lambda so_far: status.update(f"queueing: {so_far}"))
    typer.echo(f"{count} of {dataset.header.spec.total} images queued for {dataset.storage.location}")
    if wait:
        watch_to_the_end(dataset, coordinator)
