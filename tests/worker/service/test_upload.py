"""Writing a picture to the dataset."""

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from farm.dataset.completion import is_done
from farm.dataset.dataset import Dataset, create_dataset
from farm.dataset.destination import Destination
from farm.dataset.instances import VisibleInstance
from farm.dataset.outputs import IMAGE, INSTANCES, MASK, OUTPUTS
from farm.dataset.paths import INDEX_FILE, file_path, manifest_path
from farm.dataset.report import write_overview
from farm.dataset.verify import verify
from farm.errors import BrokerError, DestinationError, RenderError
from farm.spec.job import Job
from farm.storage import LocalStorage
from tests.doubles.ledger import MemoryLedger
from tests.stand_in import StandInRenderer, stand_in_header
from worker.service.lease import Lease, LeaseLostError
from worker.service.picture import Picture
from worker.service.upload import upload

JOB = Job.from_id("far-000000")


@pytest.fixture
def made(dataset: Dataset) -> Picture:
    """A picture with its labels."""
    return StandInRenderer().make(JOB, dataset.header)


def test_writes_the_layout(dataset: Dataset, made: Picture) -> None:
    """Three pictures and a manifest lie where the layout says."""
    upload(made, JOB, dataset)
    expected = {file_path(JOB, output) for output in OUTPUTS} | {manifest_path(JOB), "dataset.json"}
    assert set(dataset.storage.files()) == expected
    assert is_done(dataset, JOB)


