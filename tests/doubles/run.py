"""A run with queue, ledger, registry and worker in memory."""

from pathlib import Path

from farm.dataset.dataset import Dataset
from farm.errors import PermanentError
from farm.run.coordinator import Coordinator
from farm.run.feeder import WINDOW
from farm.run.handle import run_of
from farm.run.progress import Progress, RunHandle
from farm.run.registry.port import RunState
from farm.run.worker_settings import RendererSettings
from tests.doubles.ledger import MemoryLedger
from tests.doubles.queue import MemoryQueue
from tests.doubles.registry import MemoryRegistry
from tests.stand_in import StandInRenderer
from worker.service.kept_renderer import KeptRenderer
from worker.service.runner import JobRunner


class Bench:
    """A coordinator with its surroundings, and a worker that works when asked to.

    Args:
        dataset: the dataset.
        store: folder in which the worker looks for the dataset; by default the one that holds it.
        ledger: ledger of the run; by default a plain one.
        queue: queue of the run; by default a plain one.
        window: largest number of the dataset's jobs in the queue, as `farm.run.feeder.WINDOW`.
        lost_after_s: seconds after which a missing job counts as lost, as `farm.run.feeder.LOST_AFTER_S`; by default
            it does at once.
    """

    def __init__(
        self,
        dataset: Dataset,
        store: str | None = None,
        *,
        ledger: MemoryLedger | None = None,
        queue: MemoryQueue | None = None,
        window: int = WINDOW,
        lost_after_s: float = 0.0,
    ) -> None:
        self.dataset = dataset
        self.ledger = ledger or MemoryLedger()
        self.queue = queue or MemoryQueue()
        self.registry = MemoryRegistry()
        self.handle = RunHandle(run=run_of(dataset), ledger=self.ledger, queue=self.queue, registry=self.registry)
        store = store or str(Path(dataset.storage.location).parent)
        renderer = KeptRenderer(lambda *_: StandInRenderer(), RendererSettings())
        self.runner = JobRunner(store, renderer, lambda *_: self.ledger)
        self.coordinator = Coordinator(dataset, self.handle, poll_s=0.0, lost_after_s=lost_after_s, window=window)
        self.runs: list[str] = []

    def work(self, count: int = 1) -> None:
        """Take some messages and make their jobs."""
        for _ in range(min(count, len(self.queue.messages))):
            try:
                self.runs.append(self.runner.run(self.queue.messages.popleft().encode()).said)
            except PermanentError:
                continue

    @property
    def rendered(self) -> int:
        """Pictures that the worker has made."""
        return sum(" done in " in line for line in self.runs)

    def finish(self) -> Progress:
        """Watch to the end; the worker takes one message at each look."""
        return self.coordinator.watch(supervise=self.work)

    def want(self, state: RunState) -> None:
        """Set a person's wish for the run."""
        self.registry.replace(self.handle.run.model_copy(update={"state": state}))

    def queued(self) -> list[str]:
        """The waiting jobs."""
        return sorted(job.id for job in self.queue.queued(self.handle.run))

    def empty_redis(self) -> None:
        """Forget everything that isn't in the folder."""
        self.queue.messages.clear()
        vars(self.ledger).update(vars(MemoryLedger()))
        vars(self.registry).update(vars(MemoryRegistry()))
