"""A queue in memory: the twin of Celery's, for tests."""

from collections import deque
from collections.abc import Iterable

from farm.run.registry.port import Run
from farm.spec.job import Job, JobMessage


class MemoryQueue:
    """Implements `farm.run.queue.port.JobQueue`; `messages` are taken from the left."""

    def __init__(self) -> None:
        self.messages: deque[JobMessage] = deque()

    def submit(self, run: Run, messages: Iterable[JobMessage]) -> int:
        """Implement `JobQueue.submit`."""
        before = self.length(run)
        self.messages.extend(messages)
        return self.length(run) - before

    def length(self, run: Run) -> int:
        """Implement `JobQueue.length`."""
        return len(list(self.queued(run)))

    def queued(self, run: Run) -> Iterable[Job]:
        """Implement `JobQueue.queued`."""
        return [message.job for message in self.messages if message.key == run.key]

    def clear(self, run: Run) -> int:
        """Implement `JobQueue.clear`."""
        count = self.length(run)
        self.messages = deque(message for message in self.messages if message.key != run.key)
        return count
