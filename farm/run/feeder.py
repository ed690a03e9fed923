"""Keeps a run's queue filled, up to a window of jobs, and notices jobs that were queued and got lost.

A job is *on its way* from the moment it is queued until it is done or given up: it waits, or a worker holds it.
"""

import itertools
import time
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace

from farm.dataset.dataset import Dataset
from farm.errors import MessageError
from farm.run.ledger.owner import live_claims
from farm.run.progress import RunHandle
from farm.run.registry.port import Run
from farm.spec.job import Job
from farm.spec.job_set import JobSet

WINDOW = 30_000
"""Number of a run's jobs that may wait in Redis, where they take 40 MB: the published 25,000 images fit, and a million
are queued bit by bit."""

LOST_AFTER_S = 10.0
"""Time, in seconds, after which a job that is neither done, given up, claimed nor queued counts as lost. For an instant
a message is in no list: a worker has taken it and has not claimed its job yet. A job queued twice does no harm, but it
costs a look."""

_LOST_OFTEN = 2
"""Losses of one job after which this is told: a message or two may get lost, but this one is taken by somebody."""

_LONGEST_WAIT_S = 600.0
"""Longest time, in seconds, before a job that gets lost again and again is queued again: where its messages go to no
worker, they don't become many."""


class Feeder:
    """Puts a dataset's undone jobs into its queue.

    Args:
        dataset: the dataset.
        handle: ledger, queue and registry of the dataset's run in Redis.
        window: number of jobs that may wait; see `WINDOW`.
        lost_after_s: time, in seconds, after which a missing job counts as lost; see `LOST_AFTER_S`. It doubles with
            each loss of the job.

    Attributes:
        trouble: line that says that the queue is not as it can be by this feeder's doing; empty while it is.
    """

    def __init__(
        self, dataset: Dataset, handle: RunHandle, *, window: int = WINDOW, lost_after_s: float = LOST_AFTER_S
    ) -> None:
        self._dataset = dataset
        self._handle = handle
        self._window = window
        self._lost_after_s = lost_after_s
        self._on_the_way = self._none()
        self._suspected_s: dict[Job, float] = {}
        self._losses: dict[Job, int] = {}
        self._too_long_since_s: float | None = None
        self.trouble = ""

    def _none(self) -> JobSet:
        return JobSet(self._dataset.header.spec.quotas)

    def survey(self) -> None:
        """Read from Redis which jobs are on their way: those that wait, and those that a worker holds.

        Raises:
            BrokerError: if Redis can't be read.
        """
        # The queue is read before the claims: a job moves from the queue to the claims, never back.
        self._on_the_way = self._waiting() | self._claimed()
        self._suspected_s = {}

    def _waiting(self) -> JobSet:
        found = self._none()
        for job in self._handle.queue.queued(self._handle.run):
            found.add(job)
        return found

    def _claimed(self) -> JobSet:
        found = self._none()
        for job_id in live_claims(self._handle.ledger):
            # A key that is not a job's id was not written by this farm.
            try:
                found.add(Job.from_id(job_id))
            except MessageError:
                continue
        return found

    def follow(self, run: Run) -> None:
        """Take up a changed run: its priority holds for the jobs queued from now on."""
        self._handle = replace(self._handle, run=run)

    def top_up(self, undone: JobSet) -> int:
        """Feed the queue if it is at least half empty, which saves the work at most looks.

        Args:
            undone: jobs that are neither done nor given up.

        Returns:
            The number of jobs queued.

        Raises:
            BrokerError: if Redis can't be reached.
        """
        if self._handle.queue.length(self._handle.run) > self._window // 2:
            return 0
        return self.feed(undone)

    def feed(self, undone: JobSet, on_submitted: Callable[[int], None] = lambda _: None) -> int:
        """Queue undone jobs that are not on their way, up to the window.

        Args:
            undone: jobs that are neither done nor given up.
            on_submitted: function that gets the number of jobs queued so far, at every hundredth and at the end.

        Returns:
            The number of jobs queued.

        Raises:
            BrokerError: if Redis can't be reached; the jobs that this call has queued then count as not on their way.
        """
        waiting = self._handle.queue.length(self._handle.run)
        # Never more messages than undone jobs, whoever has queued them.
        room = max(0, min(self._window, len(undone)) - waiting)
        jobs = list(itertools.islice(undone - self._on_the_way, room))
        messages = (self._dataset.message(job, self._handle.run.place) for job in _counted(jobs, on_submitted))
        count = self._handle.queue.submit(self._handle.run, messages) if jobs else 0
        for job in jobs:
            self._on_the_way.add(job)
        return count

    def left_out(self, undone: JobSet) -> int:
        """Count the jobs among `undone` that are not on their way."""
        return len(undone - self._on_the_way)

    def mend(self, undone: JobSet) -> None:
        """Look for jobs that were queued and are lost now; the next feed queues those that stay lost.

        Args:
            undone: jobs that are neither done nor given up.

        Raises:
            BrokerError: if Redis can't be read.
        """
        now_s = time.monotonic()
        waiting = self._handle.queue.length(self._handle.run)
        self._suspected_s = {job: self._suspected_s.get(job, now_s) for job in self._lost(undone, waiting)}
        self._losses = {job: count for job, count in self._losses.items() if job in undone}
        for job, since_s in list(self._suspected_s.items()):
            losses = self._losses.get(job, 0)
            if now_s - since_s >= self._patience_s(losses):
                self._on_the_way.discard(job)
                # Once it is queued again, its time begins again.
                del self._suspected_s[job]
                self._losses[job] = losses + 1
        self.trouble = self._too_many(len(undone), waiting, now_s) or self._too_few()

    def _patience_s(self, losses: int) -> float:
        return min(_LONGEST_WAIT_S, self._lost_after_s * 2.0 ** min(losses, 10))

    def _too_many(self, undone: int, waiting: int, now_s: float) -> str:
        """Say that messages wait beyond the undone jobs, for longer than workers need to take doubled ones."""
        if waiting <= undone:
            self._too_long_since_s = None
            return ""
        self._too_long_since_s = now_s if self._too_long_since_s is None else self._too_long_since_s
        if now_s - self._too_long_since_s < self._lost_after_s:
            return ""
        return (
            f"{waiting} messages wait for {undone} missing images, so nothing is queued: another program adds to this "
            "queue, or the images are made elsewhere; farm cancel empties it"
        )

    def _too_few(self) -> str:
        """Say that jobs get lost again and again."""
        often = sum(count >= _LOST_OFTEN for count in self._losses.values())
        if not often:
            return ""
        return (
            f"{often} images were queued {_LOST_OFTEN + 1} times, and no worker has begun them: their messages go to "
            "another Redis, or another program takes them from this one"
        )

    def _lost(self, undone: JobSet, waiting: int) -> JobSet:
        outstanding = undone & self._on_the_way
        claimed = self._claimed()
        for job in [job for job in self._losses if job in claimed]:
            del self._losses[job]
        # The queue is searched only if it is shorter than it should be: claimed jobs are not in it, and duplicates hide
        # a loss only until a worker takes them.
        if len(outstanding - claimed) <= waiting:
            return self._none()
        return outstanding - self._waiting() - self._claimed()


def _counted(jobs: Iterable[Job], on_submitted: Callable[[int], None], every: int = 100) -> Iterator[Job]:
    count = 0
    for count, job in enumerate(jobs, start=1):
        yield job
        if count % every == 0:
            on_submitted(count)
    on_submitted(count)
