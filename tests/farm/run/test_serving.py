"""Who works for a run, and what is told if nobody does."""

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from farm import __version__
from farm.dataset.dataset import Dataset
from farm.dataset.place import claim_place
from farm.run.handle import run_of
from farm.run.registry.port import Refusal, Run, RunState, WorkerReport, WorkerState
from farm.run.serving import refusal, why_not_ours, why_not_yet, why_unserved

KEY = "cables:000000000000:0123456789abcdef"


def submitted(dataset: Dataset) -> Run:
    """The run of a dataset whose place has an id."""
    return run_of(dataset, place=claim_place(dataset.storage))


def as_it_is(dataset: Dataset, run: Run) -> Run:
    """The run as it was submitted."""
    del dataset
    return run


def without_dataset(dataset: Dataset, run: Run) -> Run:
    """The run of a dataset that the store lacks."""
    shutil.rmtree(dataset.storage.location)
    return run


def copied(dataset: Dataset, run: Run) -> Run:
    """The run of a folder of which the one in this store is a copy."""
    former = Path(dataset.storage.location).with_name("original")
    shutil.copytree(dataset.storage.location, former)
    return run.model_copy(update={"located": run.located.replace(dataset.storage.location, str(former))})


def spoilt(dataset: Dataset, run: Run) -> Run:
    """The run of a dataset whose header can't be read here."""
    dataset.storage.write("dataset.json", b"{}")
    return run


def spoilt_of_another_release(dataset: Dataset, run: Run) -> Run:
    """The run of another release, which alone can read the header."""
    return spoilt(dataset, run.model_copy(update={"release": "9.9.9"}))


def changed(**update: str) -> Callable[[Dataset, Run], Run]:
    """The run with other values."""
    return lambda _, run: run.model_copy(update=update)


@pytest.mark.parametrize(
    ("make", "refused"),
    [
        (as_it_is, None),
        (changed(place="", release="", located=""), None),  # as the first release registers it
        (without_dataset, Refusal.NOT_HERE),
        (changed(place="f" * 16), Refusal.NOT_HERE),
        (copied, Refusal.NOT_HERE),
        (changed(spec_sha256="f" * 64), Refusal.OTHER_DESCRIPTION),
        (changed(release="9.9.9"), Refusal.OTHER_RELEASE),
        (changed(release="9.9.9", spec_sha256="f" * 64), Refusal.OTHER_RELEASE),
        (spoilt, Refusal.UNREADABLE),
        (spoilt_of_another_release, Refusal.OTHER_RELEASE),
    ],
)
def test_refusal(dataset: Dataset, make: Callable[[Dataset, Run], Run], refused: Refusal | None) -> None:
    """A worker serves the runs of its own store and release, and tells why not the others."""
    run = make(dataset, submitted(dataset))
    assert refusal(str(Path(dataset.storage.location).parent), run) is refused


def test_release_of_an_entry_without_one(dataset: Dataset) -> None:
    """A run of a release that doesn't write its version is of the one that made the dataset."""
    run = run_of(dataset).model_copy(update={"release": ""})
    store = str(Path(dataset.storage.location).parent)
    assert dataset.header.farm_version == __version__
    assert refusal(store, run, release="9.9.9") is Refusal.OTHER_RELEASE


def worker(state: WorkerState = WorkerState.IDLE, **told: object) -> WorkerReport:
    """A worker's report."""
    return WorkerReport.model_validate({"name": "w@host", "state": state, "release": "0.2.0", **told})


def refusing(why: Refusal, **told: object) -> WorkerReport:
    """The report of a worker that refuses the run."""
    return worker(WorkerState.IDLE, refuses={KEY: str(why)}, **told)


@pytest.mark.parametrize(
    ("reports", "told"),
    [
        ([], "no worker is there"),
        ([worker(serves=(KEY,))], None),
        ([refusing(Refusal.NOT_HERE), worker(WorkerState.HELD, serves=(KEY,))], None),
        ([worker()], None),  # it has not looked yet
        ([worker(WorkerState.DRAINING, serves=(KEY,))], "1 worker about to end"),
        ([refusing(Refusal.NOT_HERE)] * 3, "3 workers without this dataset in its --store"),
        ([refusing(Refusal.UNREADABLE)], "1 worker that can't read this dataset in its --store"),
        ([refusing(Refusal.OTHER_DESCRIPTION)], "1 worker whose --store holds another dataset of this name"),
        ([worker(release="")], "1 worker of an earlier release, it needs 0.2.0"),
        (
            [refusing(Refusal.OTHER_RELEASE, release="0.1.{0}"), refusing(Refusal.NOT_HERE)],
            "1 worker of release 0.1.{0}, it needs 0.2.0; 1 worker without this dataset in its --store",
        ),
    ],
)
def test_why_unserved(reports: list[WorkerReport], told: str | None) -> None:
    """One line says why nobody works for a run, and none if somebody does or may."""
    assert why_unserved(KEY, "0.2.0", reports) == (told and f"no worker serves this run: {told}")


def test_only_its_own_release_queues_for_a_run(dataset: Dataset) -> None:
    """A run of another release is left to that one, and the line says what to do."""
    run = submitted(dataset)
    assert why_not_ours(run, dataset) == ""
    assert "of release 9.9.9" in why_not_ours(run.model_copy(update={"release": "9.9.9"}), dataset)


def test_run_of_the_first_release_goes_first(dataset: Dataset) -> None:
    """While a release that knows no places has a run of the dataset, this one waits, unless that was cancelled."""
    run = submitted(dataset)
    older = run.model_copy(update={"place": "", "release": ""})
    assert "nothing is queued" in why_not_yet(run, dataset, {older.key: older, run.key: run})
    ended = older.model_copy(update={"state": RunState.CANCELLED})
    assert why_not_yet(run, dataset, {older.key: ended, run.key: run}) == ""
    assert why_not_yet(older, dataset, {older.key: older}) == ""
