"""What the coordinator needs of a queue."""

from collections.abc import Iterable
from typing import Protocol

from farm.run.registry.port import Run
from farm.spec.job import Job, JobMessage


class JobQueue(Protocol):
    """Jobs that wait for a worker, those of each run apart. Every method may raise BrokerError."""

    def submit(self, run: Run, messages: Iterable[JobMessage]) -> int:
        """Queue the messages, taking them one by one; returns how many."""
        ...

    def length(self, run: Run) -> int:
        """Messages of a run that wait."""
        ...

    def queued(self, run: Run) -> Iterable[Job]:
        """The jobs of a run that wait. One that enters or leaves meanwhile may be missed, or seen twice."""
        ...

    def clear(self, run: Run) -> int:
        """Remove all messages of a run; returns how many."""
        ...
