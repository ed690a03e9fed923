"""A run on this machine alone, from a dataset's header to its finished folder."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from farm.dataset.dataset import create_dataset
from farm.dataset.destination import Destination
from farm.local.redis_server import PrivateRedis
from farm.local.workers import WORKER_COMMAND, LocalWorkers
from farm.machine import memory_bytes, usable_cores
from farm.run.coordinator import Coordinator
from farm.run.feeder import LOST_AFTER_S
from farm.run.handle import open_handle
from farm.run.progress import Progress
from farm.run.queue.broker import connect
from farm.run.worker_settings import MIN_FREE_MIB, RendererSettings, WorkerSettings
from farm.spec.header import DatasetHeader

_WORKER_BYTES = 2 * 2**30
"""Memory that one worker needs, for Blender, the solver and textures."""


@dataclass(frozen=True, slots=True)
class LocalRun:
    """Settings of a run on this machine.

    Attributes:
        workers: number of workers, each with a Blender.
        renderer: settings of each worker's renderer.
        logs: folder for the workers' logs.
        worker_command: command that runs the worker's program.
        min_free_mib: free space of the dataset's disk, in MiB, below which no picture is made.
        lost_after_s: see `farm.run.feeder.LOST_AFTER_S`.
        mixes: whether a dataset that another release began gets pictures of this one.
    """

    workers: int
    renderer: RendererSettings
    logs: Path
    worker_command: Sequence[str] = WORKER_COMMAND
    min_free_mib: int = MIN_FREE_MIB
    lost_after_s: float = LOST_AFTER_S
    mixes: bool = False


def default_workers() -> int:
    """Compute the number of workers: one for each core, as memory allows.

    Workers of one thread each make more pictures an hour than one worker of many threads.
    """
    return max(1, min(usable_cores(), memory_bytes() // _WORKER_BYTES))


def run_locally(
    destination: Destination,
    header: DatasetHeader,
    how: LocalRun,
    on_progress: Callable[[Progress], None] = lambda _: None,
) -> Progress:
    """Make the dataset here; every process that was started is gone when this returns or raises.

    Args:
        destination: place of the dataset.
        header: the dataset to make.
        how: settings of the run on this machine.
        on_progress: called now and then with the progress.

    Raises:
        ConflictError: if the place holds something else.
        DestinationError: if it can't be written.
        MachineError: if this machine lacks what is needed.
        FarmError: another fault of this machine, which its workers found.
        IncompleteError: if images were given up.
    """
    with PrivateRedis() as server:
        url = server.url
        dataset = create_dataset(destination, header)
        handle = open_handle(dataset, url, connect(url), mixes=how.mixes)
        coordinator = Coordinator(dataset, handle, lost_after_s=how.lost_after_s, poll_s=0.5)
        if coordinator.submit_missing() == 0 and (complete := coordinator.end_if_complete(on_progress)):
            return complete
        settings = WorkerSettings(
            store=destination.store, name="local", logs=how.logs, renderer=how.renderer, min_free_mib=how.min_free_mib
        )
        with LocalWorkers(how.workers, settings, url, how.worker_command) as workers:

            def supervise() -> None:
                server.supervise()
                workers.supervise()

            return coordinator.watch(on_progress, supervise=supervise)
