"""The interface of every job queue, as the coordinator uses it."""

from collections.abc import Iterable
from typing import Protocol

from farm.run.registry.port import Run
from farm.spec.job import Job, JobMessage


class JobQueue(Protocol):
    """Jobs that wait for a worker, in a queue for each run. Every method may raise BrokerError."""

    def submit(self, run: Run, messages: Iterable[JobMessage]) -> int:
        """Queue the messages, taking them one by one; returns their number."""
        ...

    def length(self, run: Run) -> int:
        """Count a run's messages that wait."""
        ...

    def queued(self, run: Run) -> Iterable[Job]:
        """Yield the jobs of a run that wait. One that enters or leaves meanwhile may be missed, or seen twice."""
        ...

    def clear(self, run: Run) -> int:
        """Remove all messages of a run; returns their number."""
        ...
