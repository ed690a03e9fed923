"""Keeps a run's queue filled, at most a window of it, and notices what got lost on the way."""

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
"""At most so many jobs of a run wait in Redis, 40 MB: the published 25,000 fit, a million come as the queue drains."""

LOST_AFTER_S = 10.0
"""A job that is neither done, given up, claimed nor queued for so long is lost. A message is in nobody's hands for an
instant when a worker has taken it and not yet claimed its job; a duplicate would do no harm, but cost a look."""


class Feeder:
    """Puts a dataset's undone jobs into its queue.

    Args:
        dataset: the dataset.
        hints: its run in Redis.
        window: see `WINDOW`.
        lost_after_s: see `LOST_AFTER_S`.
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

    def _none(self) -> JobSet:
        return JobSet(self._dataset.header.spec.quotas)

    def survey(self) -> None:
        """Find out afresh which jobs are on their way: those that wait, and those that somebody holds.

        Raises:
            BrokerError: if Redis can't be read.
        """
        # The queue is looked at before the claims: a job moves from there to here, never back.
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
            # What is no job's id was not written by this farm.
            try:
                found.add(Job.from_id(job_id))
            except MessageError:
                continue
        return found

    def follow(self, run: Run) -> None:
        """Take up a changed notice: a new priority, for what is queued from now on."""
        self._handle = replace(self._handle, run=run)

    def top_up(self, undone: JobSet) -> int:
        """As `feed`, once the queue is half empty: a full one is not measured out at every look."""
        if self._handle.queue.length(self._handle.run) > self._window // 2:
            return 0
        return self.feed(undone)

    def feed(self, undone: JobSet, on_submitted: Callable[[int], None] = lambda _: None) -> int:
        """Queue undone jobs that are not on their way, up to the window.

        Args:
            undone: neither done nor given up.
            on_submitted: told the number so far, now and then.

        Returns:
            How many were queued.

        Raises:
            BrokerError: if Redis goes away; what was queued before is counted as not on its way.
        """
        waiting = self._handle.queue.length(self._handle.run)
        jobs = list(itertools.islice(undone - self._on_the_way, max(0, self._window - waiting)))
        messages = (self._dataset.message(job) for job in _counted(jobs, on_submitted))
        count = self._handle.queue.submit(self._handle.run, messages) if jobs else 0
        for job in jobs:
            self._on_the_way.add(job)
        return count

    def left_out(self, undone: JobSet) -> int:
        """How many of some undone jobs are not on their way."""
        return len(undone - self._on_the_way)

    def mend(self, undone: JobSet) -> None:
        """Look for jobs that were queued and are nowhere now; the next feed queues those that stay lost.

        Args:
            undone: neither done nor given up.

        Raises:
            BrokerError: if Redis can't be read.
        """
        now_s = time.monotonic()
        self._suspected_s = {job: self._suspected_s.get(job, now_s) for job in self._lost(undone)}
        for job, since_s in self._suspected_s.items():
            if now_s - since_s >= self._lost_after_s:
                self._on_the_way.discard(job)

    def _lost(self, undone: JobSet) -> JobSet:
        outstanding = undone & self._on_the_way
        # A queue at least as long as what is expected in it is not searched: duplicates hide a loss only until they
        # are taken. What is claimed is expected elsewhere.
        waiting = self._handle.queue.length(self._handle.run)
        if len(outstanding - self._claimed()) <= waiting:
            return self._none()
        return outstanding - self._waiting() - self._claimed()


def _counted(jobs: Iterable[Job], on_submitted: Callable[[int], None], every: int = 100) -> Iterator[Job]:
    count = 0
    for count, job in enumerate(jobs, start=1):
        yield job
        if count % every == 0:
            on_submitted(count)
    on_submitted(count)
