"""A farm of real workers with the stand-in renderer, on a Redis, a store and logs of its own."""

import os
import signal
import subprocess
import time
from collections import Counter, defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from farm.dataset.completion import Completion
from farm.dataset.dataset import Dataset, create_dataset
from farm.dataset.destination import Destination
from farm.local.processes import stop
from farm.run.coordinator import Coordinator
from farm.run.handle import open_handle, open_new_run
from farm.run.progress import RunHandle
from farm.run.queue.broker import connect
from farm.run.registry.port import Priority, RunState, WorkerReport, WorkerState
from farm.run.registry.redis import RedisRegistry
from farm.run.worker_settings import WorkerSettings
from tests.stand_in import stand_in_header

PATIENCE_S = 120.0


def wait_for(condition: Callable[[], object]) -> None:
    """Wait until a condition holds, and fail the test if it doesn't."""
    give_up_s = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < give_up_s
        time.sleep(0.05)


def processes_with(text: str) -> dict[int, int]:
    """Living processes without zombies whose arguments hold a text: process id to the parent's."""
    found = {}
    for folder in Path("/proc").iterdir():
        # A process may end while its folder is being read.
        with suppress(OSError, ValueError):
            arguments = (folder / "cmdline").read_bytes()
            if text.encode() in arguments:
                found[int(folder.name)] = int((folder / "stat").read_text().rpartition(")")[2].split()[1])
    return found


class LiveFarm:
    """Workers, and the store and logs that they share.

    Args:
        folder: takes store and logs.
        redis_url: address of a Redis.
        command: starts a worker.
    """

    def __init__(self, folder: Path, redis_url: str, command: Sequence[str]) -> None:
        self.url = redis_url
        self.store = folder / "store"
        self.logs = folder / "logs"
        self.client = connect(redis_url)
        self._command = command
        self._journal = folder / "starts"
        self._workers: list[subprocess.Popen[bytes]] = []
        self.store.mkdir()
        self.logs.mkdir()

    def start(
        self,
        name: str,
        limits: Mapping[str, object] | None = None,
        *,
        command: Sequence[str] | None = None,
        **environment: str,
    ) -> "subprocess.Popen[bytes]":
        """Start a worker.

        Args:
            name: name of the worker.
            limits: settings of the worker that differ from the usual ones.
            command: command that starts it; None for the farm's usual one.
            environment: variables of its environment, beside those of this process.
        """
        usual = WorkerSettings(store=str(self.store), name=name, logs=self.logs, min_free_mib=0)
        process = subprocess.Popen(
            [*(command or self._command), *usual.model_copy(update=limits).serve_arguments()],
            env={**os.environ, "FARM_BROKER_URL": self.url, "STAND_IN_STARTS": str(self._journal), **environment},
            stdout=subprocess.DEVNULL,
            stderr=(self.logs / f"{name}.log").open("ab"),
            start_new_session=True,
        )
        self._workers.append(process)
        return process

    def end(self) -> None:
        """End all workers."""
        stop(self._workers, grace_s=5.0)
        self.client.close()

    def dataset(self, name: str, **quotas: int) -> Dataset:
        """A dataset in the store, with nothing made yet."""
        return create_dataset(Destination(str(self.store), name), stand_in_header(**quotas))

    def handle(self, dataset: Dataset, priority: Priority = Priority.NORMAL) -> RunHandle:
        """The handle of a dataset's run."""
        return open_handle(dataset, self.url, self.client, priority, settles=True)

    def workers(self, state: WorkerState) -> list[WorkerReport]:
        """The reports of the workers in a state."""
        return [report for report in RedisRegistry(self.client).workers() if report.state is state]

    def submit(self, dataset: Dataset, priority: Priority = Priority.NORMAL) -> RunHandle:
        """Register a dataset's run, and queue its missing jobs."""
        handle, _ = open_new_run(dataset, self.url, self.client, priority)
        Coordinator(dataset, handle).submit_missing()
        return handle

    def submit_without_look(self, dataset: Dataset) -> RunHandle:
        """Queue the jobs of a dataset whose folder can't be read."""
        handle, _ = open_new_run(dataset, self.url, self.client, Priority.NORMAL)
        handle.queue.submit(handle.run, [dataset.message(job, handle.run.place) for job in dataset.header.spec.jobs()])
        return handle

    @staticmethod
    def want(handle: RunHandle, state: RunState) -> None:
        """Set a person's wish for a run."""
        handle.registry.replace(handle.run.model_copy(update={"state": state}))

    def cancel(self, handle: RunHandle) -> None:
        """Cancel a run, and wait until no worker works for it."""
        self.want(handle, RunState.CANCELLED)
        handle.queue.clear(handle.run)
        wait_for(lambda: not handle.ledger.claims())

    def starts(self, since: int = 0) -> list[str]:
        """Every start of a job so far, in order, after skipping the first ones."""
        return [line.split()[0] for line in self._lines()[since:]]

    def by_renderer(self, since: int = 0) -> dict[str, list[str]]:
        """The starts, by the process that began them."""
        found: dict[str, list[str]] = defaultdict(list)
        for line in self._lines()[since:]:
            job_id, process = line.split()
            found[process].append(job_id)
        return found

    def _lines(self) -> list[str]:
        return self._journal.read_text().splitlines() if self._journal.exists() else []


def done(dataset: Dataset) -> int:
    """Number of finished images."""
    return len(Completion(dataset).audit())


def wait_until_done(dataset: Dataset, count: int | None = None) -> None:
    """Wait until a number of images are done, or all."""
    wanted = dataset.header.spec.total if count is None else count
    wait_for(lambda: done(dataset) >= wanted)


def is_once_each(starts: Sequence[str], dataset: Dataset) -> bool:
    """Whether the starts are those of all of a dataset's jobs, once each."""
    return Counter(starts) == Counter(job.id for job in dataset.header.spec.jobs())


@contextmanager
def live_farm(folder: Path, redis_url: str, command: Sequence[str]) -> Iterator[LiveFarm]:
    """A farm that ends with its test, and leaves no process."""
    farm = LiveFarm(folder, redis_url, command)
    try:
        yield farm
    finally:
        farm.end()
    for process in processes_with(str(farm.logs)):
        with suppress(ProcessLookupError):
            os.kill(process, signal.SIGKILL)
