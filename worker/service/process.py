"""One worker process: Celery's main process, and the child of its pool that makes the pictures."""

import logging
import os
import signal
import sys
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from types import FrameType
from typing import Any

import billiard
from celery import signals

from farm.errors import DestinationError, FarmError
from farm.local.tied import die_with_parent
from farm.run.ledger.port import Ledger
from farm.run.ledger.redis import RedisLedger
from farm.run.queue.broker import connect
from farm.run.queue.celery import CeleryQueue
from farm.run.queue.settings import HARD_LIMIT_S, QUEUE, SOFT_LIMIT_S, make_app
from farm.run.queue.wire import install, keep_only_task
from farm.run.registry.port import RunRegistry, RunState, WorkerState
from farm.run.registry.redis import RedisRegistry
from farm.storage import open_storage
from worker.service.backoff import Backoff
from worker.service.job_log import JobLogs
from worker.service.runner import JobRunner, OpenRenderer
from worker.service.supervisor import Supervisor, is_stopping, kill_group
from worker.service.tasks import register_tasks
from worker.service.watchdog import Signs, watch

_LOG_LIMIT_BYTES = 16 * 1024 * 1024
_LOG_FORMAT = "%(asctime)s %(levelname)s %(process)d %(message)s"


@dataclass(frozen=True, slots=True)
class WorkerSettings:
    """What a worker needs to know.

    Attributes:
        store: folder or URL below which the datasets lie.
        broker_url: the Redis.
        name: unique on this host; Flower shows it.
        log_folder: takes `<name>.log`, and below `jobs` what Blender prints, a file a job.
        concurrency: children, each with a Blender of its own.
        tasks_per_child: a child is replaced after so many jobs.
        memory_per_child_kib: or when it has grown above this; at twice as much it is killed.
        time_limit_s: of a job; then its process is killed. A job that can be told to stop is, a sixth earlier.
        min_free_bytes: no job is taken while the store's disk has less room.
    """

    store: str
    broker_url: str
    name: str
    log_folder: Path
    concurrency: int
    tasks_per_child: int
    memory_per_child_kib: int
    time_limit_s: float
    min_free_bytes: int


def serve(settings: WorkerSettings, open_renderer: OpenRenderer) -> int:
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
    install()
    app = make_app(settings.broker_url)
    app.conf.update(
        worker_max_tasks_per_child=settings.tasks_per_child,
        worker_max_memory_per_child=settings.memory_per_child_kib,
        task_time_limit=settings.time_limit_s,
        task_soft_time_limit=settings.time_limit_s * SOFT_LIMIT_S / HARD_LIMIT_S,
    )
    name = f"{settings.name}@{os.uname().nodename}"
    job_logs = settings.log_folder / "jobs"
    shared = _RedisOfProcess(settings.broker_url)
    supervisor = Supervisor(
        name,
        open_registry=shared.registry,
        open_ledger=shared.ledger,
        backoff=Backoff(settings.store, settings.min_free_bytes),
        logs=JobLogs(job_logs),
        memory_per_child_kib=settings.memory_per_child_kib,
    )
    runner = JobRunner(settings.store, open_renderer, _RedisOfProcess(settings.broker_url).ledger, job_logs)
    register_tasks(app, runner, supervisor)
    keep_only_task(app)
    app.steps["consumer"].add(supervisor.step())

    main_process = os.getpid()

    def prepare_child(**_: Any) -> None:
        # A group of its own, so that it is killed with whatever it has started.
        os.setpgid(0, 0)
        die_with_parent(main_process)
        send_output_to(log_file)

    # Celery keeps only weak references to receivers unless told otherwise.
    signals.worker_process_init.connect(prepare_child, weak=False)
    signals.worker_shutting_down.connect(_end_at_once_next_time, weak=False)
    worker = app.Worker(
        hostname=name,
        pool="prefork",
        concurrency=settings.concurrency,
        queues=[QUEUE],
        loglevel="INFO",
        task_events=True,
        without_gossip=True,
        without_mingle=True,
    )
    watch(_Eyes(settings.broker_url, supervisor, app).see, _kill_children)
    worker.start()
    with suppress(FarmError):
        shared.registry().sign_off(name)
    if supervisor.fault is not None:
        raise supervisor.fault.as_fault()
    return int(worker.exitcode or 0)


def _end_at_once_next_time(**_: Any) -> None:
    # Told to stop, Celery finishes what runs and ignores a second signal; people who send one mean it.
    signal.signal(signal.SIGTERM, _end_at_once)
    signal.signal(signal.SIGINT, _end_at_once)


def _end_at_once(number: int, _frame: FrameType | None) -> None:
    _kill_children()
    os._exit(128 + number)


def _kill_children() -> None:
    for child in billiard.active_children():
        with suppress(ProcessLookupError, PermissionError):
            kill_group(child.pid)


class _Eyes:
    """What the watchdog sees, over a connection of its own."""

    def __init__(self, broker_url: str, supervisor: Supervisor, app: Any) -> None:
        self._shared = _RedisOfProcess(broker_url)
        self._supervisor = supervisor
        self._app = app

    def see(self) -> Signs:
        """Look; raises BrokerError while Redis is away."""
        runs = [run for run in self._shared.registry().runs().values() if run.state is RunState.ACTIVE]
        queue = CeleryQueue(self._app, self._shared.client())
        report = self._supervisor.report()
        if is_stopping():
            # The loop that reports no longer runs.
            self._shared.registry().report(report)
        return Signs(
            ticked_s=self._supervisor.ticked_s,
            busy=bool(report.jobs),
            stopping=is_stopping(),
            jobs_wait=report.state is not WorkerState.HELD and any(queue.length(run) for run in runs),
        )


class _RedisOfProcess:
    """Opens what lies in Redis over one connection pool, made by whoever first asks: sockets don't survive a fork."""

    def __init__(self, broker_url: str) -> None:
        self._broker_url = broker_url
        self._client: Any = None
        self._process = 0
        self._ledgers: dict[tuple[str, str], Ledger] = {}

    def client(self) -> Any:
        """The connection pool."""
        if self._client is None or self._process != os.getpid():
            self._client, self._process, self._ledgers = connect(self._broker_url), os.getpid(), {}
        return self._client

    def registry(self) -> RunRegistry:
        """The farm's board."""
        return RedisRegistry(self.client())

    def ledger(self, dataset: str, spec_sha256: str) -> Ledger:
        """A dataset's ledger."""
        client = self.client()
        key = (dataset, spec_sha256)
        if key not in self._ledgers:
            self._ledgers[key] = RedisLedger(client, dataset, spec_sha256)
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
