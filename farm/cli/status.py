"""`farm status` and `farm watch`: how far a dataset is."""

import typer

from farm.cli.connection import coordinator_of, ledger_if_reachable
from farm.cli.display import ProgressDisplay, console, duration, table
from farm.cli.options import AsJson, Broker, DatasetPlace
from farm.completion import Completion
from farm.coordinator import Coordinator
from farm.dataset import Dataset, open_dataset, parse_destination
from farm.errors import IncompleteError
from farm.progress import measure
from farm.queue.broker import broker_url, connect, masked
from farm.report import write_overview


def status(place: DatasetPlace, broker: Broker = None, as_json: AsJson = False) -> None:
    """Tell how far a dataset is, from its folder; with Redis also the rate, what runs and what failed."""
    dataset = open_dataset(parse_destination(place))
    ledger = ledger_if_reachable(dataset, broker)
    progress = measure(dataset, Completion(dataset), ledger)
    if as_json:
        typer.echo(progress.model_dump_json(indent=1))
        return
    screen = console(results=True)
    screen.print(progress.location, markup=False)
    screen.print(table(progress))
    if ledger is None:
        screen.print(f"no Redis at {masked(broker_url(None))}: rate, running and failed images unknown", markup=False)
        return
    last = f"{progress.location.rstrip('/')}/{progress.last_picture}" if progress.last_picture else "none"
    if progress.done == progress.quota:
        screen.print(f"last     {last}", markup=False)
        return
    rate = "unknown yet" if progress.images_per_hour is None else f"{progress.images_per_hour:.0f} images an hour"
    left = "" if progress.seconds_left is None else f", {duration(progress.seconds_left)} left"
    screen.print(f"rate     {rate}{left}", markup=False)
    screen.print(f"running  {', '.join(progress.running or ()) or 'nothing'}", markup=False)
    screen.print(f"last     {last}", markup=False)
    for job_id, reason in (progress.failures or {}).items():
        screen.print(f"failed   {job_id}: {reason}", markup=False)


def watch(place: DatasetPlace, broker: Broker = None) -> None:
    """Show a dataset grow until it is done; images lost on the way are queued again."""
    dataset = open_dataset(parse_destination(place))
    url = broker_url(broker)
    watch_to_the_end(dataset, coordinator_of(dataset, url, connect(url)))


def watch_to_the_end(dataset: Dataset, coordinator: Coordinator) -> None:
    """Show a dataset grow, then write its index and report, as far as it got.

    Raises:
        IncompleteError: if images failed for good.
        BrokerError: if Redis goes away.
        DestinationError: if the folder can't be read or written.
    """
    try:
        with ProgressDisplay(console()) as display:
            coordinator.watch(display.show)
    except IncompleteError:
        write_overview(dataset)
        raise
    write_overview(dataset)
