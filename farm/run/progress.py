"""How far a dataset is: what `farm status` shows and `--json` prints."""

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
    """Images of one category, done and asked for."""

    done: int
    quota: int


class Progress(Model):
    """How far a dataset is.

    Attributes:
        location: the dataset's folder.
        quarantined: jobs that are given up, with the reason.
        state: what a person wants of the run; None without Redis, as the next ones, or where nothing was submitted.
        waiting: messages in the run's queue.
        running: jobs that workers hold now.
        workers: what the farm's workers report, those that work for other runs too.
        images_per_hour: None while too little is known.
        seconds_left: at this rate.
        last_picture: the newest picture's path below the folder.
        trouble: what keeps the look from being whole, such as a Redis that is away; None if nothing does.
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
        """Images done, of all categories."""
        return sum(category.done for category in self.categories.values())

    @property
    def quota(self) -> int:
        """Images asked for, of all categories."""
        return sum(category.quota for category in self.categories.values())

    @property
    def ended(self) -> bool:
        """Whether every image is done or given up."""
        return self.done + len(self.quarantined) >= self.quota


@dataclass(frozen=True, slots=True)
class RunHandle:
    """What Redis tells of a dataset's run."""

    run: Run
    ledger: Ledger
    queue: JobQueue
    registry: RunRegistry


def on_disk(dataset: Dataset, done: JobSet, quarantined: Mapping[str, str]) -> Progress:
    """What the folder alone tells.

    Args:
        dataset: the dataset.
        done: its done jobs.
        quarantined: the jobs that are given up; of those that are done after all nothing is told.
    """
    counts = done.counts()
    return Progress(
        location=dataset.storage.location,
        spec_sha256=dataset.header.spec_sha256,
        categories={
            category: CategoryProgress(done=counts[category], quota=quota)
            for category, quota in dataset.header.spec.quotas.items()
        },
        quarantined={job_id: reason for job_id, reason in quarantined.items() if Job.from_id(job_id) not in done},
    )


def with_handle(progress: Progress, handle: RunHandle) -> Progress:
    """The same with what Redis tells.

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
