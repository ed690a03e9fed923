"""`farm submit`: queues a dataset's jobs for the workers that listen to the same Redis."""

from typing import Annotated

import typer

from farm.cli.continuing import GoOn, wanted_dataset
from farm.cli.display import console
from farm.cli.options import Broker, DatasetOptions, Logs, Out, log_folder, takes_dataset_options
from farm.cli.status import watch_to_the_end
from farm.cli.worker_program import ask_worker, blender_is_installed
from farm.dataset.completion import Completion
from farm.dataset.dataset import create_dataset
from farm.dataset.destination import parse_destination
from farm.dataset.foreign import refuse_foreign
from farm.dataset.release import refuse_to_mix
from farm.run.coordinator import Coordinator
from farm.run.handle import open_new_run
from farm.run.queue.broker import broker_url, connect_to_write
from farm.run.registry.port import Priority
from farm.run.serving import release_of


@takes_dataset_options
def submit(
    options: DatasetOptions,
    out: Out,
    broker: Broker = None,
    priority: Annotated[
        Priority, typer.Option(help="Priority of the run; runs with a higher one go first, equal ones take turns.")
    ] = Priority.NORMAL,
    wait: Annotated[bool, typer.Option("--wait", help="Wait until all is done, and queue lost images again.")] = False,
    logs: Logs = None,
    go_on: GoOn = False,
) -> None:
    """Queue the missing images of a dataset for the workers."""
    destination = parse_destination(out)
    wanted = wanted_dataset(options, destination, go_on=go_on)
    header = wanted.header
    # Before the header: a Redis that takes no jobs leaves no dataset without them.
    url = broker_url(broker)
    client = connect_to_write(url)
    if wanted.inputs.template is not None and blender_is_installed():
        ask_worker(["check"], header, log_folder(logs))
    dataset = create_dataset(destination, header)
    if not go_on:
        refuse_to_mix(dataset)
    completion = Completion(dataset)
    completion.look()
    refuse_foreign(dataset, completion.unfit)
    # A run that was paused or cancelled goes on when it is submitted again.
    handle, replaced = open_new_run(dataset, url, client, priority)
    if replaced is not None:
        typer.echo(
            f"its run of release {release_of(replaced, dataset)} is replaced; that release's workers leave it", err=True
        )
    coordinator = Coordinator(dataset, handle)
    screen = console()
    with screen.status("queueing") as status:
        count = coordinator.submit_missing(lambda so_far: status.update(f"queueing: {so_far}"))
    place = dataset.storage.location
    typer.echo(f"{count} of {dataset.header.spec.total} images queued for {place}")
    if wait:
        watch_to_the_end(dataset, coordinator)
    elif coordinator.left_out:
        typer.echo(f"{coordinator.left_out} more follow as these are taken, while this runs: farm watch {place}")
