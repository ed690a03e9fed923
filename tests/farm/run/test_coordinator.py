"""Submitting, feeding and mending, with queue, ledger and workers in memory."""

import itertools
import os
import shutil
import threading
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest

import farm.run.coordinator
from farm.dataset.dataset import Dataset, create_dataset
from farm.dataset.destination import Destination
from farm.dataset.header_file import header_content
from farm.dataset.paths import HEADER_FILE, PLACE_FILE
from farm.dataset.place import claim_place, read_place
from farm.dataset.quarantine import Quarantine, put_in_quarantine
from farm.dataset.verify import verify
from farm.errors import (
    BrokerError,
    ConflictError,
    DestinationError,
    IncompleteError,
    RunCancelledError,
)
from farm.run.coordinator import Coordinator
from farm.run.ledger.owner import this_process
from farm.run.progress import Progress
from farm.run.registry.port import Priority, Run, RunState, WorkerReport, WorkerState
from farm.spec.header import DatasetHeader
from farm.spec.job import Job, JobMessage
from farm.storage import LocalStorage, StoredFile, is_temporary
from tests.doubles.ledger import MemoryLedger
from tests.doubles.queue import MemoryQueue
from tests.doubles.run import Bench
from tests.stand_in import StandInRenderer, stand_in_header
from worker.service.upload import upload

JOB = Job.from_id("far-000001")
NEVER_S = 1e9


class StopWatchingError(Exception):
    """Ends a watch from outside."""


@pytest.fixture(autouse=True)
def _no_rest(monkeypatch: pytest.MonkeyPatch) -> None:
    """Look again at once, without a pause."""
    monkeypatch.setattr(farm.run.coordinator, "_REST", 0)


@pytest.fixture
def bench(dataset: Dataset) -> Bench:
    """A run without any submission."""
    return Bench(dataset)


@pytest.fixture
def large(tmp_path: Path) -> Dataset:
    """A run of a hundred jobs."""
    return create_dataset(Destination(str(tmp_path / "store"), "large"), stand_in_header(far=60, far_aligned=40))


def looks(coordinator: Coordinator, count: int, act: Callable[[], None] = lambda: None) -> list[Progress]:
    """Watch for this many looks."""
    seen: list[Progress] = []

    def look(progress: Progress) -> None:
        seen.append(progress)
        if len(seen) == count:
            raise StopWatchingError

    with pytest.raises(StopWatchingError):
        coordinator.watch(look, supervise=act)
    return seen


def dead_process() -> str:
    """A process of this machine that has ended."""
    return f"{this_process().rpartition(':')[0]}:{2**22 + 1}"


def test_submits_all(bench: Bench) -> None:
    """The first submission queues the whole plan, and registers the run."""
    assert bench.coordinator.submit_missing() == 4
    assert bench.queued() == sorted(job.id for job in bench.dataset.header.spec.jobs())
    assert bench.registry.runs() == {bench.handle.run.key: bench.handle.run}
    assert bench.coordinator.left_out == 0


def test_submission_tells_how_far_it_is(large: Dataset) -> None:
    """The number of submitted jobs is reported now and then, the last time the whole."""
    told: list[int] = []
    Bench(large).coordinator.submit_missing(told.append)
    assert told == sorted(told)
    assert told[-1] == 100


def test_submits_nothing_twice(bench: Bench) -> None:
    """Jobs that wait already aren't queued again, by another process either."""
    bench.coordinator.submit_missing()
    assert bench.coordinator.submit_missing() == 0
    assert Coordinator(bench.dataset, bench.handle).submit_missing() == 0


def test_jobs_of_a_former_dataset_do_not_count(bench: Bench, tmp_path: Path) -> None:
    """A dataset that replaces a removed one of its name is queued whole, and made."""
    bench.coordinator.submit_missing()
    shutil.rmtree(tmp_path / "store/cables")
    place = Destination(str(tmp_path / "store"), "cables")
    fresh = Bench(create_dataset(place, stand_in_header(seed=5)), queue=bench.queue)
    assert fresh.coordinator.submit_missing() == 4
    assert fresh.finish().done == 4
    assert verify(fresh.dataset).clean


