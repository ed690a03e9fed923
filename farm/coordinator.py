"""Sees to it that a dataset gets done: submits what is missing, and again what got lost on the way."""

import time
from collections.abc import Callable, Iterable, Iterator

from farm.completion import Completion
from farm.dataset import Dataset
from farm.errors import IncompleteError
from farm.job import Job
from farm.ledger.owner import live_claims
from farm.ledger.port import Ledger
from farm.progress import Progress, measure
from farm.queue.port import JobQueue

LOST_AFTER_S = 10.0
"""A job that is neither done, failed, claimed nor queued for so long is lost. A message is in nobody's hands for an
instant when a worker has taken it and not yet claimed its job; a duplicate would do no harm, but cost a look."""

_SHORT_QUEUE = 2000
"""Above this length the queue is not searched for lost jobs: it takes a while, and there is work enough."""

_REST = 20
"""Pause between two looks, in the time that one took: at a full dataset they must not take a core from the workers."""

_REASONS_SHOWN = 20


class Coordinator:
    """Sees one dataset through.

    Args:
        dataset: with its header in place.
        ledger: of this dataset.
        queue: to its workers.
        poll_s: pause between two looks, in seconds; longer where a look takes long.
        lost_after_s: see `LOST_AFTER_S`.
    """

    def __init__(
        self,
        dataset: Dataset,
        ledger: Ledger,
        queue: JobQueue,
        *,
        poll_s: float = 1.0,
        lost_after_s: float = LOST_AFTER_S,
    ) -> None:
        self._dataset = dataset
        self._ledger = ledger
        self._queue = queue
        self._poll_s = poll_s
        self._lost_after_s = lost_after_s
        self._completion = Completion(dataset)

    def submit_missing(self, on_submitted: Callable[[int], None] = lambda _: None) -> int:
        """Queue every job that is neither done nor on its way; jobs that failed before get a fresh start.

        Args:
            on_submitted: told the number so far, now and then.

        Returns:
            How many jobs were queued.

        Raises:
            BrokerError: if Redis goes away.
            DestinationError: if the folder can't be read.
        """
        done = self._completion.refresh()
        self._completion.remove_leftovers(time.time())
        self._ledger.forget_failures()
        on_the_way = self._queued() | live_claims(self._ledger).keys()
        jobs = (job for job in self._dataset.header.spec.jobs() if job.id not in done and job.id not in on_the_way)
        return self._submit(_counted(jobs, on_submitted))

    def _queued(self) -> set[str]:
        return self._queue.queued(self._dataset.name, self._dataset.header.spec_sha256)

    def _submit(self, jobs: Iterable[Job]) -> int:
        return self._queue.submit(self._dataset.message(job) for job in jobs)

    def watch(
        self,
        on_progress: Callable[[Progress], None] = lambda _: None,
        *,
        mend: bool = True,
        supervise: Callable[[], None] = lambda: None,
    ) -> Progress:
        """Wait until every job is done or has failed for good.

        Args:
            on_progress: told after every look.
            mend: submit lost jobs again.
            supervise: called at every look; may restart workers.

        Returns:
            The last look.

        Raises:
            IncompleteError: if jobs failed for good; it lists their reasons.
            BrokerError: if Redis goes away.
            DestinationError: if the folder can't be read.
        """
        suspected: frozenset[str] = frozenset()
        suspected_since_s = time.monotonic()
        while True:
            supervise()
            start_s = time.monotonic()
            progress = measure(self._dataset, self._completion, self._ledger)
            on_progress(progress)
            failures = progress.failures or {}
            if progress.done + len(failures) >= progress.quota:
                self._completion.remove_leftovers(time.time())
                if failures:
                    raise IncompleteError(_reasons(progress))
                return progress
            lost = self._lost(progress) if mend else frozenset()
            suspected = suspected & lost
            if not suspected:
                suspected, suspected_since_s = lost, start_s
            elif start_s - suspected_since_s >= self._lost_after_s:
                self._submit(Job.from_id(job_id) for job_id in sorted(suspected))
                suspected = frozenset()
            time.sleep(max(self._poll_s, _REST * (time.monotonic() - start_s)))

    def _lost(self, progress: Progress) -> frozenset[str]:
        if self._queue.length() > _SHORT_QUEUE:
            return frozenset()
        # The queue is looked at before the claims: a job moves from there to here, never back.
        accounted = self._queued()
        accounted |= live_claims(self._ledger).keys()
        accounted |= (progress.failures or {}).keys() | self._completion.refresh()
        return frozenset(job.id for job in self._dataset.header.spec.jobs() if job.id not in accounted)


def _counted(jobs: Iterable[Job], on_submitted: Callable[[int], None], every: int = 100) -> Iterator[Job]:
    count = 0
    for count, job in enumerate(jobs, start=1):
        yield job
        if count % every == 0:
            on_submitted(count)
    on_submitted(count)


def _reasons(progress: Progress) -> str:
    failures = progress.failures or {}
    lines = [f"{progress.location}: {len(failures)} of {progress.quota} images failed; submit again to retry them"]
    lines += [f"  {job_id}: {reason}" for job_id, reason in list(failures.items())[:_REASONS_SHOWN]]
    if len(failures) > _REASONS_SHOWN:
        lines.append(f"  and {len(failures) - _REASONS_SHOWN} more; see farm status")
    return "\n".join(lines)
