"""One worker process: Celery's main process, and the child of its pool that makes the pictures."""

import logging
import os
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from celery import signals
from celery.worker import state

from farm.errors import DestinationError, UnfitWorkerError
from farm.ledger.port import Ledger
from farm.ledger.redis import RedisLedger
from farm.local.tied import die_with_parent
from farm.queue.broker import connect
from farm.queue.settings import QUEUE, make_app
from farm.storage import open_storage
from worker.runner import JobRunner, MakerFactory
from worker.tasks import register_tasks

_LOG_LIMIT_BYTES = 16 * 1024 * 1024
_LOG_FORMAT = "%(asctime)s %(levelname)s %(process)d %(message)s"


@dataclass(frozen=True, slots=True)
class WorkerSettings:
    """What a worker needs to know.

    Attributes:
        store: folder or URL below which the datasets lie.
        broker_url: the Redis.
        name: unique on this host; Flower shows it.
        log_folder: takes `<name>.log` with all that Blender writes.
        concurrency: children, each with a Blender of its own.
        tasks_per_child: a child is replaced after so many jobs.
        memory_per_child_kib: or when it has grown above this.
    """

    store: str
    broker_url: str
    name: str
    log_folder: Path
    concurrency: int
    tasks_per_child: int
    memory_per_child_kib: int


def serve(settings: WorkerSettings, open_maker: MakerFactory) -> int:
    """Work until told to stop by a signal: SIGTERM lets the running job end, a second one does not.

    Returns:
        The exit code.

    Raises:
        BrokerError: if Redis is not there.
        DestinationError: if the store can't be read, or the log folder not be made.
        FarmError: what made this worker unfit, once it has given its job back.
    """
    connect(settings.broker_url).close()
    open_storage(settings.store).is_empty()  # it may be empty or not there yet, but must be readable
    log_file = prepare_log(settings.log_folder, f"{settings.name}.log")
    logging.basicConfig(level=logging.INFO, format=_LOG_FORMAT)
    app = make_app(settings.broker_url)
    app.conf.update(
        worker_max_tasks_per_child=settings.tasks_per_child,
        worker_max_memory_per_child=settings.memory_per_child_kib,
    )
    faults: list[UnfitWorkerError] = []

    def take_out(fault: UnfitWorkerError) -> None:
        # Celery looks at this between two messages: none is taken after the one that is about to be given back.
        state.should_stop = fault.code
        faults.append(fault)

    register_tasks(app, JobRunner(settings.store, open_maker, _LedgersOfProcess(settings.broker_url)), take_out)

    main_process = os.getpid()

    def prepare_child(**_: Any) -> None:
        die_with_parent(main_process)
        send_output_to(log_file)

    # Celery keeps only weak references to receivers unless told otherwise.
    signals.worker_process_init.connect(prepare_child, weak=False)
    worker = app.Worker(
        hostname=f"{settings.name}@{os.uname().nodename}",
        pool="prefork",
        concurrency=settings.concurrency,
        queues=[QUEUE],
        loglevel="INFO",
        task_events=True,
        without_gossip=True,
        without_mingle=True,
    )
    worker.start()
    if faults:
        raise faults[0].as_fault()
    return int(worker.exitcode or 0)


class _LedgersOfProcess:
    """Opens ledgers over one connection pool, made in the process that first asks: sockets don't survive a fork."""

    def __init__(self, broker_url: str) -> None:
        self._broker_url = broker_url
        self._client: Any = None
        self._ledgers: dict[tuple[str, str], Ledger] = {}

    def __call__(self, dataset: str, spec_sha256: str) -> Ledger:
        if self._client is None:
            self._client = connect(self._broker_url)
        key = (dataset, spec_sha256)
        if key not in self._ledgers:
            self._ledgers[key] = RedisLedger(self._client, dataset, spec_sha256)
        return self._ledgers[key]


def prepare_log(folder: Path, name: str) -> Path:
    """Make a folder for logs.

    Returns:
        The log file in it, which can be written.

    Raises:
        DestinationError: if it can't be.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        (folder / name).open("ab").close()
    except OSError as error:
        raise DestinationError(
            f"{folder}: can't write logs: {error.strerror}; name another folder by --logs"
        ) from error
    return folder / name


def send_output_to(log_file: Path) -> None:
    """Send all that this process prints, Blender's C code included, to the end of a file; a large one starts anew."""
    sys.stdout.flush()
    sys.stderr.flush()
    too_large = log_file.exists() and log_file.stat().st_size > _LOG_LIMIT_BYTES
    flags = os.O_WRONLY | os.O_CREAT | os.O_APPEND | (os.O_TRUNC if too_large else 0)
    descriptor = os.open(log_file, flags, 0o644)
    os.dup2(descriptor, 1)
    os.dup2(descriptor, 2)
    os.close(descriptor)
