"""Worker processes on this machine: started, restarted when they die, ended."""

import subprocess
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Self

from farm.environment import own_environment
from farm.errors import BrokerError, DestinationError, MachineError, error_of
from farm.local.processes import stop
from farm.local.tied import tied
from farm.run.queue.broker import BROKER_VARIABLE
from farm.run.worker_settings import WorkerSettings
from farm.start import program

WORKER_COMMAND = program("worker.__main__")
"""Start of the command that runs the worker's program; `farm` never imports it."""

_SOON_S = 20.0
"""Seconds after its start within which a worker's end counts as soon."""

_SOON_TIMES = 3
"""Soon ends in a row after which a worker isn't started again."""


@dataclass(slots=True)
class _Running:
    name: str
    process: "subprocess.Popen[bytes]"
    started_s: float
    soon_deaths: int = 0


class LocalWorkers:
    """A number of workers that run inside `with`. The caller calls `supervise` now and then.

    Args:
        count: number of workers.
        settings: settings of each; its name is followed by a number from 1.
        broker_url: address of the Redis.
        command: command that runs the worker's program.
    """

    def __init__(
        self, count: int, settings: WorkerSettings, broker_url: str, command: Sequence[str] = WORKER_COMMAND
    ) -> None:
        self._names = [f"{settings.name}-{number}" for number in range(1, count + 1)]
        self._settings = settings
        self._broker_url = broker_url
        self._command = command
        self._running: list[_Running] = []

    def __enter__(self) -> Self:
        """Start them.

        Raises:
            DestinationError: if the logs can't be written.
        """
        try:
            self._settings.logs.mkdir(parents=True, exist_ok=True)
            for name in self._names:
                self.log_of(name).open("ab").close()
        except OSError as error:
            raise DestinationError(
                f"{self._settings.logs}: can't write logs: {error.strerror}; name another folder by --logs"
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
        """End them: after an error at once, else when they have had time to end by themselves, as they are idle."""
        self._stop(grace_s=10.0 if error is None else 1.0)

    def _start(self, name: str) -> "subprocess.Popen[bytes]":
        settings = self._settings.model_copy(update={"name": name})
        with self.log_of(name).open("ab") as log:
            return subprocess.Popen(  # noqa: S603 - our own program and arguments
                tied([*self._command, *settings.serve_arguments()]),
                env={**own_environment(), BROKER_VARIABLE: self._broker_url},
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )

    def _stop(self, grace_s: float = 1.0) -> None:
        stop([worker.process for worker in self._running], grace_s)
        self._running = []

    def log_of(self, name: str) -> Path:
        """Name the file that takes all that a worker prints."""
        return self._settings.logs / f"{name}.log"

    def supervise(self) -> None:
        """Start the workers that have ended again.

        Raises:
            FarmError: the fault with which a worker ended itself, as another would do the same on this machine.
            MachineError: if a worker keeps ending soon after its start.
        """
        for worker in self._running:
            code = worker.process.poll()
            if code is None:
                continue
            fault = error_of(code, f"{self._last_line(worker.name)}; the worker's log is {self.log_of(worker.name)}")
            # A Redis or a store that was away may be back at the next start.
            if fault is not None and not isinstance(fault, BrokerError | DestinationError):
                raise fault
            soon = time.monotonic() - worker.started_s < _SOON_S
            # A signal came from outside; an exit code is the worker's own.
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
