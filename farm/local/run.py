"""`farm run`: the whole path on this machine, from a header to a finished dataset."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from farm.dataset.dataset import Destination, create_dataset
from farm.local.redis_server import PrivateRedis
from farm.local.workers import WORKER_COMMAND, LocalWorkers, WorkerOptions
from farm.machine import memory_bytes, usable_cores
from farm.run.coordinator import Coordinator
from farm.run.feeder import LOST_AFTER_S
from farm.run.handle import open_handle
from farm.run.progress import Progress
from farm.run.queue.broker import connect
from farm.run.queue.settings import MIN_FREE_MIB
from farm.spec.header import DatasetHeader

_WORKER_BYTES = 2 * 2**30
"""Left free for each worker: Blender, the solver, textures."""


@dataclass(frozen=True, slots=True)
class LocalRun:
    """How the machine is used.

    Attributes:
        workers: processes, each with a Blender.
        device: where Cycles renders.
        threads: of each worker's renderer.
        assets: folder of baked surfaces; None for the default one.
        logs: folder for the workers' logs.
        worker_command: the program that is a worker.
        min_free_mib: no picture is made while the dataset's disk has less room.
        lost_after_s: see `farm.run.feeder.LOST_AFTER_S`.
    """

    workers: int
    device: str
    threads: int
    assets: Path | None
    logs: Path
    worker_command: Sequence[str] = WORKER_COMMAND
    min_free_mib: int = MIN_FREE_MIB
    lost_after_s: float = LOST_AFTER_S


def default_workers() -> int:
    """A worker for each core, as far as memory goes: one thread each makes more pictures an hour than one of many."""
    return max(1, min(usable_cores(), memory_bytes() // _WORKER_BYTES))


def run_locally(
    destination: Destination,
    header: DatasetHeader,
    how: LocalRun,
    on_progress: Callable[[Progress], None] = lambda _: None,
) -> Progress:
    """Make the dataset here; everything started is gone when this returns or raises.

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
        handle = open_handle(dataset, url, connect(url))
        coordinator = Coordinator(dataset, handle, lost_after_s=how.lost_after_s, poll_s=0.5)
        if coordinator.submit_missing() == 0 and (complete := coordinator.end_if_complete(on_progress)):
            return complete
        options = WorkerOptions(
            store=destination.store,
            broker_url=url,
            device=how.device,
            threads=how.threads,
            assets=how.assets,
            logs=how.logs,
            min_free_mib=how.min_free_mib,
        )
        with LocalWorkers(how.workers, options, how.worker_command) as workers:

            def supervise() -> None:
                server.supervise()
                workers.supervise()

            return coordinator.watch(on_progress, supervise=supervise)