def test_leaves_claimed_jobs(bench: Bench) -> None:
    """A job that a living worker holds is not queued."""
    bench.ledger.claim(JOB.id, this_process())
    assert bench.coordinator.submit_missing() == 3


def test_takes_jobs_from_the_dead(bench: Bench) -> None:
    """A job that an ended worker held is queued."""
    bench.ledger.claim(JOB.id, dead_process())
    assert bench.coordinator.submit_missing() == 4


def test_submits_only_what_is_missing(bench: Bench) -> None:
    """After the loss of Redis, and of one picture, exactly the undone jobs are queued."""
    bench.coordinator.submit_missing()
    bench.finish()
    bench.dataset.storage.remove("far/masks/far-000001.png")
    fresh = Bench(bench.dataset)
    assert fresh.coordinator.submit_missing() == 1
    assert fresh.queued() == [JOB.id]


def test_finished_dataset_needs_no_run(bench: Bench) -> None:
    """A whole dataset isn't registered."""
    bench.coordinator.submit_missing()
    bench.finish()
    assert bench.coordinator.submit_missing() == 0
    assert bench.registry.runs() == {}


def test_truncated_picture_is_missing(bench: Bench, tmp_path: Path) -> None:
    """A picture with another size than its manifest says is made again, to the same bytes."""
    bench.coordinator.submit_missing()
    bench.finish()
    picture = tmp_path / "store/cables/far/images/far-000000.png"
    content = picture.read_bytes()
    os.truncate(picture, 10)
    assert bench.coordinator.submit_missing() == 1
    bench.finish()
    assert picture.read_bytes() == content


def test_last_audit_finds_a_truncated_picture(bench: Bench, tmp_path: Path) -> None:
    """A picture that is damaged after its job was done is made again before the run ends."""
    picture = tmp_path / "store/cables/far/images/far-000000.png"
    whole: list[bytes] = []

    def work() -> None:
        bench.work()
        if bench.rendered == 4 and not whole:
            whole.append(picture.read_bytes())
            os.truncate(picture, 10)

    bench.coordinator.submit_missing()
    assert bench.coordinator.watch(supervise=work).done == 4
    assert bench.rendered == 5
    assert picture.read_bytes() == whole[0]


