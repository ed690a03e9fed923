"""Submitting and mending, with queue, ledger and workers in memory."""

import itertools
import os
import shutil
from collections.abc import Callable, Iterable
from pathlib import Path

import pytest

from farm.coordinator import Coordinator
from farm.dataset import Dataset, Destination, create_dataset
from farm.errors import IncompleteError, PermanentError
from farm.header import DatasetHeader
from farm.job import Job, JobMessage
from farm.ledger.memory import MemoryLedger
from farm.ledger.owner import this_process
from farm.progress import Progress
from farm.queue.memory import MemoryQueue
from farm.storage import is_temporary
from farm.verify import verify
from tests.stand_in import StandInMaker, stand_in_header
from worker.runner import JobRunner
from worker.upload import upload


class Bench:
    """A coordinator with its surroundings, and a worker that works when told to."""

    def __init__(self, dataset: Dataset, store: str) -> None:
        self.dataset = dataset
        self.ledger = MemoryLedger()
        self.queue = MemoryQueue()
        self.runner = JobRunner(store, lambda _: StandInMaker(), lambda *_: self.ledger)
        self.coordinator = Coordinator(dataset, self.ledger, self.queue, poll_s=0.0, lost_after_s=0.0)

    def work(self, count: int = 1) -> None:
        """Take some messages and do what they ask."""
        for _ in range(min(count, len(self.queue.messages))):
            try:
                self.runner.run(self.queue.messages.popleft().encode())
            except PermanentError:
                continue

    def finish(self) -> Progress:
        """Watch to the end, with the worker taking one message at each look."""
        return self.coordinator.watch(supervise=self.work)


@pytest.fixture
def bench(dataset: Dataset, tmp_path: Path) -> Bench:
    """Nothing submitted yet."""
    return Bench(dataset, str(tmp_path / "store"))


def test_submits_all(bench: Bench) -> None:
    """The first submission queues the whole plan."""
    assert bench.coordinator.submit_missing() == 4
    assert bench.queue.queued("cables", bench.dataset.header.spec_sha256) == {
        job.id for job in bench.dataset.header.spec.jobs()
    }


def test_submits_nothing_twice(bench: Bench) -> None:
    """Jobs that wait already are not queued again."""
    bench.coordinator.submit_missing()
    assert bench.coordinator.submit_missing() == 0


def test_jobs_of_a_former_dataset_do_not_count(bench: Bench, tmp_path: Path) -> None:
    """A dataset that takes the place of a removed one of its name is queued whole, and made."""
    bench.coordinator.submit_missing()
    shutil.rmtree(tmp_path / "store/cables")
    fresh = Bench(create_dataset(Destination(str(tmp_path / "store"), "cables"), stand_in_header(seed=5)), "")
    fresh.queue, fresh.runner = bench.queue, bench.runner
    fresh.coordinator = Coordinator(fresh.dataset, bench.ledger, bench.queue, poll_s=0.0, lost_after_s=0.0)
    assert fresh.coordinator.submit_missing() == 4
    assert fresh.finish().done == 4
    assert bench.ledger.failures() == {}


def test_leaves_claimed_jobs(bench: Bench) -> None:
    """A job that a living worker holds is not queued."""
    bench.ledger.claim("far-000001", this_process())
    assert bench.coordinator.submit_missing() == 3


def test_takes_jobs_from_the_dead(bench: Bench) -> None:
    """A job that an ended worker held is queued."""
    host = this_process().partition(":")[0]
    bench.ledger.claim("far-000001", f"{host}:{2**22 + 1}")
    assert bench.coordinator.submit_missing() == 4


def test_submits_only_what_is_missing(bench: Bench) -> None:
    """After the loss of Redis, and of one picture, exactly the undone jobs are queued."""
    bench.coordinator.submit_missing()
    bench.finish()
    bench.dataset.storage.remove("far/masks/far-000001.png")
    fresh = Coordinator(bench.dataset, MemoryLedger(), queue := MemoryQueue())
    assert fresh.submit_missing() == 1
    assert queue.queued("cables", bench.dataset.header.spec_sha256) == {"far-000001"}


def test_truncated_picture_is_missing(bench: Bench, tmp_path: Path) -> None:
    """A picture of another size than its manifest tells is made again, to the same bytes."""
    bench.coordinator.submit_missing()
    bench.finish()
    picture = tmp_path / "store/cables/far/images/far-000000.png"
    content = picture.read_bytes()
    os.truncate(picture, 10)
    assert bench.coordinator.submit_missing() == 1
    bench.finish()
    assert picture.read_bytes() == content


