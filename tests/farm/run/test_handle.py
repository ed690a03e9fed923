"""Finding the run of a dataset in a Redis that other places and other releases share."""

import shutil
from dataclasses import replace
from pathlib import Path

import pytest
import redis

from farm import __version__
from farm.dataset.dataset import Dataset
from farm.dataset.place import read_place
from farm.run.coordinator import Coordinator
from farm.run.handle import open_handle, open_new_run, run_of
from farm.run.progress import RunHandle
from farm.run.registry.port import Priority, Run, RunState
from farm.storage import LocalStorage

pytestmark = pytest.mark.redis


class Desk:
    """Opens the runs of datasets in one Redis."""

    def __init__(self, url: str, client: "redis.Redis") -> None:
        self.url = url
        self.client = client

    def open(self, dataset: Dataset, priority: Priority | None = None, *, settles: bool = False) -> RunHandle:
        """Open a run as commands do."""
        return open_handle(dataset, self.url, self.client, priority, settles=settles)

    def submit(self, dataset: Dataset) -> RunHandle:
        """Submit a dataset as `farm submit` does."""
        handle, self.replaced = open_new_run(dataset, self.url, self.client, Priority.NORMAL)
        Coordinator(dataset, handle).submit_missing()
        return handle


@pytest.fixture
def desk(redis_url: str, redis_client: "redis.Redis") -> Desk:
    """An empty Redis."""
    return Desk(redis_url, redis_client)


def older(dataset: Dataset, state: RunState = RunState.ACTIVE) -> Run:
    """The dataset's run as the first release registers it, made with another version of the farm."""
    return run_of(dataset).model_copy(update={"release": "", "state": state})


@pytest.fixture
def old(dataset: Dataset) -> Dataset:
    """A dataset that an earlier release made."""
    return replace(dataset, header=dataset.header.model_copy(update={"farm_version": "0.0.9"}))


def copy_of(dataset: Dataset, folder: Path) -> Dataset:
    """A copy of a dataset with all files of its folder."""
    shutil.copytree(dataset.storage.location, folder)
    return replace(dataset, storage=LocalStorage(folder))


def test_looking_writes_nothing(desk: Desk, dataset: Dataset) -> None:
    """A command that only looks gives the place no id; one that may queue jobs does, and then both see one run."""
    before = dataset.storage.files()
    desk.open(dataset)
    assert dataset.storage.files() == before
    settled = desk.open(dataset, settles=True)
    settled.registry.register(settled.run)
    assert settled.run.place == read_place(dataset.storage) != ""
    assert desk.open(dataset).run == settled.run
    assert settled.run.release == __version__


def test_equal_datasets_in_two_stores_are_apart(desk: Desk, dataset: Dataset, tmp_path: Path) -> None:
    """Datasets of one name and description in two stores share no run, queue or ledger."""
    other = copy_of(dataset, tmp_path / "b/cables")
    one, two = desk.submit(dataset), desk.submit(other)
    assert one.registry.runs().keys() == {one.run.key, two.run.key}
    assert (one.queue.length(one.run), two.queue.length(two.run)) == (4, 4)
    one.ledger.claim("far-000001", "a:1")
    assert two.ledger.claims() == {}
    one.registry.change(one.run.key, RunState.PAUSED)
    assert desk.open(other).run.state is RunState.ACTIVE


def test_copy_of_a_submitted_dataset(desk: Desk, dataset: Dataset, tmp_path: Path) -> None:
    """A copied folder, whose id came with it, is not taken for its original; when it is submitted it gets an id."""
    one = desk.submit(dataset)
    copy = copy_of(dataset, tmp_path / "b/cables")
    assert desk.open(copy).run.key not in one.registry.runs()
    two = desk.submit(copy)
    assert two.run.key != one.run.key
    assert desk.open(copy).run == two.run
    assert desk.open(dataset).run == one.run


def test_moved_dataset_keeps_its_run(desk: Desk, dataset: Dataset, tmp_path: Path) -> None:
    """A folder that was moved is still the place of its run."""
    one = desk.submit(dataset)
    shutil.move(dataset.storage.location, tmp_path / "cables")
    assert desk.open(replace(dataset, storage=LocalStorage(tmp_path / "cables")), settles=True).run == one.run


@pytest.mark.parametrize("state", RunState)
def test_run_of_the_first_release_is_respected(desk: Desk, old: Dataset, state: RunState) -> None:
    """A run of a release that knows no places is the dataset's, and no command but submit replaces it."""
    entry = older(old, state)
    registry = desk.open(old).registry
    registry.replace(entry)
    assert desk.open(old).run == desk.open(old, settles=True).run == entry
    assert read_place(old.storage) == ""
    assert registry.runs() == {entry.key: entry}


def test_submission_takes_over_the_run_of_the_first_release(desk: Desk, old: Dataset) -> None:
    """The older run is cancelled in its own words, so that its coordinator and workers leave it; at the end it goes."""
    entry = older(old, RunState.PAUSED)
    registry = desk.open(old).registry
    registry.replace(entry)
    handle = desk.submit(old)
    assert desk.replaced == entry
    assert registry.runs() == {
        entry.key: older(old, RunState.CANCELLED),
        handle.run.key: handle.run,
    }
    assert desk.open(old).run == handle.run
    Coordinator(old, handle)._take_down()
    assert registry.runs() == {}


def test_releases_that_disagree_on_the_fingerprint(desk: Desk, dataset: Dataset) -> None:
    """The run of a release that computes another fingerprint is known by its place: it is respected, and taken over."""
    handle = desk.open(dataset, settles=True)
    theirs = handle.run.model_copy(update={"release": "9.9.9", "spec_sha256": "f" * 64, "state": RunState.PAUSED})
    handle.registry.replace(theirs)
    assert desk.open(dataset, settles=True).run == theirs
    mine = desk.submit(dataset)
    assert desk.replaced == theirs
    assert mine.registry.runs()[theirs.key].state is RunState.CANCELLED
    assert desk.open(dataset).run == mine.run


def test_submission_takes_over_the_run_of_another_release(desk: Desk, dataset: Dataset) -> None:
    """A run that a later release registered is replaced, and its messages, which may have another form, are removed."""
    handle = desk.open(dataset, settles=True)
    theirs = handle.run.model_copy(update={"release": "9.9.9", "state": RunState.PAUSED})
    handle.registry.replace(theirs)
    handle.queue.submit(theirs, [dataset.message(job, theirs.place) for job in list(dataset.header.spec.jobs())[:2]])
    assert desk.open(dataset, settles=True).run == theirs
    mine = desk.submit(dataset)
    assert desk.replaced == theirs
    assert mine.registry.runs() == {mine.run.key: mine.run}
    assert mine.queue.length(mine.run) == 4