def test_manifest_is_last(dataset: Dataset, made: Picture, monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is written after the manifest, so that it never vouches for a missing file."""
    written: list[str] = []
    write = type(dataset.storage).write

    def recording(storage: object, path: str, content: bytes) -> None:
        written.append(path)
        write(storage, path, content)  # type: ignore[arg-type]  # the class's own method

    monkeypatch.setattr(type(dataset.storage), "write", recording)
    upload(made, JOB, dataset)
    assert written[-1] == manifest_path(JOB)


def test_interrupted_upload_is_not_done(dataset: Dataset, made: Picture, monkeypatch: pytest.MonkeyPatch) -> None:
    """If a write fails, the job isn't done, whatever was written before."""
    write = type(dataset.storage).write

    def failing(storage: object, path: str, content: bytes) -> None:
        if "instances" in path:
            raise DestinationError("disk full")
        write(storage, path, content)  # type: ignore[arg-type]  # the class's own method

    monkeypatch.setattr(type(dataset.storage), "write", failing)
    with pytest.raises(DestinationError):
        upload(made, JOB, dataset)
    assert not is_done(dataset, JOB)


@pytest.mark.parametrize(
    "damage",
    [
        {"mask": np.zeros((32, 32), np.uint8)},
        {"mask": np.full((32, 32), 7, np.uint8)},
        {"mask": np.zeros((16, 16), np.uint8)},
        {"image": np.zeros((32, 32), np.uint8)},
        {"instances": np.zeros((32, 32), np.uint8)},
        {"image": np.zeros((32, 32, 3), np.float32)},
    ],
)
def test_labels_that_do_not_fit(dataset: Dataset, made: Picture, damage: dict[str, Any]) -> None:
    """A picture and labels that contradict each other aren't written."""
    before = dataset.storage.files()
    with pytest.raises(RenderError):
        upload(replace(made, files={**made.files, **damage}), JOB, dataset)
    assert dataset.storage.files() == before


def test_manifest_lists_what_is_seen(dataset: Dataset, made: Picture) -> None:
    """Each number of the instance map comes with its cable and its pixels."""
    written = upload(made, JOB, dataset)
    assert written.instances == (VisibleInstance(id=1, cable=0, strand=None, pixels=4 * 32),)


def without_cables(made: Picture) -> Picture:
    """The picture's background alone."""
    empty = {MASK.role: np.zeros((32, 32), np.uint8), INSTANCES.role: np.zeros((32, 32), np.uint16)}
    scene = made.scene.model_copy(update={"cables": ()})
    return replace(made, scene=scene, settled=None, files={**made.files, **empty})


def test_a_picture_without_cables_is_done_listed_and_clean(dataset: Dataset, made: Picture) -> None:
    """It has empty labels and no physics figures; manifest and index say that it has no cable."""
    written = upload(without_cables(made), JOB, dataset)
    assert (written.scene.cables, written.settled, written.instances) == ((), None, ())
    assert is_done(dataset, JOB)
    assert not [finding for finding in verify(dataset).findings if JOB.id in finding.path]
    write_overview(dataset)
    line = json.loads(dataset.storage.read(INDEX_FILE))
    assert (line["job_id"], line["cables"], line["visible_instances"]) == (JOB.id, 0, 0)


def test_an_empty_picture_of_cables_is_not_written(tmp_path: Path) -> None:
    """Where the description asks for a visible share, labels that show nothing of the scene's cables are refused."""
    header = stand_in_header()
    cable = header.spec.ranges.cable.model_copy(update={"least_visible_share": 0.01})
    ranges = header.spec.ranges.model_copy(update={"cable": cable})
    picky = header.model_copy(update={"spec": header.spec.model_copy(update={"ranges": ranges})})
    dataset = create_dataset(Destination(str(tmp_path), "picky"), picky)
    made = StandInRenderer().make(JOB, picky)
    bare = without_cables(made)
    with pytest.raises(RenderError, match="instances: is empty, but the scene has cables"):
        upload(replace(made, files=bare.files), JOB, dataset)
    assert upload(bare, JOB, dataset).instances == ()


@pytest.mark.parametrize("has_cable", [True, False])
def test_an_instance_of_nothing_in_the_scene_is_not_written(dataset: Dataset, made: Picture, has_cable: bool) -> None:
    """Labels that show more than the scene has are refused, as is any label of a picture without cables."""
    shown = {INSTANCES.role: made.files[INSTANCES.role] * np.uint16(2)} if has_cable else {}
    scene = made.scene if has_cable else made.scene.model_copy(update={"cables": ()})
    before = dataset.storage.files()
    with pytest.raises(RenderError, match="instances: has number"):
        upload(replace(made, scene=scene, files={**made.files, **shown}), JOB, dataset)
    assert dataset.storage.files() == before


class Clock:
    """A clock that the test moves."""

    now_s = 1000.0

    def __call__(self) -> float:
        """The time, in seconds."""
        return self.now_s


class Elsewhere:
    """Another machine, which takes over the job of a worker that was silent for a minute, and makes it.

    Args:
        dataset: dataset that the other machine writes to.
        seed: seed of its pixels; a seed other than the dataset's stands for another machine's rounding.
    """

    def __init__(self, dataset: Dataset, seed: int) -> None:
        self.clock = Clock()
        self.ledger = MemoryLedger(self.clock)
        self.ledger.claim(JOB.id, "here:1", 60.0)
        self.claim = Lease(self.ledger, JOB.id, "here:1", ttl_s=60.0, clock=self.clock)
        self._dataset = dataset
        self._seed = seed

    def take_over(self) -> None:
        """Let a minute pass, in which the worker here was stopped, and make the job."""
        self.clock.now_s += 61.0
        assert self.ledger.claim(JOB.id, "elsewhere:1", 60.0)
        upload(StandInRenderer().make(JOB, stand_in_header(seed=self._seed)), JOB, self._dataset)
        self.ledger.finish(JOB.id, "elsewhere:1", "picture")


class StoppedStorage(LocalStorage):
    """A storage whose process is stopped after it has decided to write one file, and before it does."""

    def __init__(self, root: Path, watched: str, meanwhile: Callable[[], None]) -> None:
        super().__init__(root)
        self._watched = watched
        self._meanwhile = meanwhile

    def write(self, path: str, content: bytes) -> None:
        """Implement `Storage.write`."""
        if path == self._watched:
            self._meanwhile()
        super().write(path, content)


ALL_PATHS = [*(file_path(JOB, output) for output in OUTPUTS), manifest_path(JOB)]
DRAWN_PATHS = [*(file_path(JOB, output) for output in (IMAGE, MASK, INSTANCES)), manifest_path(JOB)]
"""Paths of the files whose bytes differ from one seed of the stand-in to another."""


def test_worker_that_was_stopped_writes_nothing(dataset: Dataset, made: Picture) -> None:
    """A worker that was stopped past its lease changes no bit of another worker's files."""
    other = Elsewhere(dataset, seed=5)
    other.take_over()
    before = {path: dataset.storage.read(path) for path in dataset.storage.files()}
    with pytest.raises(LeaseLostError):
        upload(made, JOB, dataset, other.claim)
    assert {path: dataset.storage.read(path) for path in dataset.storage.files()} == before


def test_worker_that_was_stopped_and_not_missed(dataset: Dataset, made: Picture) -> None:
    """Past its lease a worker asks, and writes if no other worker has taken the job."""
    other = Elsewhere(dataset, seed=5)
    other.clock.now_s += 61.0
    upload(made, JOB, dataset, other.claim)
    assert is_done(dataset, JOB)


@pytest.mark.parametrize("path", DRAWN_PATHS)
def test_stop_between_check_and_write(dataset: Dataset, made: Picture, path: str) -> None:
    """A late write among another machine's files, whose bytes differ, leaves no mixed job that seems done."""
    other = Elsewhere(dataset, seed=5)
    theirs: dict[str, bytes] = {}

    def take_over() -> None:
        other.take_over()
        theirs.update({each: dataset.storage.read(each) for each in ALL_PATHS})

    storage = StoppedStorage(Path(dataset.storage.location), path, take_over)
    with pytest.raises(LeaseLostError):
        upload(made, JOB, replace(dataset, storage=storage), other.claim)
    assert manifest_path(JOB) not in dataset.storage.files()
    for each in set(ALL_PATHS) - {path, manifest_path(JOB)}:
        assert dataset.storage.read(each) == theirs[each]
    upload(made, JOB, dataset)
    assert is_done(dataset, JOB)


@pytest.mark.parametrize("path", ALL_PATHS)
def test_stop_between_check_and_write_of_the_same(dataset: Dataset, made: Picture, path: str) -> None:
    """A late write of the same bytes does no harm, and the job stays done."""
    other = Elsewhere(dataset, seed=0)
    storage = StoppedStorage(Path(dataset.storage.location), path, other.take_over)
    with pytest.raises(LeaseLostError):
        upload(made, JOB, replace(dataset, storage=storage), other.claim)
    assert is_done(dataset, JOB)


def test_stop_before_a_redis_that_is_away(dataset: Dataset, monkeypatch: pytest.MonkeyPatch) -> None:
    """A worker that can't ask after a late write leaves no mixed job either."""
    monkeypatch.setattr("farm.dataset.outputs.OUTPUTS", (IMAGE, MASK, INSTANCES))  # the last is the stand-in's own
    made = StandInRenderer().make(JOB, dataset.header)
    other = Elsewhere(dataset, seed=5)

    def take_over_and_go_away() -> None:
        other.take_over()
        monkeypatch.setattr(other.ledger, "refresh", away)

    def away(*_: object) -> bool:
        raise BrokerError("gone")

    storage = StoppedStorage(Path(dataset.storage.location), file_path(JOB, INSTANCES), take_over_and_go_away)
    with pytest.raises(BrokerError):
        upload(made, JOB, replace(dataset, storage=storage), other.claim)
    assert manifest_path(JOB) not in dataset.storage.files()


def test_claim_that_another_got_early(dataset: Dataset, made: Picture) -> None:
    """A claim that another worker has early, as after the loss of Redis, is noticed before a write."""
    other = Elsewhere(dataset, seed=5)
    other.ledger.release(JOB.id, "here:1")
    other.ledger.claim(JOB.id, "elsewhere:1", 60.0)
    before = dataset.storage.files()
    with pytest.raises(LeaseLostError):
        upload(made, JOB, dataset, other.claim)
    assert dataset.storage.files() == before


def test_claim_that_is_held_writes(dataset: Dataset, made: Picture) -> None:
    """A worker that holds its claim writes as if it were alone."""
    upload(made, JOB, dataset, Elsewhere(dataset, seed=5).claim)
    assert is_done(dataset, JOB)
