"""The supervisor in a worker's main process: it chooses queues, holds back, reports, and bounds memory and logs.

It runs once a second in Celery's event loop, as a step of its consumer, so it may change which queues are consumed.
"""

import logging
import os
import signal
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

from celery import bootsteps
from celery.worker import state
from kombu.entity import Queue

from farm.aside import Aside
from farm.errors import BrokerError, DestinationError, MessageError, RenderError, UnfitWorkerError
from farm.run.ledger.owner import process_of_this_machine
from farm.run.ledger.port import LedgerFactory
from farm.run.queue.settings import QUEUE, queue_name
from farm.run.registry.port import RunRegistry, RunState, WorkerReport, WorkerState
from farm.spec.job import JobMessage
from worker.service.backoff import Backoff
from worker.service.failures import FAILED_IN_A_ROW
from worker.service.job_log import JobLogs

log = logging.getLogger(__name__)

TICK_S = 1.0
"""Seconds between two looks at the registry, the store and the children."""

_KILL_RATIO = 2
"""Memory above which a child is killed during a job, as a multiple of that above which it is replaced after a job."""


class Supervisor:
    """Supervises one worker from its main process.

    Args:
        name: name of the worker, as `NAME@HOST`.
        open_registry: function that opens the registry of runs and workers; called in the main process, at first use.
        open_ledger: function that opens a dataset's ledger; called in the main process, at first use.
        backoff: source of the reason why no job may be taken.
        logs: logs of the jobs that run here.
        memory_per_child_kib: memory above which a child is replaced after its job; see
            `farm.run.worker_settings.WorkerSettings`.

    Attributes:
        ticked_s: time of the last look, by the monotonic clock.
        fault: the fault that made this worker unfit; None while there is none.
    """

    def __init__(
        self,
        name: str,
        open_registry: Callable[[], RunRegistry],
        open_ledger: LedgerFactory,
        backoff: Backoff,
        logs: JobLogs,
        memory_per_child_kib: int,
    ) -> None:
        self._name = name
        self._open_registry = open_registry
        self._open_ledger = open_ledger
        self._backoff = backoff
        self._logs = logs
        # Logs may lie on a file server, too.
        self._bounding = Aside(self._bound_logs)
        self._most_bytes = _KILL_RATIO * memory_per_child_kib * 1024
        self._consumer: Any = None
        self._joined: set[str] = set()
        self._crashed: list[str] = []
        self._done = 0
        self._held_reason = ""
        self.ticked_s = time.monotonic()
        self.fault: UnfitWorkerError | None = None

    def step(self) -> type[Any]:
        """The step for Celery's consumer; it starts again with each connection."""
        supervisor = self

        class SupervisorStep(bootsteps.StartStopStep):  # type: ignore[misc]  # celery is untyped
            """Calls the supervisor while the consumer is connected."""

            requires = ("celery.worker.consumer.tasks:Tasks",)

            def start(self, consumer: Any) -> None:
                """Supervise the consumer that has just connected."""
                supervisor.attach(consumer)

        return SupervisorStep

    def attach(self, consumer: Any) -> None:
        """Supervise a consumer that has just connected; Celery ends its timers with the connection."""
        self._consumer = consumer
        # Celery consumes the queues again that it consumed before the connection was lost.
        self._joined = set(consumer.app.amqp.queues.consume_from) - {QUEUE}
        self.tick()
        consumer.timer.call_repeatedly(TICK_S, self.tick)

    def tick(self) -> None:
        """Look at the registry, the store and the children, and act."""
        self.ticked_s = time.monotonic()
        self._held_reason = self._backoff.reason()
        try:
            runs = {} if self._held_reason or self.fault else self._open_registry().runs()
            self._join({queue_name(key) for key, run in runs.items() if run.state is RunState.ACTIVE})
            self._open_registry().report(self.report())
        except BrokerError as error:
            # Celery notices the lost connection as well, and connects again.
            log.warning("%s", error)
        self._keep_memory()
        self._bounding.begin()

    def _join(self, wanted: set[str]) -> None:
        for name in sorted(self._joined - wanted):
            self._consumer.cancel_task_queue(name)
        for name in sorted(wanted - self._joined):
            # Added first, so that Celery makes no exchange for it.
            self._consumer.app.amqp.queues.add(Queue(name))  # type: ignore[no-untyped-call]  # kombu is typed in parts
            self._consumer.add_task_queue(name)
        self._joined = wanted

    def report(self) -> WorkerReport:
        """Describe the present state of this worker."""
        jobs = tuple(str(request.id).rpartition(":")[2] for request in list(state.active_requests))
        unoccupied = WorkerState.HELD if self._held_reason else WorkerState.IDLE
        doing = WorkerState.WORKING if jobs else unoccupied
        memory = sum(_rss_bytes(pid) for pid in self._children())
        return WorkerReport(
            name=self._name,
            state=WorkerState.DRAINING if is_stopping() else doing,
            reason=self._held_reason,
            jobs=jobs,
            done=self._done,
            rss_bytes=memory,
        )

    def _children(self) -> list[int]:
        pool = getattr(getattr(self._consumer, "pool", None), "_pool", None)
        return [process.pid for process in getattr(pool, "_pool", ()) if process.pid]

    def _keep_memory(self) -> None:
        for pid in self._children():
            taken = _rss_bytes(pid)
            if taken > self._most_bytes:
                log.error("process %d takes %d MiB and is killed", pid, taken // 2**20)
                with suppress(ProcessLookupError, PermissionError):
                    kill_group(pid)

    def _bound_logs(self) -> None:
        for request in list(state.active_requests):
            with suppress(MessageError):
                self._logs.bound(JobMessage.decode((request.kwargs or {}).get("message")))

    def note_done(self) -> None:
        """Note that a picture was made."""
        self._done += 1
        self._crashed.clear()
        self._backoff.succeed()

    def note_unfit(self, fault: UnfitWorkerError) -> None:
        """Note that this worker can do no job: it takes none after the one that is about to be given back, and ends."""
        self.fault = self.fault or fault
        state.should_stop = fault.code

    def note_full(self, error: DestinationError) -> None:
        """Note that the store could not be written: take no job for a while. Called before the message goes back."""
        self._backoff.fail(str(error))
        self._join(set())

    def note_crash(self, request: Any) -> None:
        """Note that the process that ran a job has died, or was killed at the time limit."""
        with suppress(ProcessLookupError, PermissionError, TypeError):
            kill_group(request.worker_pid)
        try:
            message = JobMessage.decode((request.kwargs or {}).get("message"))
            if self._backoff.store_hangs:
                # It waited for its store until the time limit: neither the job nor this worker is at fault.
                owner = process_of_this_machine(request.worker_pid)
                self._open_ledger(message.dataset, message.spec_sha256).give_back(message.job_id, owner)
                return
            self._logs.bound(message)
            printed = self._logs.tail(message)
            ledger = self._open_ledger(message.dataset, message.spec_sha256)
            ledger.add_figures({"crashes": 1})
            if printed:
                ledger.keep_log(message.job_id, printed)
        except (MessageError, BrokerError) as error:
            log.warning("its log is not kept: %s", error)
            return
        if message.job_id not in self._crashed:
            self._crashed.append(message.job_id)
        if len(self._crashed) >= FAILED_IN_A_ROW:
            told = ", ".join(self._crashed)
            reason = f"the renderer died in {len(self._crashed)} jobs in a row: {told}; see {self._logs.path(message)}"
            self.note_unfit(UnfitWorkerError(reason, RenderError.exit_code))


def is_stopping() -> bool:
    """Whether this worker was told to end."""
    # Celery says False, None or an exit code, which may be 0.
    return any(code is not None and code is not False for code in (state.should_stop, state.should_terminate))


def kill_group(pid: int) -> None:
    """Kill a child of the pool, which leads a process group, and all that it has started.

    Raises:
        ProcessLookupError: if it is gone.
    """
    os.killpg(pid, signal.SIGKILL)


def _rss_bytes(pid: int) -> int:
    try:
        return int(Path(f"/proc/{pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, IndexError, ValueError):
        return 0
