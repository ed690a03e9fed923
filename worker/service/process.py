"""One worker: Celery's main process, and the children of its pool that make the pictures."""

import logging
import os
import signal
from contextlib import suppress
from pathlib import Path
from types import FrameType
from typing import Any

import billiard
from celery import signals

from farm.aside import patiently
from farm.errors import FarmError
from farm.local.tied import die_with_parent
from farm.run.queue.broker import connect
from farm.run.queue.celery import CeleryQueue
from farm.run.queue.settings import QUEUE, SOFT_LIMIT_S, make_app
from farm.run.queue.wire import install, keep_only_task
from farm.run.registry.port import RunState, WorkerState
from farm.run.worker_settings import HARD_LIMIT_S, WorkerSettings
from farm.storage import open_storage
from worker.service.backoff import Backoff
from worker.service.job_log import JobLogs
from worker.service.kept_renderer import KeptRenderer, OpenRenderer
from worker.service.process_log import prepare_log, send_output_to
from worker.service.redis_of_process import RedisOfProcess
from worker.service.runner import JobRunner
from worker.service.supervisor import Supervisor, is_stopping, kill_group
from worker.service.tasks import register_tasks
from worker.service.watchdog import Observation, watch

log = logging.getLogger(__name__)

_SILENCE_S = 10.0
"""Seconds between two lines that say that the store gives no answer at the worker's start."""

_LOG_FORMAT = "%(asctime)s %(levelname)s %(process)d %(message)s"


def serve(settings: WorkerSettings, broker_url: str, open_renderer: OpenRenderer) -> int:
    """Work until told to stop by a signal: after SIGTERM the running job is finished, a second one ends it at once.

    Args:
        settings: settings of the worker.
        broker_url: address of the Redis.
        open_renderer: function that opens the renderer of a dataset; called in the children alone.

    Returns:
        The exit code.

    Raises:
        BrokerError: if Redis is not there.
        DestinationError: if the store can't be read, or the log folder can't be made.
        FarmError: the fault that made this worker unfit, once it has given its job back.
    """
    logging.basicConfig(level=logging.INFO, format=_LOG_FORMAT)
    connect(broker_url).close()
    # It may be empty or not there yet, but must be readable.
    patiently(
        open_storage(settings.store).is_empty,
        lambda _: log.warning("%s: gives no answer; is its file server there? waiting for it", settings.store),
        every_s=_SILENCE_S,
    )
    log_file = prepare_log(settings.logs, f"{settings.name}.log")
    install()
    name = f"{settings.name}@{os.uname().nodename}"
    redis = RedisOfProcess(broker_url)
    supervisor = _supervisor(settings, name, redis)
    app = _application(settings, broker_url, supervisor, open_renderer)
    _prepare_children(log_file)
    # Celery keeps only weak references to receivers unless told otherwise.
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
    watch(_Observer(broker_url, supervisor, app).observe, _kill_children)
    worker.start()
    with suppress(FarmError):
        redis.registry().sign_off(name)
    if supervisor.fault is not None:
        raise supervisor.fault.as_fault()
    return int(worker.exitcode or 0)


def _supervisor(settings: WorkerSettings, name: str, redis: RedisOfProcess) -> Supervisor:
    return Supervisor(
        name,
        open_registry=redis.registry,
        open_ledger=redis.ledger,
        backoff=Backoff(settings.store, settings.min_free_mib * 2**20),
        logs=_job_logs(settings),
        memory_per_child_kib=settings.memory_per_child_kib,
    )


def _application(settings: WorkerSettings, broker_url: str, supervisor: Supervisor, open_renderer: OpenRenderer) -> Any:
    """The Celery application, with the settings' limits, the farm's one task, and the supervisor as a step."""
    app = make_app(broker_url)
    app.conf.update(
        worker_max_tasks_per_child=settings.tasks_per_child,
        worker_max_memory_per_child=settings.memory_per_child_kib,
        task_time_limit=settings.time_limit_s,
        task_soft_time_limit=settings.time_limit_s * SOFT_LIMIT_S / HARD_LIMIT_S,
    )
    renderer = KeptRenderer(open_renderer, settings.renderer)
    runner = JobRunner(settings.store, renderer, RedisOfProcess(broker_url).ledger, _job_logs(settings))
    register_tasks(app, runner, supervisor)
    keep_only_task(app)
    app.steps["consumer"].add(supervisor.step())
    return app


def _job_logs(settings: WorkerSettings) -> JobLogs:
    return JobLogs(settings.logs / "jobs")


def _prepare_children(log_file: Path) -> None:
    """Have every child lead a group, end with this process, and print into the worker's log."""
    main_process = os.getpid()

    def prepare_child(**_: Any) -> None:
        # The child leads a group of its own, so that it is killed with all processes that it has started.
        os.setpgid(0, 0)
        die_with_parent(main_process)
        send_output_to(log_file)

    signals.worker_process_init.connect(prepare_child, weak=False)


def _end_at_once_next_time(**_: Any) -> None:
    # Celery would finish the running job after the first signal and ignore the second. The second ends this worker.
    signal.signal(signal.SIGTERM, _end_at_once)
    signal.signal(signal.SIGINT, _end_at_once)


def _end_at_once(number: int, _frame: FrameType | None) -> None:
    _kill_children()
    os._exit(128 + number)


def _kill_children() -> None:
    for child in billiard.active_children():
        with suppress(ProcessLookupError, PermissionError):
            kill_group(child.pid)


class _Observer:
    """Observes this worker for the watchdog, over a connection of its own."""

    def __init__(self, broker_url: str, supervisor: Supervisor, app: Any) -> None:
        self._redis = RedisOfProcess(broker_url)
        self._supervisor = supervisor
        self._app = app

    def observe(self) -> Observation:
        """Look once.

        Raises:
            BrokerError: while Redis is away.
        """
        runs = [run for run in self._redis.registry().runs().values() if run.state is RunState.ACTIVE]
        queue = CeleryQueue(self._app, self._redis.client())
        report = self._supervisor.report()
        if is_stopping():
            # The loop that reports no longer runs.
            self._redis.registry().report(report)
        return Observation(
            ticked_s=self._supervisor.ticked_s,
            busy=bool(report.jobs),
            stopping=is_stopping(),
            jobs_wait=report.state is not WorkerState.HELD and any(queue.length(run) for run in runs),
        )
