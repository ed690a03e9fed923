"""Filling a run's queue, and noticing lost messages."""

import pytest

from farm.dataset.dataset import Dataset, create_dataset
from farm.dataset.destination import Destination
from farm.run.feeder import Feeder
from farm.run.ledger.owner import this_process
from farm.spec.job import Job
from farm.spec.job_set import JobSet
from tests.doubles.run import Bench
from tests.stand_in import stand_in_header

WINDOW = 10


@pytest.fixture
def bench(tmp_path_factory: pytest.TempPathFactory) -> Bench:
    """A hundred jobs, none of them queued."""
    place = Destination(str(tmp_path_factory.mktemp("store")), "cables")
    return Bench(create_dataset(place, stand_in_header(far=100)))


def undone(dataset: Dataset) -> JobSet:
    """All jobs."""
    return JobSet(dataset.header.spec.quotas).others()


def feeder(bench: Bench, lost_after_s: float = 0.0) -> Feeder:
    """A feeder with a small window."""
    return Feeder(bench.dataset, bench.handle, window=WINDOW, lost_after_s=lost_after_s)


def test_fills_the_window(bench: Bench) -> None:
    """The first jobs of the plan are queued until the window is full, and their number is reported."""
    told: list[int] = []
    full = feeder(bench)
    assert full.feed(undone(bench.dataset), told.append) == WINDOW
    assert bench.queued() == [f"far-{index:06d}" for index in range(WINDOW)]
    assert told[-1] == WINDOW
    assert full.left_out(undone(bench.dataset)) == 90


