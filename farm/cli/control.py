"""`farm pause`, `resume`, `cancel`: set the state of a run."""

from typing import Annotated

import typer

from farm.cli.connection import handle_of
from farm.cli.options import Broker, DatasetPlace
from farm.dataset.dataset import open_dataset
from farm.dataset.destination import parse_destination
from farm.errors import ConflictError
from farm.run.progress import RunHandle
from farm.run.registry.port import Priority, RunState

NewPriority = Annotated[Priority | None, typer.Option("--priority", help="New priority of the run.")]


def pause(place: DatasetPlace, broker: Broker = None) -> None:
    """Stop handing out a dataset's images until it is resumed; workers finish those that they are making."""
    handle = _change(place, broker, RunState.PAUSED)
    typer.echo(f"paused: {place}; {handle.queue.length(handle.run)} images wait; farm resume lets them go on")


def resume(place: DatasetPlace, broker: Broker = None, priority: NewPriority = None) -> None:
    """Let a paused dataset go on."""
    handle = _change(place, broker, RunState.ACTIVE, priority)
    typer.echo(f"active: {place}; {handle.queue.length(handle.run)} images wait")


def cancel(place: DatasetPlace, broker: Broker = None) -> None:
    """Empty a dataset's queue; workers finish the images that they are making, and finished ones stay."""
    handle = _change(place, broker, RunState.CANCELLED)
    count = handle.queue.clear(handle.run)
    typer.echo(f"cancelled: {place}; {count} images were waiting; farm submit makes what is missing")


def _change(place: str, broker: str | None, state: RunState, priority: Priority | None = None) -> RunHandle:
    dataset = open_dataset(parse_destination(place))
    handle = handle_of(dataset, broker, priority)
    if not handle.registry.change(handle.run.key, state, priority):
        raise ConflictError(f"{place}: it was not submitted to this Redis, or all is done; see farm status {place}")
    if priority is not None and (waiting := handle.queue.length(handle.run)):
        # The queued messages lie in the lists of the old priority.
        typer.echo(f"the {waiting} images that wait keep their priority", err=True)
    return handle
