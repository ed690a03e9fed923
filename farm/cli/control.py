"""`farm pause`, `resume`, `cancel`: what a person wants of a run."""

from typing import Annotated

import typer

from farm.cli.connection import hints_of
from farm.cli.options import Broker, DatasetPlace
from farm.dataset.dataset import open_dataset, parse_destination
from farm.errors import ConflictError
from farm.run.progress import Hints
from farm.run.registry.port import Priority, RunState

NewPriority = Annotated[Priority | None, typer.Option("--priority", help="Also change its priority.")]


def pause(place: DatasetPlace, broker: Broker = None) -> None:
    """Let workers finish what they render and take no more of this dataset, until it is resumed."""
    hints = _change(place, broker, RunState.PAUSED)
    typer.echo(f"paused: {place}; {hints.queue.length(hints.run)} images wait; farm resume lets them go on")


def resume(place: DatasetPlace, broker: Broker = None, priority: NewPriority = None) -> None:
    """Let a paused dataset go on."""
    hints = _change(place, broker, RunState.ACTIVE, priority)
    typer.echo(f"active: {place}; {hints.queue.length(hints.run)} images wait")


def cancel(place: DatasetPlace, broker: Broker = None) -> None:
    """Empty a dataset's queue; images in the making are finished, those that are done stay."""
    hints = _change(place, broker, RunState.CANCELLED)
    count = hints.queue.clear(hints.run)
    typer.echo(f"cancelled: {place}; {count} images were waiting; farm submit makes what is missing")


def _change(place: str, broker: str | None, state: RunState, priority: Priority | None = None) -> Hints:
    dataset = open_dataset(parse_destination(place))
    hints = hints_of(dataset, broker, priority)
    if hints.run.key not in hints.board.runs():
        raise ConflictError(f"{place}: nothing of it was submitted here, or all is done; see farm status {place}")
    if priority is not None and (waiting := hints.queue.length(hints.run)):
        # What waits lies in lists of the former priority.
        typer.echo(f"the {waiting} images that wait keep their priority", err=True)
    hints.board.replace(hints.run.model_copy(update={"state": state}))
    return hints
