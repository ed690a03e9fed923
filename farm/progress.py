"""How far a dataset is: what `farm status` shows and `--json` prints."""

from collections import Counter
from collections.abc import Mapping

from farm.category import Category
from farm.completion import Completion
from farm.dataset import Dataset
from farm.job import Job
from farm.ledger.owner import live_claims
from farm.ledger.port import RETRY_OWNER, Ledger
from farm.model import Model


class CategoryProgress(Model):
    """Images of one category, done and asked for."""

    done: int
    quota: int


class Progress(Model):
    """How far a dataset is.

    Attributes:
        location: the dataset's folder.
        running: jobs that workers hold now; None without Redis, as the next ones.
        failures: jobs that failed for good, with the reason.
        images_per_hour: None while too little is known.
        seconds_left: at this rate.
        last_picture: the newest picture's path below the folder.
    """

    location: str
    spec_sha256: str
    categories: Mapping[Category, CategoryProgress]
    running: tuple[str, ...] | None = None
    failures: Mapping[str, str] | None = None
    images_per_hour: float | None = None
    seconds_left: float | None = None
    last_picture: str | None = None

    @property
    def done(self) -> int:
        """Images done, of all categories."""
        return sum(category.done for category in self.categories.values())

    @property
    def quota(self) -> int:
        """Images asked for, of all categories."""
        return sum(category.quota for category in self.categories.values())


def measure(dataset: Dataset, completion: Completion, ledger: Ledger | None) -> Progress:
    """Look at the folder, and at the ledger if there is one.

    Raises:
        DestinationError: if the folder can't be read.
        BrokerError: if the ledger can't be read.
    """
    done = completion.refresh()
    counts = Counter(Job.from_id(job_id).category for job_id in done)
    quotas = dataset.header.spec.quotas
    progress = Progress(
        location=dataset.storage.location,
        spec_sha256=dataset.header.spec_sha256,
        categories={
            category: CategoryProgress(done=counts[category], quota=quota) for category, quota in quotas.items()
        },
    )
    if ledger is None:
        return progress
    activity = ledger.activity()
    left = progress.quota - progress.done
    rate = activity.images_per_hour
    return progress.model_copy(
        update={
            "running": tuple(sorted(job_id for job_id, owner in live_claims(ledger).items() if owner != RETRY_OWNER)),
            "failures": {job_id: why for job_id, why in sorted(ledger.failures().items()) if job_id not in done},
            "images_per_hour": rate,
            "seconds_left": left / rate * 3600.0 if rate and left else None,
            "last_picture": activity.last_picture,
        }
    )
