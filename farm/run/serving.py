"""Who works for a run: workers of its own release, whose store holds its dataset; and what is told if there is none."""

from collections import Counter
from collections.abc import Mapping, Sequence

from farm import __version__
from farm.dataset.dataset import Dataset, open_dataset
from farm.dataset.destination import Destination
from farm.dataset.place import is_elsewhere, read_place
from farm.errors import ConflictError, DatasetMissingError, SpecError
from farm.run.registry.port import Refusal, Run, RunState, WorkerReport, WorkerState


def release_of(run: Run, dataset: Dataset) -> str:
    """Version of the farm that works for a run of a dataset."""
    return run.release or dataset.header.farm_version


def why_not_ours(run: Run, dataset: Dataset) -> str:
    """Say that another release works for a run, whose messages may have another form; empty if this one does."""
    release = release_of(run, dataset)
    if release == __version__:
        return ""
    return (
        f"its run is of release {release}, and this is {__version__}, so nothing is queued: go on with that release, "
        f"or mix the two by farm submit --continue with {__version__}"
    )


def others_of(run: Run, runs: Mapping[str, Run]) -> list[Run]:
    """Find the runs that other releases have registered for a run's dataset, into the same files, under other keys.

    A release that knows no places has none in its key. It may be the run of another store's dataset of the same name
    and description, which such a release doesn't tell apart. And releases may disagree on the fingerprint.
    """
    return [
        other
        for key, other in runs.items()
        if key != run.key
        and (
            key == run.older_key
            or ((other.dataset, other.place) == (run.dataset, run.place or None) and other.release != __version__)
        )
    ]


def why_not_yet(run: Run, dataset: Dataset, runs: Mapping[str, Run]) -> str:
    """Say that another release has a run of the same dataset, too; empty if none has one that is not cancelled."""
    for other in others_of(run, runs):
        if other.state is not RunState.CANCELLED:
            return (
                f"release {release_of(other, dataset)} has a run of this dataset, too, so nothing is queued: let that "
                "one end, or farm submit it again to replace it"
            )
    return ""


def refusal(store: str, run: Run, release: str = __version__) -> Refusal | None:
    """Find out why a worker doesn't serve a run; None if it does.

    Args:
        store: folder or URL below which the worker looks for datasets.
        run: the run, as it is registered.
        release: version of the worker's farm.

    Raises:
        DestinationError: if the store can't be read.
        MachineError: if the store's kind needs a package that is not installed.
    """
    other = bool(run.release) and run.release != release
    try:
        dataset = open_dataset(Destination(store, run.dataset))
    except DatasetMissingError:
        return Refusal.NOT_HERE
    except (ConflictError, SpecError):
        return Refusal.OTHER_RELEASE if other else Refusal.UNREADABLE
    if run.place and (read_place(dataset.storage) != run.place or is_elsewhere(run.located, dataset)):
        return Refusal.NOT_HERE
    if other:
        # Whether the descriptions are the same is for the run's own release to say.
        return Refusal.OTHER_RELEASE
    if dataset.identity != run.spec_sha256:
        return Refusal.OTHER_DESCRIPTION
    return None if release_of(run, dataset) == release else Refusal.OTHER_RELEASE


def why_unserved(key: str, release: str, reports: Sequence[WorkerReport]) -> str | None:
    """Say in one line that no worker serves an active run, and why.

    Args:
        key: key of the run.
        release: version of the farm that the run needs.
        reports: reports of all workers.

    Returns:
        None if a worker serves it, or one has not found out yet whether it does.
    """
    causes: Counter[str] = Counter()
    for report in reports:
        refused = report.refuses.get(key)
        if report.state is WorkerState.DRAINING:
            causes["about to end"] += 1
        elif key in report.serves:
            return None
        elif refused == Refusal.NOT_HERE:
            causes["without this dataset in its --store"] += 1
        elif refused == Refusal.OTHER_DESCRIPTION:
            causes["whose --store holds another dataset of this name"] += 1
        elif not report.release or report.release != release:
            other = f"release {report.release}" if report.release else "an earlier release"
            causes[f"of {other}, it needs {release}"] += 1
        elif refused is None:
            return None
        else:
            causes["that can't read this dataset in its --store"] += 1
    found = [f"{_workers(count)} {cause}" for cause, count in sorted(causes.items())]
    return f"no worker serves this run: {'; '.join(found) or 'no worker is there'}"


def _workers(count: int) -> str:
    return "1 worker" if count == 1 else f"{count} workers"