def test_picture_that_comes_back(bench: Bench, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A picture that was away at an audit and is whole again doesn't keep the run from ending."""
    monkeypatch.setattr(farm.run.coordinator, "_AUDIT_S", 0.0)
    monkeypatch.setattr(farm.run.coordinator, "_AUDIT_REST", 0)
    bench.coordinator.submit_missing()
    bench.finish()
    picture = tmp_path / "store/cables/far/images/far-000000.png"
    away = picture.rename(tmp_path / "away.png")
    assert bench.coordinator.submit_missing() == 1
    away.rename(picture)
    assert bench.finish().done == 4


def test_watch_tells_of_progress(bench: Bench) -> None:
    """Each look is reported; the last one is complete."""
    seen: list[Progress] = []
    bench.coordinator.submit_missing()
    last = bench.coordinator.watch(seen.append, supervise=bench.work)
    assert [look.done for look in seen] == [1, 2, 3, 4]
    assert last.done == last.quota == 4
    assert last.last_picture is not None
    assert last.trouble is None
    assert last.state is RunState.ACTIVE


def test_nothing_is_left_in_redis(bench: Bench) -> None:
    """A run that has ended isn't registered, has an empty queue and no leader."""
    bench.coordinator.submit_missing()
    bench.queue.messages.append(bench.queue.messages[0])
    bench.finish()
    assert bench.registry.runs() == {}
    assert bench.queued() == []
    assert bench.ledger.leader() is None


def test_watch_submits_too(bench: Bench) -> None:
    """A dataset that nobody submitted is queued by a watch."""
    assert bench.finish().done == 4


@pytest.mark.parametrize("window", [1, 2, 10])
def test_window(large: Dataset, window: int) -> None:
    """No more jobs than the window ever wait, and all are made, once each."""
    bench = Bench(large, window=window, lost_after_s=NEVER_S)
    longest = 0

    def work() -> None:
        nonlocal longest
        longest = max(longest, len(bench.queue.messages))
        bench.work(3)

    assert bench.coordinator.submit_missing() == window
    assert bench.coordinator.left_out == 100 - window
    assert bench.coordinator.watch(supervise=work).done == 100
    assert longest == window
    assert bench.rendered == 100


def test_large_plan_in_a_window(tmp_path: Path) -> None:
    """Of 25,000 jobs only those of the window are queued at first, spread over the categories."""
    quotas = {"close_concentrated_light": 12_500, "far": 12_500}
    bench = Bench(create_dataset(Destination(str(tmp_path), "large"), stand_in_header(**quotas)), window=100)
    assert bench.coordinator.submit_missing() == 100
    assert bench.coordinator.left_out == 24_900
    assert sum(job_id.startswith("far") for job_id in bench.queued()) == 50


def test_large_plan_is_submitted_whole(tmp_path: Path) -> None:
    """Each of 25,000 jobs is queued exactly once."""
    bench = Bench(create_dataset(Destination(str(tmp_path), "large"), stand_in_header(far=25_000)))
    assert bench.coordinator.submit_missing() == 25_000
    assert len(set(bench.queued())) == len(bench.queued()) == 25_000


def test_lost_messages_come_again(bench: Bench) -> None:
    """If messages vanish and no process holds their jobs, they are submitted again."""
    bench.coordinator.submit_missing()
    bench.queue.messages.popleft()
    bench.queue.messages.popleft()
    assert bench.finish().done == 4


def test_lost_messages_of_a_window_come_again(large: Dataset) -> None:
    """Messages that vanish while a window moves on are replaced."""
    bench = Bench(large, window=10)
    steps = itertools.count()

    def work() -> None:
        bench.work(3)
        if next(steps) % 5 == 0 and bench.queue.messages:
            bench.queue.messages.popleft()

    assert bench.coordinator.watch(supervise=work).done == 100
    assert bench.rendered == 100


def test_emptied_redis(large: Dataset) -> None:
    """A Redis that restarts empty is filled again at once, without waiting until each job counts as lost."""
    bench = Bench(large, window=10, lost_after_s=NEVER_S)

    def work() -> None:
        bench.work(3)
        if bench.rendered in {21, 60}:
            bench.empty_redis()

    bench.coordinator.submit_missing()
    assert bench.coordinator.watch(supervise=work).done == 100
    assert bench.rendered == 100


def test_two_coordinators_do_not_double(large: Dataset, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of two machines that watch one dataset, only one queues jobs, even if messages get lost."""
    bench = Bench(large, window=10, lost_after_s=NEVER_S)
    other = Coordinator(large, bench.handle, poll_s=0.0, lost_after_s=0.0, window=50)
    longest, steps = 0, itertools.count()

    def work() -> None:
        nonlocal longest
        assert next(steps) < 1000  # Each would survey for ever if both led.
        with monkeypatch.context() as patch:
            patch.setattr(farm.run.coordinator, "this_process", lambda: "elsewhere:1")
            looks(other, 1)
        longest = max(longest, len(bench.queue.messages))
        bench.work(3)

    bench.coordinator.submit_missing()
    with monkeypatch.context() as patch:
        patch.setattr(farm.run.coordinator, "this_process", lambda: "here:1")
        bench.ledger.lead("here:1", 60)
        assert bench.coordinator.watch(supervise=work).done == 100
    assert longest == 10
    assert bench.rendered == len(bench.runs) == 100


def test_dead_leader_is_followed(bench: Bench) -> None:
    """A coordinator of this machine that died doesn't keep another one from queueing."""
    bench.ledger.lead(dead_process(), NEVER_S)
    assert bench.finish().done == 4


def test_silent_leader_is_followed(dataset: Dataset) -> None:
    """A silent coordinator of another machine is replaced after its term, and not before."""
    now_s = 0.0
    bench = Bench(dataset, ledger=MemoryLedger(lambda: now_s))
    bench.ledger.lead("elsewhere:1", 60)
    looks(bench.coordinator, 10)
    assert bench.queued() == []
    now_s = 61.0
    assert bench.finish().done == 4


def test_stopped_watch_hands_over(bench: Bench) -> None:
    """A watch that stops gives up the lead."""
    looks(bench.coordinator, 1)
    assert bench.ledger.leader() is None


def test_paused_run_is_not_fed(large: Dataset) -> None:
    """A paused run gets no more jobs, and no lost ones, until it is resumed."""
    bench = Bench(large, window=10)
    bench.coordinator.submit_missing()
    bench.want(RunState.PAUSED)
    bench.queue.messages.clear()
    assert {look.state for look in looks(bench.coordinator, 10)} == {RunState.PAUSED}
    assert bench.queued() == []
    bench.want(RunState.ACTIVE)
    assert bench.finish().done == 100


def test_cancelled_run_ends_the_watch(bench: Bench) -> None:
    """A watch is told that its run was cancelled, and the done images stay."""
    bench.coordinator.submit_missing()

    def cancel_after_two() -> None:
        bench.work()
        if bench.rendered == 2:
            bench.want(RunState.CANCELLED)
            bench.queue.clear(bench.handle.run)

    with pytest.raises(RunCancelledError, match="submit it again"):
        bench.coordinator.watch(supervise=cancel_after_two)
    assert bench.queued() == []
    bench.want(RunState.ACTIVE)
    assert bench.coordinator.submit_missing() == 2


class FlakyLedger(MemoryLedger):
    """A ledger that can't be reached for a number of calls."""

    away = 0

    def claims(self) -> dict[str, str]:
        """Implement `Ledger.claims`."""
        self.away -= 1
        if self.away >= 0:
            raise BrokerError("Redis went away")
        return dict(super().claims())


class FlakyQueue(MemoryQueue):
    """A queue that can't be reached for a number of calls, after it has taken some messages."""

    away = 0

    def length(self, run: Run) -> int:
        """Implement `JobQueue.length`."""
        self.away -= 1
        if self.away >= 0:
            raise BrokerError("Redis went away")
        return super().length(run)


@pytest.mark.parametrize("what", ["ledger", "queue"])
def test_redis_that_is_away_is_waited_for(large: Dataset, what: str) -> None:
    """While Redis is away the watch says so and continues; afterwards the rest is made, each job once."""
    ledger, queue = FlakyLedger(), FlakyQueue()
    bench = Bench(large, ledger=ledger, queue=queue, window=10, lost_after_s=NEVER_S)
    gone = False

    def work() -> None:
        nonlocal gone
        if ledger.away > 0 or queue.away > 0:
            return
        bench.work(3)
        if bench.rendered >= 30 and not gone:
            gone = True
            (ledger if what == "ledger" else queue).away = 5

    seen: list[Progress] = []
    bench.coordinator.submit_missing()
    assert bench.coordinator.watch(seen.append, supervise=work).done == 100
    told = [look for look in seen if look.trouble]
    assert len(told) == 5
    assert all(look.trouble == "Redis went away; waiting for it" and look.done >= 30 for look in told)
    assert bench.rendered == 100


def test_submission_without_redis(dataset: Dataset) -> None:
    """A submission, for which a person waits, doesn't wait for Redis."""
    queue = FlakyQueue()
    queue.away = 1
    with pytest.raises(BrokerError):
        Bench(dataset, queue=queue).coordinator.submit_missing()


def test_end_needs_no_redis(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    """A done dataset ends its run, whether Redis can be reached or not."""
    bench.coordinator.submit_missing()
    bench.work(4)

    def away(*_: object) -> None:
        raise BrokerError("Redis went away")

    for part in (bench.ledger, bench.queue, bench.registry):
        for name in ("activity", "leader", "lead", "resign", "register", "remove", "clear", "length", "runs"):
            if hasattr(part, name):
                monkeypatch.setattr(part, name, away)
    assert bench.coordinator.watch().done == 4


class FlakyStorage(LocalStorage):
    """A storage that can't be listed a number of times."""

    away = 0

    def scan(self, under: str = "", *, deep: bool = True) -> Iterator[tuple[str, StoredFile]]:
        """Implement `Streams.scan`."""
        if under == "far/manifests":
            self.away -= 1
            if self.away >= 0:
                raise DestinationError("stale file handle")
        return super().scan(under, deep=deep)


def test_folder_that_is_away_is_waited_for(dataset: Dataset) -> None:
    """While the folder can't be listed the watch says so, and nothing counts as lost."""
    storage = FlakyStorage(Path(dataset.storage.location))
    bench = Bench(replace(dataset, storage=storage), lost_after_s=NEVER_S)
    seen: list[Progress] = []

    def work() -> None:
        bench.work()
        if bench.rendered == 2 and len(seen) == 1:
            storage.away = 3

    bench.coordinator.submit_missing()
    assert bench.coordinator.watch(seen.append, supervise=work).done == 4
    assert [look.trouble for look in seen if look.trouble] == ["stale file handle; waiting for it"] * 3


def test_permanent_failure_ends_the_run(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    """The run ends when all jobs but the failed ones are done, and gives each reason and what to do."""
    monkeypatch.setenv("STAND_IN_FAILS", "far-000001=permanent")
    bench.coordinator.submit_missing()
    with pytest.raises(
        IncompleteError, match=r"1 of 4 images failed.* farm retry .*\n  far-000001: no scene passed the checks"
    ):
        bench.finish()
    assert bench.rendered == 3


def test_given_up_job_is_not_submitted(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    """Submitting again, even to a new Redis, leaves a given-up job until it is released; then it is made."""
    monkeypatch.setenv("STAND_IN_FAILS", "far-000001=permanent")
    bench.coordinator.submit_missing()
    with pytest.raises(IncompleteError):
        bench.finish()
    monkeypatch.delenv("STAND_IN_FAILS")
    fresh = Bench(bench.dataset)
    assert fresh.coordinator.submit_missing() == 0
    with pytest.raises(IncompleteError):
        fresh.finish()
    Quarantine(bench.dataset).release([JOB.id])
    assert fresh.coordinator.submit_missing() == 1
    assert fresh.finish().done == 4


def test_given_up_job_that_was_made_after_all(bench: Bench) -> None:
    """The record of a job that was made after all, say by a worker that was thought dead, is removed."""
    bench.coordinator.submit_missing()
    bench.work(4)
    put_in_quarantine(bench.dataset, JOB, "died", attempts=3, worker="host:1", log="")
    assert bench.coordinator.watch().done == 4
    assert Quarantine(bench.dataset).look() == {}


def test_many_reasons_are_cut(tmp_path: Path) -> None:
    """Only some of many failures are listed, with the number of the others."""
    bench = Bench(create_dataset(Destination(str(tmp_path), "large"), stand_in_header(far=30)))
    for job in bench.dataset.header.spec.jobs():
        put_in_quarantine(bench.dataset, job, "died", attempts=3, worker="host:1", log="")
    with pytest.raises(IncompleteError, match=r"30 of 30 [^$]*and 10 more"):
        bench.finish()


def test_leftovers_of_done_jobs_are_removed(bench: Bench) -> None:
    """Files that a killed writer left beside a picture that was made after all are removed at the end."""
    bench.dataset.storage.write("far/images/.tmp-far-000000.png.host.1", b"half")
    bench.coordinator.submit_missing()
    bench.finish()
    assert not [path for path in bench.dataset.storage.files() if is_temporary(path)]


def test_work_in_progress_is_not_removed(bench: Bench) -> None:
    """A young temporary file of an undone job may be in use, so it stays."""
    bench.dataset.storage.write("far/images/.tmp-far-000000.png.host.1", b"half")
    bench.coordinator.submit_missing()
    assert [path for path in bench.dataset.storage.files() if is_temporary(path)]


def test_bucket(any_store: Callable[[str], str], header: DatasetHeader) -> None:
    """The whole path works in a folder and in a bucket."""
    store = any_store("store")
    bench = Bench(create_dataset(Destination(store, "cables"), header), store)
    bench.coordinator.submit_missing()
    assert bench.finish().done == 4
    assert verify(bench.dataset).clean


def test_done_job_of_another_description_does_not_count(tmp_path: Path, dataset: Dataset) -> None:
    """A picture that was copied from another dataset proves nothing, and nothing is rendered over it."""
    other = create_dataset(Destination(str(tmp_path), "other"), stand_in_header(seed=9))
    job = Job.from_id("far-000000")
    upload(StandInRenderer().make(job, other.header), job, other)
    for path in other.storage.files():
        if path.startswith("far/"):
            dataset.storage.write(path, other.storage.read(path))
    bench = Bench(dataset)
    with pytest.raises(ConflictError, match="whole pictures of another description"):
        bench.coordinator.submit_missing()
    assert bench.coordinator.left_out == 4


def looks_of(bench: Bench, number: int) -> list[Progress]:
    """A function that ends a watch after this many looks."""
    seen: list[Progress] = []

    def look(progress: Progress) -> None:
        seen.append(progress)
        if len(seen) == number:
            raise StopWatchingError

    with pytest.raises(StopWatchingError):
        bench.coordinator.watch(look)
    return seen


def test_folder_that_vanished_is_not_taken_for_an_empty_one(bench: Bench, tmp_path: Path) -> None:
    """While a mount is gone nothing is queued again, and the watch says what it waits for."""
    bench.coordinator.submit_missing()
    bench.work(4)
    (tmp_path / "store/cables").rename(tmp_path / "gone")
    (look,) = looks_of(bench, 1)
    assert "is gone" in str(look.trouble)
    assert bench.queued() == []
    (tmp_path / "gone").rename(tmp_path / "store/cables")
    assert bench.coordinator.watch().done == 4


def test_lost_id_of_the_place_is_written_again(bench: Bench, dataset: Dataset) -> None:
    """Workers go by it, and a move of `folder/*` leaves it behind."""
    place = claim_place(dataset.storage)
    bench.handle = replace(bench.handle, run=bench.handle.run.model_copy(update={"place": place}))
    bench.coordinator = Coordinator(dataset, bench.handle)
    dataset.storage.remove(PLACE_FILE)
    looks_of(bench, 1)
    assert read_place(dataset.storage) == place


def test_header_that_another_command_replaced_ends_the_watch(bench: Bench, dataset: Dataset) -> None:
    """Of two commands that begin different datasets in one place at once, the one that wrote first is told."""
    bench.coordinator.submit_missing()
    dataset.storage.write(HEADER_FILE, header_content(stand_in_header(seed=7)))
    with pytest.raises(ConflictError, match="is another dataset's by now"):
        bench.coordinator.watch()


def test_emptied_redis_does_not_undo_a_pause(bench: Bench) -> None:
    """The notice is registered again as it was last seen."""
    bench.coordinator.submit_missing()
    bench.want(RunState.PAUSED)
    looks_of(bench, 1)
    bench.registry.remove(bench.handle.run.key)
    looks_of(bench, 1)
    assert bench.registry.runs()[bench.handle.run.key].state is RunState.PAUSED


def test_changed_priority_holds_for_what_is_queued_next(large: Dataset) -> None:
    """A watching coordinator adopts the notice's new priority."""

    class Noting(MemoryQueue):
        priorities: tuple[Priority, ...] = ()

        def submit(self, run: Run, messages: Iterable[JobMessage]) -> int:
            """Implement `JobQueue.submit`."""
            self.priorities += (run.priority,)
            return super().submit(run, messages)

    queue = Noting()
    bench = Bench(large, window=10, queue=queue)
    bench.coordinator.submit_missing()
    bench.registry.replace(bench.handle.run.model_copy(update={"priority": Priority.HIGH}))
    bench.work(8)
    looks_of(bench, 1)
    assert queue.priorities == (Priority.NORMAL, Priority.HIGH)


def test_run_of_another_release_is_left_to_it(bench: Bench) -> None:
    """Nothing is queued for a run of another release, no pause is undone, and the watch says who goes on with it."""
    theirs = bench.handle.run.model_copy(update={"release": "9.9.9", "state": RunState.PAUSED})
    bench.registry.replace(theirs)
    with pytest.raises(ConflictError, match=r"of release 9\.9\.9"):
        bench.coordinator.submit_missing()
    assert looks_of(bench, 1)[0].trouble is None
    bench.registry.change(theirs.key, RunState.ACTIVE)
    (look,) = looks_of(bench, 1)
    assert "of release 9.9.9" in str(look.trouble)
    assert bench.registry.runs() == {theirs.key: theirs.model_copy(update={"state": RunState.ACTIVE})}
    assert bench.queued() == []
    bench.registry.replace(bench.handle.run)
    assert bench.finish().done == 4


def test_notice_that_cannot_be_read_stops_the_feeding(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    """While the run's notice is another release's that can't be read, nothing is queued, and the watch says so."""

    def refuse(run: Run) -> Run:
        raise ConflictError(f"{run.key}: can't be read")

    monkeypatch.setattr(bench.registry, "register", refuse)
    (look,) = looks_of(bench, 1)
    assert "can't be read" in str(look.trouble)
    assert bench.queued() == []


def test_run_that_nobody_serves(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    """A watch says that no worker serves its run, once that has lasted: workers take a while to start."""
    bench.coordinator.submit_missing()
    assert looks_of(bench, 2)[-1].unserved is None
    monkeypatch.setattr(farm.run.coordinator, "_UNSERVED_S", 0.0)
    assert "no worker is there" in str(looks_of(bench, 1)[0].unserved)
    bench.registry.report(WorkerReport(name="w@host", state=WorkerState.IDLE, serves=(bench.handle.run.key,)))
    assert looks_of(bench, 1)[0].unserved is None


def test_cancelled_run_takes_no_jobs(bench: Bench) -> None:
    """Mending a cancelled run says so, and jobs that a coordinator queued after the cancelling are removed."""
    bench.coordinator.submit_missing()
    bench.want(RunState.CANCELLED)
    with pytest.raises(RunCancelledError, match="submit it again"):
        bench.coordinator.submit_missing()
    assert bench.queued() == []


def test_complete_run_needs_no_worker(bench: Bench) -> None:
    """A complete run is recognised without queueing anything."""
    assert bench.coordinator.end_if_complete() is None
    bench.coordinator.submit_missing()
    bench.work(4)
    complete = bench.coordinator.end_if_complete()
    assert complete is not None
    assert complete.done == 4


def test_folder_that_hangs_is_told(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    """While a look at the folder hangs, the last progress is told with the reason, and workers are supervised."""
    bench.coordinator.submit_missing()
    bench.work(1)
    assert [progress.trouble for progress in looks(bench.coordinator, 1)] == [None]
    monkeypatch.setattr(farm.run.coordinator, "_SILENCE_S", 0.01)
    ends = threading.Event()
    read = LocalStorage.read

    def hang(storage: LocalStorage, path: str) -> bytes:
        ends.wait()
        return read(storage, path)

    monkeypatch.setattr(LocalStorage, "read", hang)
    supervised: list[int] = []
    seen: list[Progress] = []

    def look(progress: Progress) -> None:
        seen.append(progress)
        if len(seen) == 3:
            ends.set()
        if progress.trouble is None:
            raise StopWatchingError

    with pytest.raises(StopWatchingError):
        bench.coordinator.watch(look, supervise=lambda: supervised.append(1))
    silent = [progress for progress in seen if progress.trouble]
    assert len(silent) >= 3
    assert all("gives no answer" in str(progress.trouble) and progress.done == 1 for progress in silent)
    assert len(supervised) > len(silent)
