"""The progress of a dataset: what `farm status` shows and `farm status --json` prints."""

from collections.abc import Mapping
from dataclasses import dataclass

from farm.dataset.dataset import Dataset
from farm.model import Model
from farm.run.ledger.owner import live_claims
from farm.run.ledger.port import RETRY_OWNER, Ledger
from farm.run.queue.port import JobQueue
from farm.run.registry.port import Run, RunRegistry, RunState, WorkerReport
from farm.spec.category import Category
from farm.spec.job import Job
from farm.spec.job_set import JobSet


class CategoryProgress(Model):
    """Numbers of images of one category: done, and asked for."""

    done: int
    quota: int


class Progress(Model):
    """The progress of a dataset. The fields from `state` to `last_picture` are None if Redis was not asked.

    Attributes:
        location: folder or URL of the dataset.
        spec_sha256: fingerprint of the dataset's description.
        categories: images done and asked for, by category.
        quarantined: reason for each job that is given up, by its id.
        state: state of the run that a person asked for; None also if nothing was submitted.
        waiting: number of messages in the run's queue.
        running: ids of the jobs that workers hold now.
        workers: reports of all workers of the farm, including those that work for other runs.
        images_per_hour: images that the farm makes an hour; None also while too few are made to tell.
        seconds_left: time until all images are done at this rate, in seconds.
        last_picture: path of the newest picture below the folder.
        trouble: reason why the look is incomplete, such as a Redis that can't be reached; None if it is complete.
    """

    location: str
    spec_sha256: str
    categories: Mapping[Category, CategoryProgress]
    quarantined: Mapping[str, str]
    state: RunState | None = None
    waiting: int | None = None
    running: tuple[str, ...] | None = None
    workers: tuple[WorkerReport, ...] | None = None
    images_per_hour: float | None = None
    seconds_left: float | None = None
    last_picture: str | None = None
    trouble: str | None = None

    @property
    def done(self) -> int:
        """Number of images done in all categories."""
        return sum(category.done for category in self.categories.values())

    @property
    def quota(self) -> int:
        """Number of images asked for in all categories."""
        return sum(category.quota for category in self.categories.values())

    @property
    def ended(self) -> bool:
        """Whether every image is done or given up."""
        return self.done + len(self.quarantined) >= self.quota


@dataclass(frozen=True, slots=True)
class RunHandle:
    """Access to a dataset's run in Redis.

    Attributes:
        run: the run, as it was last seen in the registry or as it would be submitted.
        ledger: the run's ledger: claims, attempts, counts and timings.
        queue: the queues of all runs.
        registry: the farm's runs and workers.
    """

    run: Run
    ledger: Ledger
    queue: JobQueue
    registry: RunRegistry


def on_disk(dataset: Dataset, done: JobSet, quarantined: Mapping[str, str]) -> Progress:
    """Put together the progress that the folder alone tells.

    Args:
        dataset: the dataset.
        done: the jobs that are done.
        quarantined: reason for each job that is given up, by its id; jobs that are done after all are left out.

    Returns:
        The progress, without what Redis tells.
    """
    counts = done.counts()
    return Progress(
        location=dataset.storage.location,
        spec_sha256=dataset.identity,
        categories={
            category: CategoryProgress(done=counts[category], quota=quota)
            for category, quota in dataset.header.spec.quotas.items()
        },
        quarantined={job_id: reason for job_id, reason in quarantined.items() if Job.from_id(job_id) not in done},
    )


def with_handle(progress: Progress, handle: RunHandle) -> Progress:
    """Add to a dataset's progress what Redis tells.

    Args:
        progress: progress that the folder tells.
        handle: ledger, queue and registry of the dataset's run.

    Returns:
        A copy with the rate, the waiting and running jobs, and the workers.

    Raises:
        BrokerError: if Redis can't be read.
    """
    activity = handle.ledger.activity()
    left = progress.quota - progress.done - len(progress.quarantined)
    rate = activity.images_per_hour
    claims = live_claims(handle.ledger)
    run = handle.registry.runs().get(handle.run.key)
    return progress.model_copy(
        update={
            "state": None if run is None else run.state,
            "waiting": handle.queue.length(handle.run),
            "running": tuple(sorted(job_id for job_id, owner in claims.items() if owner != RETRY_OWNER)),
            "workers": handle.registry.workers(),
            "images_per_hour": rate,
            "seconds_left": left / rate * 3600.0 if rate and left else None,
            "last_picture": activity.last_picture,
        }
    )
