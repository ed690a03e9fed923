"""What the coordinator needs of a queue."""

from collections.abc import Iterable
from typing import Protocol

from farm.job import JobMessage


class JobQueue(Protocol):
    """Jobs that wait for a worker. Every method may raise BrokerError."""

    def submit(self, messages: Iterable[JobMessage]) -> int:
        """Queue the messages, taking them one by one; returns how many."""
        ...

    def length(self) -> int:
        """Messages that wait, of all datasets."""
        ...

    def queued(self, dataset: str, spec_sha256: str) -> set[str]:
        """The ids of the jobs that wait, of the dataset with this name and fingerprint."""
        ...