def test_tops_up_when_half_empty(bench: Bench) -> None:
    """Nothing is added until half of the window was taken; then it is filled, without doubling those taken."""
    full = feeder(bench)
    full.feed(undone(bench.dataset))
    for _ in range(WINDOW // 2 - 1):
        bench.queue.messages.popleft()
    assert full.top_up(undone(bench.dataset)) == 0
    bench.queue.messages.popleft()
    assert full.top_up(undone(bench.dataset)) == WINDOW // 2
    assert bench.queued() == [f"far-{index:06d}" for index in range(5, 15)]


def test_a_submission_fills_the_window(bench: Bench) -> None:
    """A submission, of a job that is put back, say, doesn't wait for the queue to drain."""
    full = feeder(bench)
    full.feed(undone(bench.dataset))
    bench.queue.messages.popleft()
    assert full.feed(undone(bench.dataset)) == 1


def test_survey_finds_what_is_on_its_way(bench: Bench) -> None:
    """Jobs that wait, that a process holds, or that wait for a retry aren't queued by another feeder."""
    first = feeder(bench)
    first.feed(undone(bench.dataset))
    for _ in range(WINDOW):
        bench.queue.messages.popleft()
    first.feed(undone(bench.dataset))  # jobs 10 to 19
    while len(bench.queue.messages) > 3:
        bench.queue.messages.pop()
    bench.ledger.claim("far-000050", this_process())
    bench.ledger.claim("far-000051", this_process())
    bench.ledger.postpone("far-000051", this_process(), 60)
    bench.ledger.claim("not a job", "elsewhere:1")
    second = feeder(bench)
    second.survey()
    assert second.left_out(undone(bench.dataset)) == 95  # three jobs wait, two are held
    assert second.feed(undone(bench.dataset)) == WINDOW - 3
    assert bench.queued()[:4] == ["far-000000", "far-000001", "far-000002", "far-000003"]


def test_lost_messages_are_queued_again(bench: Bench) -> None:
    """Exactly the jobs that are neither done, held nor queued count as lost."""
    mending = feeder(bench)
    mending.feed(undone(bench.dataset))
    messages = [bench.queue.messages.popleft() for _ in range(7)]
    bench.ledger.claim(messages[0].job_id, this_process())
    jobs = undone(bench.dataset)
    jobs.discard(messages[1].job)
    before = mending.left_out(jobs)
    mending.mend(jobs)
    assert mending.left_out(jobs) == before + 5
    mending.feed(jobs)
    waiting = bench.queued()
    assert {message.job_id for message in messages[2:]} <= set(waiting)
    assert not {message.job_id for message in messages[:2]} & set(waiting)
    assert len(set(waiting)) == len(waiting) == WINDOW


def test_suspicion_takes_its_time(bench: Bench) -> None:
    """A message that nobody holds for an instant isn't queued again."""
    patient = feeder(bench, lost_after_s=3600)
    patient.feed(undone(bench.dataset))
    bench.queue.messages.clear()
    before = patient.left_out(undone(bench.dataset))
    for _ in range(3):
        patient.mend(undone(bench.dataset))
    assert patient.left_out(undone(bench.dataset)) == before


def test_jobs_of_a_dead_process_are_lost(bench: Bench) -> None:
    """A claim of an ended process of this machine holds no job back."""
    mending = feeder(bench)
    mending.feed(undone(bench.dataset))
    gone = bench.queue.messages.popleft()
    bench.ledger.claim(gone.job_id, f"{this_process().rpartition(':')[0]}:{2**22 + 1}")
    before = mending.left_out(undone(bench.dataset))
    mending.mend(undone(bench.dataset))
    assert mending.left_out(undone(bench.dataset)) == before + 1


def test_duplicates_hide_a_loss_for_a_while_only(bench: Bench) -> None:
    """If a duplicate makes up for a loss in number, the loss is found once the duplicate was taken."""
    mending = feeder(bench)
    mending.feed(undone(bench.dataset))
    bench.queue.messages.popleft()
    bench.queue.messages.appendleft(bench.queue.messages[-1])
    before = mending.left_out(undone(bench.dataset))
    mending.mend(undone(bench.dataset))
    assert mending.left_out(undone(bench.dataset)) == before
    bench.queue.messages.popleft()
    mending.mend(undone(bench.dataset))
    assert mending.left_out(undone(bench.dataset)) == before + 1


def add_foreign(bench: Bench, count: int) -> None:
    """Messages that something else queues."""
    bench.queue.messages.extend(bench.dataset.message(Job.from_id(f"far-{index:06d}")) for index in range(count))


def test_queue_that_grows_is_noticed(bench: Bench) -> None:
    """If more messages wait than images are missing nothing is added, and that is told until they are fewer."""
    mending, jobs = feeder(bench), undone(bench.dataset)
    mending.feed(jobs)
    mending.mend(jobs)
    assert mending.trouble == ""
    add_foreign(bench, 95)
    mending.mend(jobs)
    assert mending.trouble.startswith(f"{WINDOW + 95} messages wait for 100 missing images, so nothing is queued")
    assert mending.top_up(jobs) == mending.feed(jobs) == 0
    bench.queue.messages.clear()
    add_foreign(bench, 1)
    mending.mend(jobs)
    assert mending.trouble == ""
    assert mending.feed(jobs) == WINDOW - 1


def test_doubled_messages_are_no_trouble_at_once(bench: Bench) -> None:
    """Messages that were delivered twice are taken within seconds, so they are told only if they stay."""
    patient, jobs = feeder(bench, lost_after_s=3600), undone(bench.dataset)
    add_foreign(bench, 150)
    patient.mend(jobs)
    assert patient.trouble == ""


def test_never_more_messages_than_missing_images(bench: Bench) -> None:
    """Near the end the queue is filled up to the missing images, not to the window."""
    jobs = undone(bench.dataset)
    for index in range(95):
        jobs.discard(Job.from_id(f"far-{index:06d}"))
    add_foreign(bench, 3)
    assert feeder(bench).feed(jobs) == 2


def test_messages_that_go_astray_are_noticed(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    """Jobs that get lost time and again are queued ever less often, and the likely cause is told."""
    now_s = 0.0
    monkeypatch.setattr("farm.run.feeder.time.monotonic", lambda: now_s)
    mending, jobs = feeder(bench, lost_after_s=10.0), undone(bench.dataset)
    told: list[tuple[int, bool]] = []
    queued = 0
    for second in range(3600):
        now_s = float(second)
        mending.mend(jobs)
        if count := mending.feed(jobs):
            queued += count
            told.append((second, bool(mending.trouble)))
        bench.queue.messages.clear()  # as if they went to another Redis
    assert [told[0], told[-1][1]] == [(0, False), True]
    assert "another Redis" in mending.trouble
    # In an hour each job is queued a dozen times at most, however often the queue is looked at.
    assert queued <= 100 * 12


def test_job_that_a_worker_begins_is_not_astray(bench: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    """A job that was lost and then begun starts over, and nothing is told."""
    now_s = 0.0
    monkeypatch.setattr("farm.run.feeder.time.monotonic", lambda: now_s)
    mending = feeder(bench, lost_after_s=10.0)
    jobs = undone(bench.dataset)
    for index in range(1, 100):
        jobs.discard(Job.from_id(f"far-{index:06d}"))
    for second in range(100):
        now_s = float(second)
        mending.mend(jobs)
        mending.feed(jobs)
        bench.queue.messages.clear()
    assert "1 images were queued 3 times" in mending.trouble
    bench.ledger.claim("far-000000", this_process())
    mending.mend(jobs)
    assert mending.trouble == ""


def test_nothing_to_feed(bench: Bench) -> None:
    """If all jobs are done, nothing is queued."""
    assert feeder(bench).feed(JobSet(bench.dataset.header.spec.quotas)) == 0
    assert bench.queued() == []
