"""Worker processes on this machine: started, restarted when they die, ended."""

import os
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Self

from farm.errors import BrokerError, DestinationError, MachineError, error_of
from farm.local.processes import stop
from farm.local.tied import tied
from farm.run.queue.broker import BROKER_VARIABLE
from farm.run.queue.settings import MEMORY_PER_CHILD_KIB, MIN_FREE_MIB, TASKS_PER_CHILD

WORKER_COMMAND = (sys.executable, "-P", "-m", "worker")
"""Started as a program of its own, as this package must not import it."""

_SOON_S = 20.0
_SOON_TIMES = 3


@dataclass(frozen=True, slots=True)
class WorkerOptions:
    """How workers run.

    Attributes:
        store: folder or URL below which the datasets lie.
        broker_url: the Redis.
        device: where Cycles renders.
        threads: of each worker's renderer; 0 for all cores.
        assets: folder of baked surfaces; None for the default one.
        logs: folder that takes each worker's log.
        tasks_per_child: a renderer is replaced after so many jobs.
        memory_per_child_kib: or when it has grown above this.
        min_free_mib: no job is taken while the store's disk has less room.
    """

    store: str
    broker_url: str
    device: str
    threads: int
    assets: Path | None
    logs: Path
    tasks_per_child: int = TASKS_PER_CHILD
    memory_per_child_kib: int = MEMORY_PER_CHILD_KIB
    min_free_mib: int = MIN_FREE_MIB

    def serve_arguments(self, name: str) -> list[str]:
        """Arguments of one worker's command."""
        arguments = ["serve", "--store", self.store, "--name", name, "--device", self.device]
        arguments += ["--threads", str(self.threads), "--logs", str(self.logs)]
        arguments += ["--tasks-per-child", str(self.tasks_per_child)]
        arguments += ["--memory-per-child-kib", str(self.memory_per_child_kib)]
        arguments += ["--min-free-mib", str(self.min_free_mib)]
        return arguments if self.assets is None else [*arguments, "--assets", str(self.assets)]

    def environment(self) -> Mapping[str, str]:
        """The environment of one worker; the broker's address is in it, as arguments can be seen by all."""
        return {**os.environ, BROKER_VARIABLE: self.broker_url}


@dataclass(slots=True)
class _Running:
    name: str
    process: "subprocess.Popen[bytes]"
    started_s: float
    soon_deaths: int = 0


class LocalWorkers:
    """A number of workers, inside `with`. Whoever holds this calls `supervise` now and then."""

    def __init__(
        self, count: int, options: WorkerOptions, command: Sequence[str] = WORKER_COMMAND, *, name: str = "local"
    ) -> None:
        self._names = [f"{name}-{number}" for number in range(1, count + 1)]
        self._options = options
        self._command = command
        self._running: list[_Running] = []

    def __enter__(self) -> Self:
        """Start them."""
        try:
            self._options.logs.mkdir(parents=True, exist_ok=True)
            for name in self._names:
                self.log_of(name).open("ab").close()
        except OSError as error:
            raise DestinationError(
                f"{self._options.logs}: can't write logs: {error.strerror}; name another folder by --logs"
            ) from error
        try:
            for name in self._names:
                self._running.append(_Running(name, self._start(name), time.monotonic()))
        except BaseException:
            self._stop()
            raise
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        """End them: at the end of the work they are idle; on an error nobody waits for a picture."""
        self._stop(grace_s=10.0 if error is None else 1.0)

    def _start(self, name: str) -> "subprocess.Popen[bytes]":
        with self.log_of(name).open("ab") as log:
            return subprocess.Popen(  # noqa: S603 - our own program and arguments
                tied([*self._command, *self._options.serve_arguments(name)]),
                env=self._options.environment(),
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )

    def _stop(self, grace_s: float = 1.0) -> None:
        stop([worker.process for worker in self._running], grace_s)
        self._running = []

    def log_of(self, name: str) -> Path:
        """The file that takes all that a worker prints."""
        return self._options.logs / f"{name}.log"

    def supervise(self) -> None:
        """Restart the dead.

        Raises:
            FarmError: that with which a worker ended itself, as another would do the same on this machine.
            MachineError: if a worker keeps ending soon after its start.
        """
        for worker in self._running:
            code = worker.process.poll()
            if code is None:
                continue
            fault = error_of(code, f"{self._last_line(worker.name)}; the worker's log is {self.log_of(worker.name)}")
            # A Redis or store that was away when it started is back at the next start, or that fails in its turn.
            if fault is not None and not isinstance(fault, BrokerError | DestinationError):
                raise fault
            soon = time.monotonic() - worker.started_s < _SOON_S
            # A signal is somebody's doing, an exit its own.
            worker.soon_deaths = worker.soon_deaths + 1 if soon and code >= 0 else 0
            if worker.soon_deaths >= _SOON_TIMES:
                raise MachineError(
                    f"worker {worker.name} ended {_SOON_TIMES} times right after its start (exit code {code}): "
                    f"{self._last_line(worker.name)}; its log is {self.log_of(worker.name)}; try farm doctor"
                )
            stop([worker.process], grace_s=0.0)
            worker.process, worker.started_s = self._start(worker.name), time.monotonic()

    def _last_line(self, name: str) -> str:
        try:
            lines = self.log_of(name).read_text(errors="replace").strip().splitlines()
        except OSError:
            lines = []
        return lines[-1].strip() if lines else "it left no message"
