"""The interface of every run registry, and the runs and workers' reports that it holds."""

from collections.abc import Mapping
from enum import IntEnum, StrEnum
from typing import Annotated, Protocol

from pydantic import ConfigDict, Field

from farm.model import Model, Sha256
from farm.spec.job import DatasetName, PlaceId, queue_key

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


class _Entry(Model):
    """An entry of the registry. Another release may have written it, so keys that are unknown here are passed over."""

    model_config = ConfigDict(extra="ignore")


class Run(_Entry):
    """The making of one dataset.

    Attributes:
        dataset: name of the dataset.
        spec_sha256: fingerprint of its description.
        priority: priority of the run.
        state: state of the run.
        place: id of the dataset's place, from `farm.dataset.place`; empty in entries of releases that have none.
        release: version of the farm that submitted the run, and alone works for it; empty where that was not written:
            then it is the version that made the dataset.
        located: description of the place by `farm.dataset.place.locate`, to know a copy by; empty if there is none.
    """

    dataset: DatasetName
    spec_sha256: Sha256
    priority: Priority = Priority.NORMAL
    state: RunState = RunState.ACTIVE
    place: PlaceId = ""
    release: Annotated[str, Field(max_length=100)] = ""
    located: str = ""

    @property
    def key(self) -> str:
        """Tells runs apart; see `farm.spec.job.queue_key`."""
        return queue_key(self.dataset, self.spec_sha256, self.place)

    @property
    def older_key(self) -> str:
        """Key that the run of the same dataset has in releases that know no places."""
        return queue_key(self.dataset, self.spec_sha256)

    def encode(self) -> str:
        """Write the entry; one without place and release is as the releases before them write it, and read it."""
        unknown = {name for name in ("place", "release", "located") if not getattr(self, name)}
        return self.model_dump_json(exclude=unknown)


class Refusal(StrEnum):
    """The reason why a worker doesn't serve a run."""

    NOT_HERE = "not here"
    OTHER_DESCRIPTION = "other description"
    OTHER_RELEASE = "other release"
    UNREADABLE = "unreadable"


class WorkerState(StrEnum):
    """The state of a worker."""

    IDLE = "idle"
    WORKING = "working"
    HELD = "held"
    DRAINING = "draining"


class WorkerReport(_Entry):
    """The report that a worker makes on itself every second.

    Attributes:
        name: `NAME@HOST`, as Flower shows it.
        state: state of the worker.
        reason: why the worker is held back; empty otherwise.
        jobs: ids of the jobs that it works on.
        done: number of jobs that it has finished since it started.
        rss_bytes: resident memory of its renderers in bytes.
        release: version of its farm; empty in reports of releases that don't tell it.
        serves: keys of the active runs that it works for.
        refuses: keys of active runs that it doesn't work for, each with a value of `Refusal`.
    """

    name: Annotated[str, Field(max_length=300)]
    state: WorkerState
    reason: str = ""
    jobs: tuple[str, ...] = ()
    done: int = 0
    rss_bytes: int = 0
    release: str = ""
    serves: tuple[str, ...] = ()
    refuses: Mapping[str, str] = {}


class RunRegistry(Protocol):
    """The registry of a farm's runs and workers. Every method may raise BrokerError."""

    def register(self, run: Run) -> Run:
        """Put a run up unless one with its key is there; returns the one that is there.

        Raises:
            ConflictError: if what is there can't be read; it is left as it is.
        """
        ...

    def replace(self, run: Run) -> None:
        """Put a run up in place of the one with its key, whatever that is: a person has asked for it."""
        ...

    def change(self, key: str, state: RunState, priority: Priority | None = None) -> bool:
        """Change a run that is up, and nothing else of its entry: another release may have written it.

        Args:
            key: key of the run.
            state: new state.
            priority: new priority; None leaves it.

        Returns:
            False if no run with this key is up.

        Raises:
            ConflictError: if what is there can't be read; it is left as it is.
        """
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