def test_watch_tells_of_progress(bench: Bench) -> None:
    """Each look is passed on; the last one is complete."""
    looks: list[Progress] = []
    bench.coordinator.submit_missing()
    last = bench.coordinator.watch(looks.append, supervise=bench.work)
    assert [look.done for look in looks] == [1, 2, 3, 4]
    assert last.done == last.quota == 4
    assert last.last_picture is not None


def test_lost_messages_come_again(bench: Bench) -> None:
    """When messages vanish and nobody holds their jobs, they are submitted again."""
    bench.coordinator.submit_missing()
    bench.queue.messages.popleft()
    bench.queue.messages.popleft()
    assert bench.finish().done == 4


def test_watch_without_mending_leaves_the_lost(bench: Bench) -> None:
    """Where mending is off, a lost message stays lost."""
    bench.coordinator.submit_missing()
    bench.queue.messages.clear()
    looks = itertools.count()

    def stop_after_some(_progress: Progress) -> None:
        if next(looks) == 10:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        bench.coordinator.watch(stop_after_some, mend=False)
    assert bench.queue.length() == 0


def test_permanent_failure_ends_the_run(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    """The run ends when all but the failed are done, and tells each reason."""
    monkeypatch.setenv("STAND_IN_FAILS", "far-000001=permanent")
    bench.coordinator.submit_missing()
    with pytest.raises(IncompleteError, match=r"1 of 4 images failed.*\n  far-000001: no scene passed the checks"):
        bench.finish()
    assert len(bench.coordinator._completion.done) == 3


def test_failed_job_is_tried_at_the_next_submission(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    """Submitting again forgets failures, so a mended cause is found out."""
    monkeypatch.setenv("STAND_IN_FAILS", "far-000001=permanent")
    bench.coordinator.submit_missing()
    with pytest.raises(IncompleteError):
        bench.finish()
    monkeypatch.delenv("STAND_IN_FAILS")
    assert bench.coordinator.submit_missing() == 1
    assert bench.finish().done == 4


def test_leftovers_of_done_jobs_are_removed(bench: Bench) -> None:
    """What a killed writer left beside a picture that was made after all goes at the end of the run."""
    bench.dataset.storage.write("far/images/.tmp-far-000000.png.host.1", b"half")
    bench.coordinator.submit_missing()
    bench.finish()
    assert not [path for path in bench.dataset.storage.files() if is_temporary(path)]


def test_work_in_progress_is_not_removed(bench: Bench) -> None:
    """A young temporary file of an undone job may be somebody's work."""
    bench.dataset.storage.write("far/images/.tmp-far-000000.png.host.1", b"half")
    bench.coordinator.submit_missing()
    assert [path for path in bench.dataset.storage.files() if is_temporary(path)]


def test_bucket(any_store: Callable[[str], str], header: DatasetHeader) -> None:
    """The whole path works in a folder and in a bucket alike."""
    store = any_store("store")
    bench = Bench(create_dataset(Destination(store, "cables"), header), store)
    bench.coordinator.submit_missing()
    assert bench.finish().done == 4
    assert verify(bench.dataset).clean


def test_plan_is_lazy(tmp_path: Path) -> None:
    """Of 25,000 jobs only those are built that somebody asks for."""

    class Counting(MemoryQueue):
        def submit(self, messages: Iterable[JobMessage]) -> int:
            assert iter(messages) is messages
            return super().submit(itertools.islice(messages, 3))

    header = stand_in_header(
        close_concentrated_light=5000,
        close_aligned_concentrated_light=5000,
        close_distributed_light=2500,
        close_aligned_distributed_light=2500,
        far=5000,
        far_aligned=5000,
    )
    dataset = create_dataset(Destination(str(tmp_path), "large"), header)
    assert Coordinator(dataset, MemoryLedger(), Counting()).submit_missing() == 3


def test_large_plan_is_submitted_whole(tmp_path: Path) -> None:
    """Each of 25,000 jobs is queued exactly once."""
    header = stand_in_header(far=25_000)
    dataset = create_dataset(Destination(str(tmp_path), "large"), header)
    queue = MemoryQueue()
    assert Coordinator(dataset, MemoryLedger(), queue).submit_missing() == 25_000
    assert len(queue.queued("large", header.spec_sha256)) == 25_000


def test_done_job_of_another_description_does_not_count(tmp_path: Path, dataset: Dataset) -> None:
    """A manifest that was copied from another dataset proves nothing."""
    other = create_dataset(Destination(str(tmp_path), "other"), stand_in_header(seed=9))
    job = Job.from_id("far-000000")
    upload(StandInMaker().make(job, other.header), job, other)
    for path in other.storage.files():
        if path.startswith("far/"):
            dataset.storage.write(path, other.storage.read(path))
    assert Coordinator(dataset, MemoryLedger(), MemoryQueue()).submit_missing() == 4
