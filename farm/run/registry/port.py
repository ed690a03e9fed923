"""The interface of every run registry, and the runs and workers' reports that it holds."""

from collections.abc import Mapping
from enum import IntEnum, StrEnum
from typing import Annotated, Protocol

from pydantic import Field

from farm.model import Model, Sha256
from farm.spec.job import DatasetName, queue_key

SEEN_S = 30.0
"""Seconds after which a worker that has not reported is gone. Workers report every second."""


class RunState(StrEnum):
    """The state of a run, as a person has set it."""

    ACTIVE = "active"
    PAUSED = "paused"
    CANCELLED = "cancelled"


class Priority(StrEnum):
    """Workers take from the run of the highest priority as long as it has jobs; runs of one priority take turns."""

    HIGH = "high"
    NORMAL = "normal"
    LOW = "low"

    @property
    def step(self) -> int:
        """The queue's own number for it, from 0, the most urgent, to 9."""
        return int(_Step[self.name])


class _Step(IntEnum):
    HIGH = 0
    NORMAL = 5
    LOW = 9


PRIORITY_STEPS = [int(step) for step in _Step]


class Run(Model):
    """The making of one dataset."""

    dataset: DatasetName
    spec_sha256: Sha256
    priority: Priority = Priority.NORMAL
    state: RunState = RunState.ACTIVE

    @property
    def key(self) -> str:
        """Tells runs apart; see `farm.spec.job.queue_key`."""
        return queue_key(self.dataset, self.spec_sha256)


class WorkerState(StrEnum):
    """The state of a worker."""

    IDLE = "idle"
    WORKING = "working"
    HELD = "held"
    DRAINING = "draining"


class WorkerReport(Model):
    """The report that a worker makes on itself every second.

    Attributes:
        name: `NAME@HOST`, as Flower shows it.
        state: state of the worker.
        reason: why the worker is held back; empty otherwise.
        jobs: ids of the jobs that it works on.
        done: number of jobs that it has finished since it started.
        rss_bytes: resident memory of its renderers in bytes.
    """

    name: Annotated[str, Field(max_length=300)]
    state: WorkerState
    reason: str = ""
    jobs: tuple[str, ...] = ()
    done: int = 0
    rss_bytes: int = 0


class RunRegistry(Protocol):
    """The registry of a farm's runs and workers. Every method may raise BrokerError."""

    def register(self, run: Run) -> Run:
        """Put a run up unless one with its key is there; returns the one that is there."""
        ...

    def replace(self, run: Run) -> None:
        """Put a run up in place of the one with its key."""
        ...

    def remove(self, key: str) -> None:
        """Take a run down."""
        ...

    def runs(self) -> Mapping[str, Run]:
        """Return the runs, by key."""
        ...

    def report(self, report: WorkerReport) -> None:
        """Put a worker's report up in place of its last."""
        ...

    def sign_off(self, name: str) -> None:
        """Take a worker's report down."""
        ...

    def workers(self) -> tuple[WorkerReport, ...]:
        """Return the reports of the workers seen within `SEEN_S`, by name."""
        ...
