"""A queue in memory: the twin of Celery's, for tests."""

from collections import deque
from collections.abc import Iterable

from farm.job import JobMessage


class MemoryQueue:
    """Implements `farm.queue.port.JobQueue`; `messages` are taken from the left."""

    def __init__(self) -> None:
        self.messages: deque[JobMessage] = deque()

    def submit(self, messages: Iterable[JobMessage]) -> int:
        """See `JobQueue.submit`."""
        before = len(self.messages)
        self.messages.extend(messages)
        return len(self.messages) - before

    def length(self) -> int:
        """See `JobQueue.length`."""
        return len(self.messages)

    def queued(self, dataset: str, spec_sha256: str) -> set[str]:
        """See `JobQueue.queued`."""
        asked = (dataset, spec_sha256)
        return {message.job_id for message in self.messages if (message.dataset, message.spec_sha256) == asked}
