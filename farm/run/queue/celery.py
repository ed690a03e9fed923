"""Celery's queues, seen from the coordinator: sending tasks by name, and looking at those that wait."""

import json
from collections.abc import Iterable, Iterator
from typing import Any, cast

import redis
from kombu.exceptions import BatchPublishError, OperationalError

from farm.errors import BrokerError, MessageError
from farm.run.queue.broker import as_broker_error
from farm.run.queue.refusals import explained
from farm.run.queue.settings import TASK_NAME, queue_name
from farm.run.registry.port import PRIORITY_STEPS, Run
from farm.spec.job import Job, JobMessage

_PAGE = 500
_BATCH = 500
_PRIORITY_MARK = "\x06\x16"
"""Separator that kombu puts between a queue's name and a priority step in the name of a Redis list. The name for step 0
is the queue's name alone."""


class CeleryQueue:
    """Implements `farm.run.queue.port.JobQueue`.

    Args:
        app: from `make_app`.
        client: a client of the same Redis, with `decode_responses=True`.
    """

    def __init__(self, app: Any, client: "redis.Redis") -> None:
        self._app = app
        self._client = client

    def submit(self, run: Run, messages: Iterable[JobMessage]) -> int:
        """See `JobQueue.submit`. A batch goes to Redis whole; a batch that is cut off counts as not queued."""
        count = 0
        try:
            with self._app.producer_pool.acquire(block=True) as producer, producer.batch(max_size=_BATCH):
                for message in messages:
                    self._app.send_task(
                        TASK_NAME,
                        kwargs={"message": message.encode()},
                        task_id=message.task_id,
                        queue=queue_name(run.key),
                        priority=run.priority.step,
                        producer=producer,
                        retry=False,
                        # Flower shows these instead of the whole message.
                        argsrepr=message.dataset,
                        kwargsrepr=message.job_id,
                    )
                    count += 1
        except (BatchPublishError, OperationalError, redis.RedisError, OSError) as error:
            raise BrokerError(
                f"Redis failed after about {count} queued jobs: {explained(error)}; submit again, nothing is doubled"
            ) from error
        return count

    def length(self, run: Run) -> int:
        """See `JobQueue.length`."""
        with as_broker_error():
            pipe = self._client.pipeline(transaction=False)
            for name in _lists(run):
                pipe.llen(name)
            return sum(pipe.execute())

    def queued(self, run: Run) -> Iterator[Job]:
        """See `JobQueue.queued`. Messages enter on the left, so reading from there misses none that stays."""
        with as_broker_error():
            for name in _lists(run):
                start = 0
                while page := cast(list[str], self._client.lrange(name, start, start + _PAGE - 1)):
                    for key, job in map(_names, page):
                        if key == run.key and job is not None:
                            yield job
                    start += _PAGE

    def clear(self, run: Run) -> int:
        """See `JobQueue.clear`."""
        count = self.length(run)
        with as_broker_error():
            self._client.delete(*_lists(run))
        return count


def _lists(run: Run) -> list[str]:
    name = queue_name(run.key)
    return [f"{name}{_PRIORITY_MARK}{step}" if step else name for step in PRIORITY_STEPS]


def _names(envelope: str) -> tuple[str, Job | None]:
    # The task's id is in the envelope's headers, so the body need not be decoded. Foreign messages are passed over.
    try:
        key, _, job_id = str(json.loads(envelope)["headers"]["id"]).rpartition(":")
        return key, Job.from_id(job_id)
    except (ValueError, TypeError, KeyError, RecursionError, MessageError):
        return "", None
