"""Parts of a dataset that lie elsewhere, behind links: whatever looks at a dataset sees the same."""

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from farm.dataset.completion import STALE_TEMPORARY_S, Completion, is_done
from farm.dataset.dataset import Dataset, open_dataset
from farm.dataset.destination import parse_destination
from farm.dataset.index import write_index
from farm.dataset.outputs import IMAGE
from farm.dataset.paths import file_path, manifest_path
from farm.dataset.quarantine import Quarantine, put_in_quarantine
from farm.dataset.report import write_report
from farm.dataset.verify import damaged_jobs, verify
from farm.errors import DestinationError
from farm.spec.job import Job
from tests.stand_in import StandInRenderer
from worker.service.upload import upload

JOB = Job.from_id("far-000001")

PARTS = ["far", "far/images", "far/manifests", manifest_path(JOB), file_path(JOB, IMAGE), "dataset.json", ""]
"""Parts of a dataset that a user may move to another disk; the last is the whole."""


@pytest.fixture
def made(dataset: Dataset) -> Dataset:
    """A finished dataset."""
    for job in dataset.header.spec.jobs():
        upload(StandInRenderer().make(job, dataset.header), job, dataset)
    return dataset


def move(dataset: Dataset, part: str, elsewhere: Path, *, relative: bool) -> None:
    """Move a part of a dataset elsewhere, and link to it."""
    here = Path(dataset.storage.location) / part
    elsewhere.mkdir(exist_ok=True)
    there = elsewhere / "moved"
    shutil.move(here, there)
    here.symlink_to(os.path.relpath(there, here.parent) if relative else there)


def place(dataset: Dataset) -> Dataset:
    """The dataset as a command opens it."""
    return open_dataset(parse_destination(dataset.storage.location))


@pytest.mark.parametrize("relative", [True, False])
@pytest.mark.parametrize("part", PARTS[:-1])
def test_linked_part(made: Dataset, tmp_path: Path, part: str, relative: bool) -> None:
    """A linked part is as good as one in its place, for each that looks, and nothing in it is extra."""
    move(made, part, tmp_path / "disk", relative=relative)
    dataset = place(made)
    assert verify(dataset).findings == ()
    assert list(damaged_jobs(dataset)) == []
    assert len(Completion(dataset).audit()) == len(Completion(dataset).look()) == 4
    assert write_index(dataset) == write_report(dataset) == 4
    assert is_done(dataset, JOB)


def test_linked_dataset(made: Dataset, tmp_path: Path) -> None:
    """A link to a dataset is the dataset, under its own name."""
    (tmp_path / "short").symlink_to(made.storage.location)
    assert verify(open_dataset(parse_destination(str(tmp_path / "short")))).clean


@pytest.mark.parametrize("part", PARTS[:-2])
def test_linked_part_that_is_away(made: Dataset, tmp_path: Path, part: str) -> None:
    """While a link's target is away nothing counts as missing, and nothing is written or made in its place."""
    move(made, part, tmp_path / "disk", relative=False)
    (tmp_path / "disk").rename(tmp_path / "unmounted")
    picture = StandInRenderer().make(JOB, made.header)
    looks: list[Callable[[], object]] = [
        lambda: verify(made),
        lambda: list(damaged_jobs(made)),
        lambda: Completion(made).audit(),
        lambda: is_done(made, JOB),
        lambda: write_index(made),
        lambda: write_report(made),
        lambda: upload(picture, JOB, made),
    ]
    for look in looks:
        with pytest.raises(DestinationError, match="which is not there; is its disk mounted"):
            look()
    (tmp_path / "unmounted").rename(tmp_path / "disk")
    assert verify(made).clean


@pytest.mark.parametrize("part", ["", "dataset.json"])
def test_dataset_that_is_away(made: Dataset, tmp_path: Path, part: str) -> None:
    """A link to a dataset whose disk is away is no place for a new one."""
    move(made, part, tmp_path / "disk", relative=False)
    (tmp_path / "disk").rename(tmp_path / "unmounted")
    with pytest.raises(DestinationError, match="which is not there; is its disk mounted"):
        place(made)


def test_pictures_are_made_through_a_link(dataset: Dataset, tmp_path: Path) -> None:
    """A worker writes into the folder that a link leads to, and leaves the link."""
    far = Path(dataset.storage.location) / "far"
    (tmp_path / "disk").mkdir()
    far.symlink_to(tmp_path / "disk")
    upload(StandInRenderer().make(JOB, dataset.header), JOB, dataset)
    assert far.is_symlink()
    assert {path.name for path in (tmp_path / "disk").iterdir()} == {"images", "masks", "instances", "manifests"}
    assert is_done(dataset, JOB)


def test_leftovers_behind_a_link(made: Dataset, tmp_path: Path) -> None:
    """What killed writers left behind a link is removed as elsewhere, and given-up jobs are found there."""
    put_in_quarantine(made, JOB, "no scene passed", attempts=1, worker="host:1", log="")
    left = ["far/images/.tmp-far-000001.png.host.1", "quarantine/.tmp-far-000001.json.host.1"]
    for path in left:
        made.storage.write(path, b"")
    for part in ("far/images", "quarantine"):
        move(made, part, tmp_path / f"disk-{part[:3]}", relative=True)
    completion = Completion(made)
    completion.audit()
    now_s = (tmp_path / "disk-far/moved" / Path(left[0]).name).stat().st_mtime + STALE_TEMPORARY_S + 1
    assert completion.remove_leftovers(now_s) == len(left)
    assert Quarantine(made).look() == {JOB.id: "no scene passed"}


def test_mount_that_vanishes_amid_a_picture(made: Dataset, tmp_path: Path) -> None:
    """A picture whose dataset has gone with its mount is not written beneath it, nor is a record, index or page."""
    picture = StandInRenderer().make(JOB, made.header)
    folder = Path(made.storage.location)
    folder.rename(tmp_path / "unmounted")
    folder.mkdir()
    writes: list[Callable[[], object]] = [
        lambda: upload(picture, JOB, made),
        lambda: put_in_quarantine(made, JOB, "why", attempts=1, worker="host:1", log=""),
        lambda: write_index(made),
        lambda: write_report(made),
    ]
    for write in writes:
        with pytest.raises(DestinationError, match=r"its dataset\.json is gone; is its disk mounted"):
            write()
    assert list(folder.iterdir()) == []
