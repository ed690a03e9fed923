"""`farm repair` and `farm retry`: queue images again that were lost, damaged or given up."""

from collections.abc import Mapping
from typing import Annotated

import typer

from farm.cli.connection import handle_if_reachable, handle_of
from farm.cli.continuing import GoOn
from farm.cli.options import Broker, DatasetPlace, job_of
from farm.dataset.dataset import Dataset, open_dataset
from farm.dataset.destination import parse_destination
from farm.dataset.foreign import refuse_foreign
from farm.dataset.paths import manifest_path
from farm.dataset.quarantine import Quarantine
from farm.dataset.verify import damaged_jobs
from farm.errors import ConflictError, SpecError
from farm.run.coordinator import Coordinator
from farm.run.progress import RunHandle
from farm.run.registry.port import RunState
from farm.run.serving import why_not_ours


def repair(
    place: DatasetPlace,
    broker: Broker = None,
    checksums: Annotated[
        bool, typer.Option("--checksums", help="Read every file too, and make images with a damaged file again.")
    ] = False,
    go_on: GoOn = False,
) -> None:
    """Compare folder and queue once, and queue every image that is neither done, nor waiting, nor being made."""
    dataset = open_dataset(parse_destination(place))
    handle = handle_of(dataset, broker, settles=True, mixes=go_on)
    damaged = list(damaged_jobs(dataset)) if checksums else []
    # What a checksum confirms stays, whatever description it is of.
    refuse_foreign(dataset, damaged)
    if damaged:
        _require_ours(dataset, handle)
    for job in damaged:
        dataset.storage.remove(manifest_path(job))
    count = Coordinator(dataset, handle).submit_missing()
    _tell_if_paused(handle)
    found = f", {len(damaged)} of them damaged" if damaged else ""
    typer.echo(f"{count} of {dataset.header.spec.total} images queued for {place}{found}")


def retry(
    place: DatasetPlace,
    jobs: Annotated[list[str] | None, typer.Argument(metavar="[JOB]...", help="Ids of images; none means all.")] = None,
    broker: Broker = None,
    go_on: GoOn = False,
) -> None:
    """Take images out of quarantine, and queue them; without Redis the next farm run makes them."""
    for job_id in jobs or []:
        job_of(job_id)
    dataset = open_dataset(parse_destination(place))
    handle = handle_if_reachable(dataset, broker, settles=True, mixes=go_on)
    quarantine = Quarantine(dataset)
    released = _chosen(dataset, quarantine.look(), jobs or [])
    if handle is not None:
        if released:
            _require_ours(dataset, handle)
        # The ledger forgets the attempts first: a job that has used them up would be given up again at once.
        handle.ledger.forgive(released)
    quarantine.release(released)
    if handle is None:
        typer.echo(f"{len(released)} images put back; farm run or farm submit makes them")
        return
    count = Coordinator(dataset, handle).submit_missing()
    typer.echo(f"{len(released)} images put back; {count} queued for {place}")
    _tell_if_paused(handle)


def _require_ours(dataset: Dataset, handle: RunHandle) -> None:
    """Raise ConflictError if the run is another release's: nothing is removed then that it could not queue again."""
    if theirs := why_not_ours(handle.run, dataset):
        raise ConflictError(f"{dataset.storage.location}: {theirs}")


def _tell_if_paused(handle: RunHandle) -> None:
    run = handle.registry.runs().get(handle.run.key)
    if run is not None and run.state is RunState.PAUSED:
        typer.echo("the run is paused; farm resume lets it go on", err=True)


def _chosen(dataset: Dataset, given_up: Mapping[str, str], asked: list[str]) -> list[str]:
    for job_id in asked:
        if job_id not in given_up:
            raise SpecError(f"{job_id}: not in quarantine; farm status {dataset.storage.location} lists those that are")
    return asked or list(given_up)
