"""`farm status` and `farm watch`: show the progress of a dataset."""

import json

import typer

from farm.cli.connection import handle_if_reachable, handle_of
from farm.cli.display import ProgressDisplay, console, duration, table
from farm.cli.options import AsJson, Broker, DatasetPlace
from farm.dataset.completion import Completion
from farm.dataset.dataset import Dataset, open_dataset
from farm.dataset.destination import parse_destination
from farm.dataset.quarantine import Quarantine
from farm.dataset.report import write_overview
from farm.errors import IncompleteError
from farm.run.coordinator import Coordinator
from farm.run.progress import Progress, on_disk, with_handle
from farm.run.queue.address import masked
from farm.run.queue.broker import broker_url
from farm.run.registry.port import RunState, WorkerReport


def status(place: DatasetPlace, broker: Broker = None, as_json: AsJson = False) -> None:
    """Show a dataset's progress, from its folder; with Redis also the rate, running images and workers."""
    dataset = open_dataset(parse_destination(place))
    handle = handle_if_reachable(dataset, broker)
    progress = on_disk(dataset, Completion(dataset).audit(), Quarantine(dataset).look())
    if handle is not None:
        progress = with_handle(progress, handle)
        if progress.ended:
            # If nobody watched to the end, the run is still registered.
            handle.registry.remove(handle.run.key)
    if as_json:
        # Python's own writer takes a location of any bytes.
        typer.echo(json.dumps(progress.model_dump(mode="json"), indent=1))
        return
    screen = console(results=True)
    screen.print(progress.location, markup=False)
    screen.print(table(progress))
    for line in _lines(progress, broker_is_there=handle is not None):
        screen.print(line, markup=False)


def _lines(progress: Progress, *, broker_is_there: bool) -> list[str]:
    given_up = [f"failed   {job_id}: {reason}" for job_id, reason in progress.quarantined.items()]
    if not broker_is_there:
        return [f"no Redis at {masked(broker_url(None))}: rate, running images and workers unknown", *given_up]
    last = f"{progress.location.rstrip('/')}/{progress.last_picture}" if progress.last_picture else "none"
    if progress.done == progress.quota:
        return [f"last     {last}"]
    rate = "unknown yet" if progress.images_per_hour is None else f"{progress.images_per_hour:.0f} images an hour"
    left = "" if progress.seconds_left is None else f", {duration(progress.seconds_left)} left"
    lines = [] if progress.state in {None, RunState.ACTIVE} else [f"state    {progress.state}"]
    lines += [f"rate     {rate}{left}", f"waiting  {progress.waiting or 0}"]
    lines += [f"running  {', '.join(progress.running or ()) or 'nothing'}", f"last     {last}"]
    if progress.unserved is not None:
        lines.append(f"served   {progress.unserved}")
    lines += [f"worker   {_worker(report)}" for report in progress.workers or ()]
    return lines + given_up


def _worker(report: WorkerReport) -> str:
    why = f": {report.reason}" if report.reason else ""
    return f"{report.name} {report.state}{why}, {report.done} done"


def watch(place: DatasetPlace, broker: Broker = None) -> None:
    """Wait until a dataset is done; queue the images that are missing, and again those that are lost meanwhile."""
    dataset = open_dataset(parse_destination(place))
    watch_to_the_end(dataset, Coordinator(dataset, handle_of(dataset, broker, settles=True)))


def watch_to_the_end(dataset: Dataset, coordinator: Coordinator) -> None:
    """Show progress until a dataset is done or its images are given up, then write its index and report.

    Args:
        dataset: the dataset.
        coordinator: coordinator of its run.

    Raises:
        IncompleteError: if images were given up.
        RunCancelledError: if the run was cancelled.
        DestinationError: if the index or report can't be written.
    """
    try:
        with ProgressDisplay(console()) as display:
            coordinator.watch(display.show)
    except IncompleteError:
        write_overview(dataset)
        raise
    write_overview(dataset)
