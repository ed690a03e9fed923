"""A run with queue, ledger, board and worker in memory."""

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
    """A coordinator with its surroundings, and a worker that works when told to.

    Args:
        dataset: the dataset.
        store: where the worker looks for it; by default where it is.
        ledger: in place of a plain one.
        queue: likewise.
        window: see `farm.run.feeder.WINDOW`.
        lost_after_s: see `farm.run.feeder.LOST_AFTER_S`; by default what is lost is missed at once.
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
        """Take some messages and do what they ask."""
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
        """Watch to the end, with the worker taking one message at each look."""
        return self.coordinator.watch(supervise=self.work)

    def want(self, state: RunState) -> None:
        """Say what a person wants of the run."""
        self.registry.replace(self.handle.run.model_copy(update={"state": state}))

    def queued(self) -> list[str]:
        """The jobs that wait."""
        return sorted(job.id for job in self.queue.queued(self.handle.run))

    def empty_redis(self) -> None:
        """Forget all that is not in the folder."""
        self.queue.messages.clear()
        vars(self.ledger).update(vars(MemoryLedger()))
        vars(self.registry).update(vars(MemoryRegistry()))
